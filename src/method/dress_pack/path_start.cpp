#include "method/dress_pack/path_start.h"

namespace tendril::dress_pack {

bool take_path(const PackProblem& pack, const JointPath& given, const ReducedOptions& options, const RunContext& context, ReducedResult& out) {
  out.path = options.via > 0 ? given.resampled(options.via) : given;
  const std::string beyond = beyond_robot(out.path, *pack.robot, options.seconds);
  if (!beyond.empty()) {
    out.status = Status::infeasible;
    out.message = "the path cannot be improved from where it starts: " + beyond;
    return false;
  }
  SimulationOptions simulation;
  simulation.steps = options.steps;
  out.before = simulate(pack, out.path, simulation, context);
  return true;
}

bool follow_once(ReducedProblem& problem, const RunContext& context, ReducedResult& out) {
  const PackFollower::Outcome way = problem.start(context);
  if (way.ok()) return true;
  const bool ended = way.status == Status::cancelled || way.status == Status::timeout;
  out.status = ended ? way.status : Status::infeasible;
  out.message = ended ? "interrupted before the path was followed once" : "the rods cannot follow the path: " + out.before.message;
  return false;
}

}  // namespace tendril::dress_pack
