#include "method/dress_pack/ipopt_program.h"

#include <exception>

#include "base/load_module.h"

namespace tendril::dress_pack {
namespace {

/// What the program throws is kept until the solver, which knows no exceptions of others, has ended.
class Guarded final : public NonlinearProgram {
 public:
  explicit Guarded(NonlinearProgram& program) : program_(program) {
    lower = program.lower, upper = program.upper, start = program.start;
    row_lower = program.row_lower, row_upper = program.row_upper;
    jacobian_entries = program.jacobian_entries, hessian_entries = program.hessian_entries;
  }
  bool value(In x, double& f) override {
    return guard([&] { return program_.value(x, f); });
  }
  bool slope(In x, Out f_x) override {
    return guard([&] { return program_.slope(x, f_x); });
  }
  bool constraints(In x, Out c) override {
    return guard([&] { return program_.constraints(x, c); });
  }
  bool jacobian(In x, Out entries) override {
    return guard([&] { return program_.jacobian(x, entries); });
  }
  bool hessian(In x, double factor, In multipliers, Out entries) override {
    return guard([&] { return program_.hessian(x, factor, multipliers, entries); });
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  template <class Work>
  bool guard(Work work) {
    if (thrown_) return false;
    try {
      return work();
    } catch (...) {
      thrown_ = std::current_exception();
      return false;
    }
  }
  NonlinearProgram& program_;
  std::exception_ptr thrown_;
};

}  // namespace

NonlinearOutcome solve_nonlinear(NonlinearProgram& program, const NonlinearOptions& options, const RunContext& context) {
  static const auto entry =
      reinterpret_cast<NonlinearEntry>(module_entry("dress pack: the direct formulation", "tendril_ipopt.so", nonlinear_entry));
  Guarded guarded(program);
  NonlinearOutcome out;
  entry(guarded, options, context, out);
  guarded.rethrow();
  return out;
}

}  // namespace tendril::dress_pack
