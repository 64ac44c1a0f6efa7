#include "method/route/harness_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "base/units.h"
#include "method/route/route_guess.h"

namespace tendril::routing {

namespace {

constexpr double least_miss = 2e-5;  // m: the route's certificate leaves half of it

std::string name_of_junction(int number) { return "junction " + std::to_string(number + 1); }

/// Segments by the route's length: refinement keeps their number.
Rod rod_of(const HarnessBranch& branch, double length, const HarnessOptions& options) {
  const int segments = std::clamp(static_cast<int>(std::ceil(branch.length / options.segment)), 4, Rod::max_segments);
  return Rod::uniform(length, options.section, segments);
}

/// Arc lengths of a rod (m) outside its free ends.
struct Kept {
  double from, to;
};
Kept kept_of(const HarnessBranch& branch, double length, const HarnessOptions& options) {
  return {branch.from.junction ? 0 : options.free_ends, length - (branch.to.junction ? 0 : options.free_ends)};
}

/// m of the rod, outside its free ends, where its surface is within an obstacle by more than contact leaves.
double length_within(const SceneEquilibrium& eq, const SolvedRod& rod, const Kept& kept) {
  if (!eq.surroundings || !(kept.to > kept.from)) return 0;
  const double radius = rod.problem.rod.largest_radius();
  const int count = std::clamp(static_cast<int>(std::ceil((kept.to - kept.from) / (0.5 * radius))), 8, 100000);
  const double piece = (kept.to - kept.from) / count;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = rod.equilibrium.frame_at(kept.from + (i + 0.5) * piece).at;
    const ClosestPoint closest = eq.surroundings->closest(at, 2 * radius);
    if (closest.obstacle >= 0 && too_close(closest.distance - radius, 0, radius)) sum += piece;
  }
  return sum;
}

std::string mm(double value) { return number_text(std::round(value / units::mm * 100) / 100) + " mm"; }

/// What one branch at rest does not keep, though its route does.
class RestReport {
 public:
  RestReport(HarnessResult& harness, int branch)
      : harness_(harness), branch_(harness.branches[branch]), rod_(harness.equilibrium->rods[branch]) {}

  void judge(const Kept& kept) {
    const HarnessOptions& options = harness_.options;
    if (branch_.settled_bend_radius < options.min_bend_radius * (1 - 1e-6))
      add("bend radius " + mm(branch_.settled_bend_radius) + ", " + mm(options.min_bend_radius) + " demanded",
          1 - branch_.settled_bend_radius / options.min_bend_radius);
    if (kept.to > kept.from) {
      judge_obstacles(kept);
      judge_zones(kept);
    }
    const double stretch = branch_.settled_length / rod_.problem.rod.length - 1;
    if (options.refine && stretch > options.max_stretch + 1e-6)
      add("stretched by " + number_text(std::round(stretch * 1e4) / 100) + " %, at most " + number_text(options.max_stretch * 100) + " % allowed",
          stretch - options.max_stretch);
  }

 private:
  void add(const std::string& what, double share) {
    harness_.settled_misses.push_back(branch_.name + ": " + what);
    harness_.missed_share += share;
  }
  void too_near(double gap, double demanded, const std::string& name) {
    const double radius = harness_.options.section.radius();
    const std::string how = too_close(gap, 0, radius) ? "penetrates " + name + " by " + mm(-gap)
                            : gap < least_miss       ? "touches " + name
                                                     : "gap " + mm(gap) + " to " + name;
    add(how + ", " + mm(demanded) + " demanded", (demanded - gap) / std::max(demanded, radius));
  }
  void judge_obstacles(const Kept& kept) {
    const Surroundings& demanded = harness_.space->surroundings();
    const double radius = harness_.options.section.radius();
    const Clearance& nearest = branch_.settled_clearance;
    if (nearest.obstacle < 0 || nearest.value >= demanded.largest_clearance()) return;
    for (int k = 0; k < harness_.space->first_zone(); ++k) {
      const double clearance = demanded.clearance(k);
      const Clearance gap = k == nearest.obstacle ? nearest : harness_.equilibrium->clearance(rod_, k, kept.from, kept.to);
      if (gap.obstacle < 0) continue;
      const bool missed = clearance > 0 ? gap.value < clearance - least_miss : too_close(gap.value, 0, radius);
      if (missed) too_near(gap.value, clearance, "'" + harness_.space->name(k) + "'");
    }
  }
  void judge_zones(const Kept& kept) {
    const FreeSpace& space = *harness_.space;
    const Surroundings& zones = space.surroundings();
    const double radius = harness_.options.section.radius();
    for (int k = space.first_zone(); k < zones.size(); ++k) {
      const Clearance gap = clearance_of(rod_.problem.rod, rod_.equilibrium,
                                         [&](const Vec3& p) { return zones.closest_on(k, p, std::numeric_limits<double>::infinity()); },
                                         kept.from, kept.to);
      if (gap.value < -least_miss) too_near(gap.value, 0, space.name(k));
    }
    if (!harness_.options.space.keep_in) return;
    double out = 0;
    for (const Vec3& p : rod_.equilibrium.points)
      for (int axis = 0; axis < 3; ++axis)
        out = std::max({out, harness_.options.space.keep_in->min()[axis] + radius - p[axis], p[axis] + radius - harness_.options.space.keep_in->max()[axis]});
    if (out > least_miss) add(mm(out) + " outside of keep_in", out / radius);
  }

  HarnessResult& harness_;
  HarnessBranch& branch_;
  const SolvedRod& rod_;
};

}  // namespace

Scene scene_of(const Scene& scene, const HarnessResult& harness) {
  Scene alone(scene.gravity());
  for (const PlacedObstacle& obstacle : scene.bodies()) alone.add(obstacle);
  std::vector<PlacedRod*> rods;
  for (std::size_t b = 0; b < harness.branches.size(); ++b) {
    const HarnessBranch& branch = harness.branches[b];
    const Curve curve = branch.points.curve();
    rods.push_back(&alone.add(PlacedRod(branch.name, rod_of(branch, harness.design.lengths[b], harness.options), curve.at(0), curve.at(curve.length()))));
  }
  for (const HarnessClip& clip : harness.design.clips) rods[clip.branch]->hold(Hold{clip.at, clip.frame});
  for (std::size_t j = 0; j < harness.junctions.size(); ++j) {
    std::vector<BranchPlace> places;
    for (std::size_t k = 0; k < harness.junctions[j].branches.size(); ++k) {
      const int b = harness.junctions[j].branches[k];
      const HarnessEnd& from = harness.branches[b].from;
      const bool begins = from.junction && from.number == static_cast<int>(j);
      places.push_back({rods[b], begins ? 0 : rods[b]->rod().length, harness.design.sections[j][k]});
    }
    alone.join(name_of_junction(static_cast<int>(j)), places, std::nullopt);
  }
  return alone;
}

void settle(const Scene& scene, HarnessResult& harness, const RunContext& context, const SceneEquilibrium* from) {
  const Scene alone = scene_of(scene, harness);
  SceneEquilibrium route;
  for (std::size_t b = 0; b < harness.branches.size(); ++b) {
    const Curve curve = harness.branches[b].points.curve();
    const Rod& rod = alone.rods()[b]->rod();
    const Design design{rod, curve.at(0), curve.at(curve.length()), 0, {}, curve};
    route.rods.push_back({harness.branches[b].name, {}, {}, *guess_along_route(design)});
  }
  for (const auto& branch : alone.branches()) route.branches.push_back({branch->name, branch->frame, {}});
  SolveOptions options = harness.options.solve;
  options.follow = options.follow || from != nullptr;
  const auto eq = std::make_shared<SceneEquilibrium>(alone.solve(options, context, from ? from : &route));
  harness.equilibrium = eq;
  harness.settled_misses.clear();
  harness.missed_share = 0;
  if (!eq->ok()) return;
  harness.length_in_collision = 0;
  for (std::size_t b = 0; b < harness.branches.size(); ++b) {
    HarnessBranch& branch = harness.branches[b];
    const SolvedRod& rod = eq->rods[b];
    const Kept kept = kept_of(branch, rod.problem.rod.length, harness.options);
    branch.settled_length = rod.equilibrium.settled_length();
    branch.settled_bend_radius = rod.equilibrium.smallest_bend_radius();
    branch.settled_clearance = {std::numeric_limits<double>::infinity()};
    if (kept.to > kept.from) branch.settled_clearance = eq->clearance(rod, -1, kept.from, kept.to);
    harness.length_in_collision += length_within(*eq, rod, kept);
    RestReport(harness, static_cast<int>(b)).judge(kept);
  }
  for (HarnessClip& clip : harness.design.clips) clip.force = eq->reaction(eq->rods[clip.branch], clip.at).force.norm();
  for (std::size_t j = 0; j < harness.junctions.size(); ++j) harness.junctions[j].settled = eq->branches[j].frame;
}

}  // namespace tendril::routing
