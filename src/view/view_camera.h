// The orthographic named views and how they are fitted.
#pragma once

#include <string>
#include <vector>

#include "view/picture.h"

namespace tendril {

/// Looks along -back; `right` and `up` are the page's axes. All three are unit vectors in world axes.
struct ViewCamera {
  Vec3 right, up, back;
  Vec3 centre = Vec3::Zero();  ///< shown in the middle of the page, m
  double metres_per_pixel = 1;
  double width = 1, height = 1;  ///< pixels

  /// x to the right and y down from the top left corner in pixels; z towards the eye in metres.
  Vec3 project(const Vec3& world) const;
};

/// The axes of "iso" (from +x, -y, +z), "front" (from -y), "top" (from +z) or "side" (from +x).
ViewCamera named_camera(const std::string& view);

/// A place to keep in view: a ball.
struct FitBall {
  Vec3 at;
  double radius = 0;
};

/// What the picture is fitted to: the box's corners, else the tubes, else everything.
std::vector<FitBall> fit_balls(const Picture& picture);

/// The named view of `balls` on a page of width x height pixels, with a tenth of their extent to spare on each side.
/// A view along a straight rod, which has next to no extent there, still shows a third of the largest extent.
ViewCamera fitted_camera(const std::string& view, const std::vector<FitBall>& balls, double width, double height);

}  // namespace tendril
