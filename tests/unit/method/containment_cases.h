// Three hoses in a T with tolerances, solved, and how far an outcome reaches out of an envelope.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/distance_tree.h"
#include "geometry/inside_test.h"
#include "method/envelope/arc_points.h"
#include "unit/method/envelope_cases.h"
#include "unit/method/variation_cases.h"

namespace tendril::test {

constexpr double tee_radius = 0.013;  ///< m
constexpr int tee_segments = 8;

/// Lengths within 50 mm, connections within a cone of 15 degrees, all uniform, as independent outcomes.
inline variation::Options tee_tolerances(int outcomes) {
  variation::Options options;
  for (const auto& [hose, end] : {std::pair{"a", ".from"}, std::pair{"b", ".to"}, std::pair{"c", ".to"}}) {
    options.vary.push_back(testing::number(hose + std::string(".length"), 0.05));
    options.vary.back().spread = variation::Spread::uniform;
    options.vary.push_back(testing::cone(hose + std::string(end), 15 * units::deg));
    options.vary.back().spread = variation::Spread::uniform;
  }
  options.measures = {testing::measure("a.min_bend_radius")};
  options.outcomes = outcomes;
  return options;
}

/// The solved outcomes as frames, seven numbers a vertex; `lost`: how many others there were.
inline Places solved_tee(int outcomes, std::uint64_t seed, int& lost) {
  const Scene scene = testing::three_hoses(tee_segments);
  Places places;
  places.rods.assign(3, {std::vector<double>(tee_segments, tee_radius), 5});
  const auto keep = [&](const variation::OutcomeView& view) {
    if (view.status != variation::OutcomeStatus::solved) return;
    for (const auto& frames : view.frames) places.numbers.emplace_back(frames.begin(), frames.end());
  };
  const variation::Result result = variation::run(scene, tee_tolerances(outcomes), keep, testing::with_seed(seed));
  lost = outcomes - result.outcomes.count(variation::OutcomeStatus::solved);
  return places;
}

/// How far rods reach out of a closed mesh. A rod is the union of balls of its radius along its curved centre line; a ball
/// lies within the mesh exactly where its middle does, and the surface is no nearer than the radius. So nothing is missed
/// around the section, whatever the direction; along the rod, between two stations, next to nothing.
class ReachTest {
 public:
  explicit ReachTest(const Mesh& mesh) : inside_(mesh), tree_(mesh) {}

  /// m: the largest distance from the mesh to a point of the rod that lies outside; where all of it lies inside, less than
  /// zero, by the least depth (at most a radius). `frames`: seven numbers a vertex; `stations`: a segment.
  double reach(std::span<const double> frames, double radius, int stations) const {
    double farthest = -radius;
    int hint = -1;
    for (std::size_t v = 0; v + 14 <= frames.size(); v += 7) {
      const envelope::ElementArc arc(&frames[v], &frames[v + 7]);
      for (int i = 0; i <= stations; ++i) {
        const Vec3 middle = arc.at(static_cast<double>(i) / stations);
        const bool within = inside_.inside(middle);
        const double limit = within ? 2 * radius : INFINITY;
        const DistanceTree::Nearest nearest = tree_.closest(middle, limit, hint);
        hint = nearest.triangle;
        farthest = std::max(farthest, within ? radius - nearest.distance : radius + nearest.distance);
      }
    }
    return farthest;
  }

  /// The same of all rods of one outcome.
  double reach(const Places& places, int outcome, int stations) const {
    double farthest = -INFINITY;
    for (std::size_t rod = 0; rod < places.rods.size(); ++rod) {
      const double radius = places.rods[rod].radii[0];
      farthest = std::max(farthest, reach(places(outcome, static_cast<int>(rod)), radius, stations));
    }
    return farthest;
  }

 private:
  InsideTest inside_;
  DistanceTree tree_;
};

}  // namespace tendril::test
