#include "scene/scene_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/number_text.h"

namespace tendril {
namespace {

int severity(Status status) {
  switch (status) {
    case Status::solved: return 0;
    case Status::stalled: return 1;
    case Status::infeasible: return 2;
    case Status::timeout: return 3;
    case Status::cancelled: return 4;
  }
  return 4;
}

/// Arc lengths at which what the rod is fastened to begins and ceases to count, rising.
std::vector<double> fastening_borders(const RodProblem& problem) {
  std::vector<double> borders;
  for (const Fastening& one : problem.fastenings)
    borders.insert(borders.end(), {problem.holds[one.hold].at - one.reach, problem.holds[one.hold].at + one.reach});
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  return borders;
}

/// The obstacles that the rod is fastened to near an arc length.
std::vector<int> fastened_at(const RodProblem& problem, double s) {
  std::vector<int> spared;
  for (const Fastening& one : problem.fastenings)
    if (std::abs(s - problem.holds[one.hold].at) <= one.reach) spared.push_back(one.obstacle);
  return spared;
}

ClosestPoint closest_but(const SceneEquilibrium& eq, const Vec3& p, int to, const std::vector<int>& spared) {
  if (spared.empty()) return eq.closest(p, to);
  ClosestPoint best{std::numeric_limits<double>::infinity(), p, -1};
  for (int k = 0; k < static_cast<int>(eq.obstacles.size()); ++k) {
    if ((to >= 0 && k != to) || std::count(spared.begin(), spared.end(), k) > 0) continue;
    const ClosestPoint found = eq.surroundings->closest_on(k, p, best.distance);
    if (found.obstacle >= 0) best = found;
  }
  return best;
}

}  // namespace

Status SceneEquilibrium::status() const {
  Status worst = Status::solved;
  for (const SolvedRod& rod : rods)
    if (severity(rod.equilibrium.status) > severity(worst)) worst = rod.equilibrium.status;
  return worst;
}

std::string SceneEquilibrium::message() const {
  if (ok()) return "solved";
  std::string text;
  for (const SolvedSystem& system : systems) {
    const SolvedRod& rod = rods[system.rods.front()];
    if (!rod.equilibrium.ok()) text += (text.empty() ? "" : "; ") + rod.name + ": " + rod.equilibrium.message;
  }
  return text;
}

int SceneEquilibrium::iterations() const {
  int sum = 0;
  for (const SolvedSystem& system : systems) sum += rods[system.rods.front()].equilibrium.iterations;
  return sum;
}

std::vector<double> SceneEquilibrium::steps() const {
  std::vector<double> longest;
  for (const SolvedSystem& system : systems) {
    const std::vector<double>& own = rods[system.rods.front()].equilibrium.steps;
    if (own.size() > longest.size()) longest = own;
  }
  return longest;
}

double SceneEquilibrium::residual() const {
  double largest = 0;
  for (const SolvedRod& rod : rods) largest = std::max(largest, rod.equilibrium.residual);
  return largest;
}

bool SceneEquilibrium::stable() const {
  return std::all_of(rods.begin(), rods.end(), [](const SolvedRod& rod) { return rod.equilibrium.stable; });
}

Energy SceneEquilibrium::energy() const {
  Energy sum;
  for (const SolvedRod& rod : rods) {
    const Energy& e = rod.equilibrium.energy;
    sum.bend += e.bend;
    sum.twist += e.twist;
    sum.stretch += e.stretch;
    sum.shear += e.shear;
    sum.gravity += e.gravity;
    sum.contact += e.contact;
    sum.load += e.load;
  }
  return sum;
}

std::optional<ErrorEstimate> SceneEquilibrium::error() const {
  std::optional<ErrorEstimate> worst;
  for (const SolvedRod& rod : rods) {
    const std::optional<ErrorEstimate>& e = rod.equilibrium.error;
    if (!e) continue;
    const bool worse = !worst || (worst->valid && !e->valid) || (worst->valid == e->valid && e->value > worst->value);
    if (worse) worst = e;
  }
  return worst;
}

double SceneEquilibrium::deepest_penetration() const {
  double deepest = 0;
  for (const SolvedRod& rod : rods) deepest = std::max(deepest, rod.equilibrium.deepest_penetration);
  return deepest;
}

const SolvedRod& SceneEquilibrium::rod(std::string_view name) const {
  std::vector<std::string> names;
  for (const SolvedRod& rod : rods) {
    if (rod.name == name) return rod;
    names.push_back(rod.name);
  }
  throw UsageError("equilibrium: unknown rod " + unknown_name(name, "rods", names));
}

const SolvedBranch& SceneEquilibrium::branch(std::string_view name) const {
  std::vector<std::string> names;
  for (const SolvedBranch& branch : branches) {
    if (branch.name == name) return branch;
    names.push_back(branch.name);
  }
  throw UsageError("equilibrium: unknown branch point " + unknown_name(name, "branch points", names));
}

std::optional<SystemEquilibrium> SceneEquilibrium::part(const SceneEquilibrium& like, const std::vector<int>& rod_numbers,
                                                        const std::vector<int>& branch_numbers) const {
  SystemEquilibrium found;
  for (const int k : rod_numbers)
    for (const SolvedRod& rod : rods)
      if (rod.name == like.rods[k].name) found.rods.push_back(rod.equilibrium);
  for (const int k : branch_numbers)
    for (const SolvedBranch& branch : branches)
      if (branch.name == like.branches[k].name) found.branches.push_back(branch.frame);
  if (found.rods.size() != rod_numbers.size() || found.branches.size() != branch_numbers.size() || !found.complete()) return {};
  return found;
}

void SceneEquilibrium::take(SystemEquilibrium solved, const std::vector<int>& rod_numbers, const std::vector<int>& branch_numbers) {
  for (std::size_t i = 0; i < rod_numbers.size(); ++i) {
    SolvedRod& rod = rods[rod_numbers[i]];
    rod.equilibrium = std::move(solved.rods[i]);
    for (std::size_t h = 0; h < rod.problem.holds.size() && h < rod.equilibrium.reactions.size(); ++h) {
      Hold& hold = rod.problem.holds[h];
      if (!hold.slide) continue;
      if (hold.cut_at < 0) hold.cut_at = hold.at;  // the segments stay as they were cut
      hold.at = rod.equilibrium.reactions[h].s;
    }
  }
  for (std::size_t i = 0; i < branch_numbers.size(); ++i) {
    branches[branch_numbers[i]].frame = solved.branches[i];
    branches[branch_numbers[i]].support = solved.branch_supports[i];
  }
}

int SceneEquilibrium::obstacle(std::string_view name) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (obstacles[i].name == name) return static_cast<int>(i);
    names.push_back(obstacles[i].name);
  }
  throw UsageError("equilibrium: unknown obstacle " + unknown_name(name, "obstacles", names));
}

ClosestPoint SceneEquilibrium::closest(const Vec3& p, int to) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!surroundings) return {infinity, p, -1};
  return to < 0 ? surroundings->closest(p, infinity) : surroundings->closest_on(to, p, infinity);
}

Clearance SceneEquilibrium::clearance(const RodProblem& problem, const Equilibrium& state, int to, double begin, double end) const {
  const Rod& design = problem.rod;
  if (end < 0) end = design.length;
  std::vector<double> borders{begin};
  for (const double border : fastening_borders(problem))
    if (border > begin && border < end) borders.push_back(border);
  borders.push_back(end);
  Clearance best;
  best.value = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const std::vector<int> spared = fastened_at(problem, 0.5 * (borders[i] + borders[i + 1]));
    if (std::count(spared.begin(), spared.end(), to) > 0) continue;
    const auto distance = [&](const Vec3& p) { return closest_but(*this, p, to, spared); };
    const Clearance here = clearance_of(design, state, distance, borders[i], borders[i + 1]);
    if (here.value < best.value) best = here;
  }
  return best;
}

ClosestPoint SceneEquilibrium::closest(const SolvedRod& rod, double s, const Vec3& p, int to) const {
  return closest_but(*this, p, to, fastened_at(rod.problem, s));
}

std::vector<SceneEquilibrium::JudgedGap> SceneEquilibrium::judged_gaps(const SolvedRod& rod) const {
  std::vector<JudgedGap> all;
  const auto judge = [&](const Clearance& gap) {
    if (gap.obstacle < 0) return;
    const double required = obstacles[gap.obstacle].clearance;
    all.push_back({gap, required, too_close(gap.value, required, rod.problem.rod.section_at(gap.s).radius())});
  };
  const Clearance nearest = clearance(rod);
  judge(nearest);
  for (int k = 0; k < static_cast<int>(obstacles.size()); ++k)
    if (k != nearest.obstacle && obstacles[k].clearance > 0) judge(clearance(rod, k));
  return all;
}

Reaction SceneEquilibrium::reaction(const SolvedRod& rod, double at) const {
  const double length = rod.problem.rod.length;
  std::string places;
  for (const Reaction& reaction : rod.equilibrium.reactions) {
    if (std::abs(reaction.s - at) <= 1e-9 * length) return reaction;
    places += (places.empty() ? "" : ", ") +
              (reaction.s <= 0 ? "start" : reaction.s >= length ? "finish" : number_text(reaction.s) + " m");
  }
  throw UsageError("equilibrium: '" + rod.name + "' is not held at " + number_text(at) + " m (held at: " + places + ")");
}

}  // namespace tendril
