#include "method/pcc/pcc_descent.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "method/pcc/bfgs.h"
#include "method/pcc/cost_integral.h"
#include "method/pcc/pcc_terms.h"

namespace tendril::routing {

namespace {

// Penalty weights times the smallest radius: the first lets a curve pull itself tight, the second leaves misses of less than
// a thousandth of the radius. A softer start would cut through walls.
constexpr double first_weight = 5, second_weight = 500;
// Of the radius: polishing begins near its optimum, and must not jump through a wall to another one.
constexpr double polish_step = 0.1;
// What misses its demands by this share of the radius after the second weight has nowhere to go.
constexpr double hopeless = 0.2;
// Turns below this (rad) are no bends. What leaving one out moves is a thousandth of what counts as kept.
constexpr double no_bend = 1e-8;

/// One descent's parts and what it has used.
struct Descent {
  const DescentOptions& options;
  const RunContext& context;
  PccUnknowns& unknowns;
  PccTerms& terms;
  double unit;  ///< m, the smallest radius
  Eigen::VectorXd x;
  int iterations = 0;
  Eigen::MatrixXd inverse = {};  ///< of BFGS, where it goes on from the minimum before

  /// To the minimum for the weights and multipliers there are.
  void settle(double gradient, double decrease) {
    BfgsOptions bfgs;
    bfgs.iterations = options.iterations;
    bfgs.gradient = gradient;
    bfgs.decrease = decrease;
    bfgs.largest_step = options.polish ? polish_step * unit : unit;
    const auto function = [this](const Eigen::VectorXd& at, Eigen::VectorXd& by) { return terms(at, by); };
    iterations += minimize(function, x, bfgs, context, &inverse).iterations;
  }

  void penalize(double weight, double gradient, double decrease) {
    terms.weight = weight / unit;
    inverse.resize(0, 0);
    for (int round = 0; round < 3 && !context.stop(); ++round) {
      if (round > 0 && terms.planned(x)) return;
      terms.plan(x, options.sample);
      settle(gradient, decrease);
    }
  }

  /// Augmented Lagrangian: multipliers, from those there are, until the curve's own demands are missed by no more than
  /// `mismatch`, and its distances by no more than `gap_mismatch` (m); 0: those stay with their penalties.
  void hold(double mismatch, double gap_mismatch, int rounds, double gradient, double decrease) {
    Eigen::VectorXd slope(x.size());
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds && !context.stop(); ++round) {
      terms(x, slope);
      const double own = terms.mismatch(), gaps = gap_mismatch > 0 ? terms.gap_mismatch() : 0;
      if ((own <= mismatch && gaps <= gap_mismatch) || own > hopeless * unit) return;
      terms.update_multipliers(gap_mismatch > 0);
      const double missed = gaps > gap_mismatch ? std::max(own, mismatch / gap_mismatch * gaps) : own;
      if (missed > 0.25 * before && terms.weight < 2 * second_weight / unit) terms.weight *= 2;
      before = missed;
      settle(gradient, decrease);
    }
  }
};

/// The vertices without those at which nothing bends.
PccPoints cleaned(const PccShape& shape, const std::vector<double>& radii) {
  PccPoints curve;
  curve.points.push_back(shape.points.front());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (shape.turns[i] <= no_bend) continue;
    curve.points.push_back(shape.points[i + 1]);
    curve.radii.push_back(radii[i]);
  }
  curve.points.push_back(shape.points.back());
  return curve;
}

/// The straight, or a single bend between directions that are fixed: nothing is left to choose.
DescentResult settled(const FreeSpace& space, const Ends& ends, const PccPoints& seed) {
  DescentResult result;
  result.curve = {{ends.start, ends.finish}, seed.radii};
  if (seed.bends() == 1) result.curve.points.insert(result.curve.points.begin() + 1, crossing(ends));
  result.length = result.curve.length();
  result.objective = cost_integral(space, result.curve);
  return result;
}

void check(const PccPoints& seed, const DescentOptions& options) {
  std::ostringstream said;
  if (seed.points.size() != seed.radii.size() + 2)
    said << seed.points.size() << " points and " << seed.radii.size() << " radii; two ends, and a radius for each vertex between them";
  else if (!(options.sample > 0) || !std::isfinite(options.sample))
    said << "samples " << options.sample << " m apart; a finite distance above 0";
  else if (!(options.margin >= 0) || !std::isfinite(options.margin))
    said << "a margin of " << options.margin << " m; a finite one of at least 0";
  if (!said.str().empty()) throw UsageError("pcc descent: " + said.str() + " is expected");
  for (const Vec3& point : seed.points)
    if (!all_finite(point)) throw UsageError("pcc descent: a seed with a point that is not finite");
}

}  // namespace

DescentResult descend(const FreeSpace& space, const PccDemands& demands, const Ends& ends, const PccPoints& seed,
                      const DescentOptions& options, const RunContext& context) {
  check(seed, options);
  const bool cones = demands.start_cone > 0 || demands.finish_cone > 0;
  if (seed.bends() == 0 || (seed.bends() == 1 && !cones)) return settled(space, ends, seed);
  PccUnknowns unknowns(demands, ends, seed.radii);
  PccTerms terms(space, demands, unknowns, options.margin);
  Descent descent{options, context, unknowns, terms, *std::min_element(seed.radii.begin(), seed.radii.end()), unknowns.nearest(seed)};
  const double unit = descent.unit;
  if (!options.polish) {
    terms.slack = 1e-5 * unit;
    descent.penalize(first_weight, 1e-2, 1e-4);
    descent.penalize(second_weight, 1e-3, 1e-5);
    descent.hold(5e-6 * unit, 0, 6, 1e-3, 1e-6);
  } else {
    terms.slack = 1e-10 * unit;
    terms.fine_costs = true;
    descent.penalize(second_weight, 1e-5, 1e-9);
    // Turns up to the largest that is allowed have their true tangents now.
    unknowns.linear_from = std::clamp(demands.max_turn + 0.05, 2.75, 3.1);
    terms.plan(descent.x, options.sample);
    descent.settle(1e-7, 1e-12);
    descent.hold(2e-11 * unit, 2e-5 * unit, 15, 1e-7, 1e-12);
  }
  DescentResult result;
  PccShape shape;
  unknowns.evaluate(descent.x, shape);
  result.curve = cleaned(shape, seed.radii);
  result.length = result.curve.length();
  result.objective = cost_integral(space, result.curve);
  result.iterations = descent.iterations;
  result.queries = terms.queries();
  return result;
}

}  // namespace tendril::routing
