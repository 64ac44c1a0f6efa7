#include "scene/scene_surfaces.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "geometry/tube_surface.h"

namespace tendril {

namespace {

using States = std::vector<std::shared_ptr<const SceneEquilibrium>>;

constexpr int most_sections = 2000;

/// The colours of M. Okabe and K. Ito (2008), which colour-blind eyes tell apart too, without black and yellow.
std::array<float, 3> colour_of_rod(std::size_t number) {
  static constexpr std::array<std::array<float, 3>, 6> colours = {{{0, 0.447f, 0.698f},
                                                                  {0.835f, 0.369f, 0},
                                                                  {0, 0.620f, 0.451f},
                                                                  {0.902f, 0.624f, 0},
                                                                  {0.8f, 0.475f, 0.655f},
                                                                  {0.337f, 0.706f, 0.914f}}};
  return colours[number % colours.size()];
}

void check_shape(const SolvedRod& rod) {
  const Equilibrium& eq = rod.equilibrium;
  bool sound = eq.points.size() >= 2 && eq.rotations.size() == eq.points.size() && eq.s.size() == eq.points.size();
  for (const Vec3& p : eq.points) sound = sound && p.allFinite();
  if (!sound)
    throw UsageError("surfaces: rod '" + rod.name + "' has no shape in this equilibrium" +
                     (eq.message.empty() ? "" : " (" + eq.message + ")") + "; solve the scene first");
}

/// How a rod is cut into a tube: the same in every state of a motion.
struct TubeMesh {
  std::vector<double> places;  ///< arc lengths of its sections, m
  std::vector<double> radii;
  int sides;
};

TubeMesh tube_of(const SolvedRod& rod, double sharpest, double wanted) {
  const Rod& design = rod.problem.rod;
  const double radius = design.largest_radius(), tolerance = wanted > 0 ? wanted : 0.02 * radius;
  // The sagitta of a step h on a bend of radius r is h^2 / (8 r).
  const double step = std::sqrt(8 * std::max(sharpest, radius) * tolerance);
  const double least = static_cast<double>(std::min<std::size_t>(rod.equilibrium.points.size(), most_sections) - 1);
  const int count = static_cast<int>(std::clamp(std::ceil(design.length / step), std::max(least, 1.0), most_sections - 1.0));
  TubeMesh tube;
  for (int i = 0; i <= count; ++i) {
    tube.places.push_back(i < count ? design.length * i / count : design.length);
    tube.radii.push_back(design.section_at(tube.places.back()).radius());
  }
  tube.sides = sides_for(radius, tolerance);
  return tube;
}

std::vector<Frame> sections_of(const SolvedRod& rod, const TubeMesh& tube) {
  std::vector<Frame> sections;
  for (const double s : tube.places) sections.push_back(rod.equilibrium.frame_at(s));
  return sections;
}

SurfacePart part_of(const SolvedRod& rod, std::size_t number, const TubeMesh& tube, const std::vector<Frame>& sections) {
  SurfacePart part;
  part.name = rod.name;
  part.mesh = std::make_shared<const Mesh>(tube_surface(sections, tube.radii, tube.sides));
  part.colour = colour_of_rod(number);
  part.smooth = true;
  return part;
}

SurfacePart part_of(const PlacedObstacle& body, const Eigen::AlignedBox3d& around) {
  SurfacePart part;
  part.name = body.name;
  part.mesh = drawn_mesh(body, around);
  part.pose = body.body.pose;
  part.colour = body.of_robot ? std::array{0.85f, 0.55f, 0.25f} : std::array{0.70f, 0.69f, 0.67f};
  part.opacity = body.of_robot ? 1 : 0.5f;
  part.double_sided = true;
  return part;
}

bool is_shown(const PlacedObstacle& body, const SurfaceOptions& options) { return body.of_robot ? options.robots : options.obstacles; }

Eigen::AlignedBox3d box_of_rods(const SceneEquilibrium& state) {
  Eigen::AlignedBox3d box;
  for (const SolvedRod& rod : state.rods)
    for (const Vec3& p : rod.equilibrium.points) box.extend(p);
  return box;
}

void check_options(const SurfaceOptions& options) {
  if (!(std::isfinite(options.tolerance) && options.tolerance >= 0))
    throw UsageError("surfaces: the tolerance is not a finite number of at least 0");
}

bool same_names(const SceneEquilibrium& a, const SceneEquilibrium& b) {
  const auto same = [](const auto& x, const auto& y) { return x.name == y.name; };
  return std::equal(a.rods.begin(), a.rods.end(), b.rods.begin(), b.rods.end(), same) &&
         std::equal(a.obstacles.begin(), a.obstacles.end(), b.obstacles.begin(), b.obstacles.end(), same);
}

void check_states(const States& states) {
  if (states.size() < 2) throw UsageError("surfaces: a motion of " + std::to_string(states.size()) + " states; at least 2 expected");
  for (const auto& state : states)
    if (!same_names(*states.front(), *state)) throw UsageError("surfaces: the states of the motion do not hold the same rods and bodies");
}

bool same(const Frame& a, const Frame& b) { return a.at == b.at && a.rotation.coeffs() == b.rotation.coeffs(); }

MovingPart moving_rod(const States& states, std::size_t number, const SurfaceOptions& options) {
  double sharpest = INFINITY;
  for (const auto& state : states) {
    check_shape(state->rods[number]);
    sharpest = std::min(sharpest, state->rods[number].equilibrium.smallest_bend_radius());
  }
  const SolvedRod& rod = states.front()->rods[number];
  const TubeMesh tube = tube_of(rod, sharpest, options.tolerance);
  MovingPart moving;
  for (const auto& state : states) moving.sections.push_back(sections_of(state->rods[number], tube));
  moving.part = part_of(rod, number, tube, moving.sections.front());
  moving.section_of_vertex = section_of_vertex(static_cast<int>(tube.places.size()), tube.sides);
  return moving;
}

MovingPart moving_body(const States& states, std::size_t number, const Eigen::AlignedBox3d& around) {
  MovingPart moving;
  moving.part = part_of(states.front()->obstacles[number], around);
  bool moves = false;
  for (const auto& state : states) {
    moving.poses.push_back(state->obstacles[number].body.pose);
    moves = moves || !same(moving.poses.back(), moving.poses.front());
  }
  if (!moves) moving.poses.clear();
  return moving;
}

void append_number(std::string& out, double value) {
  char digits[32];
  out += ',';
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::vector<SurfacePart> surfaces_of(const SceneEquilibrium& equilibrium, const SurfaceOptions& options) {
  check_options(options);
  std::vector<SurfacePart> parts;
  for (std::size_t i = 0; options.rods && i < equilibrium.rods.size(); ++i) {
    const SolvedRod& rod = equilibrium.rods[i];
    check_shape(rod);
    const TubeMesh tube = tube_of(rod, rod.equilibrium.smallest_bend_radius(), options.tolerance);
    parts.push_back(part_of(rod, i, tube, sections_of(rod, tube)));
  }
  const Eigen::AlignedBox3d around = box_of_rods(equilibrium);
  for (const PlacedObstacle& body : equilibrium.obstacles)
    if (is_shown(body, options)) parts.push_back(part_of(body, around));
  return parts;
}

std::vector<SurfacePart> surfaces_of(const Scene& scene, const SurfaceOptions& options) {
  check_options(options);
  Eigen::AlignedBox3d around;
  for (const auto& rod : scene.rods())
    for (const Hold& hold : rod->holds()) around.extend(hold.frame.at);
  std::vector<SurfacePart> parts;
  for (const PlacedObstacle& body : scene.bodies())
    if (is_shown(body, options)) parts.push_back(part_of(body, around));
  return parts;
}

std::vector<MovingPart> moving_surfaces_of(const States& states, const SurfaceOptions& options) {
  check_options(options);
  check_states(states);
  const SceneEquilibrium& first = *states.front();
  std::vector<MovingPart> parts;
  for (std::size_t i = 0; options.rods && i < first.rods.size(); ++i) parts.push_back(moving_rod(states, i, options));
  Eigen::AlignedBox3d around;
  for (const auto& state : states) around.extend(box_of_rods(*state));
  for (std::size_t i = 0; i < first.obstacles.size(); ++i)
    if (is_shown(first.obstacles[i], options)) parts.push_back(moving_body(states, i, around));
  return parts;
}

std::vector<MovingPart> moving_bodies_of(const std::vector<CarriedBody>& bodies, const States& states) {
  check_states(states);
  std::vector<MovingPart> parts;
  for (const CarriedBody& carried : bodies) {
    PlacedObstacle shown;
    shown.name = carried.name;
    shown.body = carried.body;
    MovingPart moving;
    moving.part = part_of(shown, {});
    moving.part.opacity = 1;
    for (const auto& state : states) {
      const SolvedRod& rod = state->rod(carried.rod);
      check_shape(rod);
      moving.poses.push_back(rod.equilibrium.frame_at(carried.at) * carried.body.pose);
      moving.poses.back().rotation.normalize();
    }
    moving.part.pose = moving.poses.front();
    parts.push_back(std::move(moving));
  }
  return parts;
}

std::string rods_csv(const SceneEquilibrium& equilibrium) {
  std::string text = "rod,s (m),x (m),y (m),z (m),tangent x,tangent y,tangent z,bend radius (m),tension (N)\n";
  for (const SolvedRod& rod : equilibrium.rods) {
    check_shape(rod);
    const Equilibrium& eq = rod.equilibrium;
    const std::vector<double> radii = eq.bend_radii();
    const std::string name = csv_field(rod.name);
    for (std::size_t i = 0; i < eq.points.size(); ++i) {
      const std::size_t segment = std::min(i, eq.forces.size() - 1);
      const Vec3 tangent = eq.rotations[i] * Vec3::UnitZ();
      text += name;
      append_number(text, eq.s[i]);
      for (int k = 0; k < 3; ++k) append_number(text, eq.points[i][k]);
      for (int k = 0; k < 3; ++k) append_number(text, tangent[k]);
      append_number(text, radii[i]);
      append_number(text, eq.forces[segment].dot((eq.points[segment + 1] - eq.points[segment]).normalized()));
      text += '\n';
    }
  }
  return text;
}

}  // namespace tendril
