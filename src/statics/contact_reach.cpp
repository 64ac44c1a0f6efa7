#include "statics/contact_reach.h"

#include <algorithm>
#include <optional>

namespace tendril {
namespace {

struct Ball {
  Vec3 centre;
  double radius;  ///< m
};

/// How much longer than its length the rod may be.
double stretch_of(const RodProblem& problem) {
  double stiffness = problem.rod.parts.front().section.EA, load = problem.rod.mass() * problem.gravity.norm();
  for (const RodPart& part : problem.rod.parts) stiffness = std::min(stiffness, part.section.EA);
  for (const PointLoad& point : problem.loads) load += point.force.norm();
  return 1.05 + 2 * load / stiffness;
}

/// Between two held places h1 and h2, l of rod apart, |p - h1| + |p - h2| <= l: a ball of diameter l about their middle.
/// Beyond them a free end reaches as far as it is long.
std::optional<Ball> ball_about_holds(const RodProblem& problem, double stretch) {
  const Hold *first = nullptr, *last = nullptr;
  for (const Hold& hold : problem.holds) {
    if (!hold.position || hold.slide) continue;
    if (!first || hold.at < first->at) first = &hold;
    if (!last || hold.at > last->at) last = &hold;
  }
  if (!first) return std::nullopt;
  const Vec3 centre = 0.5 * (first->frame.at + last->frame.at);
  const double aside = (first->frame.at - centre).norm();
  const double tail = std::max(first->at, problem.rod.length - last->at);
  // What holds pull apart is as long as they are apart.
  const double between = std::max(0.5 * stretch * (last->at - first->at), 1.05 * aside);
  return Ball{centre, std::max(between, aside + stretch * tail)};
}

/// Somewhere a network is held; no further from there than all its rods together are long.
std::optional<Ball> ball_about_network(const RodNetwork& network) {
  double length = 0;
  std::optional<Vec3> centre;
  for (int k = 0; k < network.rods(); ++k) {
    const RodProblem& problem = network.rod(k).problem();
    length += stretch_of(problem) * problem.rod.length;
    for (const Hold& hold : problem.holds)
      if (hold.position && !centre) centre = hold.frame.at;
  }
  for (const BranchPoint& branch : network.problem().branches) {
    if (branch.position && !centre) centre = branch.frame.at;
    for (const JoinedSection& section : branch.sections) length += 2 * section.relative.at.norm();
  }
  if (!centre) return std::nullopt;
  return Ball{*centre, length};
}

}  // namespace

bool can_touch(const RodNetwork& network, ClearanceRule clearance) {
  for (int k = 0; k < network.rods(); ++k) {
    const RodProblem& problem = network.rod(k).problem();
    if (!problem.surroundings) continue;
    std::optional<Ball> ball = ball_about_holds(problem, stretch_of(problem));
    if (!ball) ball = ball_about_network(network);
    if (!ball) return true;
    const double limit = ball->radius + problem.rod.largest_radius();
    const double keep = clearance == ClearanceRule::push ? problem.surroundings->largest_clearance() : 0;
    if (problem.surroundings->closest_kept(ball->centre, limit, keep).obstacle >= 0) return true;
  }
  return false;
}

}  // namespace tendril
