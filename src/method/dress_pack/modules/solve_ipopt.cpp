// Ipopt behind method/dress_pack/ipopt_program.h.
#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpTNLP.hpp>

#include <chrono>
#include <exception>
#include <limits>
#include <mutex>

#include "method/dress_pack/ipopt_program.h"

namespace {

using namespace tendril;
using namespace tendril::dress_pack;
using Ipopt::Index;
using Ipopt::Number;
using Ipopt::SmartPtr;
using Ipopt::SolverReturn;

constexpr double ipopt_infinity = 2e19;
constexpr std::chrono::milliseconds turn{20};  // between two looks whether to go on waiting

using Vector = Eigen::VectorXd;
Eigen::Map<const Vector> in(const Number* x, Index n) { return {x, n}; }
Eigen::Map<Vector> out_of(Number* x, Index n) { return {x, n}; }

void copy_bounds(const Vector& lower, const Vector& upper, Number* to_lower, Number* to_upper) {
  for (Index k = 0; k < static_cast<Index>(lower.size()); ++k) {
    to_lower[k] = std::max(lower[k], -ipopt_infinity);
    to_upper[k] = std::min(upper[k], ipopt_infinity);
  }
}

class Adapter final : public Ipopt::TNLP {
 public:
  Adapter(NonlinearProgram& program, const NonlinearOptions& options, const RunContext& context, NonlinearOutcome& out)
      : program_(program), options_(options), context_(context), out_(out) {}

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = program_.variables();
    m = program_.rows();
    jacobian = static_cast<Index>(program_.jacobian_entries.size());
    hessian = static_cast<Index>(program_.hessian_entries.size());
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index, Number* x_lower, Number* x_upper, Index, Number* lower, Number* upper) override {
    copy_bounds(program_.lower, program_.upper, x_lower, x_upper);
    copy_bounds(program_.row_lower, program_.row_upper, lower, upper);
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    out_of(x, n) = program_.start;
    return true;
  }
  bool eval_f(Index n, const Number* x, bool, Number& f) override { return program_.value(in(x, n), f); }
  bool eval_grad_f(Index n, const Number* x, bool, Number* slope) override { return program_.slope(in(x, n), out_of(slope, n)); }
  bool eval_g(Index n, const Number* x, bool, Index m, Number* c) override { return program_.constraints(in(x, n), out_of(c, m)); }
  bool eval_jac_g(Index n, const Number* x, bool, Index, Index count, Index* rows, Index* columns, Number* values) override {
    return values ? program_.jacobian(in(x, n), out_of(values, count)) : place(program_.jacobian_entries, rows, columns);
  }
  bool eval_h(Index n, const Number* x, bool, Number factor, Index m, const Number* multipliers, bool, Index count, Index* rows,
              Index* columns, Number* values) override {
    if (!values) return place(program_.hessian_entries, rows, columns);
    return program_.hessian(in(x, n), factor, in(multipliers, m), out_of(values, count));
  }
  void finalize_solution(SolverReturn, Index n, const Number* x, const Number*, const Number*, Index m, const Number* c, const Number*,
                         Number value, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    out_.x = in(x, n);
    out_.value = value;
    out_.violation = program_.violation(in(x, n), in(c, m));
  }
  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number value, Number, Number, Number, Number, Number, Number, Number,
                             Index, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    out_.iterations = iteration;
    if (options_.progress) options_.progress(iteration, value);
    return !context_.stop();
  }

 private:
  static bool place(const std::vector<NonlinearProgram::Entry>& entries, Index* rows, Index* columns) {
    for (std::size_t k = 0; k < entries.size(); ++k) {
      rows[k] = entries[k].row;
      columns[k] = entries[k].column;
    }
    return true;
  }

  NonlinearProgram& program_;
  const NonlinearOptions& options_;
  const RunContext& context_;
  NonlinearOutcome& out_;
};

void stopped(Status status, NonlinearOutcome& out) {
  out.status = status;
  out.message = status == Status::timeout ? "out of time" : "interrupted";
}

void translate(Ipopt::ApplicationReturnStatus status, const RunContext& context, NonlinearOutcome& out) {
  const auto say = [&](Status how, const char* message) {
    out.status = how;
    out.message = message;
  };
  switch (status) {
    case Ipopt::Solve_Succeeded: return say(Status::solved, "solved");
    case Ipopt::Solved_To_Acceptable_Level: return say(Status::solved, "solved to a lower accuracy");
    case Ipopt::Feasible_Point_Found: return say(Status::solved, "solved");
    case Ipopt::Infeasible_Problem_Detected: return say(Status::infeasible, "no way was found to satisfy the equations");
    case Ipopt::Search_Direction_Becomes_Too_Small: return say(Status::stalled, "no step improves the path any more");
    case Ipopt::Diverging_Iterates: return say(Status::stalled, "the iterates diverge");
    case Ipopt::User_Requested_Stop: return stopped(context.stop().value_or(Status::cancelled), out);
    case Ipopt::Maximum_Iterations_Exceeded: return say(Status::stalled, "out of iterations");
    case Ipopt::Maximum_CpuTime_Exceeded: return say(Status::timeout, "out of time");
    case Ipopt::Restoration_Failed: return say(Status::stalled, "the way back to satisfied equations was not found");
    case Ipopt::Error_In_Step_Computation: return say(Status::stalled, "no step could be computed");
    case Ipopt::Invalid_Number_Detected: return say(Status::stalled, "a function is not a number");
    case Ipopt::Not_Enough_Degrees_Of_Freedom: return say(Status::infeasible, "more equations than variables");
    case Ipopt::Insufficient_Memory: return say(Status::stalled, "not enough memory");
    default: return say(Status::stalled, "the solver of non-linear programs failed");
  }
}

void set_options(Ipopt::IpoptApplication& solver, const NonlinearOptions& options) {
  Ipopt::OptionsList& list = *solver.Options();
  list.SetIntegerValue("print_level", 0);
  list.SetStringValue("sb", "yes");
  list.SetStringValue("linear_solver", "mumps");
  list.SetNumericValue("tol", options.tolerance);
  list.SetNumericValue("constr_viol_tol", options.tolerance);
  list.SetIntegerValue("max_iter", options.most_iterations);
  list.SetNumericValue("mu_init", options.barrier);
  list.SetStringValue("nlp_scaling_method", "none");
  list.SetNumericValue("obj_scaling_factor", options.scale);
  // Multipliers of bounds that suit the barrier: those of the default, 1, would hold the variables back.
  list.SetStringValue("bound_mult_init_method", "mu-based");
  // The start is an equilibrium within all limits: it is neither moved from its bounds nor are they relaxed.
  list.SetNumericValue("bound_push", 1e-8);
  list.SetNumericValue("bound_frac", 1e-8);
  list.SetNumericValue("slack_bound_push", 1e-8);
  list.SetNumericValue("slack_bound_frac", 1e-8);
  list.SetNumericValue("bound_relax_factor", 0);
}

void solve(NonlinearProgram& program, const NonlinearOptions& options, const RunContext& context, NonlinearOutcome& out) {
  SmartPtr<Ipopt::IpoptApplication> solver = new Ipopt::IpoptApplication(false);
  set_options(*solver, options);
  // No options from a file that happens to lie in the folder.
  solver->Options()->SetStringValue("option_file_name", "");
  if (solver->Initialize("") != Ipopt::Solve_Succeeded) {
    out.message = "the solver of non-linear programs did not start";
    return;
  }
  SmartPtr<Ipopt::TNLP> adapter = new Adapter(program, options, context, out);
  translate(solver->OptimizeTNLP(adapter), context, out);
}

}  // namespace

extern "C" void tendril_solve_nonlinear(NonlinearProgram& program, const NonlinearOptions& options, const RunContext& context,
                                        NonlinearOutcome& out) {
  out.x = program.start;
  out.value = out.violation = std::numeric_limits<double>::infinity();
  // Ipopt's linear solver keeps its state in static memory: two solutions at a time would end the process.
  static std::timed_mutex one_at_a_time;
  std::unique_lock<std::timed_mutex> lock(one_at_a_time, std::defer_lock);
  while (!lock.try_lock_for(turn))
    if (const auto why = context.stop()) return stopped(*why, out);
  try {
    solve(program, options, context, out);
  } catch (const std::exception& failure) {
    out.status = Status::stalled;
    out.message = std::string("the solver of non-linear programs failed: ") + failure.what();
  } catch (...) {
    out.status = Status::stalled;
    out.message = "the solver of non-linear programs failed";
  }
}

extern "C" const char* tendril_module_about() { return "Ipopt " IPOPT_VERSION; }
