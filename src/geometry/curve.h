// Curves in space by arc length: polylines, straights with circular bends, interpolating splines, and helices.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/frame.h"

namespace tendril {

/// What a curve is made of; curve.cpp, arc_path.cpp, spline_path.cpp and helix_path.cpp hold the kinds.
class CurvePath {
 public:
  virtual ~CurvePath() = default;
  virtual double length() const = 0;
  /// Within 0 ... length. Where the curve jumps, what follows.
  virtual Frame frame(double s) const = 0;
  virtual Vec3 curvature(double s) const = 0;
  struct Sharpest {
    double radius, at;  ///< m; an infinite radius for a straight curve
  };
  virtual Sharpest sharpest() const = 0;
  virtual const std::vector<double>& breaks() const = 0;
};

/// An immutable curve, cheap to copy. Arc lengths (m) run from 0 to length(); others, by more than rounding, throw
/// UsageError. Errors name the curve's kind and count points from 1.
class Curve {
 public:
  /// Straight from point to point (m). At least two points; neighbours must differ.
  static Curve polyline(const std::vector<Vec3>& points);

  /// Straights between the points with each corner rounded by a circular arc of the given radius (m): piecewise
  /// constant curvature, as a bent tube has. Throws UsageError naming the corner where the arc does not fit.
  static Curve pcc(const std::vector<Vec3>& points, double radius);
  /// With one radius for each inner point.
  static Curve pcc(const std::vector<Vec3>& points, const std::vector<double>& radii);

  /// The cubic spline through the points with continuous curvature, parametrised by chord length. An end without a
  /// given direction has no curvature, like an elastic strip held at the points. Directions need not be unit vectors.
  struct SplineEnds {
    std::optional<Vec3> start, finish;
  };
  static Curve spline(const std::vector<Vec3>& points, const SplineEnds& ends = {});

  /// The circular helix about the z axis that begins at (radius, 0, 0) and rises by `pitch` (m) a turn; d1 points to the
  /// axis, so that curvature and torsion are constant in the section's axes. Throws UsageError unless radius and turns
  /// are above 0 and all three are finite.
  static Curve helix(double radius, double pitch, double turns, bool left_handed = false);

  /// What a curve was made from, by its kind: points, and for "pcc" the radii, for "spline" the ends; for "helix" its numbers
  /// alone (the points are then its ends).
  struct Origin {
    std::vector<Vec3> points = {};
    std::vector<double> radii = {};
    SplineEnds ends = {};
    double radius = 0, pitch = 0, turns = 0;
    bool left_handed = false;
  };
  const Origin& origin() const { return *origin_; }

  const char* kind() const { return kind_; }  ///< "polyline", "pcc", "spline" or "helix"
  const std::vector<Vec3>& points() const { return origin_->points; }  ///< those it was made from; a helix: its ends

  double length() const { return path_->length(); }

  /// Place and orientation: d3 is the tangent; d1 and d2 turn about it no more than they must (rotation-minimising),
  /// starting from those of Frame::looking along the first tangent. (A helix: see there.) At a corner of a polyline: the part that follows.
  Frame at(double s) const;

  /// The curvature vector, 1/m: towards the middle of the bend, of length 1 / radius.
  Vec3 curvature(double s) const;
  double bend_radius(double s) const;  ///< m; infinite where straight

  /// The smallest bend radius (m) and the arc length where it is first reached: 0 at a polyline's corners; infinite for
  /// a straight curve.
  double min_bend_radius() const { return path_->sharpest().radius; }
  double min_bend_radius_at() const { return path_->sharpest().at; }

  /// Arc lengths, rising, inside the curve, where the curvature jumps or the tangent does.
  const std::vector<double>& breaks() const { return path_->breaks(); }

  /// Points at equal arc lengths, at most `spacing` (m) apart, both ends included.
  std::vector<Vec3> sampled(double spacing) const;

 private:
  Curve(const char* kind, Origin origin, std::unique_ptr<const CurvePath> path)
      : kind_(kind), origin_(std::make_shared<const Origin>(std::move(origin))), path_(std::move(path)) {}
  double checked(double s) const;

  const char* kind_;
  std::shared_ptr<const Origin> origin_;
  std::shared_ptr<const CurvePath> path_;
};

/// The kinds of paths. Points are valid: two or more, finite, neighbours apart.
std::unique_ptr<const CurvePath> make_polyline_path(const std::vector<Vec3>& points);
std::unique_ptr<const CurvePath> make_pcc_path(const std::vector<Vec3>& points, const std::vector<double>& radii);
std::unique_ptr<const CurvePath> make_spline_path(const std::vector<Vec3>& points, const Curve::SplineEnds& ends);
std::unique_ptr<const CurvePath> make_helix_path(double radius, double pitch, double turns, bool left_handed);

}  // namespace tendril
