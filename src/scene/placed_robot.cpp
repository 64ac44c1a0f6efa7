#include "scene/placed_robot.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril {
namespace {

std::variant<std::shared_ptr<const TriangleSurface>, Solid> shape_of(const LinkShape& shape) {
  if (const auto* mesh = std::get_if<std::shared_ptr<const LinkMesh>>(&shape.shape)) return (*mesh)->surface();
  return std::get<Solid>(shape.shape);
}

LinkBody body_of(const PlacedRobot& placed, int number) {
  const Link& link = placed.robot->links()[number];
  const std::vector<LinkShape>& shapes = link.collision.empty() ? link.visual : link.collision;
  LinkBody body;
  body.link = number;
  body.solid.name = placed.body_name(number);
  body.solid.clearance = placed.clearance;
  body.solid.clip = false;
  body.solid.of_robot = true;
  if (shapes.size() == 1) {
    body.solid.body.shape = shape_of(shapes.front());
    body.solid.body.pose = shapes.front().pose;
  } else {
    body.solid.body.shape = std::make_shared<const TriangleSurface>(joined_mesh(shapes, link.name));
  }
  if (!link.collision.empty() && !link.visual.empty()) {
    body.solid.drawn = [robot = placed.robot, number, back = body.solid.body.pose.inverse()] {
      const Link& seen = robot->links()[number];
      const Mesh mesh = joined_mesh(seen.visual, seen.name);
      return std::make_shared<const Mesh>(mesh.moved(back.at, back.rotation));
    };
  }
  return body;
}

}  // namespace

void PlacedRobot::check(const char* caller) const {
  if (name.empty()) throw UsageError(std::string(caller) + ": the name is empty, expected a word");
  const std::string who = std::string(caller) + ": '" + name + "'";
  if (name.find('.') != std::string::npos) throw UsageError(who + ": a robot's name cannot have a dot, which stands before its links' names");
  if (!robot) throw UsageError(who + ": no robot was given");
  if (!all_finite(base.at) || !all_finite(base.rotation.coeffs()) || std::abs(base.rotation.norm() - 1) > 1e-9)
    throw UsageError(who + ": 'at' is not a frame; finite numbers and a unit rotation expected");
  if (!std::isfinite(clearance) || clearance < 0)
    throw UsageError(who + ": 'clearance' is " + number_text(clearance) + " m, expected a finite number of at least 0");
  robot->check(joints, who.c_str());
  const std::string beyond = robot->beyond_limits(joints, 1e-9);
  if (!beyond.empty()) throw UsageError(who + ": beyond the joint limits: " + beyond);
}

Frame PlacedRobot::link_frame(int link) const {
  Frame frame = base * robot->link_frame(link, joints);
  frame.rotation.normalize();
  return frame;
}

std::vector<LinkBody> link_bodies(const PlacedRobot& placed) {
  std::vector<LinkBody> bodies;
  for (int k = 0; k < static_cast<int>(placed.robot->links().size()); ++k) {
    const Link& link = placed.robot->links()[k];
    if (!link.collision.empty() || !link.visual.empty()) bodies.push_back(body_of(placed, k));
  }
  return bodies;
}

Mesh joined_mesh(const std::vector<LinkShape>& shapes, const std::string& name) {
  Mesh joined;
  joined.name = name;
  for (const LinkShape& shape : shapes) {
    PlacedObstacle one;
    one.body.shape = shape_of(shape);
    const Mesh part = drawn_mesh(one, {})->moved(shape.pose.at, shape.pose.rotation);
    const int first = static_cast<int>(joined.vertices.size());
    joined.vertices.insert(joined.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& t : part.triangles) joined.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return joined;
}

std::vector<int> rigid_with(const Robot& robot, int link) {
  // The first link of each that is joined by fixed joints alone.
  std::vector<int> first{0}, found;
  for (std::size_t k = 0; k < robot.joints().size(); ++k) {
    const Joint& joint = robot.joints()[k];
    first.push_back(joint.kind == JointKind::fixed ? first[joint.parent] : static_cast<int>(k) + 1);
  }
  for (int k = 0; k < static_cast<int>(first.size()); ++k)
    if (first[k] == first[link]) found.push_back(k);
  return found;
}

}  // namespace tendril
