#include "scene/scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"
#include "statics/solve.h"

namespace tendril {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// False when no shape that the rod can take comes near the obstacle's box. A point of the rod is no farther from a hold
/// than the length between them, give or take some stretch.
bool can_reach(const PlacedRod& rod, const PlacedObstacle& obstacle) {
  const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&obstacle.body.shape);
  if (!surface) return false;  // a solid has no tree to build
  const Frame to_mesh = obstacle.body.pose.inverse();
  const double reach = 1.2 * rod.rod().length + rod.rod().largest_radius();
  double both = 0;
  for (const Hold& hold : rod.holds()) {
    if (!hold.position) continue;
    const double distance = std::sqrt((*surface)->box().squaredExteriorDistance((to_mesh * hold.frame).at));
    if (distance > reach) return false;
    const bool at_end = hold.at == 0 || hold.at == rod.rod().length;
    if (at_end) both += distance;
  }
  const bool held_at_both = rod.hold_at(0) && rod.hold_at(rod.rod().length);
  return !held_at_both || both <= reach;
}

void build_tree(const PlacedObstacle& obstacle) {
  const auto& surface = *std::get<std::shared_ptr<const TriangleSurface>>(obstacle.body.shape);
  surface.tree();
  surface.topology();
}

}  // namespace

Scene::Scene(const Vec3& gravity) : gravity_(gravity) {
  if (!all_finite(gravity)) throw UsageError("scene.new: 'gravity' must be finite numbers in m/s^2");
}

void Scene::check_free(std::string_view name, const char* who) const {
  const std::string text(name);
  for (const PlacedObstacle& obstacle : obstacles_)
    if (obstacle.name == name)
      throw UsageError(std::string(who) + ": the scene already has an obstacle '" + text + "'; remove it first");
  for (const auto& rod : rods_)
    if (rod->name() == name)
      throw UsageError(std::string(who) + ": the scene already has a rod '" + text + "'; remove it first");
}

void Scene::add(PlacedObstacle obstacle) {
  check_free(obstacle.name, "scene:obstacle");
  obstacle.check();
  obstacles_.push_back(std::move(obstacle));
  surroundings_.reset();
}

PlacedRod& Scene::add(PlacedRod rod) {
  check_free(rod.name(), "scene:rod");
  rods_.push_back(std::make_unique<PlacedRod>(std::move(rod)));
  return *rods_.back();
}

void Scene::remove(std::string_view name) {
  const auto rod = std::find_if(rods_.begin(), rods_.end(), [&](const auto& r) { return r->name() == name; });
  if (rod != rods_.end()) {
    rods_.erase(rod);
    return;
  }
  const auto obstacle =
      std::find_if(obstacles_.begin(), obstacles_.end(), [&](const PlacedObstacle& o) { return o.name == name; });
  if (obstacle == obstacles_.end()) {
    std::vector<std::string> names;
    for (const auto& r : rods_) names.push_back(r->name());
    for (const PlacedObstacle& o : obstacles_) names.push_back(o.name);
    throw UsageError("scene:remove: unknown name " + unknown_name(name, "rods and obstacles", names));
  }
  obstacles_.erase(obstacle);
  surroundings_.reset();
}

PlacedRod& Scene::rod(std::string_view name) const {
  std::vector<std::string> names;
  for (const auto& rod : rods_) {
    if (rod->name() == name) return *rod;
    names.push_back(rod->name());
  }
  throw UsageError("scene: unknown rod " + unknown_name(name, "rods", names));
}

const PlacedObstacle& Scene::obstacle(std::string_view name) const {
  std::vector<std::string> names;
  for (const PlacedObstacle& obstacle : obstacles_) {
    if (obstacle.name == name) return obstacle;
    names.push_back(obstacle.name);
  }
  throw UsageError("scene: unknown obstacle " + unknown_name(name, "obstacles", names));
}

std::shared_ptr<const Surroundings> Scene::surroundings() const {
  if (!surroundings_ && !obstacles_.empty()) {
    auto all = std::make_shared<Surroundings>();
    for (const PlacedObstacle& obstacle : obstacles_) all->add(obstacle.body);
    surroundings_ = std::move(all);
  }
  return surroundings_;
}

RodProblem Scene::problem_of(const PlacedRod& rod) const {
  RodProblem problem;
  problem.rod = rod.rod();
  problem.holds = rod.holds();
  problem.loads = rod.loads();
  problem.gravity = rod.rod().mass() > 0 ? gravity_ : Vec3(Vec3::Zero());
  return problem;
}

SceneEquilibrium Scene::solve(const SolveOptions& options, const RunContext& context,
                              const SceneEquilibrium* from) const {
  if (rods_.empty()) throw UsageError("scene:solve: the scene has no rods; add one with scene:rod(name, design, {...})");
  SceneEquilibrium result;
  for (const auto& rod : rods_) {
    result.rods.push_back({rod->name(), problem_of(*rod), options, {}});
    if (rod->holds().empty())
      throw UsageError("scene:solve: '" + rod->name() +
                       "' is not held anywhere, so it can move freely; give it from= or to=, or hold it");
  }
  result.surroundings = surroundings();
  result.obstacles = obstacles_;
  const Clock::time_point building = Clock::now();
  for (const PlacedObstacle& obstacle : obstacles_)
    if (std::any_of(rods_.begin(), rods_.end(), [&](const auto& rod) { return can_reach(*rod, obstacle); }))
      build_tree(obstacle);
  result.seconds_for_trees = seconds_since(building);

  const Clock::time_point solving = Clock::now();
  for (SolvedRod& rod : result.rods) {
    rod.problem.surroundings = result.surroundings.get();
    const Equilibrium* warm = nullptr;
    if (from)
      for (const SolvedRod& old : from->rods)
        if (old.name == rod.name) warm = &old.equilibrium;
    try {
      rod.equilibrium = tendril::solve(rod.problem, options, context, warm);
    } catch (const UsageError& error) {
      throw UsageError("scene:solve: '" + rod.name + "': " + error.what());
    }
  }
  result.seconds = seconds_since(solving);
  return result;
}

}  // namespace tendril
