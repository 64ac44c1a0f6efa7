// The robots of a scene: their joints, their links as solid bodies, and the rods' holds that they carry.
#include <algorithm>

#include "base/error.h"
#include "base/nearest_name.h"
#include "scene/scene.h"

namespace tendril {

void Scene::add(PlacedRobot robot) {
  if (robot.robot && robot.joints.empty())
    for (int k = 0; k < robot.robot->size(); ++k)
      robot.joints.push_back(std::clamp(0.0, robot.robot->lower()[k], robot.robot->upper()[k]));
  robot.check();
  check_free(robot.name, "scene:robot");
  robot.bodies = std::make_shared<const std::vector<LinkBody>>(link_bodies(robot));
  for (const LinkBody& body : *robot.bodies) check_free(body.solid.name, "scene:robot");
  robots_.push_back(std::move(robot));
  forget_bodies();
}

void Scene::set_joints(std::string_view name, const std::vector<double>& joints) {
  PlacedRobot moved = robot(name);
  moved.joints = joints;
  moved.check("placed_robot:move");
  for (const auto& rod : rods_) rod->follow(moved.name, [&](int link) { return moved.link_frame(link); });
  robots_[index_of_robot(name)] = std::move(moved);
  forget_bodies();
}

void Scene::attach(const Attachment& attachment) {
  PlacedRod& held = rod(attachment.rod);
  const PlacedRobot& carrier = robot(attachment.robot);
  const int links = static_cast<int>(carrier.robot->links().size());
  if (attachment.link < 0 || attachment.link >= links)
    throw UsageError("scene:attach: robot '" + carrier.name + "' has no link of the number " + std::to_string(attachment.link) + ", it has " +
                     std::to_string(links));
  for (const auto& branch : branches_)
    if (branch->joins(held.name(), attachment.at, 1e-9 * held.rod().length))
      throw UsageError("scene:attach: '" + held.name() + "' belongs to branch point '" + branch->name + "' at " +
                       held.describe(attachment.at));
  Frame frame = carrier.link_frame(attachment.link) * attachment.in_link;
  frame.rotation.normalize();
  held.attach(attachment, frame);
}

void Scene::check_removable(const PlacedRobot& robot) const {
  std::string attached;
  for (const auto& rod : rods_)
    for (const Attachment& a : rod->attachments())
      if (a.robot == robot.name) attached += (attached.empty() ? "'" : ", '") + rod->name() + "' at " + rod->describe(a.at);
  if (!attached.empty())
    throw UsageError("scene:remove: robot '" + robot.name + "' carries " + attached + "; release or remove that first");
}

void Scene::forget_bodies() {
  bodies_.reset();
  surroundings_.reset();
}

int Scene::index_of_robot(std::string_view name) const {
  for (std::size_t k = 0; k < robots_.size(); ++k)
    if (robots_[k].name == name) return static_cast<int>(k);
  return -1;
}

const PlacedRobot& Scene::robot(std::string_view name) const {
  if (const int k = index_of_robot(name); k >= 0) return robots_[k];
  std::vector<std::string> names;
  for (const PlacedRobot& robot : robots_) names.push_back(robot.name);
  throw UsageError("scene: unknown robot " + unknown_name(name, "robots", names));
}

const std::vector<PlacedObstacle>& Scene::bodies() const {
  if (bodies_) return *bodies_;
  std::vector<PlacedObstacle> all = obstacles_;
  for (const PlacedRobot& robot : robots_) {
    const std::vector<Frame> frames = robot.robot->link_frames(robot.joints);
    for (const LinkBody& body : *robot.bodies) {
      all.push_back(body.solid);
      Frame& pose = all.back().body.pose;
      pose = robot.base * frames[body.link] * pose;
      pose.rotation.normalize();
    }
  }
  bodies_ = std::move(all);
  return *bodies_;
}

std::vector<Fastening> Scene::fastenings_of(const PlacedRod& rod) const {
  std::vector<Fastening> found;
  for (const Attachment& a : rod.attachments()) {
    const auto hold = std::find_if(rod.holds().begin(), rod.holds().end(), [&](const Hold& h) { return h.at == a.at; });
    const double reach = fastened_radii * rod.rod().section_at(a.at).radius();
    int number = static_cast<int>(obstacles_.size());
    for (const PlacedRobot& robot : robots_) {
      const std::vector<int> rigid = robot.name == a.robot ? rigid_with(*robot.robot, a.link) : std::vector<int>();
      for (const LinkBody& body : *robot.bodies) {
        if (std::count(rigid.begin(), rigid.end(), body.link) > 0)
          found.push_back({static_cast<int>(hold - rod.holds().begin()), number, reach});
        ++number;
      }
    }
  }
  return found;
}

}  // namespace tendril
