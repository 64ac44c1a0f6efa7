// Polygons into triangles.

#include <Eigen/Geometry>

#include "geometry/mesh_file.h"

namespace tendril {

namespace {

using Flat = Eigen::Vector2d;

double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// The polygon in the plane it spans, counter-clockwise: its normal is the sum over its sides, which also holds for
// corners that do not quite lie in one plane.
std::vector<Flat> flattened(const std::vector<Vec3>& vertices, const std::vector<int>& corners) {
  Vec3 normal = Vec3::Zero();
  const Vec3 origin = vertices[corners[0]];
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += (vertices[corners[i]] - origin).cross(vertices[corners[(i + 1) % corners.size()]] - origin);
  std::vector<Flat> flat;
  if (!(normal.norm() > 0)) return flat;
  normal.normalize();
  const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
  for (int corner : corners) flat.emplace_back(x.dot(vertices[corner] - origin), y.dot(vertices[corner] - origin));
  return flat;
}

bool is_ear(const std::vector<Flat>& flat, const std::vector<int>& left, std::size_t i) {
  const std::size_t n = left.size(), before = (i + n - 1) % n, after = (i + 1) % n;
  const Flat &a = flat[left[before]], &b = flat[left[i]], &c = flat[left[after]];
  if (!(turn(a, b, c) > 0)) return false;
  for (std::size_t k = 0; k < n; ++k) {
    if (k == before || k == i || k == after) continue;
    const Flat& p = flat[left[k]];
    if (p == a || p == b || p == c) continue;  // a corner passed twice, as around a hole
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate(const std::vector<Vec3>& vertices, const std::vector<int>& corners,
                 std::vector<std::array<int, 3>>& triangles) {
  if (corners.size() == 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  const std::vector<Flat> flat = flattened(vertices, corners);
  std::vector<int> left(corners.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
  std::size_t at = 1;
  while (left.size() > 3) {
    // Without an ear (a polygon that crosses itself or has no area) the next corner has to do.
    std::size_t ear = at % left.size();
    for (std::size_t k = 0; k < left.size() && !flat.empty(); ++k)
      if (is_ear(flat, left, (at + k) % left.size())) {
        ear = (at + k) % left.size();
        break;
      }
    const std::size_t n = left.size();
    triangles.push_back({corners[left[(ear + n - 1) % n]], corners[left[ear]], corners[left[(ear + 1) % n]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    at = ear;
  }
  triangles.push_back({corners[left[0]], corners[left[1]], corners[left[2]]});
}

}  // namespace tendril
