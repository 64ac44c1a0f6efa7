#include "statics/contact_points.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace tendril {

namespace {

void check_arrays(std::span<const double> s, std::span<const double> radii) {
  if (s.size() < 2 || radii.size() + 1 != s.size())
    throw UsageError("contact_points: got " + std::to_string(s.size()) + " vertices and " +
                     std::to_string(radii.size()) + " radii; expected one radius for each segment between vertices");
}

/// R [e3]: its product with theta is minus the change of R e3.
Mat3 turned_cross_e3(const Quat& q) {
  const Mat3 R = q.toRotationMatrix();
  Mat3 m;
  m.col(0) = R.col(1);
  m.col(1) = -R.col(0);
  m.col(2).setZero();
  return m;
}

/// Second derivative of w . exp([theta]) e3 at theta = 0: (w e3^T + e3 w^T) / 2 - w_z I.
Mat3 geometric_block(const Vec3& w) {
  Mat3 m = Mat3::Zero();
  m(0, 0) = m(1, 1) = -w.z();
  m(0, 2) = m(2, 0) = 0.5 * w.x();
  m(1, 2) = m(2, 1) = 0.5 * w.y();
  return m;
}

}  // namespace

ContactPoint contact_point_at(std::span<const double> s, std::span<const double> radii, Element element, int segment,
                              double xi) {
  check_arrays(s, radii);
  const double h = s[segment + 1] - s[segment];
  ContactPoint p{segment, s[segment] + xi * h, 0, radii[segment], 1 - xi, xi, 0, 0};
  if (xi == 1) p.s = s[segment + 1];
  if (element == Element::se3) {
    const double rest = 1 - xi;
    p.ra = (1 + 2 * xi) * rest * rest;
    p.rb = xi * xi * (3 - 2 * xi);
    p.ta = h * xi * rest * rest;
    p.tb = -h * xi * xi * rest;
  }
  return p;
}

ContactPoint slope_of(const ContactPoint& point, std::span<const double> s, Element element) {
  const double h = s[point.segment + 1] - s[point.segment], xi = (point.s - s[point.segment]) / h;
  ContactPoint slope{point.segment, point.s, 0, point.radius, -1 / h, 1 / h, 0, 0};
  if (element == Element::se3) {
    slope.rb = 6 * xi * (1 - xi) / h;
    slope.ra = -slope.rb;
    slope.ta = (1 - xi) * (1 - 3 * xi);
    slope.tb = xi * (3 * xi - 2);
  }
  return slope;
}

ContactPoint curvature_of(const ContactPoint& point, std::span<const double> s, Element element) {
  const double h = s[point.segment + 1] - s[point.segment], xi = (point.s - s[point.segment]) / h;
  ContactPoint curvature{point.segment, point.s, 0, point.radius, 0, 0, 0, 0};
  if (element == Element::se3) {
    curvature.ra = (12 * xi - 6) / (h * h);
    curvature.rb = -curvature.ra;
    curvature.ta = (6 * xi - 4) / h;
    curvature.tb = (6 * xi - 2) / h;
  }
  return curvature;
}

double kept_at(double way, double radius) {
  const double arc = 8 * radius, x = std::max(0.0, way - radius), bent = std::min(x, 0.5 * arc);
  return bent * bent / (2 * arc) + 0.5 * (x - bent);
}

void set_trapezoid_weights(std::span<ContactPoint> points) {
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i) {
    const double before = i > 0 ? points[i].s - points[i - 1].s : 0;
    const double after = i + 1 < n ? points[i + 1].s - points[i].s : 0;
    points[i].weight = 0.5 * (before + after);
  }
}

std::vector<ContactPoint> contact_points(std::span<const double> s, std::span<const double> radii, Element element,
                                         double spacing) {
  check_arrays(s, radii);
  const int segments = static_cast<int>(radii.size());
  std::vector<ContactPoint> points;
  for (int i = 0; i < segments; ++i) {
    const double wanted = std::ceil((s[i + 1] - s[i]) / (spacing * radii[i]) - 1e-9);
    const int parts = static_cast<int>(std::clamp(wanted, 1.0, double(max_points_per_segment)));
    for (int j = 0; j < parts; ++j) {
      points.push_back(contact_point_at(s, radii, element, i, double(j) / parts));
      if (j == 0 && i > 0) points.back().radius = std::max(radii[i - 1], radii[i]);
    }
  }
  points.push_back(contact_point_at(s, radii, element, segments - 1, 1));
  set_trapezoid_weights(points);
  return points;
}

Vec3 position_of(const ContactPoint& p, const VertexShape& shape) {
  Vec3 x = p.ra * shape.points[p.segment] + p.rb * shape.points[p.segment + 1];
  if (p.ta != 0) x += p.ta * (shape.rotations[p.segment] * Vec3::UnitZ());
  if (p.tb != 0) x += p.tb * (shape.rotations[p.segment + 1] * Vec3::UnitZ());
  return x;
}

Vec3 displacement_of(const ContactPoint& p, const VertexShape& shape, std::span<const Vec6> step) {
  const Vec6& a = step[p.segment];
  const Vec6& b = step[p.segment + 1];
  Vec3 dx = p.ra * a.head<3>() + p.rb * b.head<3>();
  if (p.ta != 0) dx += p.ta * (shape.rotations[p.segment] * Vec3(a[4], -a[3], 0));
  if (p.tb != 0) dx += p.tb * (shape.rotations[p.segment + 1] * Vec3(b[4], -b[3], 0));
  return dx;
}

namespace {

/// Positions of all points, each vertex being asked once: `point_of` and `normal_of` give its place and section normal.
template <class PointOf, class NormalOf>
void fill_positions(std::span<const ContactPoint> points, PointOf point_of, NormalOf normal_of, std::vector<Vec3>& out) {
  out.resize(points.size());
  int segment = -1;
  bool turned = false;  // the section normals of this segment are at hand
  Vec3 ra = Vec3::Zero(), rb = ra, ta = ra, tb = ra;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& p = points[i];
    if (p.segment != segment) {
      const bool next = segment >= 0 && p.segment == segment + 1;
      ra = next ? rb : point_of(p.segment);
      rb = point_of(p.segment + 1);
      segment = p.segment;
      turned = false;
    }
    out[i] = p.ra * ra + p.rb * rb;
    if (p.ta == 0 && p.tb == 0) continue;
    if (!turned) {
      ta = normal_of(segment);
      tb = normal_of(segment + 1);
      turned = true;
    }
    out[i] += p.ta * ta + p.tb * tb;
  }
}

}  // namespace

void positions_of(std::span<const ContactPoint> points, const VertexShape& shape, std::vector<Vec3>& out) {
  fill_positions(
      points, [&](int v) -> Vec3 { return shape.points[v]; },
      [&](int v) -> Vec3 { return shape.rotations[v] * Vec3::UnitZ(); }, out);
}

void moved_positions(std::span<const ContactPoint> points, const VertexShape& shape, std::span<const Vec6> step,
                     double share, std::vector<Vec3>& out) {
  fill_positions(
      points, [&](int v) -> Vec3 { return shape.points[v] + share * step[v].head<3>(); },
      [&](int v) -> Vec3 {
        return shape.rotations[v] * (exp_rotation(share * step[v].tail<3>()) * Vec3::UnitZ());
      },
      out);
}

void add_point_force(const ContactPoint& p, const VertexShape& shape, const Vec3& force, Vec6& at_a, Vec6& at_b) {
  at_a.head<3>() += p.ra * force;
  at_b.head<3>() += p.rb * force;
  if (p.ta != 0) at_a.tail<3>() -= p.ta * (turned_cross_e3(shape.rotations[p.segment]).transpose() * force);
  if (p.tb != 0) at_b.tail<3>() -= p.tb * (turned_cross_e3(shape.rotations[p.segment + 1]).transpose() * force);
}

void add_point_energy(const ContactPoint& p, const VertexShape& shape, const Vec3& gradient, const Mat3& hessian,
                      const Vec3& geometric, BlockView system) {
  const int a = p.segment, b = a + 1;
  if (p.ra != 0) {
    system.gradient[a].head<3>() += p.ra * gradient;
    system.diagonal[a].topLeftCorner<3, 3>() += (p.ra * p.ra) * hessian;
  }
  if (p.rb != 0) {
    system.gradient[b].head<3>() += p.rb * gradient;
    system.diagonal[b].topLeftCorner<3, 3>() += (p.rb * p.rb) * hessian;
  }
  if (p.ra != 0 && p.rb != 0) system.upper[a].topLeftCorner<3, 3>() += (p.ra * p.rb) * hessian;
  if (p.ta == 0 && p.tb == 0) return;

  // dx = ra dr_a + rb dr_b + A theta_a + B theta_b
  const Mat3 A = -p.ta * turned_cross_e3(shape.rotations[a]);
  const Mat3 B = -p.tb * turned_cross_e3(shape.rotations[b]);
  const Mat3 HA = hessian * A, HB = hessian * B;
  system.gradient[a].tail<3>() += A.transpose() * gradient;
  system.gradient[b].tail<3>() += B.transpose() * gradient;

  Mat6& aa = system.diagonal[a];
  aa.topRightCorner<3, 3>() += p.ra * HA;
  aa.bottomLeftCorner<3, 3>() += p.ra * HA.transpose();
  aa.bottomRightCorner<3, 3>() += A.transpose() * HA + geometric_block(p.ta * (shape.rotations[a].conjugate() * geometric));
  Mat6& bb = system.diagonal[b];
  bb.topRightCorner<3, 3>() += p.rb * HB;
  bb.bottomLeftCorner<3, 3>() += p.rb * HB.transpose();
  bb.bottomRightCorner<3, 3>() += B.transpose() * HB + geometric_block(p.tb * (shape.rotations[b].conjugate() * geometric));
  Mat6& ab = system.upper[a];
  ab.topRightCorner<3, 3>() += p.ra * HB;
  ab.bottomLeftCorner<3, 3>() += p.rb * HA.transpose();
  ab.bottomRightCorner<3, 3>() += A.transpose() * HB;
}

}  // namespace tendril
