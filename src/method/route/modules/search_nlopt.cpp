// NLopt behind method/route/derivative_free.h.
#include <nlopt.h>

#include <memory>
#include <string>

#include "method/route/derivative_free.h"

namespace {

using namespace tendril::routing;

struct Call {
  const SearchTask* task;
  nlopt_opt method;
};

double value_at(unsigned n, const double* x, double*, void* data) {
  const Call& call = *static_cast<Call*>(data);
  const double value = call.task->value(Eigen::Map<const Eigen::VectorXd>(x, n));
  if (call.task->stop()) nlopt_force_stop(call.method);
  return value;
}

}  // namespace

extern "C" void tendril_search_without_derivatives(const SearchTask& task, SearchOutcome& out) {
  const auto n = static_cast<unsigned>(task.start.size());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> method(nlopt_create(NLOPT_LN_SBPLX, n), nlopt_destroy);
  Call call{&task, method.get()};
  nlopt_set_min_objective(method.get(), value_at, &call);
  nlopt_set_lower_bounds(method.get(), task.lower.data());
  nlopt_set_upper_bounds(method.get(), task.upper.data());
  nlopt_set_initial_step(method.get(), task.step.data());
  const Eigen::VectorXd least = task.tolerance * task.step;
  nlopt_set_xtol_abs(method.get(), least.data());
  nlopt_set_ftol_rel(method.get(), task.tolerance);
  nlopt_set_maxeval(method.get(), task.max_evaluations);
  out.x = task.start;
  const nlopt_result result = nlopt_optimize(method.get(), out.x.data(), &out.value);
  out.converged = result > 0 && result != NLOPT_MAXEVAL_REACHED && result != NLOPT_MAXTIME_REACHED;
}

extern "C" const char* tendril_module_about() {
  int major = 0, minor = 0, fix = 0;
  nlopt_version(&major, &minor, &fix);
  static const std::string about = "NLopt " + std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(fix);
  return about.c_str();
}
