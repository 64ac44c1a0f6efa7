#include "method/preform/preform.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "method/preform/global_search.h"
#include "method/preform/pcc_filtering.h"
#include "method/preform/pcc_optimization.h"
#include "method/preform/pcc_sampling.h"

namespace tendril::preform {

namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw UsageError("preform: " + what);
}

std::string millimetres(double value) { return number_text(value / units::mm) + " mm"; }

void check_ends(const Ends& ends) {
  require(all_finite(ends.start) && all_finite(ends.finish), "the ends must be finite places");
  require(std::abs(ends.start_along.norm() - 1) < 1e-6 && std::abs(ends.finish_along.norm() - 1) < 1e-6,
          "the directions of the ends must be unit vectors");
  require((ends.finish - ends.start).norm() > 1e-6, "both ends are in one place");
}

void check_curve(const Options& options) {
  const routing::PccDemands& curve = options.curve;
  require(!curve.radii.empty(), "no bend radius was given");
  for (const double radius : curve.radii) {
    require(std::isfinite(radius) && radius > 0, "the bend radius is " + number_text(radius) + " m; a finite length above 0 expected");
    require(radius > options.space.radius, "the bend radius of " + millimetres(radius) + " is not more than the hose's own radius of " +
                                               millimetres(options.space.radius) + "; bend radii are those of the centre line");
  }
  for (const double length : {curve.min_straight, curve.end_straight, curve.min_length, curve.free_ends})
    require(std::isfinite(length) && length >= 0, "a length that is demanded is " + number_text(length) + " m; at least 0 expected");
  require(curve.max_length > curve.min_length, "the longest length allowed, " + millimetres(curve.max_length) +
                                                   ", is not above the shortest, " + millimetres(curve.min_length));
  const double straight = (options.ends.finish - options.ends.start).norm();
  require(curve.max_length >= straight, "the ends are " + millimetres(straight) + " apart, farther than the longest length allowed, " +
                                            millimetres(curve.max_length));
}

void check(const Options& options) {
  check_ends(options.ends);
  check_curve(options);
  require(options.max_bends >= 0 && options.max_bends <= 30, "the most bends are " + std::to_string(options.max_bends) + "; 0 to 30 expected");
  require(std::isfinite(options.grid) && options.grid > 0, "the grid's step is " + number_text(options.grid) + " m; above 0 expected");
  require(options.max_detour >= 1, "the longest detour is " + number_text(options.max_detour) + " times the cheapest path; at least 1 expected");
  require(options.max_paths >= 1, "the most paths are " + std::to_string(options.max_paths) + "; at least 1 expected");
}

long feasible(const std::vector<Optimized>& curves) {
  return std::count_if(curves.begin(), curves.end(), [](const Optimized& c) { return c.violations.empty(); });
}

std::vector<Optimized> chosen(const std::vector<Optimized>& curves, const std::vector<int>& indices) {
  std::vector<Optimized> all;
  for (const int index : indices) all.push_back(curves[index]);
  return all;
}

/// The candidates that came nearest to what is demanded, and what each still lacks.
std::vector<std::string> near_misses(const FreeSpace& space, std::vector<Optimized> curves) {
  std::erase_if(curves, [](const Optimized& c) { return c.violations.empty(); });
  std::stable_sort(curves.begin(), curves.end(), [](const Optimized& a, const Optimized& b) {
    return a.violations.front().by < b.violations.front().by;
  });
  std::vector<std::string> texts;
  for (const Optimized& curve : curves) {
    const std::string text = std::to_string(curve.points.bends()) + " bends, " + millimetres(curve.length) + " long: " +
                             routing::text_of(curve.violations.front(), space);
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
    if (texts.size() == 3) break;
  }
  return texts;
}

std::string found(const Result& r) {
  const std::size_t count = r.hoses.size();
  return std::to_string(count) + (count == 1 ? " hose" : " hoses") + " in " + std::to_string(r.passages) +
         (r.passages == 1 ? " passage" : " passages");
}

void conclude(Result& r, const std::vector<Optimized>& tried) {
  for (const Hose& hose : r.hoses) r.passages = std::max(r.passages, hose.passage);
  r.ok = r.status == Status::solved && !r.hoses.empty();
  if (r.status != Status::solved) {
    r.message = std::string(r.status == Status::timeout ? "out of time" : "cancelled") + "; so far " + found(r);
  } else if (r.ok) {
    r.message = found(r);
  } else {
    r.status = Status::infeasible;
    r.near_misses = near_misses(*r.space, tried);
    r.message = "no hose keeps all that is demanded";
    if (!r.near_misses.empty()) r.message += "; the nearest miss: " + r.near_misses.front();
  }
}

}  // namespace

Result run(const Scene& scene, const Options& options, const RunContext& context) {
  check(options);
  Result r;
  r.options = options;
  StepClock steps(r.steps);
  const auto stopped = [&] {
    if (const auto status = context.stop()) r.status = *status;
    return r.status == Status::cancelled || r.status == Status::timeout;
  };

  // Room to turn around outside of everything.
  const double margin =
      2 * options.curve.radii.front() + options.curve.end_straight + options.space.radius + options.space.clearance;
  r.space = std::make_shared<const FreeSpace>(scene, options.space, std::vector<Vec3>{options.ends.start, options.ends.finish}, margin, context);
  const FreeSpace& space = *r.space;
  steps.end("distance_field", {{"obstacles", space.surroundings().size()}});
  r.status = Status::solved;

  GlobalPaths paths;
  if (!stopped()) paths = global_search(space, options, context);
  steps.end("global_search", {{"nodes", paths.nodes}, {"free nodes", paths.free_nodes}, {"paths", long(paths.paths.size())}});
  if (paths.paths.empty() && !paths.obstruction.empty() && !stopped()) {
    r.status = Status::infeasible;
    r.message = paths.obstruction;
    r.seconds = steps.seconds();
    return r;
  }

  std::vector<Candidate> candidates;
  if (!stopped()) candidates = pcc_sampling(space, options, paths, context);
  steps.end("pcc_sampling", {{"candidates", long(candidates.size())}});

  std::vector<Optimized> optimized;
  if (!stopped()) optimized = pcc_optimization(space, options, candidates, context);
  std::vector<Optimized> winners = chosen(optimized, distinct(optimized, options));
  if (!stopped()) polish(space, options, winners, context);
  steps.end("pcc_optimization", {{"feasible", feasible(optimized)}, {"infeasible", long(optimized.size()) - feasible(optimized)}});

  stopped();
  r.hoses = pcc_filtering(space, options, winners, context);
  steps.end("pcc_filtering", {{"hoses", long(r.hoses.size())}});
  r.seconds = steps.seconds();
  conclude(r, optimized);
  return r;
}

}  // namespace tendril::preform
