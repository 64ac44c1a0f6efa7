// The convex hull of points that are inserted one after the other.
#pragma once

#include <array>
#include <vector>

#include "base/vectors.h"

namespace tendril::envelope {

/// A closed surface of triangles, convex up to rounding. A point whose insertion would leave that surface open is
/// refused, so that whatever lies below all facets lies within the hull of the points inserted. Facets are kept without
/// gaps; memory is kept from hull to hull.
class ConvexHull {
 public:
  struct Facet {
    std::array<int, 3> corner;     ///< counter-clockwise from outside
    std::array<int, 3> neighbour;  ///< across the side from corner k to corner k + 1
  };

  /// Starts from four points. False when they lie in one plane to the precision of the arithmetic.
  bool begin(const std::array<Vec3, 4>& corners);

  /// False when the point lies inside or its insertion is refused.
  bool insert(const Vec3& point);

  /// How far a point lies above the facet that it is farthest above, m; negative inside.
  double height(const Vec3& point) const;

  int size() const { return static_cast<int>(facets_.size()); }
  const Facet& facet(int f) const { return facets_[f]; }
  Vec3 normal(int f) const { return {x_[f], y_[f], z_[f]}; }
  double offset(int f) const { return offset_[f]; }

  /// All points inserted, in that order; some may have come to lie inside since.
  const std::vector<Vec3>& points() const { return points_; }
  /// Marks the points that are corners of facets.
  std::vector<char> corners() const;

 private:
  struct Side {
    int from, to;  ///< points; the facet beyond runs from `to` to `from`
    int beyond;
  };
  struct Plane {
    Vec3 normal;
    double offset;
  };
  bool plane_of(int a, int b, int c, Plane& plane) const;
  void set(int f, const Facet& facet, const Plane& plane);
  bool find_horizon();
  void remove(int f);
  void replace_visible(int point);

  std::vector<Vec3> points_;
  std::vector<Facet> facets_;
  std::vector<double> x_, y_, z_, offset_, height_;  ///< by facet
  std::vector<int> visible_, slots_;
  std::vector<Side> horizon_;
  std::vector<Plane> planes_;       ///< of the facets to be, by horizon side
  std::vector<int> side_from_;      ///< by point: the horizon's side that starts there, -1 for none
};

}  // namespace tendril::envelope
