#include "method/route/stretch_trial.h"

#include <algorithm>
#include <cmath>

#include "method/route/gap_profile.h"
#include "statics/solve.h"

namespace tendril::routing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double far_enough = 0.05;   // m, room beyond which nothing is looked at more closely
constexpr double keeps_from = 1e-4;   // shares: what the refinement begins with is inside, not on the edge
constexpr int most_iterations = 150;  // as in refinement

/// The way itself as a shape to start from, at arc lengths from the stretch's beginning.
Equilibrium along_way(const std::function<Frame(double)>& way, double begin, double end, int segments) {
  Equilibrium shape;
  for (int i = 0; i <= segments; ++i) {
    const double s = (end - begin) * i / segments;
    const Frame frame = way(begin + s);
    shape.s.push_back(s);
    shape.points.push_back(frame.at);
    shape.rotations.push_back(frame.rotation);
  }
  return shape;
}

}  // namespace

Rod part_of(const Rod& rod, double begin, double end, int segments) {
  Rod part;
  part.length = end - begin;
  part.segments = std::max(segments, static_cast<int>(std::lround(rod.segments * part.length / rod.length)));
  double last = 0;
  for (const RodPart& piece : rod.parts) {
    const double upto = std::min(piece.upto - begin, part.length);
    if (upto > last + 1e-9 * rod.length) part.parts.push_back({last = upto, piece.section});
  }
  part.parts.back().upto = part.length;
  if (!rod.shape) return part;
  part.shape = [shape = rod.shape, begin](double s) { return shape(begin + s); };
  for (const double at : rod.shape_breaks)
    if (at > begin + 1e-9 * rod.length && at < end - 1e-9 * rod.length) part.shape_breaks.push_back(at - begin);
  return part;
}

double StretchTrial::margin(const Hold& from, const Hold& to) const {
  if (context_.stop()) return -infinity;
  RodProblem problem;
  problem.rod = part_of(rod_, from.at, to.at);
  if (rod_.mass() > 0) problem.gravity = gravity_;
  problem.surroundings = around_.touchable.get();
  problem.holds = {from, to};
  problem.holds.front().at = 0;
  problem.holds.back().at = problem.rod.length;
  for (Hold& hold : problem.holds) hold.cut_at = -1;
  SolveOptions solve_options = options_.solve;
  solve_options.clearance = ClearanceRule::judge;
  solve_options.error = false;
  solve_options.follow = true;
  solve_options.max_iterations = std::min(solve_options.max_iterations, most_iterations);
  const Equilibrium start = along_way(way_, from.at, to.at, problem.rod.segments);
  const Equilibrium rod = solve(problem, solve_options, context_, &start);
  if (!rod.ok() || !rod.stable) return -infinity;
  double margin = infinity;
  if (options_.min_bend_radius > 0) margin = std::min(margin, 1 - options_.min_bend_radius / rod.smallest_bend_radius());
  if (std::isfinite(options_.max_tension)) margin = std::min(margin, 1 - rod.largest_tension() / options_.max_tension);
  if (std::isfinite(options_.max_strain)) margin = std::min(margin, 1 - rod.largest_strain() / options_.max_strain);
  double scale = rod_.largest_radius();
  for (const PlacedObstacle& obstacle : around_.obstacles) scale = std::max(scale, obstacle.clearance);
  // Free stretches begin at the rod's ends and at clips.
  const double before = from.at > 0 ? options_.free_clips : options_.free_ends;
  const double after = to.at < rod_.length ? options_.free_clips : options_.free_ends;
  const GapProfile profile(around_.demanded, start, far_enough);
  if (problem.rod.length - after > before)
    for (const Room& room : profile.along(problem.rod, rod, {{before, problem.rod.length - after}}))
      margin = std::min(margin, room.value / scale);
  return margin - keeps_from;
}

}  // namespace tendril::routing
