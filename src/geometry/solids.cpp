#include "geometry/solids.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>

#include "base/error.h"

namespace tendril {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Outside, n points away from the nearest point of the box; the Hessian is that of the distance to this point within
// the axes in which p lies beyond a face: none for a face, a plane across an edge, all of space at a corner.
SolidDistance distance(const Box& box, const Vec3& p) {
  const Vec3 half = 0.5 * box.size;
  const Vec3 nearest = p.cwiseMax(-half).cwiseMin(half);
  const Vec3 off = p - nearest;
  const double d = off.norm();
  if (d > 0) {
    const Vec3 n = off / d;
    const Mat3 free = (off.array() != 0).cast<double>().matrix().asDiagonal();
    Mat3 hessian = Mat3::Zero();
    if ((off.array() != 0).count() > 1) hessian = (free - n * n.transpose()) / d;
    return {d, n, nearest, hessian};
  }
  int axis;
  const double depth = (half - p.cwiseAbs()).minCoeff(&axis);
  Vec3 n = Vec3::Zero();
  n[axis] = p[axis] < 0 ? -1 : 1;
  Vec3 point = p;
  point[axis] = n[axis] * half[axis];
  return {-depth, n, point, Mat3::Zero()};
}

SolidDistance distance(const Sphere& sphere, const Vec3& p) {
  const double r = p.norm();
  if (!(r > 1e-12 * sphere.radius)) return {-sphere.radius, Vec3::UnitZ(), {0, 0, sphere.radius}, Mat3::Zero()};
  const Vec3 n = p / r;
  return {r - sphere.radius, n, sphere.radius * n, (Mat3::Identity() - n * n.transpose()) / r};
}

// In the half-plane through the axis and p: `out` beyond the side, `over` beyond an end. Turning p about the axis by a
// small angle bends the normal's radial part, which is where the term in the direction of the turn comes from.
SolidDistance distance(const Cylinder& cylinder, const Vec3& p) {
  const double rho = std::hypot(p.x(), p.y());
  const bool on_axis = !(rho > 1e-12 * cylinder.radius);
  const Vec3 radial = on_axis ? Vec3::UnitX() : Vec3(p.x() / rho, p.y() / rho, 0);
  const Vec3 turn = Vec3::UnitZ().cross(radial);
  const Vec3 axial(0, 0, p.z() < 0 ? -1 : 1);
  const double out = rho - cylinder.radius, over = std::abs(p.z()) - 0.5 * cylinder.length;
  const Mat3 about_axis = on_axis ? Mat3::Zero() : Mat3(turn * turn.transpose() / rho);

  if (out > 0 && over > 0) {
    const double d = std::hypot(out, over);
    const Vec3 n = (out * radial + over * axial) / d, t = (over * radial - out * axial) / d;
    return {d, n, p - d * n, t * t.transpose() / d + (out / d) * about_axis};
  }
  if (out > over) return {out, radial, p - out * radial, about_axis};
  return {over, axial, p - over * axial, Mat3::Zero()};
}

SolidDistance distance(const HalfSpace&, const Vec3& p) {
  return {p.z(), Vec3::UnitZ(), {p.x(), p.y(), 0}, Mat3::Zero()};
}

// The part of the way inside a slab |x_axis| <= half narrows [from, to]; the normal is that of the last face entered.
bool clip_to_slab(double at, double way, double half, const Vec3& axis, double& from, double& to, Vec3& normal) {
  if (way == 0) return std::abs(at) < half;
  const double sign = way > 0 ? 1 : -1;
  const double enter = (-sign * half - at) / way, leave = (sign * half - at) / way;
  if (enter > from) {
    from = enter;
    normal = -sign * axis;
  }
  to = std::min(to, leave);
  return from < to;
}

// Share of the way a + t w at which |.| first falls to `radius`, and at which it leaves again.
std::optional<std::pair<double, double>> round_crossing(double ww, double aw, double aa, double radius) {
  if (ww == 0) return std::nullopt;
  // The distance of the line from the centre, without the cancellation of the textbook discriminant.
  const double nearest = -aw / ww, gap = aa - aw * aw / ww, room = radius * radius - gap;
  if (!(room > 0)) return std::nullopt;
  const double half = std::sqrt(room / ww);
  return std::pair{nearest - half, nearest + half};
}

std::optional<SolidHit> entry(const Box& box, const Vec3& a, const Vec3& b) {
  double from = -infinity, to = 1;
  Vec3 normal = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (!clip_to_slab(a[k], b[k] - a[k], 0.5 * box.size[k], Vec3::Unit(k), from, to, normal)) return std::nullopt;
  if (from < 0 || from > 1) return std::nullopt;
  return SolidHit{from, normal};
}

std::optional<SolidHit> entry(const Sphere& sphere, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const auto crossing = round_crossing(way.squaredNorm(), a.dot(way), a.squaredNorm(), sphere.radius);
  if (!crossing || crossing->first < 0 || crossing->first > 1) return std::nullopt;
  return SolidHit{crossing->first, (a + crossing->first * way).normalized()};
}

std::optional<SolidHit> entry(const Cylinder& cylinder, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const Eigen::Vector2d flat = a.head<2>(), flat_way = way.head<2>();
  double from = -infinity, to = infinity;
  Vec3 normal = Vec3::Zero();
  const auto crossing =
      round_crossing(flat_way.squaredNorm(), flat.dot(flat_way), flat.squaredNorm(), cylinder.radius);
  if (crossing) {
    std::tie(from, to) = *crossing;
    const Vec3 at = a + from * way;
    normal = Vec3(at.x(), at.y(), 0).normalized();
  } else if (!(flat_way.squaredNorm() == 0 && flat.norm() < cylinder.radius)) {
    return std::nullopt;
  }
  if (!clip_to_slab(a.z(), way.z(), 0.5 * cylinder.length, Vec3::UnitZ(), from, to, normal)) return std::nullopt;
  if (from < 0 || from > 1) return std::nullopt;
  return SolidHit{from, normal};
}

std::optional<SolidHit> entry(const HalfSpace&, const Vec3& a, const Vec3& b) {
  if (!(a.z() > 0 && b.z() <= 0)) return std::nullopt;
  return SolidHit{a.z() / (a.z() - b.z()), Vec3::UnitZ()};
}

void positive(double value, const char* who, const char* what) {
  if (std::isfinite(value) && value > 0) return;
  std::ostringstream said;
  said << who << ": " << what << " is " << value << "; a finite length above 0 expected (m)";
  throw UsageError(said.str());
}

void check_one(const Box& box, const char* who) {
  positive(box.size.x(), who, "size x");
  positive(box.size.y(), who, "size y");
  positive(box.size.z(), who, "size z");
}
void check_one(const Sphere& sphere, const char* who) { positive(sphere.radius, who, "radius"); }
void check_one(const Cylinder& cylinder, const char* who) {
  positive(cylinder.radius, who, "radius");
  positive(cylinder.length, who, "length");
}
void check_one(const HalfSpace&, const char*) {}

Vec3 half_size(const Box& box) { return 0.5 * box.size; }
Vec3 half_size(const Sphere& sphere) { return Vec3::Constant(sphere.radius); }
Vec3 half_size(const Cylinder& c) { return {c.radius, c.radius, 0.5 * c.length}; }
Vec3 half_size(const HalfSpace&) { return Vec3::Constant(infinity); }

}  // namespace

void check(const Solid& solid, const char* who) {
  std::visit([&](const auto& shape) { check_one(shape, who); }, solid);
}

SolidDistance distance_to(const Solid& solid, const Vec3& p) {
  return std::visit([&](const auto& shape) { return distance(shape, p); }, solid);
}

std::optional<SolidHit> entry_into(const Solid& solid, const Vec3& a, const Vec3& b) {
  return std::visit([&](const auto& shape) { return entry(shape, a, b); }, solid);
}

Eigen::AlignedBox3d box_of(const Solid& solid) {
  const Vec3 half = std::visit([](const auto& shape) { return half_size(shape); }, solid);
  return {-half, half};
}

}  // namespace tendril
