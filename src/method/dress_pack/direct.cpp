#include "method/dress_pack/direct.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "base/number_text.h"
#include "method/dress_pack/direct_problem.h"
#include "method/dress_pack/path_start.h"

namespace tendril::dress_pack {
namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

constexpr int most_in_a_round = 20;        // of Ipopt's iterations
constexpr double smallest_reach = 1e-5;    // rad or m
constexpr double agreement = 1e-5;         // of the program's objective with that of the followed equilibria
constexpr double scaled_objective = 10;
constexpr double least_objective = 1e-3;
constexpr double finest = 1e-8;            // Ipopt's conditions at double precision

void refuse(const PackDemands& demands) {
  if (demands.clearance >= 0 || demands.robot_clearance >= 0)
    throw UsageError("dress pack: the direct formulation keeps no clearance; leave it out, or use the reduced formulation");
}

/// Values that a limit's rounding has put beyond it go back to it.
JointPath within_limits(const JointPath& path, const Robot& robot) {
  std::vector<JointVector> via = path.via();
  for (std::size_t k = 1; k + 1 < via.size(); ++k)
    for (int i = 0; i < robot.size(); ++i) via[k][i] = std::clamp(via[k][i], robot.lower()[i], robot.upper()[i]);
  return JointPath(std::move(via));
}

/// Solves the program again and again, each time from equilibria that are followed to the last path and with the via points kept
/// near it: the linear model of a step holds for rods that turn little, and what the equations know nothing of, whether an
/// equilibrium is stable, is seen to in between.
class Rounds {
 public:
  Rounds(const PackProblem& pack, ReducedProblem& at, const ReducedOptions& options, DirectResult& out)
      : pack_(pack), at_(at), options_(options), out_(out), reach_(options.first_radius) {}

  void run(const RunContext& context) {
    for (int round = 0; round < options_.most_iterations; ++round) {
      if (context.stop()) return stop(*context.stop());
      const double before = at_.objective();
      const NonlinearOutcome found = solve(context);
      if (context.stop()) return stop(*context.stop());
      const double farthest = (found.x.head(at_.variables()) - at_.values()).cwiseAbs().maxCoeff();
      const bool inside = farthest < 0.99 * reach_, solved = found.status == Status::solved;
      const bool better = take(found, context);
      if (context.stop()) return stop(*context.stop());
      out_.history.push_back({at_.objective(), farthest, reach_, better});
      const bool settled = before - at_.objective() <= options_.tolerance * std::abs(before);
      if (solved && inside && settled && std::abs(found.value - at_.objective()) <= agreement * (1 + std::abs(before))) {
        out_.status = Status::solved;
        out_.message = "solved";
        return;
      }
      if (better && solved && !inside) reach_ *= 2;
      if (!better || !solved) reach_ *= 0.4;
      if (reach_ < smallest_reach) return fail(solved ? "no step improves the path any more" : found.message);
    }
    fail("not finished in " + std::to_string(options_.most_iterations) + " rounds");
  }

 private:
  NonlinearOutcome solve(const RunContext& context) {
    DirectProblem problem(pack_, at_, options_.steps, options_.demands, options_.weights, options_.seconds);
    out_.variables = problem.variables();
    out_.equations = problem.rows();
    const Eigen::VectorXd u = at_.values();
    const int n = at_.variables();
    problem.lower.head(n) = problem.lower.head(n).cwiseMax(u - Eigen::VectorXd::Constant(n, reach_));
    problem.upper.head(n) = problem.upper.head(n).cwiseMin(u + Eigen::VectorXd::Constant(n, reach_));
    NonlinearOptions solver;
    solver.tolerance = std::max(options_.tolerance, finest);
    solver.most_iterations = most_in_a_round;
    solver.scale = scaled_objective / std::max(at_.objective(), least_objective);
    const int before = out_.iterations;
    solver.progress = [&](int iteration, double) {
      if (context.progress) context.progress(std::min(0.99, (before + iteration) / (before + iteration + 20.0)), "optimisation");
    };
    NonlinearOutcome found = solve_nonlinear(problem, solver, context);
    out_.iterations += found.iterations;
    out_.violation = found.violation;
    return found;
  }

  /// Whether the rods follow from here to what was found, and are better off there.
  bool take(const NonlinearOutcome& found, const RunContext& context) {
    const JointPath path = within_limits(at_.path_with(found.x.head(at_.variables())), *pack_.robot);
    if (!beyond_robot(path, *pack_.robot, options_.seconds).empty()) return false;
    Eigen::VectorXd u(at_.variables());
    for (int j = 0; j < at_.free_points(); ++j) u.segment(j * at_.joints(), at_.joints()) = path.via()[j + 1];
    const ReducedProblem::Trial trial = at_.try_values(u, context);
    if (!trial.ok() || !(trial.objective < at_.objective())) return false;
    at_.accept();
    return true;
  }

  void stop(Status why) {
    out_.status = why;
    out_.message = why == Status::timeout ? "out of time; this is the best path so far" : "interrupted; this is the best path so far";
  }
  void fail(const std::string& why) {
    out_.status = Status::stalled;
    out_.message = why + "; this is the best path so far";
  }

  const PackProblem& pack_;
  ReducedProblem& at_;
  const ReducedOptions& options_;
  DirectResult& out_;
  double reach_;  ///< rad or m, of each via point's joint in a round
};

}  // namespace

DirectResult optimise_direct(const PackProblem& given, const JointPath& given_path, const ReducedOptions& options, const RunContext& context) {
  given.check();
  check(options, *given.robot);
  refuse(options.demands);
  const Clock::time_point begin = Clock::now();
  PackProblem pack = given;
  pack.bodies.clear();
  DirectResult out;
  if (!take_path(pack, given_path, options, context, out)) return out;
  const Clock::time_point search_begin = Clock::now();
  ReducedProblem start(pack, out.path, options.steps, options.demands, options.weights);
  if (!follow_once(start, context, out)) return out;
  out.objective_before = start.objective();
  out.status = Status::solved;
  out.message = "solved";
  if (start.variables() > 0) Rounds(pack, start, options, out).run(context);
  out.objective = start.objective();
  out.path = start.path();
  out.search_seconds = since(search_begin);
  SimulationOptions simulation;
  simulation.steps = options.steps;
  out.after = simulate(pack, out.path, simulation, context);
  out.seconds = since(begin);
  return out;
}

}  // namespace tendril::dress_pack
