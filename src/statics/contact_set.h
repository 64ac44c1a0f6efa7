// The contact points of one rod and what is known of the surroundings at each: a lower bound of the distance, which
// saves queries while a point has moved less than its gap, the shift of the augmented Lagrangian, and the contact force
// that the last Newton step predicted.
#pragma once

#include <algorithm>
#include <vector>

#include "statics/contact_energy.h"
#include "statics/contact_points.h"
#include "statics/field_along.h"

namespace tendril {

/// A term belongs to the contact in a direction when their angle is below 60 degrees.
inline bool faces(const DistanceTerm& term, const Vec3& direction) { return term.normal.dot(direction) > 0.5; }

class ContactSet {
 public:
  /// `field` must outlive the set. `horizon` (m): how far ahead distances are looked up; farther is only "beyond".
  ContactSet(const FieldAlong& field, std::vector<ContactPoint> points, double horizon);

  const ContactField& field() const { return field_.all(); }
  const ContactField& field_at(int i) const { return *own_field_[i]; }                    ///< that point i meets
  const ContactField& field_after(int i) const { return field_.between(points_[i].s, points_[i + 1].s); }  ///< and the way to the next
  const std::vector<ContactPoint>& points() const { return points_; }
  int size() const { return static_cast<int>(points_.size()); }

  ContactLaw law;

  /// Positions of the last evaluate(), one a point (m).
  const std::vector<Vec3>& positions() const { return x_; }

  /// Computes the contact of every point at the positions `x` and returns the energy (J); infinite for positions that
  /// are not finite. Points out of reach cost at most one comparison or query.
  double evaluate(const std::vector<Vec3>& x);

  /// The contact of point i at the last positions; null when it is out of reach.
  const PointContact* at(int i) const { return active_[i] >= 0 ? &contacts_[active_[i]] : nullptr; }
  bool any() const { return !contacts_.empty(); }

  /// Adds force and Hessian of the last positions. The material part is exact; the curvature of the surroundings and
  /// the rotation of the centre line's tangents are scaled by how well the last step predicted the force (0 ... 1:
  /// mixed-stress), or taken in full.
  enum class Geometry { predicted, full };
  void add_to(const VertexShape& shape, Geometry geometry, BlockView system) const;

  /// Stores the force that the linearisation at the last positions predicts after `share` of `step`.
  void predict(const VertexShape& shape, std::span<const Vec6> step, double share);
  void predict_standing();  ///< the forces of the last positions, as they are
  void forget_prediction();

  /// Distance and its gradient at the nearest feature that is not covered within `range` (m) of point i at the last positions.
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    Vec3 normal = Vec3::Zero();
    int obstacle = -1;
  };
  Nearest nearest(int i, double range);

  /// How much farther off than its surface an obstacle acts on point i (m).
  double thickness(int i, int obstacle) const { return std::min(field().clearance(obstacle), points_[i].keep); }

  /// Of a point with a contact: the distance from the surface itself (m), negative inside a closed solid.
  double surface_distance(int i) const { return at(i)->distance + thickness(i, at(i)->obstacle); }

  /// A number that the distance of point i from all obstacles, thickened, cannot be below when it is at `x` (m).
  double distance_bound(int i, const Vec3& x) const { return known_[i].distance - (x - known_[i].at).norm(); }

  /// Augmented Lagrangian: shift <- max(0, shift + radius - distance) at the last positions. The force stays, the
  /// penetration goes. `beside` (m, one a point): how much deeper the rod overlaps beside a point than at it; the point
  /// then rests that much farther off, and begins to carry a force if it carried none.
  void update_shifts(const std::vector<double>& beside);
  const std::vector<double>& shifts() const { return shift_; }
  void set_shifts(const std::vector<double>& shifts) { shift_ = shifts; }

  /// Points that take no part (held by a support): no energy, no penetration.
  void exclude(int i) { excluded_[i] = true; }
  bool excluded(int i) const { return excluded_[i]; }

  /// Something else stands for the contact of point `point` with what lies against `direction` (unit): terms whose normal
  /// is within 60 degrees of it are left out.
  struct Cover {
    int point;
    Vec3 direction;
  };
  /// `covers`: in the order of the points. They hold until the next call.
  void cover(const std::vector<Cover>& covers);
  bool covered(int i) const { return first_cover_[i] < first_cover_[i + 1]; }

  /// The largest radius - distance over all points at the last positions (m); negative without penetration.
  double deepest() const;

  /// Distance queries made so far.
  long queries() const { return queries_; }

 private:
  struct Known {
    Vec3 at = Vec3::Zero();
    double distance = -std::numeric_limits<double>::infinity();
  };
  double reach(int i) const { return points_[i].radius + shift_[i]; }
  bool out_of_reach(int i, const Vec3& x);
  void leave_out_covered(int i);

  FieldAlong field_;
  std::vector<ContactPoint> points_;
  double horizon_;
  std::vector<Vec3> x_;
  std::vector<const ContactField*> own_field_;  ///< by point
  std::vector<Known> known_;
  std::vector<double> shift_;
  std::vector<char> excluded_;
  std::vector<Cover> covers_;
  std::vector<int> first_cover_;        ///< by point, and one past the last
  std::vector<char> was_active_;
  std::vector<int> active_;             ///< index into contacts_, -1: out of reach
  std::vector<PointContact> contacts_;
  std::vector<Vec3> predicted_;         ///< gradient after the last step; zero without one
  std::vector<DistanceTerm> terms_;     ///< of the point at work; kept to reuse its memory
  long queries_ = 0;
};

}  // namespace tendril
