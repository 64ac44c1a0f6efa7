#include "view/view_camera.h"

#include <algorithm>
#include <cmath>

namespace tendril {

Vec3 ViewCamera::project(const Vec3& world) const {
  const Vec3 d = world - centre;
  return {0.5 * width + d.dot(right) / metres_per_pixel, 0.5 * height - d.dot(up) / metres_per_pixel, d.dot(back)};
}

ViewCamera named_camera(const std::string& view) {
  ViewCamera camera;
  camera.up = Vec3::UnitZ();
  if (view == "front") {
    camera.back = -Vec3::UnitY();
  } else if (view == "top") {
    camera.back = Vec3::UnitZ();
    camera.up = Vec3::UnitY();
  } else if (view == "side") {
    camera.back = Vec3::UnitX();
  } else {
    camera.back = Vec3(1, -1, 1).normalized();
    camera.up = (Vec3::UnitZ() - camera.back.z() * camera.back).normalized();
  }
  camera.right = camera.up.cross(camera.back);
  return camera;
}

std::vector<FitBall> fit_balls(const Picture& picture) {
  std::vector<FitBall> balls;
  if (picture.fit) {
    const PictureBox& box = *picture.fit;
    for (int i = 0; i < 8; ++i)
      balls.push_back(
          {{i & 1 ? box.high.x() : box.low.x(), i & 2 ? box.high.y() : box.low.y(), i & 4 ? box.high.z() : box.low.z()},
           0});
    return balls;
  }
  for (const PictureTube& tube : picture.tubes)
    for (std::size_t i = 0; i < tube.points.size(); ++i)
      balls.push_back({tube.points[i], tube.radii.empty() ? tube.radius : tube.radii[i]});
  if (!balls.empty()) return balls;
  for (const PictureSurface& surface : picture.surfaces) {
    const Mat3 turn = surface.pose.rotation.toRotationMatrix();
    for (const Vec3& vertex : surface.vertices)
      if (all_finite(vertex)) balls.push_back({turn * vertex + surface.pose.at, 0});
  }
  for (const PicturePath& path : picture.paths)
    for (const Vec3& point : path.points) balls.push_back({point, 0});
  return balls;
}

ViewCamera fitted_camera(const std::string& view, const std::vector<FitBall>& balls, double width, double height) {
  ViewCamera camera = named_camera(view);
  camera.width = width, camera.height = height;
  Mat3 axes;
  axes << camera.right.transpose(), camera.up.transpose(), camera.back.transpose();
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
  for (const FitBall& ball : balls) {
    const Vec3 p = axes * ball.at;
    low = low.cwiseMin(p - Vec3::Constant(ball.radius));
    high = high.cwiseMax(p + Vec3::Constant(ball.radius));
  }
  if (balls.empty()) low.setConstant(-0.5), high.setConstant(0.5);
  const Vec3 size = high - low;
  const double least = size.maxCoeff() > 0 ? size.maxCoeff() / 3 : 1e-3;
  camera.centre = axes.transpose() * (0.5 * (low + high));
  const double spare = 1.2;
  camera.metres_per_pixel = spare * std::max({size.x() / width, size.y() / height, least / std::max(width, height)});
  return camera;
}

}  // namespace tendril
