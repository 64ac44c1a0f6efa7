#include "method/route/local_refinement.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "method/route/clipped_design.h"
#include "method/route/derivative_free.h"
#include "method/route/design_model.h"
#include "method/route/refinement_report.h"

namespace tendril::routing {
namespace {

using Eigen::VectorXd;
using Clock = std::chrono::steady_clock;

constexpr double feasible = 5e-6;  // violations below the model's margins

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// One design, as many clips as it has.
class Refinement {
 public:
  Refinement(const SurroundingsByUse& around, const Vec3& gravity, const Design& design, const RefinementOptions& options,
             const RunContext& context)
      : around_(around), options_(options), context_(context), space_(design, options),
        model_(around, gravity, space_, options, context) {}

  RefinementResult run() {
    RefinementResult result;
    if (!model_.begin(model_.start())) {
      result.status = context_.stop().value_or(Status::stalled);
      result.message = result.status == Status::stalled ? "the design has no equilibrium to start from: " + model_.why_not()
                                                        : model_.why_not();
      result.design = space_.design(model_.unscaled(model_.start()));
      return result;
    }
    const bool found = look_for(model_.start()) || look_from_other_lengths();
    finish(result);
    if (found && !result.unmet.empty() && !model_.touches_all() && !context_.stop()) {
      // Where it may be nearer than demanded, something touches: then contact is part of every equilibrium.
      model_.touch_all();
      look_for(model_.accepted().x);
      finish(result);
    }
    set_verdict(result);
    return result;
  }

 private:
  int most_evaluations() const {
    if (options_.max_evaluations > 0) return options_.max_evaluations;
    return options_.solver == RefinementSolver::gradient ? 100 : 400;
  }
  bool kept() const { return model_.accepted().value.valid && model_.accepted().value.violation <= feasible; }

  /// Leaves the best design at hand; true when it keeps what is demanded.
  bool look_for(const VectorXd& start) {
    if (space_.size() == 0)
      take_if_valid(start);
    else if (options_.solver == RefinementSolver::gradient)
      descend_from(start);
    else
      search_from(start);
    return kept();
  }

  void take_if_valid(const VectorXd& x) {
    if (model_.evaluate(x).valid) model_.accept();
    converged_ = true;
  }

  void descend_from(const VectorXd& start) {
    DescentOptions descent;
    descent.tolerance = options_.tolerance;
    descent.feasible = feasible;
    descent.max_evaluations = most_evaluations();
    converged_ = descend(model_, start, descent, context_).converged;
  }

  /// Cost plus penalty, as the paper has it. The penalty is exact: at its minimum nothing is missed.
  void search_from(const VectorXd& start) {
    const ConstrainedProblem::Value first = model_.evaluate(start);
    if (!first.valid) return;
    model_.accept();
    const double penalty = 10 * std::max(first.cost, 1e-9);
    double best = first.cost + penalty * first.violation;
    SearchTask task{model_.lower(), model_.upper(), start, VectorXd::Constant(start.size(), 0.25),
                    options_.tolerance, most_evaluations(), {}, [&] { return context_.stop().has_value(); }};
    const double failed = 1e3 * best;
    task.value = [&](const VectorXd& x) {
      const ConstrainedProblem::Value value = model_.evaluate(x);
      const double merit = value.valid ? value.cost + penalty * value.violation : failed;
      if (merit < best) {
        best = merit;
        model_.accept();
      }
      return merit;
    };
    // A simplex that has collapsed on a ridge sees it again from a new one.
    for (double before = INFINITY; best < before * (1 - options_.tolerance) && task.max_evaluations > 0 && !context_.stop();) {
      before = best;
      const std::size_t used = model_.history().size();
      converged_ = search(task).converged;
      task.start = model_.accepted().x;
      task.max_evaluations -= static_cast<int>(model_.history().size() - used);
    }
  }

  /// Too long or too short to see a way: other lengths to start from.
  bool look_from_other_lengths() {
    const auto& variables = space_.variables();
    const auto length = std::find_if(variables.begin(), variables.end(), [](const DesignSpace::Variable& v) {
      return v.kind == DesignSpace::Variable::Kind::length;
    });
    if (length == variables.end()) return false;
    const auto j = length - variables.begin();
    const VectorXd first = model_.start();
    for (const double factor : {1.05, 0.95, 1.15, 0.9, 1.3}) {
      if (context_.stop()) return false;
      const DesignModel::State best = model_.accepted();
      VectorXd start = first;
      start[j] *= factor;
      start = start.cwiseMax(model_.lower()).cwiseMin(model_.upper());
      if (look_for(start)) return true;
      if (best.value.valid && best.value.violation <= model_.accepted().value.violation) model_.go_back_to(best);
    }
    return false;
  }

  void finish(RefinementResult& result) {
    const DesignModel::State& best = model_.accepted();
    result.design = space_.design(model_.unscaled(best.x));
    result.objective = best.value.valid ? best.value.cost : std::nan("");
    result.equilibrium = model_.verified(best.x);
    result.adjusted.clear();
    for (int k = 0; k < space_.size(); ++k) {
      const DesignSpace::Variable& v = space_.variables()[k];
      result.adjusted.push_back({v.name, v.unit, v.start, model_.unscaled(best.x)[k]});
    }
    judge(around_, options_, result);
  }

  void set_verdict(RefinementResult& result) {
    result.history = model_.history();
    result.evaluations = static_cast<int>(result.history.size());
    if (const std::optional<Status> stopped = context_.stop()) {
      result.status = *stopped;
      result.message = *stopped == Status::cancelled ? "interrupted; this is the best design so far"
                                                     : "out of time; this is the best design so far";
      return;
    }
    result.ok = result.unmet.empty();
    result.status = result.ok ? Status::solved : Status::infeasible;
    result.message = !result.ok     ? text_of(result.unmet)
                     : converged_   ? "solved"
                                    : "all demands are kept, but the search ended after " + std::to_string(result.evaluations) +
                                        " equilibria before it was sure that nothing nearby is better";
  }

  const SurroundingsByUse& around_;
  const RefinementOptions& options_;
  const RunContext& context_;
  DesignSpace space_;
  DesignModel model_;
  bool converged_ = false;
};

}  // namespace

namespace {

/// One refinement after another: their equilibria in one history.
class Attempts {
 public:
  Attempts(const Scene& scene, const RefinementOptions& options, const RunContext& context)
      : around_(scene, options), gravity_(scene.gravity()), context_(context) {}

  const SurroundingsByUse& around() const { return around_; }
  const Vec3& gravity() const { return gravity_; }

  RefinementResult run(const Design& design, const RefinementOptions& options) {
    const double before = seconds_since(began_);
    RefinementResult result = Refinement(around_, gravity_, design, options, context_).run();
    for (RefinementRecord& record : result.history) {
      record.seconds += before;
      history_.push_back(record);
    }
    return result;
  }

  void conclude(RefinementResult& result) {
    result.history = std::move(history_);
    result.evaluations = static_cast<int>(result.history.size());
    result.seconds = seconds_since(began_);
  }

 private:
  SurroundingsByUse around_;
  Vec3 gravity_;
  const RunContext& context_;
  Clock::time_point began_ = Clock::now();
  std::vector<RefinementRecord> history_;
};

bool may_need_clips(const RefinementResult& result) {
  return result.status == Status::infeasible || result.status == Status::stalled;
}

/// As few clips along the way as hold the design there, then their arc lengths. False: there is no way, or no place on it.
bool clip_along_way(Attempts& attempts, const Design& design, const RefinementOptions& options, const RunContext& context,
                    RefinementResult& result) {
  const std::optional<ClippedDesign> clipped = clipped_along_way(attempts.around(), attempts.gravity(), design, options, context);
  if (!clipped || context.stop()) return false;
  const auto explain = [&] {
    if (!result.ok && !clipped->lack.empty()) result.message += (result.message.empty() ? "" : "; ") + clipped->lack;
  };
  if (!clipped->found) {
    explain();
    return true;
  }
  RefinementOptions with_clips = options;
  with_clips.adjust.clips = options.adjust.clips || design.clips.empty();
  RefinementResult held = attempts.run(clipped->design, with_clips);
  if (held.equilibrium || !result.equilibrium) {
    result = std::move(held);
    result.added_clips = clipped->added;
  }
  explain();
  return true;
}

/// Without a way to lie on: a clip where what is demanded is missed most, again and again.
void clip_where_missed(Attempts& attempts, const RefinementOptions& options, RefinementResult& result) {
  std::vector<Hold> added;
  while (result.status == Status::infeasible && result.equilibrium && static_cast<int>(added.size()) < options.most_clips) {
    const std::optional<Hold> clip = propose_clip(*result.equilibrium, result.design, options);
    if (!clip) {
      result.message += "; no place for another clip within reach";
      break;
    }
    Design clipped = result.design;
    clipped.clips.push_back(*clip);
    added.push_back(*clip);
    result = attempts.run(clipped, options);
  }
  result.added_clips = added;
}

}  // namespace

RefinementResult refine(const Scene& scene, const Design& design, const RefinementOptions& options, const RunContext& context) {
  Attempts attempts(scene, options, context);
  RefinementResult result = attempts.run(design, options);
  if (options.most_clips > 0 && may_need_clips(result) && !clip_along_way(attempts, design, options, context, result))
    clip_where_missed(attempts, options, result);
  attempts.conclude(result);
  return result;
}

RefinementResult refine_clipped(const Scene& scene, const Design& design, const RefinementOptions& options, const RunContext& context) {
  Attempts attempts(scene, options, context);
  RefinementResult result;
  result.status = Status::infeasible;
  result.design = design;
  if (!clip_along_way(attempts, design, options, context, result)) {
    result.status = context.stop().value_or(Status::infeasible);
    result.message = "nothing to fasten a clip to is in reach of the route";
  }
  attempts.conclude(result);
  return result;
}

}  // namespace tendril::routing
