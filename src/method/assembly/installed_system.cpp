#include "method/assembly/installed_system.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/nearest_name.h"
#include "base/number_text.h"
#include "method/assembly/quasi_static.h"
#include "method/assembly/connector_ends.h"
#include "statics/solve.h"

namespace tendril::assembly {

namespace {

// Of equilibria that change when they are touched, in radii: how far they may be from each other, and what is no change.
constexpr double touched_off = 0.5, touched_still = 0.01;
constexpr int most_touches = 4;

void add_place(SystemProblem& problem, int rod, double at) { problem.rods[rod].springs.push_back({at, Frame{}, 0, 0}); }

}  // namespace

Scene::System system_of(const Scene& scene, const std::vector<std::string>& rods, const std::string& who) {
  std::vector<std::string> names;
  for (const auto& rod : scene.rods()) names.push_back(rod->name());
  if (names.empty()) throw UsageError(who + ": the scene has no rods");
  for (const std::string& wanted : rods)
    if (std::find(names.begin(), names.end(), wanted) == names.end()) throw UsageError(who + ": unknown " + unknown_name(wanted, "rods", names));
  const std::string first = rods.empty() ? names.front() : rods.front();
  for (Scene::System& system : scene.systems()) {
    const auto has = [&](const std::string& name) {
      return std::any_of(system.rods.begin(), system.rods.end(), [&](int k) { return names[k] == name; });
    };
    if (!has(first)) continue;
    for (const std::string& wanted : rods.empty() ? names : rods)
      if (!has(wanted))
        throw UsageError(who + ": rods '" + first + "' and '" + wanted + "' do not hang together; take them one after the other ('rods' names those of one)");
    return system;
  }
  throw UsageError(who + ": rod '" + first + "' belongs to no system");
}

Frame InstalledSystem::pose(const SystemEquilibrium& state, const Grip& grip) const {
  if (grip.branch >= 0) return state.branches[grip.branch];
  const Equilibrium& rod = state.rods[grip.rod];
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < rod.s.size(); ++i)
    if (std::abs(rod.s[i] - grip.at) < std::abs(rod.s[nearest] - grip.at)) nearest = i;
  return {rod.points[nearest], rod.rotations[nearest]};
}

// Distances along the rods between places (ends, joined sections, the grip) by Dijkstra's method.
double InstalledSystem::arm(const Grip& grip) const {
  struct Place {
    int rod;
    double at;
    int branch;
  };
  std::vector<Place> places;
  std::vector<std::vector<int>> on_rod(free.rods.size()), at_branch(free.branches.size());
  const auto add = [&](const Place& place) {
    on_rod[place.rod].push_back(static_cast<int>(places.size()));
    if (place.branch >= 0) at_branch[place.branch].push_back(static_cast<int>(places.size()));
    places.push_back(place);
  };
  for (int k = 0; k < static_cast<int>(free.rods.size()); ++k)
    for (const double at : {0.0, free.rods[k].rod.length}) add({k, at, -1});
  for (int b = 0; b < static_cast<int>(free.branches.size()); ++b)
    for (const JoinedSection& section : free.branches[b].sections) add({section.rod, section.at, b});
  std::vector<double> way(places.size(), INFINITY);
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> waiting;
  const auto reach = [&](int place, double length) {
    if (length >= way[place]) return;
    way[place] = length;
    waiting.push({length, place});
  };
  if (grip.branch >= 0)
    for (const int place : at_branch[grip.branch]) reach(place, 0);
  else
    for (const int place : on_rod[grip.rod]) reach(place, std::abs(places[place].at - grip.at));
  while (!waiting.empty()) {
    const auto [length, here] = waiting.top();
    waiting.pop();
    if (length > way[here]) continue;
    for (const int place : on_rod[places[here].rod]) reach(place, length + std::abs(places[place].at - places[here].at));
    if (places[here].branch < 0) continue;
    for (const int place : at_branch[places[here].branch]) reach(place, length);
  }
  return *std::max_element(way.begin(), way.end());
}

namespace {

// Without friction some equilibria on edges have a neighbour a fraction of a radius away that they change to when they are touched:
// every installation would end there. Touched and let go until it stays; where that leads farther away it is left as it was.
void settle(InstalledSystem& installed, const SolveOptions& solve, const RunContext& context) {
  const Grip& touched = installed.extra.front();
  std::vector<Grip> grips = installed.connections;
  grips.push_back(touched);
  SystemEquilibrium state = installed.routed;
  for (int again = 0; again < most_touches && state.ok() && !context.stop(); ++again) {
    std::vector<Frame> poses = installed.connected;
    poses.push_back(installed.pose(state, touched));
    const SystemEquilibrium held = tendril::solve(held_by(installed.free, grips, poses), solve, context, &state);
    if (!held.ok()) return;
    SystemEquilibrium freed = tendril::solve(held_by(installed.free, installed.connections, installed.connected), solve, context, &held);
    if (!freed.ok() || farthest_move(freed, installed.routed) > touched_off * installed.radius) return;
    const bool stays = farthest_move(freed, state) < touched_still * installed.radius;
    state = std::move(freed);
    if (stays) break;
  }
  installed.routed = std::move(state);
}

}  // namespace

InstalledSystem installed_system(const Scene& scene, const Options& options, int between, const RunContext& context) {
  const Scene::System system = system_of(scene, options.rods, "assembly");
  InstalledSystem installed;
  installed.surroundings = scene.surroundings();
  installed.free = system.problem;
  for (std::size_t k = 0; k < system.rods.size(); ++k) {
    const int rod = static_cast<int>(k);
    RodProblem& problem = installed.free.rods[k];
    const std::string name = scene.rods()[system.rods[k]]->name();
    installed.rods.push_back(name);
    installed.radius = std::max(installed.radius, problem.rod.largest_radius());
    problem.surroundings = installed.surroundings.get();
    for (const Hold& hold : problem.holds) {
      if (!hold.position || !hold.orientation || hold.slide)
        throw UsageError("assembly: '" + name + "' is held at " + scene.rods()[system.rods[k]]->describe(hold.at) +
                         " in part only; connections must hold place and orientation");
      const std::string where = hold.at <= 0 ? "start" : hold.at >= problem.rod.length * (1 - 1e-12) ? "finish" : number_text(hold.at);
      installed.connections.push_back({name + "." + where, rod, -1, hold.at, true});
      installed.connected.push_back(hold.frame);
      add_place(installed.free, rod, hold.at);
    }
    problem.holds.clear();
    problem.fastenings.clear();
    for (int i = 0; i <= between; ++i) {
      const double share = i == 0 ? 0.5 : static_cast<double>((i + 1) / 2 * (i % 2 ? 1 : -1)) / (between + 2) + 0.5;
      installed.extra.push_back({name + "." + std::to_string(static_cast<int>(std::lround(100 * share))), rod, -1, share * problem.rod.length, false});
      add_place(installed.free, rod, share * problem.rod.length);
    }
  }
  for (std::size_t b = 0; b < system.branches.size(); ++b) {
    BranchPoint& branch = installed.free.branches[b];
    const std::string name = scene.branches()[system.branches[b]]->name;
    installed.branches.push_back(name);
    if (branch.position != branch.orientation)
      throw UsageError("assembly: branch point '" + name + "' is held in part only; connections must hold place and orientation");
    const Grip grip{name, -1, static_cast<int>(b), 0, branch.position && branch.orientation};
    if (grip.connection) {
      installed.connections.push_back(grip);
      installed.connected.push_back(branch.frame);
    } else {
      installed.extra.push_back(grip);
    }
    branch.position = branch.orientation = false;
  }
  if (installed.connections.empty()) throw UsageError("assembly: nothing holds the rods in their routed configuration");
  SolveOptions near = options.solve;
  near.follow = near.follow || options.routed;
  const SceneEquilibrium routed = scene.solve(near, context, options.routed.get());
  const std::optional<SystemEquilibrium> start = routed.part(routed, system.rods, system.branches);
  if (start) add_connectors(installed, options.connectors, *start);
  near.follow = true;
  installed.routed = tendril::solve(held_by(installed.free, installed.connections, installed.connected), near, context, start ? &*start : nullptr);
  if (installed.routed.ok() && installed.surroundings) settle(installed, near, context);
  return installed;
}

SystemProblem held_by(const SystemProblem& free, const std::vector<Grip>& grips, const std::vector<Frame>& poses) {
  SystemProblem problem = free;
  for (const Grip& grip : grips) {
    if (grip.branch >= 0) problem.branches[grip.branch].position = problem.branches[grip.branch].orientation = true;
    else problem.rods[grip.rod].holds.push_back({grip.at, Frame{}});
  }
  place(problem, grips, poses);
  return problem;
}

void place(SystemProblem& problem, const std::vector<Grip>& grips, const std::vector<Frame>& poses) {
  std::vector<int> next(problem.rods.size(), 0);
  for (std::size_t g = 0; g < grips.size(); ++g) {
    if (grips[g].branch >= 0) problem.branches[grips[g].branch].frame = poses[g];
    else problem.rods[grips[g].rod].holds[next[grips[g].rod]++].frame = poses[g];
  }
}

void set_gravity(SystemProblem& problem, const Vec3& gravity) {
  for (RodProblem& rod : problem.rods) rod.gravity = gravity;
}

}  // namespace tendril::assembly
