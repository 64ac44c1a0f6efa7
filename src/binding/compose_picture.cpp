#include "binding/compose_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/units.h"
#include "binding/compose_envelope.h"
#include "binding/compose_tubes.h"

namespace tendril {
namespace {

using Box = Eigen::AlignedBox3d;

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string millimetres(double metres) {
  if (!std::isfinite(metres)) return "none";
  return text(std::abs(metres) < 0.1 ? "%.3g mm" : "%.4g mm", metres / units::mm);
}

std::string seconds(double value) { return value < 1 ? text("%.3g ms", 1e3 * value) : text("%.3g s", value); }

constexpr Rgb robot_colour{0.88f, 0.56f, 0.22f};

/// What a picture shows of the scene, from the equilibrium when there is one.
struct Shown {
  const std::vector<PlacedObstacle>& obstacles;
  const SceneEquilibrium* equilibrium;
  Box rods;  ///< around the rods' surfaces, or around the holds of a scene that is not solved
  Box envelope = {};
  Box carriers = {};  ///< around the robots that carry rods
};

Box box_of_tube(const PictureTube& tube) {
  Box box;
  for (const Vec3& p : tube.points) box.extend(p);
  return box.isEmpty() ? box : Box(box.min().array() - tube.radius, box.max().array() + tube.radius);
}

/// "arm" of "arm.link_3"; empty for what is no link.
std::string robot_of(const PlacedObstacle& obstacle) { return obstacle.of_robot ? obstacle.name.substr(0, obstacle.name.find('.')) : ""; }

/// By its own name, or a link by its robot's.
bool is_named(const PlacedObstacle& obstacle, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return name == obstacle.name || name == robot_of(obstacle); });
}

/// Around the robots that carry rods.
Box box_of_carriers(const SceneEquilibrium& eq) {
  std::vector<std::string> carriers;
  for (const SolvedRod& rod : eq.rods)
    for (const Fastening& one : rod.problem.fastenings) carriers.push_back(robot_of(eq.obstacles[one.obstacle]));
  Box box;
  for (int k = 0; k < static_cast<int>(eq.obstacles.size()); ++k)
    if (eq.obstacles[k].of_robot && is_named(eq.obstacles[k], carriers)) box.extend(eq.surroundings->box_of(k));
  return box;
}

void add_surfaces(const Shown& shown, const PictureWish& wish, Picture& picture) {
  for (const PlacedObstacle& obstacle : shown.obstacles) {
    const std::shared_ptr<const Mesh> mesh = drawn_mesh(obstacle, shown.rods);
    PictureSurface surface;
    surface.name = obstacle.name;
    surface.vertices = mesh->vertices;
    surface.triangles = mesh->triangles;
    surface.owner = mesh;
    surface.pose = obstacle.body.pose;
    const bool ghost = wish.ghost ? is_named(obstacle, *wish.ghost) : !obstacle.of_robot;
    surface.style = ghost ? SurfaceStyle::ghost : SurfaceStyle::solid;
    if (obstacle.of_robot) surface.colour = robot_colour;
    picture.surfaces.push_back(std::move(surface));
  }
}

PictureHold::Kind kind_of(const Hold& hold) {
  if (hold.position && hold.orientation) return PictureHold::Kind::clamp;
  return hold.position ? PictureHold::Kind::pin : PictureHold::Kind::guide;
}

void add_holds(const Rod& rod, const std::vector<Hold>& holds, const Equilibrium* solved, Picture& picture) {
  for (const Hold& hold : holds) {
    PictureHold marker;
    marker.frame = solved ? solved->frame_at(hold.at) : hold.frame;
    marker.radius = rod.section_at(hold.at).radius();
    marker.kind = kind_of(hold);
    picture.holds.push_back(marker);
  }
}

void add_loads(const SolvedRod& rod, Picture& picture) {
  for (const PointLoad& load : rod.problem.loads) {
    if (load.force.isZero(0)) continue;
    PictureArrow arrow;
    arrow.at = rod.equilibrium.frame_at(load.at).at;
    arrow.direction = load.force;
    arrow.label = text("%.3g N", load.force.norm());
    picture.arrows.push_back(arrow);
  }
}

using Gap = SceneEquilibrium::JudgedGap;
using Gaps = std::vector<Gap>;

/// A gap drawn from surface to surface.
void add_gap_label(const SolvedRod& rod, const Gap& judged, Picture& picture) {
  const Clearance& gap = judged.gap;
  PictureLabel label;
  const double radius = rod.problem.rod.section_at(gap.s).radius();
  const double way = (gap.on - gap.at).norm();
  label.at = way > 0 ? Vec3(gap.at + (gap.on - gap.at) * std::min(1.0, radius / way)) : gap.at;
  label.to = gap.on;
  const bool touches = std::abs(gap.value) < 0.01 * radius;
  label.text = touches ? "touches" : gap.value > 0 ? "gap " + millimetres(gap.value) : "overlap " + millimetres(-gap.value);
  label.alarm = judged.too_close;
  picture.labels.push_back(label);
}

using Rows = std::vector<PictureCard::Row>;

void add_rod_rows(const SceneEquilibrium& eq, const SolvedRod& rod, const Gaps& gaps, bool alone, Rows& rows) {
  const std::string prefix = alone ? "" : rod.name + ": ";
  rows.push_back({prefix + "length", text("%.4g m", rod.problem.rod.length), false});
  const double bend = rod.equilibrium.smallest_bend_radius();
  rows.push_back({prefix + "min. bend radius", bend > 1e3 * rod.problem.rod.length ? "straight" : millimetres(bend), false});
  if (!eq.obstacles.empty() && gaps.empty()) rows.push_back({prefix + "min. clearance", "none near", false});
  constexpr std::size_t most = 4;  // obstacles with rows of their own
  for (std::size_t i = 0; i < std::min(most, gaps.size()); ++i) {
    const std::string& name = eq.obstacles[gaps[i].gap.obstacle].name;
    std::string value = millimetres(gaps[i].gap.value);
    if (i == 0 && eq.obstacles.size() > 1) value += " to " + name;
    if (gaps[i].required > 0) value += " (required " + millimetres(gaps[i].required) + ")";
    rows.push_back({prefix + (i == 0 ? "min. clearance" : "clearance to " + name), value, gaps[i].too_close});
  }
}

PictureCard card_of(const SceneEquilibrium& eq, const std::vector<Gaps>& gaps, const std::string& title) {
  PictureCard card;
  card.title = title.empty() ? (eq.rods.size() == 1 ? eq.rods.front().name : "equilibrium") : title;
  card.rows.push_back({"status", eq.ok() ? (eq.stable() ? "solved, stable" : "solved, not stable") : name_of(eq.status()),
                       !eq.ok() || !eq.stable()});
  constexpr std::size_t most = 4;  // rods with rows of their own; more would not fit the card
  for (std::size_t i = 0; i < std::min(most, eq.rods.size()); ++i)
    add_rod_rows(eq, eq.rods[i], gaps[i], eq.rods.size() == 1, card.rows);
  if (eq.rods.size() > most) card.rows.push_back({"rods", std::to_string(eq.rods.size()), false});
  card.rows.push_back({"residual", text("%.2g N", eq.residual()), false});
  if (const auto error = eq.error())
    card.rows.push_back({"estimated error", error->valid ? text("%.2g mm", error->value / units::mm) : "not valid", !error->valid});
  else
    card.rows.push_back({"estimated error", "not asked for", false});
  if (eq.seconds > 0) card.rows.push_back({"solved in", seconds(eq.seconds), false});  // a state of a motion was not solved by itself
  card.rows.push_back({"tendril", TENDRIL_VERSION, false});
  return card;
}

bool is_link_of(const Shown& shown, const std::string& surface, const std::string& robot) {
  return std::any_of(shown.obstacles.begin(), shown.obstacles.end(),
                     [&](const PlacedObstacle& o) { return o.name == surface && robot_of(o) == robot; });
}

std::optional<PictureBox> fit_box(const Shown& shown, const Picture& picture, const std::vector<std::string>& wanted) {
  if (wanted.empty() && shown.envelope.isEmpty() && shown.carriers.isEmpty()) return std::nullopt;
  Box box = wanted.empty() ? Box(shown.rods.merged(shown.envelope).merged(shown.carriers)) : Box();
  for (const std::string& name : wanted) {
    std::vector<std::string> names;
    Box found;
    for (const PictureTube& tube : picture.tubes) {
      names.push_back(tube.name);
      if (tube.name == name) found = box_of_tube(tube);
    }
    for (const PictureSurface& surface : picture.surfaces) {
      names.push_back(surface.name);
      if (surface.name == name || is_link_of(shown, surface.name, name))
        for (const Vec3& v : surface.vertices) found.extend(surface.pose.at + surface.pose.rotation * v);
    }
    if (found.isEmpty() && std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError("view:save: 'fit': unknown name " + unknown_name(name, "rods and obstacles", names));
    box.extend(found);
  }
  if (box.isEmpty()) box = shown.rods;
  return PictureBox{box.min(), box.max()};
}

/// Labels the smallest gap of all rods, and every other that falls short of what is required.
void add_gap_labels(const SceneEquilibrium& eq, const std::vector<Gaps>& gaps, Picture& picture) {
  const Gap* tightest = nullptr;
  for (const Gaps& of_rod : gaps)
    if (!of_rod.empty() && (!tightest || of_rod.front().gap.value < tightest->gap.value)) tightest = &of_rod.front();
  for (std::size_t i = 0; i < gaps.size(); ++i)
    for (const Gap& gap : gaps[i])
      if (&gap == tightest || gap.too_close) add_gap_label(eq.rods[i], gap, picture);
}

void add_solved(const SceneEquilibrium& eq, const PictureWish& wish, Picture& picture) {
  std::vector<Gaps> gaps;
  for (const SolvedRod& rod : eq.rods) {
    gaps.push_back(eq.judged_gaps(rod));
    add_holds(rod.problem.rod, rod.problem.holds, &rod.equilibrium, picture);
    add_loads(rod, picture);
  }
  add_gap_labels(eq, gaps, picture);
  picture.scale = compose_scale(eq, wish.colour);
  picture.card = card_of(eq, gaps, wish.title);
}

}  // namespace

void compose_check(const Scene& scene, const SceneEquilibrium* eq, const PictureWish& wish) {
  std::vector<std::string> names;
  for (const PlacedObstacle& obstacle : eq ? eq->obstacles : scene.bodies()) {
    names.push_back(obstacle.name);
    const std::string robot = robot_of(obstacle);
    if (!robot.empty() && std::find(names.begin(), names.end(), robot) == names.end()) names.push_back(robot);
  }
  if (!wish.ghost) return;
  for (const std::string& name : *wish.ghost)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError("view.new: 'ghost': unknown obstacle " + unknown_name(name, "obstacles", names));
}

Picture compose_picture(const Scene& scene, const SceneEquilibrium* eq, const PictureWish& wish) {
  compose_check(scene, eq, wish);
  Picture picture;
  picture.views = wish.views;
  picture.width = wish.width;
  picture.height = wish.height;
  Shown shown{eq ? eq->obstacles : scene.bodies(), eq, {}};
  const bool shell_coloured = wish.envelope && wish.colour == RodColour::clearance && !shown.obstacles.empty();
  PictureWish rod_wish = wish;
  if (shell_coloured) rod_wish.colour = RodColour::plain;
  if (eq) picture.tubes = compose_tubes(*eq, rod_wish);
  if (!wish.designs.empty()) {
    if (!eq) picture.card.title = wish.title.empty() ? "designs" : wish.title;
    add_designs(wish.designs, picture);
  }
  picture.tubes.insert(picture.tubes.end(), wish.extras.tubes.begin(), wish.extras.tubes.end());
  for (const PictureTube& tube : picture.tubes) shown.rods.extend(box_of_tube(tube));
  if (!eq)
    for (const auto& rod : scene.rods())
      for (const Hold& hold : rod->holds()) shown.rods.extend(hold.frame.at);
  if (eq) shown.carriers = box_of_carriers(*eq);
  add_surfaces(shown, wish, picture);
  if (eq) {
    add_solved(*eq, rod_wish, picture);
  } else if (!wish.designs.empty()) {
    if (wish.gap_scale) picture.scale = *wish.gap_scale;
    picture.card.rows.push_back({"tendril", TENDRIL_VERSION, false});
  } else {
    for (const auto& rod : scene.rods()) add_holds(rod->rod(), rod->holds(), nullptr, picture);
    picture.card.title = wish.title.empty() ? "scene" : wish.title;
    picture.card.rows = {{"status", "not solved", false},
                         {"rods", std::to_string(scene.rods().size()), false},
                         {"obstacles", std::to_string(scene.obstacles().size()), false},
                         {"tendril", TENDRIL_VERSION, false}};
  }
  picture.paths = wish.extras.paths;
  picture.labels.insert(picture.labels.end(), wish.extras.labels.begin(), wish.extras.labels.end());
  picture.card.rows.insert(picture.card.rows.end(), wish.extras.rows.begin(), wish.extras.rows.end());
  if (wish.envelope) {
    shown.envelope = wish.envelope->box();
    add_envelope(wish.envelope, shown.obstacles, shell_coloured, picture);
  }
  picture.fit = fit_box(shown, picture, wish.fit);
  return picture;
}

}  // namespace tendril
