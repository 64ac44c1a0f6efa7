// Large sparse non-linear programs with exact derivatives, for Ipopt (Waechter and Biegler 2006), which a module brings that is
// loaded when it is first used:
//     least f(x)   subject to   lower <= x <= upper,   row_lower <= c(x) <= row_upper.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/run_context.h"

namespace tendril::dress_pack {

/// What to solve. Functions return false where they have no value; the search then takes a shorter step. All arrays are as long as
/// there are variables, rows or entries.
class NonlinearProgram {
 public:
  using In = Eigen::Ref<const Eigen::VectorXd>;
  using Out = Eigen::Ref<Eigen::VectorXd>;
  virtual ~NonlinearProgram() = default;

  struct Entry {
    int row = 0, column = 0;  ///< entries that are named twice are added
  };
  int variables() const { return static_cast<int>(start.size()); }
  int rows() const { return static_cast<int>(row_lower.size()); }

  Eigen::VectorXd lower, upper, start;      ///< by variable; infinite: no bound
  Eigen::VectorXd row_lower, row_upper;     ///< by row
  std::vector<Entry> jacobian_entries;      ///< of dc/dx
  std::vector<Entry> hessian_entries;       ///< of the Lagrangian's second derivative: row >= column

  virtual bool value(In x, double& f) = 0;
  virtual bool slope(In x, Out f_x) = 0;
  virtual bool constraints(In x, Out c) = 0;
  virtual bool jacobian(In x, Out entries) = 0;
  /// Second derivative of factor f + multipliers . c.
  virtual bool hessian(In x, double factor, In multipliers, Out entries) = 0;

  /// The largest amount by which x breaks a bound or c a row.
  double violation(In x, In c) const {
    double most = 0;
    const auto look = [&](const Eigen::VectorXd& least, In value, const Eigen::VectorXd& largest) {
      for (int k = 0; k < value.size(); ++k) most = std::max({most, least[k] - value[k], value[k] - largest[k]});
    };
    look(lower, x, upper);
    look(row_lower, c, row_upper);
    return most;
  }
};

struct NonlinearOptions {
  double tolerance = 1e-7;     ///< of the conditions of optimality, in the units of the scaled program
  int most_iterations = 100;
  double barrier = 1e-5;       ///< of the interior-point method, at the beginning
  double scale = 1;            ///< of the objective: ten or so where it is to weigh like equations of order one
  std::function<void(int iteration, double objective)> progress;
};

struct NonlinearOutcome {
  Status status = Status::stalled;
  std::string message;
  Eigen::VectorXd x;
  double value = 0;
  double violation = 0;   ///< of x
  int iterations = 0;
};

/// One program at a time is solved in a process: others wait for their turn, unless their context says stop. Throws UsageError
/// where the module cannot be loaded; what the program's functions throw passes through.
NonlinearOutcome solve_nonlinear(NonlinearProgram& program, const NonlinearOptions& options, const RunContext& context);

/// The module's entry point: nothing that C++ throws passes it.
using NonlinearEntry = void (*)(NonlinearProgram& program, const NonlinearOptions& options, const RunContext& context, NonlinearOutcome& out);
inline constexpr const char* nonlinear_entry = "tendril_solve_nonlinear";

}  // namespace tendril::dress_pack
