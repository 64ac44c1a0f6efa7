#include "method/route/harness_smoothing.h"

#include <algorithm>
#include <cmath>

#include "method/pcc/cost_integral.h"
#include "method/preform/pcc_optimization.h"
#include "method/route/harness_descent.h"

namespace tendril::routing {

namespace {

using preform::Candidate;
using preform::Optimized;

preform::Options options_of(const HarnessOptions& options, const HarnessShape& shape, int branch, const EndCones& cones) {
  preform::Options one;
  one.ends = shape.ends(branch, options.connections);
  one.space = options.space;
  one.curve = demands_of(options, shape.branches[branch], cones);
  one.max_bends = options.max_bends;
  one.grid = options.grid;
  return one;
}

bool is_better(const Optimized& a, const Optimized& b) {
  if (a.violations.empty() != b.violations.empty()) return a.violations.empty();
  return a.violations.empty() ? a.objective < b.objective : a.violations.front().by < b.violations.front().by;
}

std::vector<Optimized> best_of(std::vector<Optimized> curves) {
  const auto best = std::min_element(curves.begin(), curves.end(), is_better);
  if (best == curves.end()) return {};
  return {std::move(*best)};
}

/// From the path over the grid, or the curve there is.
std::vector<Optimized> smoothed(const FreeSpace& space, const preform::Options& one, const std::vector<Vec3>& path, const RunContext& context) {
  preform::GlobalPaths paths;
  paths.paths.push_back(path);
  std::vector<Optimized> best = best_of(pcc_optimization(space, one, pcc_sampling(space, one, paths, context), context));
  polish(space, one, best, context);
  return best;
}

/// What penalties leave is made up for by multipliers.
Optimized held(const FreeSpace& space, const preform::Options& one, const PccPoints& curve, const RunContext& context) {
  const double reach = std::max(space.demands().radius + space.demands().clearance, 1e-3 * one.curve.radii.front());
  DescentOptions descent;
  descent.polish = true;
  descent.sample = std::min(0.1 * reach, 0.1 * one.curve.radii.front());
  descent.margin = 2 * descent.sample * descent.sample / reach;
  const DescentResult result = descend(space, one.curve, one.ends, curve, descent, context);
  return {result.curve, result.length, result.objective, -1, routing::violations(space, one.curve, one.ends, result.curve)};
}

}  // namespace

double misses(const ShapeViolations& violations) {
  double sum = 0;
  for (const std::vector<Violation>& of_branch : violations)
    if (!of_branch.empty()) sum += 1 + std::min(1.0, of_branch.front().by);
  return sum;
}

double weighted_cost(const FreeSpace& space, const HarnessShape& shape) {
  double sum = shape.cost();
  for (const ShapeBranch& branch : shape.branches) sum += branch.factor * preference_along(space, branch.points);
  return sum;
}

double preference_along(const FreeSpace& space, const PccPoints& curve) {
  if (!space.has_preferences()) return 0;
  return cost_integral(space, curve) - curve.length();
}

ShapeViolations smooth(const FreeSpace& space, const HarnessOptions& options, HarnessShape& shape, double cone, const RunContext& context) {
  ShapeViolations violations(shape.branches.size());
  for (std::size_t b = 0; b < shape.branches.size(); ++b) {
    ShapeBranch& branch = shape.branches[b];
    const preform::Options one = options_of(options, shape, static_cast<int>(b),
                                            cone > 0 ? shape.cones(static_cast<int>(b), cone) : shape.cones(static_cast<int>(b)));
    branch.points = {{one.ends.start, one.ends.finish}, {}};
    std::vector<Optimized> best = smoothed(space, one, branch.path, context);
    if (best.empty() || !best.front().violations.empty()) {
      // The tree knows nothing of bends: through another passage there may be room for them.
      std::vector<Optimized> others = pcc_optimization(space, one, pcc_sampling(space, one, global_search(space, one, context), context), context);
      best.insert(best.end(), others.begin(), others.end());
      best = best_of(std::move(best));
      polish(space, one, best, context);
    }
    if (!best.empty()) branch.points = best.front().points;
    violations[b] = best.empty() ? routing::violations(space, one.curve, one.ends, branch.points) : best.front().violations;
  }
  shape.take_directions();
  return violations;
}

ShapeViolations improve(const FreeSpace& space, const HarnessOptions& options, HarnessShape& shape, const RunContext& context) {
  shape = descend_together(space, options, shape, context);
  ShapeViolations violations(shape.branches.size());
  for (std::size_t b = 0; b < shape.branches.size(); ++b) {
    ShapeBranch& branch = shape.branches[b];
    const preform::Options one = options_of(options, shape, static_cast<int>(b), shape.cones(static_cast<int>(b)));
    std::vector<Optimized> best = pcc_optimization(space, one, {{branch.points, -1}}, context);
    polish(space, one, best, context);
    if (best.empty() || !best.front().violations.empty()) {
      std::vector<Optimized> other = smoothed(space, one, branch.points.points, context);
      for (const PccPoints& curve : {branch.points, best.empty() ? branch.points : best.front().points})
        other.push_back(held(space, one, curve, context));
      best.insert(best.end(), other.begin(), other.end());
      best = best_of(std::move(best));
    }
    if (!best.empty()) branch.points = best.front().points;
    violations[b] = best.empty() ? routing::violations(space, one.curve, one.ends, branch.points) : best.front().violations;
  }
  shape.take_directions();
  return violations;
}

}  // namespace tendril::routing
