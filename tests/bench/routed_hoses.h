// Hoses that are routed between random places of the engine bay, to be refined in benchmarks.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "bench/bay_routes.h"
#include "method/route/clipped_design.h"
#include "method/route/route.h"

namespace tendril::bench {

constexpr int pairs = 7;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The engine bay of over a million triangles under gravity.
inline const Scene& bay() {
  static const Scene scene = [] {
    Scene built{Vec3(0, 0, -9.81)};
    for (const PlacedObstacle& obstacle : engine_bay().obstacles()) built.add(obstacle);
    return built;
  }();
  return scene;
}

/// Reinforced rubber, filled with water.
inline Section hose() { return Section::round(0.020, 0.012, Material::from_poisson(40e6, 0.45, 1700)); }

inline route::Options options_for(const routing::Ends& ends, bool preformed) {
  route::Options options;
  options.from = Frame::looking(ends.start, ends.start_along);
  options.to = Frame::looking(ends.finish, ends.finish_along);
  options.section = hose();
  options.preformed = preformed;
  options.space.radius = options.section.radius();
  options.space.clearance = 0.005;
  options.curve = bay_curve();
  options.curve.free_ends = 0.02;
  options.max_clips = 8;
  return options;
}

inline const std::vector<routing::Ends>& ends() {
  static const std::vector<routing::Ends> all = [] {
    routing::SpaceDemands demands;
    demands.radius = hose().radius();
    demands.clearance = 0.005;
    const routing::FreeSpace space(bay(), demands, {}, 0.22);
    std::mt19937_64 random(1);
    std::vector<routing::Ends> found;
    for (int k = 0; k < pairs; ++k) found.push_back(random_ends(space, random));
    return found;
  }();
  return all;
}

inline routing::RefinementOptions demands_for(const route::Options& options) {
  routing::RefinementOptions demands;
  demands.clearance_weight = 0.5;
  demands.min_bend_radius = 0.8 * options.curve.radii.front();
  demands.clearance = options.space.clearance;
  demands.free_ends = options.curve.free_ends;
  demands.adjust.from_tilt = demands.adjust.to_tilt = true;
  demands.adjust.clips = true;
  demands.most_clips = options.max_clips;
  return demands;
}

struct Task {
  routing::Design design;
  routing::RefinementOptions demands;
};

/// Where refinement begins: the nominal routes' designs, with the clips that they need.
inline std::vector<Task> tasks(bool preformed) {
  std::vector<Task> all;
  const RunContext context;
  for (const routing::Ends& pair : ends()) {
    route::Options options = options_for(pair, preformed);
    options.refine = false;
    const route::Result nominal = route::run(bay(), options);
    if (nominal.routes.empty()) continue;
    Task task{nominal.routes.front().design, demands_for(options)};
    if (const auto clipped = routing::clipped_along_way(routing::SurroundingsByUse(bay(), task.demands), bay().gravity(), task.design, task.demands, context);
        clipped && clipped->found)
      task.design = clipped->design;
    task.demands.most_clips = 0;
    if (routing::refine(bay(), task.design, task.demands).ok) all.push_back(task);
  }
  return all;
}

inline double median(std::vector<double> values) {
  if (values.empty()) return infinity;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Seconds from the first design looked at, whose equilibrium both solvers share.
inline double seconds_of(const routing::RefinementRecord& record, const routing::RefinementResult& result) {
  return record.seconds - result.history.front().seconds;
}

}  // namespace tendril::bench
