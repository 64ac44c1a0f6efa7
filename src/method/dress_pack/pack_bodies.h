// The bodies of a dress pack where the robot has them: as surroundings for contact, and in their own axes for distances.
#pragma once

#include <memory>
#include <vector>

#include "geometry/inside_test.h"
#include "method/dress_pack/pack.h"

namespace tendril::dress_pack {

/// Axes and place of a body in the world.
struct BodyPose {
  Mat3 axes = Mat3::Identity();
  Vec3 at = Vec3::Zero();
  Vec3 to_body(const Vec3& p) const { return axes.transpose() * (p - at); }
  Vec3 to_world(const Vec3& p) const { return axes * p + at; }
};

/// What the distance of a point from a body is, all in the body's axes. Negative inside solids, and inside closed meshes where
/// sides are told.
struct BodyDistance {
  double distance = 0;         ///< m; the limit when the body is no nearer
  Vec3 point = Vec3::Zero();   ///< of the surface
  bool found = false;
};

/// Whether points inside a closed mesh are told from those outside: it costs a test for each, and the mesh's topology.
enum class Sides { as_solids, of_meshes_too };

/// What places on rods and bodies are compared for.
enum class Compared { clearance, contact };

class PackBodies {
 public:
  /// The pack must outlive this. Throws UsageError for bodies that Surroundings refuses.
  explicit PackBodies(const PackProblem& pack, Sides sides = Sides::as_solids);

  int size() const { return static_cast<int>(pack_.bodies.size()); }
  const PackProblem& pack() const { return pack_; }
  bool fixed(int body) const { return pack_.bodies[body].link < 0; }
  /// On a link behind a joint that moves.
  bool moves(int body) const { return !fixed(body) && rigid_[pack_.bodies[body].link] != 0; }
  const Eigen::AlignedBox3d& own_box(int body) const { return boxes_[body]; }  ///< in its own axes, m
  std::string name(int body) const { return surroundings_.name(body); }

  void poses(const JointVector& q, std::vector<BodyPose>& out) const;

  /// Smaller than `limit` (m), or not found.
  BodyDistance distance(int body, const Vec3& in_body, double limit) const;
  /// Whether a straight path in the body's axes enters the body.
  bool passes(int body, const Vec3& from, const Vec3& to) const;

  /// A stretch of rod near a hold lies near what carries it: within four radii of arc length it is not compared with that link's bodies,
  /// or with fixed ones where no link carries the hold. Contact does nothing within one radius of a held place, whatever the body.
  bool compared(int rod, double s, int body, Compared what) const;

  /// The links' bodies go where the robot has them.
  void move(const JointVector& q);
  const Surroundings& surroundings() const { return surroundings_; }

  /// Gives the rods of a system made from the pack their surroundings, which are this object's, and what they are fastened to.
  void surround(SystemProblem& system) const;

 private:
  const PackProblem& pack_;
  Surroundings surroundings_;
  std::vector<int> rigid_;            ///< of each link: the first one that it is joined to rigidly
  static constexpr int any = -2;
  struct Skip {
    double at, reach;                 ///< m
    int rod, group;                   ///< of links; -1: fixed bodies; any: all bodies, for contact alone
  };
  std::vector<Skip> skips_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< in the bodies' axes, m
  std::vector<std::shared_ptr<const InsideTest>> inside_;  ///< of closed meshes where sides are told, else null
};

}  // namespace tendril::dress_pack
