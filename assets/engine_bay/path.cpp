#include "engine_bay/path.h"

namespace tendril::engine_bay {
namespace {

struct Arc {
  Vec3 begin, centre, axis;
  double angle;
};

// The arc that touches both lines at the corner b; its angle is 0 where they go straight on.
Arc arc_at(const Vec3& a, const Vec3& b, const Vec3& c, double radius, double room_before, double room_after) {
  const Vec3 in = (b - a).normalized(), out = (c - b).normalized();
  const Vec3 normal = in.cross(out);
  const double angle = std::atan2(normal.norm(), in.dot(out));
  if (angle < 1e-6 || radius <= 0) return {b, b, Vec3::UnitZ(), 0};
  const double setback = std::min({radius * std::tan(angle / 2), room_before, room_after});
  const double fitted = setback / std::tan(angle / 2);
  const Vec3 axis = normal.normalized();
  const Vec3 begin = b - setback * in;
  return {begin, begin + fitted * axis.cross(in), axis, angle};
}

}  // namespace

Path divided(const Path& path, const Detail& detail) {
  Path out{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 step = path[i] - path[i - 1];
    const int n = detail.steps(step.norm());
    for (int k = 1; k <= n; ++k) out.push_back(k == n ? path[i] : Vec3(path[i - 1] + step * (double(k) / n)));
  }
  return out;
}

Path rounded_path(const Path& corners, double radius, const Detail& detail) {
  Path out{corners.front()};
  const std::size_t last = corners.size() - 1;
  for (std::size_t i = 1; i < last; ++i) {
    // An inner line is shared by the arcs at its two ends, an end line belongs to one.
    const double before = (corners[i] - corners[i - 1]).norm() * (i == 1 ? 0.98 : 0.49);
    const double after = (corners[i + 1] - corners[i]).norm() * (i + 1 == last ? 0.98 : 0.49);
    const Arc arc = arc_at(corners[i - 1], corners[i], corners[i + 1], radius, before, after);
    const Vec3 arm = arc.begin - arc.centre;
    const int n = arc.angle > 0 ? detail.steps(arm.norm(), arc.angle) : 0;
    for (int k = 0; k <= n; ++k)
      out.push_back(arc.centre + exp_rotation(arc.axis * (n ? arc.angle * k / n : 0.0)) * arm);
  }
  out.push_back(corners.back());
  return divided(out, detail);
}

std::vector<double> arc_lengths(const Path& path) {
  std::vector<double> s{0};
  for (std::size_t i = 1; i < path.size(); ++i) s.push_back(s.back() + (path[i] - path[i - 1]).norm());
  return s;
}

}  // namespace tendril::engine_bay
