#include "scene/scene_modes.h"

#include <algorithm>

#include "statics/modes.h"

namespace tendril {
namespace {

constexpr int eigenvalues_a_system = 4;

/// Moves of the rods' vertices along a mode of their system.
void keep_shape(const Eigenmode& mode, NetworkSolver& solver, const RodState& state, const SolvedSystem& system,
                const SceneEquilibrium& found, SceneModes& out) {
  constexpr double small = 1e-4;  // far below what the shape itself changes over
  RodState moved = state;
  solver.network().apply(moved, mode.shape, small);
  out.softest.clear();
  for (std::size_t k = 0; k < system.rods.size(); ++k) {
    const RodNetwork& network = solver.network();
    const std::vector<Frame> before = network.rod(k).frames_of(network.of_rod(k, state));
    const std::vector<Frame> after = network.rod(k).frames_of(network.of_rod(k, moved));
    std::vector<Vec3>& moves = out.softest[found.rods[system.rods[k]].name];
    for (std::size_t i = 0; i < before.size(); ++i) moves.push_back((after[i].at - before[i].at) / small);
  }
}

}  // namespace

void find_modes(SceneEquilibrium& found, const SolveOptions& options, const RunContext& context) {
  if (!found.ok()) return;
  SceneModes modes;
  double softest = 0;
  std::vector<std::shared_ptr<SceneEquilibrium>> others;
  for (const SolvedSystem& system : found.systems) {
    const std::optional<SystemEquilibrium> here = found.part(found, system.rods, system.branches);
    if (!here) continue;
    NetworkSolver solver(system.problem, options);
    const RodState state = solver.starting_state(&*here);
    const std::vector<Eigenmode> own = softest_modes(solver, state, eigenvalues_a_system);
    if (!own.empty() && (modes.eigenvalues.empty() || own.front().eigenvalue < softest)) {
      softest = own.front().eigenvalue;
      keep_shape(own.front(), solver, state, system, found, modes);
    }
    for (const Eigenmode& mode : own) modes.eigenvalues.push_back(mode.eigenvalue);
    for (SystemEquilibrium& other : other_equilibria(system.problem, options, context, *here)) {
      auto scene = std::make_shared<SceneEquilibrium>(found);
      scene->modes.reset();
      scene->take(std::move(other), system.rods, system.branches);
      others.push_back(std::move(scene));
    }
  }
  std::sort(modes.eigenvalues.begin(), modes.eigenvalues.end());
  std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a->energy().total() < b->energy().total(); });
  modes.others = std::move(others);
  found.modes = std::move(modes);
}

}  // namespace tendril
