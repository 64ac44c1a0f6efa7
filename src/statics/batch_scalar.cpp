#include "statics/batch_scalar.h"

#include "base/error.h"
#include "statics/solve.h"

namespace tendril {

namespace {

std::vector<Frame> frames_of(const Equilibrium& rod, const std::vector<double>* shares) {
  std::vector<Frame> frames;
  if (!shares || shares->size() == rod.s.size())
    for (std::size_t i = 0; i < rod.points.size(); ++i) frames.push_back({rod.points[i], rod.rotations[i]});
  else
    for (const double share : *shares) frames.push_back(rod.frame_at(share * rod.s.back()));
  return frames;
}

}  // namespace

ScalarAnswer solve_scalar(const SystemProblem& problem, const SolveOptions& options, const RunContext& context,
                          const SystemEquilibrium* from, const std::vector<std::vector<double>>* shares) {
  ScalarAnswer answer;
  if (shares && problem.rods.size() != shares->size()) {
    answer.message = "the outcome has another number of rods than the nominal problem";
    return answer;
  }
  try {
    const SystemEquilibrium found = solve(problem, options, context, from);
    const Equilibrium& first = found.rods.at(0);
    answer.status = first.status;
    answer.iterations = first.iterations;
    answer.last_step = first.last_step;
    if (!found.ok()) answer.message = first.message;
    for (std::size_t k = 0; k < found.rods.size(); ++k) {
      answer.at.vertices.push_back(frames_of(found.rods[k], shares ? &(*shares)[k] : nullptr));
      answer.holds.emplace_back();
      for (const Reaction& reaction : found.rods[k].reactions)
        answer.holds.back().push_back({reaction.force, reaction.moment});
    }
    answer.at.branches = found.branches;
    for (std::size_t b = 0; b < found.branch_supports.size(); ++b) {
      const BranchPoint& branch = problem.branches[b];
      answer.branches.push_back({branch.position ? found.branch_supports[b].force : Vec3::Zero(),
                                 branch.orientation ? found.branch_supports[b].moment : Vec3::Zero()});
    }
  } catch (const UsageError& error) {
    answer.message = error.what();
  }
  return answer;
}

}  // namespace tendril
