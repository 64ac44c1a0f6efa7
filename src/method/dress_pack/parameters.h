// The free-form method for dress packs: named numbers of the pack itself (a hose's length, where and at what angle it is fastened, where a
// clip sits) are optimised for one motion of the robot, or for several.
//
//     least  sum over motions of weight . mean over time of cost(equilibrium)  +  weight . length of all rods
// with the cost of pack_cost.h. Quasi-Newton method (damped BFGS, Powell 1978) in a trust region (trust_step.h) within the numbers' bounds.
// Derivatives by what only moves attachments are exact, from end loads by one adjoint solution a time step; by other numbers they are
// central differences of equilibria that are moved along with the number. A local optimum is found.
//
// Not done: contact and clearance; rods that slide through holds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "method/dress_pack/pack_simulation.h"
#include "method/dress_pack/reduced_problem.h"

namespace tendril::dress_pack {

/// A number of a pack, between finite bounds.
struct PackParameter {
  std::string name;
  double lower = 0, upper = 0, start = 0;   ///< m or rad
  std::function<void(double value, PackProblem& pack)> apply;
  bool moves_attachments = false;           ///< it changes nothing but where attachments are in their links
};

/// All numbers that a pack offers: "hose.length" (m; what stands at the finish stays there), "hose.start.x", ".y", ".z" (m, in the link's
/// axes) and "hose.start.rx", ".ry", ".rz" (rad, turns about the section's own axes against where it is now, one after the other in this
/// order) for each attachment, and "hose.0.4.at" (m, arc length) for each hold between the ends.
std::vector<std::string> parameter_names(const PackProblem& pack);

/// One of them. It starts at the pack's value. Throws UsageError for a name that does not exist, with the nearest one, and for bounds that
/// make no sense, do not contain the start, or carry a hold over another one or over an end.
PackParameter pack_parameter(const PackProblem& pack, const std::string& name, double lower, double upper);

struct PackTask {
  JointPath path;
  double weight = 1;
};

struct ParameterOptions {
  int steps = 40;                ///< time steps of each motion
  PackDemands demands = {};
  double length_weight = 0;      ///< 1/m
  double tolerance = 1e-6;       ///< of the objective, relative: what another step would gain
  int most_iterations = 60;
  double first_radius = 0.2;     ///< share of the bounds' distance, all numbers together
};

struct ParameterResult {
  Status status = Status::stalled;
  std::string message;
  std::vector<double> values;    ///< the best that were found, in the order of the parameters
  PackProblem pack;              ///< with them
  double objective_before = 0, objective = 0;
  int iterations = 0;
  std::vector<double> history;   ///< objective, by iteration
  std::vector<PackMotion> before, after;  ///< by task
  double seconds = 0;
  bool ok() const { return status == Status::solved; }
};

/// A task beyond the robot's limits, or one that the rods cannot follow at the start, makes it infeasible, with the reason. Interrupted, the
/// best values so far. Tasks are worked on by several threads, with the same bits for any number. Throws UsageError for no tasks or
/// parameters, and for numbers that make no sense.
ParameterResult optimise_parameters(const PackProblem& pack, const std::vector<PackParameter>& parameters, const std::vector<PackTask>& tasks,
                                    const ParameterOptions& options = {}, const RunContext& context = {});

/// The objective as a function of the numbers, each from 0 at its lower to 1 at its upper bound.
class ParameterProblem {
 public:
  /// All must outlive this.
  ParameterProblem(const PackProblem& pack, const std::vector<PackParameter>& parameters, const std::vector<PackTask>& tasks,
                   const ParameterOptions& options);

  int variables() const { return static_cast<int>(parameters_.size()); }
  Eigen::VectorXd start() const;
  PackProblem pack_with(const Eigen::VectorXd& x) const;
  std::vector<double> values_of(const Eigen::VectorXd& x) const;

  /// The equilibria at x, followed from the start of each motion.
  struct Point {
    Status status = Status::stalled;
    std::string message;
    Eigen::VectorXd x;
    double objective = 0;
    std::vector<std::vector<RodState>> states;  ///< by task and time step
    bool ok() const { return status == Status::solved; }
  };
  Point at(const Eigen::VectorXd& x, const RunContext& context) const;

  /// False where a neighbouring state has no equilibrium, or the context says stop.
  bool gradient(const Point& point, Eigen::VectorXd& out, const RunContext& context) const;

 private:
  double length_of(const PackProblem& pack) const;
  bool task_gradient(const Point& point, const PackProblem& pack, std::size_t task, Eigen::VectorXd& out, const RunContext& context) const;
  bool adjoint(const Point& point, const PackProblem& pack, std::size_t task, Eigen::VectorXd& out, const RunContext& context) const;
  bool moved_cost(const Point& point, const PackProblem& pack, std::size_t task, double& cost, const RunContext& context) const;

  const PackProblem& pack_;
  const std::vector<PackParameter>& parameters_;
  const std::vector<PackTask>& tasks_;
  const ParameterOptions& options_;
};

}  // namespace tendril::dress_pack
