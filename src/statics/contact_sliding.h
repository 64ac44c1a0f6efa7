// Contact points that slide along the rod to where it is pressed hardest.
//
// An edge or a bump touches a rod at one place, which moves along the rod as the rod slides over it. Fixed points would
// catch the edge between two of them. A sliding point stands at the arc length s* where the contact energy Phi(x(s)) of
// a point is largest; by the envelope theorem its force is that of a fixed point at s*, and its second derivative is
//   d2/dq2 Phi(x(s*)) = [fixed point] - v v^T / Phi''(s*),  v = d/dq Phi'(s*) = J^T H x' + J'^T g,
// with x = J q to first order, J' = dJ/ds, g and H the gradient and Hessian of Phi by x, and Phi'' < 0. Over a straight
// edge the second part takes away just the curvature that would push a fixed point off the edge: sliding costs nothing.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "statics/contact_set.h"

namespace tendril {

class SlidingContacts {
 public:
  /// `s`: the vertices' arc lengths (m), `radii`: one for each segment (m); they and `field` must outlive this. `keep`:
  /// the most of the obstacles' clearances that counts (m).
  SlidingContacts(const FieldAlong& field, std::span<const double> s, std::span<const double> radii, Element element,
                  double keep = 0)
      : field_(field), s_(s), radii_(radii), element_(element), keep_(keep) {}

  struct Point {
    ContactPoint at;                ///< where it stands; `at.weight` is the length of rod it stands for
    Vec3 direction = Vec3::Zero();  ///< unit: it stands for contact with what lies against this (contact_set.h, faces())
    double shift = 0;               ///< of the augmented Lagrangian, m
    PointContact contact;           ///< at the last shape
    Vec3 x = Vec3::Zero();          ///< m
    Vec3 tangent = Vec3::Zero();    ///< dx/ds
    double bend = 0;                ///< Phi''(s*), N/m; zero where the point cannot slide: at an end of the rod or a kink
    bool active = false;
    Vec3 predicted = Vec3::Zero();  ///< gradient after the last step
  };

  const std::vector<Point>& points() const { return points_; }
  bool empty() const { return points_.empty(); }
  void clear() { points_.clear(); }

  /// A point that stands for `length` (m) of rod, starts at the arc length `s` (m), carries a shift (m) and touches what
  /// lies against `direction`.
  void add(double s, double length, double shift, const Vec3& direction);

  /// Lets every point slide to its place on the shape and returns the energy (J).
  double evaluate(const VertexShape& shape, const ContactLaw& law);

  /// Adds force and second derivative at the shape of the last evaluate(); `exact`, else curvature and sliding are scaled
  /// by how well the last step predicted the force, as for fixed points (contact_set.h).
  void add_to(const VertexShape& shape, bool exact, BlockView system) const;

  void predict(const VertexShape& shape, std::span<const Vec6> step, double share);
  void predict_standing();
  void forget_prediction();

  /// Drops points without force, turns the others to what they now touch. True when any was dropped.
  bool tidy();

  /// shift <- max(0, shift + radius - distance).
  void update_shifts();

  /// shift <- f(shift).
  template <class F>
  void change_shifts(F f) {
    for (Point& p : points_) p.shift = f(p.shift);
  }

  /// Takes out the points under which the surface has become so flat that their place along the rod means little. Half a
  /// radius to both sides the distance is that of a parabola whose curvature times the radius is below `sharpness`: 1 for an
  /// edge across a straight rod, 0 for a plane.
  std::vector<Point> take_flat(double sharpness, const VertexShape& shape);

  /// Takes out the points where less than the whole clearance of their obstacle counts; `kept`: how much does at an arc length.
  template <class F>
  std::vector<Point> take_near_holds(F kept) {
    return take_if([&](const Point& p) { return p.active && kept(p.at.s) < field_.all().clearance(p.contact.obstacle); });
  }

  /// The largest radius - distance (m); minus infinity without any.
  double deepest() const;

 private:
  template <class F>
  std::vector<Point> take_if(F unwanted) {
    const auto rest = std::stable_partition(points_.begin(), points_.end(), [&](const Point& p) { return !unwanted(p); });
    std::vector<Point> taken(rest, points_.end());
    points_.erase(rest, points_.end());
    return taken;
  }
  void slide(Point& point, const VertexShape& shape, const ContactLaw& law);
  double distance_facing(const ContactField& field, const Vec3& x, const Vec3& direction, double limit);
  double sharpness_of(const Point& point, const VertexShape& shape);
  ContactPoint place(int near, double s) const;
  double look_at(Point& point, double s, const VertexShape& shape, const ContactLaw& law);

  FieldAlong field_;
  std::span<const double> s_, radii_;
  Element element_;
  double keep_;
  std::vector<Point> points_;
  std::vector<DistanceTerm> terms_;  ///< of the point at work; kept to reuse its memory
};

}  // namespace tendril
