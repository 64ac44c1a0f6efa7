#include "statics/batch_scalar.h"

#include "base/error.h"
#include "statics/solve.h"

namespace tendril {

ScalarAnswer solve_scalar(const SystemProblem& problem, const SolveOptions& options, const RunContext& context) {
  ScalarAnswer answer;
  try {
    const Equilibrium found = solve(problem.rods.at(0), options, context);
    answer.status = found.status;
    answer.iterations = found.iterations;
    answer.last_step = found.last_step;
    if (!found.ok()) answer.message = found.message;
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < found.points.size(); ++i) frames.push_back({found.points[i], found.rotations[i]});
    answer.at.vertices.push_back(frames);
    for (const Reaction& reaction : found.reactions) answer.reactions.push_back({reaction.force, reaction.moment});
  } catch (const UsageError& error) {
    answer.message = error.what();
  }
  return answer;
}

}  // namespace tendril
