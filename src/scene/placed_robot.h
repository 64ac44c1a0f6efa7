// A robot in the world: where its base stands, where its joints are, and its links as solid bodies.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/robot.h"
#include "scene/placed_obstacle.h"

namespace tendril {

struct LinkBody;

struct PlacedRobot {
  std::string name;
  std::shared_ptr<const Robot> robot;
  Frame base;                       ///< of link 0, in world axes
  std::vector<double> joints = {};  ///< rad or m, in the order of Robot::variables(); empty: each as near to 0 as its limits allow
  double clearance = 0;             ///< m, that rods are required to keep from its links

  /// The solid links, see link_bodies(): Scene::add() finds them.
  std::shared_ptr<const std::vector<LinkBody>> bodies = nullptr;

  /// Throws UsageError for an empty name or one with a dot, a missing robot, numbers that are not finite, a negative clearance, and joint
  /// values that do not fit the robot or are beyond its limits. Messages open with `who`.
  void check(const char* who = "scene:robot") const;

  Frame link_frame(int link) const;  ///< in world axes

  /// "arm.link_3".
  std::string body_name(int link) const { return name + "." + robot->links()[link].name; }
};

/// What is solid of a link: its collision bodies, or where it has none what is seen of it.
struct LinkBody {
  int link = 0;
  PlacedObstacle solid;  ///< its pose is in the link's axes
};

/// The solid links, in their order; several shapes of one link become one mesh. Reads the meshes that are in files: throws UsageError
/// for those that cannot be read. What pictures show instead is read when they are drawn.
std::vector<LinkBody> link_bodies(const PlacedRobot& placed);

/// All shapes as one mesh in the link's axes; solids with round parts in 48 sides.
Mesh joined_mesh(const std::vector<LinkShape>& shapes, const std::string& name);

/// The links that are joined rigidly to `link`, itself included.
std::vector<int> rigid_with(const Robot& robot, int link);

}  // namespace tendril
