#include "binding/solve_options.h"

#include <chrono>

namespace tendril::lua {

Schema solve_schema() {
  return {
      option<std::string>("element", "", "Rod element: fourth order, or the second-order reference element")
          .one_of({"se3", "staggered"}).preset("se3"),
      option<std::string>("clamp", "", "How the staggered element clamps an end: second order, or the thesis's first order")
          .one_of({"half_cell", "thesis"}).preset("half_cell"),
      option<double>("tolerance", "", "Largest last step: rotations in rad, positions over the length")
          .at_least(1e-14).at_most(1e-2).preset(1e-9),
      option<std::string>("clearance", "", "What obstacles' required clearances do: judged after the solve, or kept: contact "
                                           "then acts that far off, growing from nothing at holds")
          .one_of({"judge", "push"}).preset("judge"),
      option<bool>("error", "", "Also estimate the discretisation error").preset(false),
  };
}

SolveOptions solve_options(const Options& o) {
  SolveOptions options;
  options.element = o.get<std::string>("element") == "staggered" ? Element::staggered : Element::se3;
  options.clamp = o.get<std::string>("clamp") == "thesis" ? ClampRule::thesis : ClampRule::half_cell;
  if (options.clamp == ClampRule::thesis && options.element == Element::se3)
    throw UsageError(o.who() + ": clamp = 'thesis' belongs to element = 'staggered', got 'se3'");
  options.tolerance = o.get<double>("tolerance");
  options.error = o.get<bool>("error");
  if (o.get<std::string>("clearance") == "push") options.clearance = ClearanceRule::push;
  return options;
}

Schema timeout_schema() {
  return {option<double>("timeout", "s", "Give up after this time, with the best state so far; default: never")
              .above(0).at_most(1e9)};
}

RunContext run_context(lua_State* L, const Options& o) {
  RunContext context = run_context(L);
  if (const auto seconds = o.maybe<double>("timeout"))
    context.deadline = RunContext::Clock::now() +
                       std::chrono::duration_cast<RunContext::Clock::duration>(std::chrono::duration<double>(*seconds));
  return context;
}

}  // namespace tendril::lua
