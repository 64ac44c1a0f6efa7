// The circular helix, exact.

#include <cmath>

#include "base/units.h"
#include "geometry/curve.h"

namespace tendril {

namespace {

class HelixPath final : public CurvePath {
 public:
  HelixPath(double radius, double pitch, double turns, bool left_handed)
      : radius_(radius), rise_(pitch / (2 * units::pi)), way_(std::hypot(radius, rise_)), side_(left_handed ? -1 : 1),
        length_(2 * units::pi * turns * way_) {}

  double length() const override { return length_; }

  Frame frame(double s) const override {
    const double angle = s / way_, x = std::cos(angle), y = side_ * std::sin(angle);
    const Vec3 at(radius_ * x, radius_ * y, rise_ * angle);
    const Vec3 along(-radius_ * side_ * y / way_, radius_ * side_ * x / way_, rise_ / way_);
    Mat3 axes;
    axes.col(0) = Vec3(-x, -y, 0);
    axes.col(2) = along;
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return {at, Quat(axes).normalized()};
  }

  Vec3 curvature(double s) const override {
    const double angle = s / way_;
    return radius_ / (way_ * way_) * Vec3(-std::cos(angle), -side_ * std::sin(angle), 0);
  }

  Sharpest sharpest() const override { return {way_ * way_ / radius_, 0}; }
  const std::vector<double>& breaks() const override { return breaks_; }

 private:
  double radius_, rise_, way_, side_, length_;  ///< m; rise and way per radian; side: 1 right-handed, -1 left-handed
  std::vector<double> breaks_;
};

}  // namespace

std::unique_ptr<const CurvePath> make_helix_path(double radius, double pitch, double turns, bool left_handed) {
  return std::make_unique<HelixPath>(radius, pitch, turns, left_handed);
}

}  // namespace tendril
