// Minimisation without derivatives, by NLopt's subplex method (T. Rowan's Nelder-Mead on subspaces, with bounds), which a module
// brings that is loaded when it is first used.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace tendril::routing {

struct SearchTask {
  Eigen::VectorXd lower, upper, start, step;  ///< n each; step: the first size of a change
  double tolerance = 1e-6;                    ///< of the variables, against their steps, and of the value, relative
  int max_evaluations = 400;
  std::function<double(const Eigen::VectorXd&)> value;  ///< finite
  std::function<bool()> stop;                 ///< true: end now
};

struct SearchOutcome {
  Eigen::VectorXd x;
  double value = 0;
  bool converged = false;  ///< false: stopped, or out of evaluations
};

/// Throws UsageError where the module cannot be loaded; what `value` throws passes through.
SearchOutcome search(const SearchTask& task);

/// The module's entry point: nothing that C++ throws passes it.
using SearchEntry = void (*)(const SearchTask& task, SearchOutcome& out);
inline constexpr const char* search_entry = "tendril_search_without_derivatives";

}  // namespace tendril::routing
