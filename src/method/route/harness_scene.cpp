#include "method/route/harness_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "method/route/route_guess.h"

namespace tendril::routing {

namespace {

std::string name_of_junction(int number) { return "junction " + std::to_string(number + 1); }

Rod rod_of(const HarnessBranch& branch, const HarnessOptions& options) {
  const int segments = std::clamp(static_cast<int>(std::ceil(branch.length / options.segment)), 4, Rod::max_segments);
  return Rod::uniform(branch.length, options.section, segments);
}

/// Arc lengths of a rod (m) outside its free ends.
struct Kept {
  double from, to;
};
Kept kept_of(const HarnessBranch& branch, const HarnessOptions& options) {
  return {branch.from.junction ? 0 : options.free_ends, branch.length - (branch.to.junction ? 0 : options.free_ends)};
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

}  // namespace

Scene scene_of(const Scene& scene, const HarnessResult& harness) {
  Scene alone(scene.gravity());
  for (const PlacedObstacle& obstacle : scene.obstacles()) alone.add(obstacle);
  std::vector<PlacedRod*> rods;
  for (const HarnessBranch& branch : harness.branches) {
    const Curve curve = branch.points.curve();
    rods.push_back(&alone.add(PlacedRod(branch.name, rod_of(branch, harness.options), curve.at(0), curve.at(curve.length()))));
  }
  for (std::size_t j = 0; j < harness.junctions.size(); ++j) {
    std::vector<BranchPlace> places;
    for (const int b : harness.junctions[j].branches) {
      const HarnessEnd& from = harness.branches[b].from;
      const bool begins = from.junction && from.number == static_cast<int>(j);
      places.push_back({rods[b], begins ? 0 : rods[b]->rod().length, std::nullopt});
    }
    alone.join(name_of_junction(static_cast<int>(j)), places, std::nullopt);
  }
  return alone;
}

void settle(const Scene& scene, HarnessResult& harness, const RunContext& context) {
  const Scene alone = scene_of(scene, harness);
  SceneEquilibrium route;
  for (std::size_t b = 0; b < harness.branches.size(); ++b) {
    const Curve curve = harness.branches[b].points.curve();
    const Rod& rod = alone.rods()[b]->rod();
    const Design design{rod, curve.at(0), curve.at(curve.length()), 0, {}, curve};
    route.rods.push_back({harness.branches[b].name, {}, {}, *guess_along_route(design)});
  }
  for (const auto& branch : alone.branches()) route.branches.push_back({branch->name, branch->frame, {}});
  const auto eq = std::make_shared<SceneEquilibrium>(alone.solve(harness.options.solve, context, &route));
  harness.equilibrium = eq;
  if (!eq->ok()) return;
  harness.length_in_collision = 0;
  for (std::size_t b = 0; b < harness.branches.size(); ++b) {
    HarnessBranch& branch = harness.branches[b];
    const SolvedRod& rod = eq->rods[b];
    const Kept kept = kept_of(branch, harness.options);
    branch.settled_length = rod.equilibrium.settled_length();
    branch.settled_bend_radius = rod.equilibrium.smallest_bend_radius();
    branch.settled_clearance = {std::numeric_limits<double>::infinity()};
    if (kept.to > kept.from) branch.settled_clearance = eq->clearance(rod, -1, kept.from, kept.to);
    harness.length_in_collision += length_within(*eq, rod, kept);
  }
  for (std::size_t j = 0; j < harness.junctions.size(); ++j) harness.junctions[j].settled = eq->branches[j].frame;
}

}  // namespace tendril::routing
