#include "method/free_space/distance_gradient.h"

namespace tendril::routing {

Vec3 distance_gradient(const Surroundings& surroundings, const Vec3& p, const ClosestPoint& found, double distance) {
  if (const auto* solid = std::get_if<Solid>(&surroundings.obstacle(found.obstacle).shape)) {
    const Frame& pose = surroundings.obstacle(found.obstacle).pose;
    return pose.rotation * distance_to(*solid, pose.rotation.conjugate() * (p - pose.at)).normal;
  }
  return distance > 0 ? Vec3((p - found.point) / distance) : Vec3::Zero();
}

}  // namespace tendril::routing
