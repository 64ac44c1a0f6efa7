#include "method/assembly/assembly.h"

#include "base/number_text.h"
#include "base/units.h"
#include "method/assembly/installed_system.h"
#include "method/assembly/manipulation_search.h"
#include "method/assembly/stage.h"

namespace tendril::assembly {

namespace {

constexpr const char* step_names[] = {"routed_configuration", "constraint_relaxation",       "handle_path_planning",
                                      "path_smoothing",       "grip_point_supplementation", "optimisation"};

void conclude(const InstalledSystem& system, bool proven, const RunContext& context, Result& r) {
  if (!proven && context.stop()) {
    r.status = *context.stop();
    r.message = std::string(r.status == Status::timeout ? "out of time" : "cancelled") + " after " + std::to_string(r.attempts.size()) + " attempts";
    return;
  }
  if (!system.routed.ok()) {
    r.message = "the routed configuration has no equilibrium: " + system.routed.rods.front().message;
    return;
  }
  r.ok = proven;
  r.status = proven ? Status::solved : Status::infeasible;
  if (proven)
    r.message = "installed by " + std::to_string(r.hands) + " grips; played forward it ends " + number_text(r.proof.deviation / units::mm) + " mm from the routed configuration";
  else if (r.attempts.empty())
    r.message = "none found: " + r.message;
  else
    r.message = "none found in " + std::to_string(r.attempts.size()) + " attempts; the best: " + r.message;
}

}  // namespace

Result run(const Scene& scene, const Options& options, const RunContext& context) {
  const auto start = RunContext::Clock::now();
  Result r;
  for (const char* name : step_names) r.steps.push_back({name, 0, {}});
  InstalledSystem system;
  {
    const Stage stage(r.steps[routed_configuration], "solves");
    system = installed_system(scene, options, 2, context);
    r.steps[routed_configuration].counts = {{"rods", long(system.rods.size())}, {"connections", long(system.connections.size())}};
  }
  // Constraint relaxation, handle path planning, path smoothing and grip point supplementation, attempt by attempt; optimisation.
  const bool proven = system.routed.ok() && ManipulationSearch(scene, system, options, context, r).run();
  conclude(system, proven, context, r);
  r.seconds = std::chrono::duration<double>(RunContext::Clock::now() - start).count();
  return r;
}

}  // namespace tendril::assembly
