// How far the bodies of a robot's links are from the fixed ones: exact, surface to surface.
//
// Meshes against meshes by branch and bound over trees of both (mesh_pair.h). Boxes and cylinders are taken as meshes, cylinders with 64
// sides about them (at most 0.12 % of the radius too near); spheres and half-spaces by their formulas.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "method/dress_pack/mesh_pair.h"
#include "method/dress_pack/pack_bodies.h"

namespace tendril::dress_pack {

/// A body of a link and a fixed one.
struct LinkGap {
  double gap = std::numeric_limits<double>::infinity();  ///< m; 0 where they meet, negative by how deep a corner lies inside
  int body = -1, other = -1;                             ///< of the link; fixed
  Vec3 on_link = Vec3::Zero(), on_other = Vec3::Zero();  ///< world axes, m
};

class RobotGaps {
 public:
  /// The bodies must outlive this. Bodies of links that do not move are not compared.
  explicit RobotGaps(const PackBodies& bodies);

  struct Known {
    Eigen::Matrix<double, 3, 8> corners;   ///< of the link body's box, in the fixed body's axes, where
    double distance = -std::numeric_limits<double>::infinity();  ///< the gap was no smaller, m
    TriangleNumbers triangles;                                   ///< that were nearest: where the next search begins
  };
  using Memory = std::vector<Known>;

  /// All pairs with a gap below `limit` (m). The memory saves looking at pairs that have not come near since.
  void near(const JointVector& q, double limit, Memory& memory, std::vector<LinkGap>& out) const;
  /// The nearest pair; no body beyond `limit`.
  LinkGap smallest(const JointVector& q, double limit, Memory& memory) const;

 private:
  struct Shape;
  struct Pair {
    int body, other;
  };
  LinkGap measure(const Pair& pair, const std::vector<BodyPose>& poses, double limit, Known& known) const;
  double bound(std::size_t k, const std::vector<BodyPose>& poses, const Memory& memory, Eigen::Matrix<double, 3, 8>& corners) const;

  const PackBodies& bodies_;
  std::vector<std::shared_ptr<const Shape>> shapes_;  ///< by body
  std::vector<Pair> pairs_;
};

}  // namespace tendril::dress_pack
