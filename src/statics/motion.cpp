#include "statics/motion.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "statics/solve.h"

namespace tendril {
namespace {

constexpr double growth = 1.7, shrinking = 0.5;

void place(SystemProblem& problem, const std::vector<HeldPath>& paths, double t) {
  for (const HeldPath& path : paths) {
    const Frame frame = path.at(t);
    if (!all_finite(frame.at) || !all_finite(frame.rotation.coeffs()))
      throw UsageError("motion: the frame at t = " + number_text(t) + " has numbers that are not finite");
    if (path.branch >= 0)
      problem.branches[path.branch].frame = frame;
    else
      problem.rods[path.rod].holds[path.hold].frame = frame;
  }
}

/// The farthest that any vertex has moved.
struct Move {
  int rod = 0;
  double s = 0, distance = 0;
  double share = 0;  ///< of its rod's length
};

Move farthest(const SystemEquilibrium& a, const SystemEquilibrium& b) {
  Move most;
  for (std::size_t k = 0; k < a.rods.size(); ++k)
    for (std::size_t i = 0; i < a.rods[k].points.size(); ++i) {
      const double distance = (a.rods[k].points[i] - b.rods[k].points[i]).norm();
      if (distance / a.rods[k].s.back() > most.share)
        most = {static_cast<int>(k), a.rods[k].s[i], distance, distance / a.rods[k].s.back()};
    }
  return most;
}

void check(const SystemProblem& problem, const std::vector<HeldPath>& paths) {
  if (paths.empty()) throw UsageError("motion: no hold moves; give at least one path");
  for (const HeldPath& path : paths) {
    const bool branch = path.branch >= 0 && path.branch < static_cast<int>(problem.branches.size());
    const bool rod = path.rod >= 0 && path.rod < static_cast<int>(problem.rods.size()) && path.hold >= 0 &&
                     path.hold < static_cast<int>(problem.rods[path.rod].holds.size());
    if (!branch && !rod) throw UsageError("motion: a path belongs to a hold that the problem does not have");
  }
}

}  // namespace

Motion move_holds(const SystemProblem& problem, const std::vector<HeldPath>& paths, const MotionOptions& motion,
                  const SolveOptions& options, const RunContext& context, const SystemEquilibrium* from) {
  check(problem, paths);
  const auto path = [&paths](double t, SystemProblem& moved) { place(moved, paths, t); };
  return follow(problem, path, motion, options, context, from);
}

Motion follow(const SystemProblem& given, const ProblemPath& path, const MotionOptions& motion, const SolveOptions& options,
              const RunContext& context, const SystemEquilibrium* from) {
  if (motion.steps < 1) throw UsageError("motion: " + std::to_string(motion.steps) + " steps, expected at least 1");
  SolveOptions following = options;
  following.follow = true;
  following.error = false;
  SystemProblem problem = given;
  Motion out;
  path(0, problem);
  SystemEquilibrium here = solve(problem, options, context, from);
  out.solves = 1;
  out.status = here.rods.front().status;
  out.message = here.rods.front().message;
  if (!here.ok()) return out;
  out.steps.push_back({0, here});
  double t = 0, step = 1.0 / motion.steps;
  int next = 1;  // of the asked-for solutions
  while (next <= motion.steps) {
    if (out.solves >= motion.most_solves) {
      out.status = Status::stalled;
      out.message = "no end of it in " + std::to_string(out.solves) + " solutions, at t = " + number_text(t);
      return out;
    }
    const double stop = double(next) / motion.steps;
    const bool arrives = t + step >= stop - 1e-12;
    const double there = arrives ? stop : t + step;
    path(there, problem);
    SystemEquilibrium found = solve(problem, following, context, &here);
    ++out.solves;
    const Status status = found.rods.front().status;
    if (status == Status::cancelled || status == Status::timeout) {
      out.status = status;
      out.message = found.rods.front().message + " at t = " + number_text(t);
      return out;
    }
    const Move move = found.ok() ? farthest(here, found) : Move{};
    const bool smooth = found.ok() && move.share <= motion.largest_move;
    if (!smooth && there - t > motion.smallest_step * (1 + 1e-9)) {
      step = std::max(motion.smallest_step, shrinking * (there - t));
      continue;
    }
    if (!found.ok()) {
      out.status = status;
      out.message = "no equilibrium beyond t = " + number_text(t) + ": " + found.rods.front().message;
      return out;
    }
    if (!smooth) {
      out.snaps.push_back({t, move.rod, move.s, move.distance, here.energy() - found.energy()});
      if (out.steps.back().t < t) out.steps.push_back({t, here});
    }
    if (arrives || !smooth) out.steps.push_back({there, found});
    if (arrives) ++next;
    here = std::move(found);
    if (smooth && move.share < 0.5 * motion.largest_move) step = std::min(growth * step, 1.0 / motion.steps);
    t = there;
  }
  out.message = out.snaps.empty() ? "solved" : "solved, with " + std::to_string(out.snaps.size()) + " snap-through" + (out.snaps.size() > 1 ? "s" : "");
  return out;
}

}  // namespace tendril
