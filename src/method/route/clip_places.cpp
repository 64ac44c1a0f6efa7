#include "method/route/clip_places.h"

#include <algorithm>
#include <cmath>

#include "method/route/local_refinement.h"

namespace tendril::routing {

double room_at_holds(double length, double radius) { return std::max(0.02 * length, 4 * radius); }

bool ClipSites::take(const Vec3& at, double radius) const {
  if (!around) return false;
  const ClosestPoint kept = around->closest_kept(at, 1e3, 1e3);
  if (kept.obstacle >= 0 && kept.distance < radius) return false;
  for (int k = 0; k < static_cast<int>(obstacles->size()); ++k)
    if ((*obstacles)[k].clip && around->closest_on(k, at, reach + radius).obstacle >= 0) return true;
  return false;
}

std::vector<Hold> clip_places(const std::function<Frame(double)>& way, double length, double radius, double spacing, double ends,
                              const ClipSites& sites) {
  std::vector<Hold> places;
  const double room = length - 2 * ends;
  if (!(room >= 0) || !(spacing > 0)) return places;
  const int pieces = static_cast<int>(std::ceil(room / spacing));
  for (int i = 0; i <= pieces; ++i) {
    const double s = pieces > 0 ? ends + room * i / pieces : 0.5 * length;
    const Frame frame = way(s);
    if (sites.take(frame.at, radius)) places.push_back({s, frame});
  }
  return places;
}

namespace {

/// Holds before and after an arc length.
std::pair<const Hold*, const Hold*> neighbours(const RodProblem& problem, double s) {
  std::size_t next = 1;
  while (next + 1 < problem.holds.size() && s > problem.holds[next].at) ++next;
  return {&problem.holds[next - 1], &problem.holds[next]};
}

/// Where the section would be without sagging: on the design's route, or on the straight between its neighbouring holds.
Frame unsagged(const RodProblem& problem, const Design& design, double s, const Frame& now) {
  if (design.route) {
    const Frame there = design.route->at(s / problem.rod.length * design.route->length());
    return {there.at, shortest_turn(now.d3(), there.d3()) * now.rotation};
  }
  const auto [a, b] = neighbours(problem, s);
  const Vec3 way = b->frame.at - a->frame.at;
  const Vec3 at = a->frame.at + (s - a->at) / (b->at - a->at) * way;
  if (!(way.norm() > 1e-9 * problem.rod.length)) return {at, now.rotation};
  return {at, shortest_turn(now.d3(), way.normalized()) * now.rotation};
}

/// The clip at an arc length: as little sagged as something is in reach.
std::optional<Hold> clip_at(const SceneEquilibrium& eq, const Design& design, double s, double reach) {
  const SolvedRod& rod = eq.rods.front();
  const Frame now = rod.equilibrium.frame_at(s), best = unsagged(rod.problem, design, s, now);
  for (const double share : {1.0, 0.8, 0.6, 0.4, 0.2, 0.0}) {
    const Frame frame{now.at + share * (best.at - now.at), now.rotation.slerp(share, best.rotation)};
    if (ClipSites{eq.surroundings.get(), &eq.obstacles, reach}.take(frame.at, rod.problem.rod.section_at(s).radius()))
      return Hold{s, frame};
  }
  return std::nullopt;
}

/// Arc length where the rod hangs farthest below the straight between its neighbouring holds; without gravity, where it is
/// farthest from it.
double farthest_from_chord(const SceneEquilibrium& eq) {
  const SolvedRod& rod = eq.rods.front();
  const Equilibrium& shape = rod.equilibrium;
  const Vec3 down = rod.problem.gravity.isZero(0) ? Vec3(Vec3::Zero()) : Vec3(rod.problem.gravity.normalized());
  double farthest = -1, at = 0.5 * rod.problem.rod.length;
  for (std::size_t i = 0; i < shape.s.size(); ++i) {
    const auto [a_hold, b_hold] = neighbours(rod.problem, shape.s[i]);
    const Hold &a = *a_hold, &b = *b_hold;
    const double share = std::clamp((shape.s[i] - a.at) / (b.at - a.at), 0.0, 1.0);
    const Vec3 off = shape.points[i] - (a.frame.at + share * (b.frame.at - a.frame.at));
    const double sag = down.isZero(0) ? off.norm() : off.dot(down);
    if (sag > farthest) {
      farthest = sag;
      at = shape.s[i];
    }
  }
  return at;
}

/// Arc length where a demanded clearance is missed most; where none is, where the rod sags most.
double wanted_place(const SceneEquilibrium& eq, const RefinementOptions& options) {
  const SolvedRod& rod = eq.rods.front();
  const double length = rod.problem.rod.length, begin = std::min(options.free_ends, 0.5 * length);
  double wanted = farthest_from_chord(eq), worst = 0;
  for (int k = 0; k < static_cast<int>(eq.obstacles.size()); ++k) {
    const double required = eq.obstacles[k].clearance;
    if (!(required > 0)) continue;
    const Clearance gap = eq.clearance(rod, k, begin, length - begin);
    if (gap.obstacle < 0 || required - gap.value <= worst) continue;
    worst = required - gap.value;
    wanted = gap.s;
  }
  return wanted;
}

}  // namespace

std::optional<Hold> propose_clip(const SceneEquilibrium& equilibrium, const Design& design, const RefinementOptions& options) {
  if (equilibrium.rods.empty() || equilibrium.rods.front().equilibrium.s.empty() || !equilibrium.surroundings) return std::nullopt;
  const RodProblem& problem = equilibrium.rods.front().problem;
  const double wanted = wanted_place(equilibrium, options), apart = std::max(0.05 * problem.rod.length, 4 * problem.rod.largest_radius());
  std::optional<Hold> best;
  constexpr int places = 100;
  for (int i = 1; i < places; ++i) {
    const double s = problem.rod.length * i / places;
    const bool taken = std::any_of(problem.holds.begin(), problem.holds.end(),
                                   [&](const Hold& hold) { return std::abs(hold.at - s) < apart; });
    if (taken || (best && std::abs(best->at - wanted) <= std::abs(s - wanted))) continue;
    if (const std::optional<Hold> clip = clip_at(equilibrium, design, s, options.clip_reach)) best = clip;
  }
  return best;
}

}  // namespace tendril::routing
