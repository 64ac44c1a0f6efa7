#include "method/dress_pack/pack_scene.h"

#include <algorithm>

#include "base/error.h"

namespace tendril::dress_pack {
namespace {

bool carries(const PlacedRod& rod, const std::string& robot) {
  return std::any_of(rod.attachments().begin(), rod.attachments().end(), [&](const auto& a) { return a.robot == robot; });
}

void check_rod(const Scene& scene, const PlacedRod& rod, const std::string& robot) {
  const std::string who = "dress pack of '" + robot + "': '" + rod.name() + "'";
  for (const auto& branch : scene.branches())
    for (const JoinedPlace& place : branch->places)
      if (place.rod == rod.name()) throw UsageError(who + " belongs to branch point '" + branch->name + "', expected rods without any");
  for (const PointLoad& load : rod.loads())
    if (!load.moment.isZero(0))
      throw UsageError(who + " carries a dead moment at " + rod.describe(load.at) + ", expected forces alone");
}

void add_rod(const Scene& scene, int number, const std::string& robot, ScenePack& out) {
  const PlacedRod& rod = *scene.rods()[number];
  check_rod(scene, rod, robot);
  const int own = static_cast<int>(out.rods.size());
  out.rods.push_back(number);
  out.problem.rods.push_back(scene.problem_of(rod));
  out.problem.names.push_back(rod.name());
  for (std::size_t h = 0; h < rod.holds().size(); ++h) {
    const tendril::Attachment* attached = rod.attachment_at(rod.holds()[h].at);
    if (attached && attached->robot == robot) out.problem.attachments.push_back({own, static_cast<int>(h), attached->link, attached->in_link});
  }
}

PackBody body_of(const PlacedObstacle& placed) {
  PackBody body{placed.body, -1};
  body.body.name = placed.name;
  body.body.clearance = placed.clearance;
  return body;
}

/// In the order of Scene::bodies().
std::vector<PackBody> bodies_of(const Scene& scene, int robot) {
  std::vector<PackBody> all;
  for (const PlacedObstacle& placed : scene.bodies()) all.push_back(body_of(placed));
  std::size_t next = scene.obstacles().size();
  for (int k = 0; k < static_cast<int>(scene.robots().size()); ++k)
    for (const LinkBody& body : *scene.robots()[k].bodies) {
      PackBody& own = all[next++];
      if (k != robot) continue;
      own.body.pose = body.solid.body.pose;
      own.link = body.link;
    }
  return all;
}

}  // namespace

ScenePack pack_of(const Scene& scene, std::string_view name) {
  const PlacedRobot& robot = scene.robot(name);
  ScenePack out;
  out.robot = static_cast<int>(&robot - scene.robots().data());
  out.problem.robot = robot.robot;
  out.problem.base = robot.base;
  for (int k = 0; k < static_cast<int>(scene.rods().size()); ++k)
    if (carries(*scene.rods()[k], robot.name)) add_rod(scene, k, robot.name, out);
  if (out.rods.empty())
    throw UsageError("dress pack of '" + robot.name + "': no rods are attached to it; attach some with scene:attach(rod, where, \"" +
                     robot.name + "\", link, frame)");
  out.problem.bodies = bodies_of(scene, out.robot);
  out.problem.check();
  return out;
}

std::shared_ptr<SceneEquilibrium> scene_state(const Scene& scene, const ScenePack& pack, const JointVector& q, SystemEquilibrium solved) {
  if (solved.rods.size() != pack.rods.size())
    throw UsageError("dress pack: a state of " + std::to_string(solved.rods.size()) + " rods, expected " + std::to_string(pack.rods.size()));
  auto state = std::make_shared<SceneEquilibrium>();
  const std::vector<Frame> links = pack.problem.robot->link_frames({q.data(), static_cast<std::size_t>(q.size())});
  auto surroundings = std::make_shared<Surroundings>();
  state->obstacles = scene.bodies();
  for (std::size_t k = 0; k < state->obstacles.size(); ++k) {
    PackBody placed = pack.problem.bodies[k];
    Frame& pose = placed.body.pose;
    if (placed.link >= 0) pose = pack.problem.base * (links[placed.link] * pose);
    pose.rotation.normalize();
    state->obstacles[k].body.pose = pose;
    surroundings->add(std::move(placed.body));
  }
  if (surroundings->size() > 0) state->surroundings = std::move(surroundings);
  SolvedSystem system{pack.problem.system_at(q), {}, {}};
  for (std::size_t k = 0; k < pack.rods.size(); ++k) {
    system.problem.rods[k].surroundings = state->surroundings.get();
    system.rods.push_back(static_cast<int>(k));
    state->rods.push_back({pack.problem.names[k], system.problem.rods[k], {}, {}});
  }
  state->take(std::move(solved), system.rods, {});
  state->seconds = state->rods.front().equilibrium.seconds;
  state->systems.push_back(std::move(system));
  return state;
}

std::shared_ptr<SceneEquilibrium> scene_state(const Scene& scene, const ScenePack& pack, const PackStep& step, PackStatics& statics) {
  if (step.solved) return scene_state(scene, pack, step.q, *step.solved);
  SystemEquilibrium solved = statics.describe(step.state);
  for (Equilibrium& rod : solved.rods) {
    rod.status = Status::solved;
    rod.stable = true;  // a simulation keeps no other states
    rod.message = "solved";
  }
  return scene_state(scene, pack, step.q, std::move(solved));
}

std::vector<std::shared_ptr<SceneEquilibrium>> scene_states(const Scene& scene, const ScenePack& pack, const std::vector<PackStep>& steps) {
  std::unique_ptr<PackStatics> statics;
  std::vector<std::shared_ptr<SceneEquilibrium>> states;
  for (const PackStep& step : steps) {
    if (!step.solved && !statics) statics = std::make_unique<PackStatics>(pack.problem);
    states.push_back(step.solved ? scene_state(scene, pack, step.q, *step.solved) : scene_state(scene, pack, step, *statics));
  }
  return states;
}

}  // namespace tendril::dress_pack
