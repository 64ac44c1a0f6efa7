#include "method/preform/pcc_filtering.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "method/preform/hose_labels.h"

namespace tendril::preform {

namespace {

/// m: farther surfaces are not named as the nearest.
constexpr double farthest_clearance = 0.2;
/// Share of the objective within which fewer bends are preferred: before the last optimum, and after it.
constexpr double nearly_as_good = 1e-2, as_good = 1e-4;

/// The feasible ones by objective; equal ones by bends, then as they came.
std::vector<int> ranked(const std::vector<Optimized>& curves) {
  std::vector<int> order;
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (curves[i].violations.empty() && std::isfinite(curves[i].objective)) order.push_back(static_cast<int>(i));
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
    if (curves[i].objective != curves[j].objective) return curves[i].objective < curves[j].objective;
    return curves[i].points.bends() < curves[j].points.bends();
  });
  return order;
}

/// Groups of curves that are the same, each led by its best; within a group in the order of ranks.
std::vector<std::vector<int>> groups_of(const std::vector<Optimized>& curves, double same) {
  std::vector<std::vector<int>> groups;
  std::vector<std::vector<Vec3>> leaders;
  for (const int index : ranked(curves)) {
    const std::vector<Vec3> places = routing::compared_places(curves[index].points);
    std::size_t g = 0;
    while (g < groups.size() && routing::largest_distance(leaders[g], places) >= same) ++g;
    if (g == groups.size()) {
      groups.emplace_back();
      leaders.push_back(places);
    }
    groups[g].push_back(index);
  }
  return groups;
}

/// Passages as connected parts of the graph of pairs that are known to be deformable into each other.
struct Passages {
  std::vector<int> number;                  ///< by hose, from 1
  std::vector<std::vector<int>> blocking;   ///< by hose, against the first hose
};

Passages passages_of(const FreeSpace& space, const Options& options, const std::vector<Hose>& hoses, const RunContext& context) {
  const int count = static_cast<int>(hoses.size());
  Passages result{std::vector<int>(count), std::vector<std::vector<int>>(count)};
  std::vector<int>& number = result.number;
  std::iota(number.begin(), number.end(), 0);
  for (int j = 1; j < count && !context.stop(); ++j) {
    // Each earlier hose in parallel; of those the next one joins all that it matches.
    std::vector<char> same(j, 0);
    const int workers = std::min(thread_count(context.threads), j);
    run_workers(workers, [&](int worker) {
      for (int i = worker; i < j && !context.stop(); i += workers)
        same[i] = same_passage(space, hoses[i].points, hoses[j].points, options.curve.free_ends,
                               i == 0 ? &result.blocking[j] : nullptr);
    });
    for (int i = 0; i < j; ++i) {
      if (!same[i] || number[i] == number[j]) continue;
      const int kept = std::min(number[i], number[j]), gone = std::max(number[i], number[j]);
      std::replace(number.begin(), number.begin() + j + 1, gone, kept);
    }
  }
  // Counted from 1 in the order of the hoses.
  std::vector<int> names(count, 0);
  int passages = 0;
  for (int& n : number) {
    if (names[n] == 0) names[n] = ++passages;
    n = names[n];
  }
  for (int j = 0; j < count; ++j)
    if (number[j] == 1) result.blocking[j].clear();
  return result;
}

void measure_clearance(const FreeSpace& space, const Options& options, Hose& hose) {
  const double free = options.curve.free_ends;
  routing::CurveClearance clearance = routing::clearance_of(space, hose.points, free, free, farthest_clearance);
  hose.clearance = clearance.gap;
  hose.clearance_to = std::move(clearance.to);
}

}  // namespace

std::vector<int> distinct(const std::vector<Optimized>& curves, const Options& options) {
  std::vector<int> kept;
  for (const std::vector<int>& group : groups_of(curves, options.same)) {
    const Optimized& best = curves[group.front()];
    kept.push_back(group.front());
    int fewest = best.points.bends();
    for (const int index : group) {
      if (curves[index].points.bends() >= fewest || curves[index].objective > (1 + nearly_as_good) * best.objective) continue;
      fewest = curves[index].points.bends();
      kept.push_back(index);
    }
  }
  std::stable_sort(kept.begin(), kept.end(), [&](int i, int j) { return curves[i].objective < curves[j].objective; });
  return kept;
}

std::vector<Hose> pcc_filtering(const FreeSpace& space, const Options& options, const std::vector<Optimized>& curves,
                                const RunContext& context) {
  std::vector<Hose> hoses;
  for (const std::vector<int>& group : groups_of(curves, options.same)) {
    int chosen = group.front();
    for (const int index : group)
      if (curves[index].points.bends() < curves[chosen].points.bends() &&
          curves[index].objective <= (1 + as_good) * curves[group.front()].objective)
        chosen = index;
    Hose hose;
    hose.points = curves[chosen].points;
    hose.length = curves[chosen].length;
    hose.objective = curves[chosen].objective;
    hoses.push_back(std::move(hose));
  }
  std::stable_sort(hoses.begin(), hoses.end(), [](const Hose& a, const Hose& b) { return a.objective < b.objective; });
  const int workers = std::min(thread_count(context.threads), std::max(1, static_cast<int>(hoses.size())));
  run_workers(workers, [&](int worker) {
    for (std::size_t i = worker; i < hoses.size(); i += workers) measure_clearance(space, options, hoses[i]);
  });
  const Passages passages = passages_of(space, options, hoses, context);
  for (std::size_t i = 0; i < hoses.size(); ++i) hoses[i].passage = passages.number[i];
  const std::vector<std::string> labels = labels_of(space, hoses, passages.blocking);
  for (std::size_t i = 0; i < hoses.size(); ++i) hoses[i].label = labels[i];
  return hoses;
}

}  // namespace tendril::preform
