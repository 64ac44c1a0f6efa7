// The two energies of the thesis's staggered grid (section 2.1.4): stretch and shear of a segment, whose rotation lives at
// its middle, and bending and twist of a cell between two such rotations. Second order in the segment's length.
//
// Gradient and second derivative are exact; the geometric terms take a stress of their own (mixed-stress Newton).
#pragma once

#include "base/frame.h"
#include "rod/rotation_log.h"
#include "base/vectors.h"

namespace tendril {

/// Stretch and shear of a segment of length h: E = h/2 (G - e3 - gamma0) . K (G - e3 - gamma0), G = R^T (r_b - r_a)/h.
struct StretchSegment {
  double h = 0;
  Vec3 stiffness = Vec3::Zero();  ///< GA1, GA2, EA
  Vec3 reference = Vec3::Zero();  ///< gamma0 + e3

  struct Terms {
    double energy;
    Vec3 strain;             ///< G - e3 - gamma0
    Vec3 force;              ///< gradient in r_b, world axes; minus that in r_a
    Vec3 theta;              ///< gradient in the rotation
    Mat3 rr, rt, tt;         ///< second derivative: r_b r_b, r_b theta, theta theta
    Mat3 rate_r, rate_theta; ///< derivative of the stress n = K strain
  };

  Vec3 stress(const Vec3& strain) const { return stiffness.cwiseProduct(strain); }

  /// `geometric`: the stress of the geometric terms; null: the actual one.
  Terms evaluate(const Vec3& way, const Quat& rotation, const Vec3* geometric) const {
    const Mat3 axes = rotation.toRotationMatrix();
    const Mat3 k = stiffness.asDiagonal();
    const Vec3 g = axes.transpose() * way / h;
    Terms t;
    t.strain = g - reference;
    const Vec3 n = stress(t.strain);
    const Vec3 ng = geometric ? *geometric : n;
    const Mat3 cg = cross_matrix(g);
    t.energy = 0.5 * h * t.strain.dot(n);
    t.force = axes * n;
    t.theta = h * n.cross(g);
    t.rr = axes * k * axes.transpose() / h;
    t.rt = axes * (k * cg - cross_matrix(ng));
    t.tt = h * (cg.transpose() * k * cg + 0.5 * (ng * g.transpose() + g * ng.transpose()) - ng.dot(g) * Mat3::Identity());
    t.rate_r = k * axes.transpose() / h;
    t.rate_theta = k * cg;
    return t;
  }
};

/// Bending and twist between two rotations ds apart: E = ds/2 (phi/ds - omega0) . K (phi/ds - omega0),
/// phi = log(R_a^T R_b).
struct BendCell {
  double ds = 0;
  Vec3 stiffness = Vec3::Zero();  ///< EI1, EI2, GJ
  Vec3 reference = Vec3::Zero();  ///< omega0, 1/m

  struct Terms {
    double energy;
    Vec3 curvature;       ///< phi/ds
    Vec3 theta_a, theta_b;
    Mat3 aa, ab, bb;
    Mat3 rate_a, rate_b;  ///< derivative of the moment m
  };

  Vec3 moment(const Vec3& curvature) const { return stiffness.cwiseProduct(curvature - reference); }

  Terms evaluate(const Quat& a, const Quat& b, const Vec3* geometric) const {
    const Quat p = a.conjugate() * b;
    JacobianCoefficients<double> k;
    const V3<double> phi = rotation_log<double>({p.w(), {p.x(), p.y(), p.z()}}, k);
    auto dense = [](const M3<double>& m) { return Mat3(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.e)); };
    const Mat3 left = dense(inverse_left_jacobian(phi, k.c));  // A; its transpose is the inverse right Jacobian
    Terms t;
    t.curvature = Vec3(phi.x, phi.y, phi.z) / ds;
    const Vec3 m = moment(t.curvature);
    const Vec3 mg = geometric ? *geometric : m;
    const V3<double> mv{mg.x(), mg.y(), mg.z()};
    const Mat3 plus = dense(jacobian_derivative(phi, mv, k, 1)), minus = dense(jacobian_derivative(phi, mv, k, -1));
    const Mat3 stiff = (stiffness / ds).asDiagonal();
    t.energy = 0.5 * ds * m.dot(t.curvature - reference);
    t.theta_a = -(left.transpose() * m);
    t.theta_b = left * m;
    const Mat3 pb = plus * left.transpose(), pa = minus * left;
    t.bb = left * stiff * left.transpose() + 0.5 * (pb + pb.transpose());
    t.aa = left.transpose() * stiff * left + 0.5 * (pa + pa.transpose());
    t.ab = -(left.transpose() * stiff * left.transpose()) - (plus * left).transpose();
    t.rate_a = -(stiff * left);
    t.rate_b = stiff * left.transpose();
    return t;
  }
};

}  // namespace tendril
