#include "method/assembly/proof.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"

namespace tendril::assembly {

namespace {

constexpr double most_overlap = 0.02;  // radii, of the system and an obstacle
constexpr double still_way = 20;  // radii that a change without a way counts for
constexpr double stiffest = 6, falls_by = 9;  // powers of ten of EI/L^3, of grips that let go

std::vector<Frame> poses_at(const Manipulation& manipulation, double t) {
  std::vector<Frame> poses;
  for (std::size_t g = 0; g < manipulation.grips.size(); ++g) poses.push_back(manipulation.pose(static_cast<int>(g), t));
  return poses;
}

/// Mostly next to nothing moves where grips stay: one step is tried, and smaller ones only where that jumps.
void all_at_once_first(DriveOptions& options) {
  options.stays = true;
  options.first_step = options.most_step = still_way;
}

Drive hang(const InstalledSystem& system, const Manipulation& manipulation, const SystemEquilibrium& start, DriveOptions options,
           const SolveOptions& solve, const RunContext& context) {
  all_at_once_first(options);
  options.flow = true;  // how it hangs before it is installed is nobody's concern
  const SystemProblem held = held_by(system.free, manipulation.grips, poses_at(manipulation, 0));
  const ProblemPath path = [&](double t, SystemProblem& problem) { set_gravity(problem, t * system.gravity()); };
  const auto moved = [&](double from, double to) { return (to - from) * still_way * system.radius; };
  SystemProblem weightless = held;
  set_gravity(weightless, Vec3::Zero());
  return drive(weightless, path, moved, start, options, solve, context);
}

Drive move(const InstalledSystem& system, const Manipulation& manipulation, const SystemEquilibrium& start, const DriveOptions& options,
           const SolveOptions& solve, const RunContext& context) {
  const SystemProblem held = held_by(system.free, manipulation.grips, poses_at(manipulation, 0));
  const ProblemPath path = [&](double t, SystemProblem& problem) { place(problem, manipulation.grips, poses_at(manipulation, t)); };
  const std::function<double(double, double)> moved = Travelled(manipulation);
  return drive(held, path, moved, start, options, solve, context);
}

/// Grips that are no connections become springs that get ever softer.
Drive let_go(const InstalledSystem& system, const std::vector<Grip>& grips, const SystemEquilibrium& start, DriveOptions options,
             const SolveOptions& solve, const RunContext& context) {
  all_at_once_first(options);
  const SystemProblem bare = held_by(system.free, system.connections, system.connected);
  const ProblemPath path = [&](double t, SystemProblem& problem) {
    problem = bare;
    if (t >= 1) return;
    for (const Grip& grip : grips) {
      if (grip.connection) continue;
      int rod = grip.rod;
      double at = grip.at;
      Frame pose = system.pose(start, grip);
      if (grip.branch >= 0) {
        const JoinedSection& section = system.free.branches[grip.branch].sections.front();
        rod = section.rod;
        at = section.at;
        pose = pose * section.relative;
      }
      const Rod& design = problem.rods[rod].rod;
      const Section& section = design.section_at(at);
      const double stiffness = std::min(section.EI1, section.EI2) / std::pow(design.length, 3) * std::pow(10, stiffest - falls_by * t);
      problem.rods[rod].springs.push_back({at, pose, stiffness, 0.05 * stiffness * design.length * design.length});
    }
  };
  const auto moved = [&](double from, double to) { return (to - from) * still_way * system.radius; };
  return drive(bare, path, moved, start, options, solve, context);
}

/// Worst values over what was played.
void measure(const InstalledSystem& system, const Drive& drive, double from, double to, Proof& proof) {
  for (const Passed& passed : drive.passed) {
    const double t = from + (to - from) * passed.t;
    for (std::size_t k = 0; k < passed.equilibrium.rods.size(); ++k) {
      const Equilibrium& rod = passed.equilibrium.rods[k];
      if (const double strain = rod.largest_strain(); strain > proof.strain) {
        proof.strain = strain;
        proof.strain_at_time = t;
        proof.strain_of = system.rods[k];
      }
      if (const double bend = rod.smallest_bend_radius(); bend < proof.bend_radius) {
        proof.bend_radius = bend;
        proof.bend_radius_at_time = t;
        proof.bend_radius_of = system.rods[k];
      }
      if (!system.surroundings) continue;
      for (std::size_t i = 0; i < rod.points.size(); ++i) {
        const double radius = system.free.rods[k].rod.section_at(rod.s[i]).radius();
        const ClosestPoint closest = system.surroundings->closest(rod.points[i], proof.clearance + radius);
        if (closest.obstacle < 0 || closest.distance - radius >= proof.clearance) continue;
        proof.clearance = closest.distance - radius;
        proof.clearance_at_time = t;
        proof.clearance_to = system.surroundings->obstacle(closest.obstacle).name;
      }
    }
  }
}

}  // namespace

Played play(const InstalledSystem& system, const Manipulation& manipulation, const SystemEquilibrium& start, double deviation,
            const DriveOptions& options, const SolveOptions& solve, const RunContext& context) {
  Played played;
  Proof& proof = played.proof;
  proof.bend_radius = INFINITY;
  proof.clearance = 1;
  DriveOptions strict = options;
  strict.flow = false;
  played.hung = hang(system, manipulation, start, options, solve, context);
  if (!played.hung.ok()) {
    proof.message = "before it is moved: " + played.hung.message;
    return played;
  }
  played.moved = move(system, manipulation, played.hung.passed.back().equilibrium, strict, solve, context);
  measure(system, played.moved, 0, 1, proof);
  proof.steps = static_cast<int>(played.moved.passed.size()) - 1;
  if (!played.moved.ok()) {
    proof.message = "at " + number_text(std::round(1e3 * played.moved.passed.back().t) / 10) + " % of the way in: " + played.moved.message;
    return played;
  }
  played.let_go = let_go(system, manipulation.grips, played.moved.passed.back().equilibrium, strict, solve, context);
  measure(system, played.let_go, 1, 1, proof);
  proof.steps += static_cast<int>(played.let_go.passed.size()) - 1;
  if (!played.let_go.ok()) {
    proof.message = "when the last grips let go: " + played.let_go.message;
    return played;
  }
  const SystemEquilibrium& last = played.let_go.passed.back().equilibrium;
  proof.deviation = farthest_move(last, system.routed);
  bool stable = true;
  for (const Equilibrium& rod : last.rods) stable = stable && rod.stable;
  const bool overlaps = proof.clearance < -most_overlap * system.radius;
  proof.ok = stable && !overlaps && proof.deviation <= deviation;
  if (!stable) proof.message = "what it ends in is not stable";
  else if (overlaps) proof.message = "it gets " + number_text(-proof.clearance / units::mm) + " mm into '" + proof.clearance_to + "'";
  else if (!proof.ok) proof.message = "it ends " + number_text(proof.deviation / units::mm) + " mm away from where it should be";
  return played;
}

}  // namespace tendril::assembly
