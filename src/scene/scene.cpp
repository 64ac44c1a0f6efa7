#include "scene/scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"
#include "scene/reach.h"
#include "statics/solve.h"

namespace tendril {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void build_tree(const PlacedObstacle& obstacle) {
  const auto& surface = *std::get<std::shared_ptr<const TriangleSurface>>(obstacle.body.shape);
  surface.tree();
  surface.topology();
}

}  // namespace

Scene::Scene(const Vec3& gravity) : gravity_(gravity) {
  if (!all_finite(gravity)) throw UsageError("scene.new: 'gravity' must be finite numbers in m/s^2");
}

Scene Scene::without_rods() const {
  Scene bare(gravity_);
  bare.obstacles_ = obstacles_;
  bare.robots_ = robots_;
  bare.bodies_ = bodies_;
  bare.surroundings_ = surroundings_;
  bare.fields_ = fields();
  return bare;
}

void Scene::check_free(std::string_view name, const char* who) const {
  const std::string text(name);
  for (const PlacedObstacle& obstacle : obstacles_)
    if (obstacle.name == name)
      throw UsageError(std::string(who) + ": the scene already has an obstacle '" + text + "'; remove it first");
  for (const auto& rod : rods_)
    if (rod->name() == name)
      throw UsageError(std::string(who) + ": the scene already has a rod '" + text + "'; remove it first");
  for (const auto& branch : branches_)
    if (branch->name == name)
      throw UsageError(std::string(who) + ": the scene already has a branch point '" + text + "'; remove it first");
  for (const PlacedRobot& robot : robots_) {
    if (robot.name == name)
      throw UsageError(std::string(who) + ": the scene already has a robot '" + text + "'; remove it first");
    for (const LinkBody& body : *robot.bodies)
      if (body.solid.name == name) throw UsageError(std::string(who) + ": '" + text + "' is a link of robot '" + robot.name + "'");
  }
}

void Scene::add(PlacedObstacle obstacle) {
  check_free(obstacle.name, "scene:obstacle");
  obstacle.check();
  obstacles_.push_back(std::move(obstacle));
  forget_bodies();
}

PlacedRod& Scene::add(PlacedRod rod) {
  check_free(rod.name(), "scene:rod");
  rods_.push_back(std::make_unique<PlacedRod>(std::move(rod)));
  return *rods_.back();
}

PlacedBranch& Scene::join(std::string name, const std::vector<BranchPlace>& places, const std::optional<Frame>& held) {
  check_free(name, "scene:branch");
  for (const BranchPlace& place : places) {
    if (const Attachment* attached = place.rod->attachment_at(place.at))
      throw UsageError("scene:branch: '" + place.rod->name() + "' is attached to robot '" + attached->robot + "' at " +
                       place.rod->describe(place.at) + "; release it there first");
    for (const auto& other : branches_)
      if (other->joins(place.rod->name(), place.at, 1e-9 * place.rod->rod().length))
        throw UsageError("scene:branch: '" + place.rod->name() + "' belongs to branch point '" + other->name + "' at " +
                         place.rod->describe(place.at) + " already");
  }
  branches_.push_back(std::make_unique<PlacedBranch>(make_branch(std::move(name), places, held)));
  return *branches_.back();
}

void Scene::remove(std::string_view name) {
  const auto rod = std::find_if(rods_.begin(), rods_.end(), [&](const auto& r) { return r->name() == name; });
  if (rod != rods_.end()) {
    for (const auto& branch : branches_)
      for (const JoinedPlace& place : branch->places)
        if (place.rod == name)
          throw UsageError("scene:remove: rod '" + place.rod + "' belongs to branch point '" + branch->name + "'; remove that first");
    rods_.erase(rod);
    return;
  }
  const auto branch = std::find_if(branches_.begin(), branches_.end(), [&](const auto& b) { return b->name == name; });
  if (branch != branches_.end()) {
    branches_.erase(branch);
    return;
  }
  const auto robot = std::find_if(robots_.begin(), robots_.end(), [&](const PlacedRobot& r) { return r.name == name; });
  if (robot != robots_.end()) {
    check_removable(*robot);
    robots_.erase(robot);
    forget_bodies();
    return;
  }
  const auto obstacle =
      std::find_if(obstacles_.begin(), obstacles_.end(), [&](const PlacedObstacle& o) { return o.name == name; });
  if (obstacle == obstacles_.end()) {
    std::vector<std::string> names;
    for (const auto& r : rods_) names.push_back(r->name());
    for (const auto& b : branches_) names.push_back(b->name);
    for (const PlacedRobot& r : robots_) names.push_back(r.name);
    for (const PlacedObstacle& o : obstacles_) names.push_back(o.name);
    throw UsageError("scene:remove: unknown name " + unknown_name(name, "rods, branch points, robots and obstacles", names));
  }
  obstacles_.erase(obstacle);
  forget_bodies();
}

PlacedBranch& Scene::branch(std::string_view name) const {
  std::vector<std::string> names;
  for (const auto& branch : branches_) {
    if (branch->name == name) return *branch;
    names.push_back(branch->name);
  }
  throw UsageError("scene: unknown branch point " + unknown_name(name, "branch points", names));
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
  if (!surroundings_ && !bodies().empty()) {
    auto all = std::make_shared<Surroundings>();
    for (const PlacedObstacle& obstacle : bodies()) {
      Obstacle body = obstacle.body;
      body.clearance = obstacle.clearance;
      body.name = obstacle.name;
      all->add(std::move(body));
    }
    surroundings_ = std::move(all);
  }
  return surroundings_;
}

const std::shared_ptr<FieldStore>& Scene::fields() const {
  if (!fields_) fields_ = std::make_shared<FieldStore>();
  return fields_;
}

RodProblem Scene::problem_of(const PlacedRod& rod) const {
  RodProblem problem;
  problem.rod = rod.rod();
  problem.holds = rod.holds();
  problem.loads = rod.loads();
  problem.gravity = rod.rod().mass() > 0 ? gravity_ : Vec3(Vec3::Zero());
  problem.fastenings = fastenings_of(rod);
  return problem;
}

int Scene::index_of_rod(std::string_view name) const {
  for (std::size_t k = 0; k < rods_.size(); ++k)
    if (rods_[k]->name() == name) return static_cast<int>(k);
  return -1;
}

/// A system is held where a rod of it or a branch point is held in position.
void Scene::check_held(const System& system) const {
  bool held = false;
  for (const RodProblem& rod : system.problem.rods)
    for (const Hold& hold : rod.holds) held = held || hold.position;
  for (const BranchPoint& branch : system.problem.branches) held = held || branch.position;
  if (held) return;
  const std::string& name = rods_[system.rods.front()]->name();
  if (system.rods.size() == 1)
    throw UsageError("scene:solve: '" + name + "' is not held anywhere, so it can move freely; give it from= or to=, or hold it");
  throw UsageError("scene:solve: '" + name + "' and the rods that hang together with it are not held anywhere, so they can move "
                   "freely; hold a rod or a branch point");
}

std::vector<Scene::System> Scene::systems() const {
  // Rods that share a branch point get the same root.
  std::vector<int> root(rods_.size());
  for (std::size_t k = 0; k < root.size(); ++k) root[k] = static_cast<int>(k);
  const auto find = [&](int k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
  };
  for (const auto& branch : branches_)
    for (const JoinedPlace& place : branch->places)
      root[find(index_of_rod(place.rod))] = find(index_of_rod(branch->places.front().rod));
  std::vector<System> systems;
  std::vector<int> system_of(rods_.size(), -1), place_in(rods_.size(), 0);
  for (int k = 0; k < static_cast<int>(rods_.size()); ++k) {
    int& number = system_of[find(k)];
    if (number < 0) {
      number = static_cast<int>(systems.size());
      systems.emplace_back();
    }
    System& system = systems[number];
    place_in[k] = static_cast<int>(system.rods.size());
    system.rods.push_back(k);
    system.problem.rods.push_back(problem_of(*rods_[k]));
  }
  for (int b = 0; b < static_cast<int>(branches_.size()); ++b) {
    const PlacedBranch& placed = *branches_[b];
    System& system = systems[system_of[find(index_of_rod(placed.places.front().rod))]];
    BranchPoint branch{{}, placed.frame, placed.position, placed.orientation};
    for (const JoinedPlace& place : placed.places)
      branch.sections.push_back({place_in[index_of_rod(place.rod)], place.at, place.relative});
    system.branches.push_back(b);
    system.problem.branches.push_back(std::move(branch));
  }
  for (const System& system : systems) check_held(system);
  return systems;
}

SceneEquilibrium Scene::solve(const SolveOptions& options, const RunContext& context,
                              const SceneEquilibrium* from) const {
  if (rods_.empty()) throw UsageError("scene:solve: the scene has no rods; add one with scene:rod(name, design, {...})");
  SceneEquilibrium result;
  std::vector<System> systems = this->systems();
  for (const auto& rod : rods_) result.rods.push_back({rod->name(), problem_of(*rod), options, {}});
  for (const auto& branch : branches_) result.branches.push_back({branch->name, branch->frame, {}});
  result.surroundings = surroundings();
  result.obstacles = bodies();
  const Clock::time_point building = Clock::now();
  for (const PlacedObstacle& obstacle : result.obstacles)
    if (obstacle.triangles() > 0 &&
        std::any_of(rods_.begin(), rods_.end(), [&](const auto& rod) { return can_reach(*rod, obstacle); }))
      build_tree(obstacle);
  result.seconds_for_trees = seconds_since(building);

  const Clock::time_point solving = Clock::now();
  for (System& system : systems) {
    for (std::size_t k = 0; k < system.rods.size(); ++k)
      result.rods[system.rods[k]].problem.surroundings = system.problem.rods[k].surroundings = result.surroundings.get();
    const std::optional<SystemEquilibrium> warm = from ? from->part(result, system.rods, system.branches) : std::nullopt;
    try {
      result.take(tendril::solve(system.problem, options, context, warm ? &*warm : nullptr), system.rods, system.branches);
    } catch (const UsageError& error) {
      throw UsageError("scene:solve: '" + rods_[system.rods.front()]->name() + "': " + error.what());
    }
    result.systems.push_back({std::move(system.problem), std::move(system.rods), std::move(system.branches)});
  }
  result.seconds = seconds_since(solving);
  return result;
}

}  // namespace tendril
