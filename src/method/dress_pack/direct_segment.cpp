#include "method/dress_pack/direct_segment.h"

#include <Eigen/Cholesky>

namespace tendril::dress_pack {
namespace {

V3<double> lanes(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vector(const V3<double>& v) { return {v.x, v.y, v.z}; }
Mat3 matrix(const M3<double>& m) {
  Mat3 out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out(i, j) = m(i, j);
  return out;
}
Mat3 symmetric(const Mat3& m) { return 0.5 * (m + m.transpose()); }

/// ad_x in (v, phi), and M with M y = ad_y^T w.
Mat6 adjoint(const Vec6& x) {
  Mat6 out = Mat6::Zero();
  out.topLeftCorner<3, 3>() = out.bottomRightCorner<3, 3>() = cross_matrix(x.tail<3>());
  out.topRightCorner<3, 3>() = cross_matrix(x.head<3>());
  return out;
}
Mat6 coadjoint(const Vec6& w) {
  Mat6 out = Mat6::Zero();
  out.topRightCorner<3, 3>() = out.bottomLeftCorner<3, 3>() = cross_matrix(w.head<3>());
  out.bottomRightCorner<3, 3>() = cross_matrix(w.tail<3>());
  return out;
}

}  // namespace

SegmentMotion::SegmentMotion(const Vec3& ra, const Quat& qa, const Vec3& rb, const Quat& qb) : axes_(qa.toRotationMatrix()) {
  const Quat turn = qa.conjugate() * qb;
  const V3<double> phi = rotation_log(Q4<double>{turn.w(), {turn.x(), turn.y(), turn.z()}}, k_);
  phi_ = vector(phi);
  d_ = axes_.transpose() * (rb - ra);
  a_ = matrix(inverse_left_jacobian(phi, k_.c));
  g_ = matrix(jacobian_derivative(phi, lanes(d_), k_, 1));
  xi_.head<3>() = a_ * d_;
  xi_.tail<3>() = phi_;
  // v' = A R_a^T (dr_b - dr_a) + A [d] theta_a + G phi',   phi' = A^T theta_b - A theta_a.
  const Mat3 by_d = a_ * axes_.transpose(), va = a_ * cross_matrix(d_) - g_ * a_, vb = g_ * a_.transpose();
  slope_.block<3, 3>(0, 0) = -by_d.transpose();
  slope_.block<3, 3>(3, 0) = va.transpose();
  slope_.block<3, 3>(6, 0) = by_d.transpose();
  slope_.block<3, 3>(9, 0) = vb.transpose();
  slope_.block<3, 3>(0, 3).setZero();
  slope_.block<3, 3>(3, 3) = -a_.transpose();
  slope_.block<3, 3>(6, 3).setZero();
  slope_.block<3, 3>(9, 3) = a_;
}

// The terms that are linear in the gradient: second derivatives of v by (d, phi), and of d and phi by the increments.
Mat12 SegmentMotion::hessian(const Vec6& by_xi, const Mat6& by_xi_twice) const {
  const V3<double> phi = lanes(phi_), n = lanes(by_xi.head<3>());
  const Vec3 f = a_.transpose() * by_xi.head<3>(), m = g_.transpose() * by_xi.head<3>() + by_xi.tail<3>();
  const Mat3 d_phi = matrix(jacobian_derivative(phi, n, k_, -1));
  const Mat3 phi_phi = matrix(second_derivative_of_v(phi, lanes(d_), n, k_));
  const Mat3 turn = matrix(jacobian_derivative(phi, lanes(m), k_, 1));
  const Mat3 cross = cross_matrix(d_), at = a_.transpose();
  const Mat3 aa = 2 * cross * d_phi * a_ + f * d_.transpose() + turn * a_ - cross_matrix(m) * a_ - f.dot(d_) * Mat3::Identity();
  const Mat3 da = axes_ * (-d_phi * a_ - cross_matrix(f)), db = axes_ * d_phi * at;
  const Mat3 ab = -cross * d_phi * at - at * phi_phi * at - (turn * a_).transpose();
  Mat12 out = slope_ * by_xi_twice * slope_.transpose();
  const auto add = [&](int i, int j, const Mat3& block) {
    out.block<3, 3>(3 * i, 3 * j) += block;
    if (i != j) out.block<3, 3>(3 * j, 3 * i) += block.transpose();
  };
  add(0, 1, -da);
  add(2, 1, da);
  add(0, 3, -db);
  add(2, 3, db);
  add(1, 1, symmetric(aa) + at * phi_phi * a_);
  add(1, 3, ab);
  add(3, 3, symmetric(turn * at) + a_ * phi_phi * at);
  return out;
}

MixedSegment::MixedSegment(const Se3Segment<double>& s) : h_(s.h), q_(s.q) {
  k_.head<3>() = vector(s.flexibility_v);
  k_.tail<3>() = vector(s.flexibility_phi);
  rate_.head<3>() = vector(s.rate_v);
  rate_.tail<3>() = vector(s.rate_phi);
  rest_ = k_.asDiagonal();
  if (s.varies) {
    rest_.topLeftCorner<3, 3>() = matrix(detail::varied_flexibility(s, s.flexibility_v));
    rest_.bottomRightCorner<3, 3>() = matrix(detail::varied_flexibility(s, s.flexibility_phi));
  }
}

Mat6 MixedSegment::flexibility(const Mat6& ad) const { return rest_ + q_ * ad * k_.asDiagonal() * ad.transpose(); }

Vec6 MixedSegment::wrench(const SegmentMotion& motion) const {
  const Vec6 rate = motion.xi() / h_;
  return flexibility(adjoint(rate)).ldlt().solve(rate - rate_);
}

void MixedSegment::terms(const SegmentMotion& motion, const Vec6& w, bool second, MixedTerms& out) const {
  const Vec6 rate = motion.xi() / h_;
  const Mat6 ad = adjoint(rate), m = coadjoint(w);
  const Vec6 U = m * rate, u = k_.cwiseProduct(U);
  const Vec6 by_xi = w + q_ * m * u;
  out.value = h_ * (w.dot(rate - rate_) - 0.5 * w.dot(rest_ * w) - 0.5 * q_ * U.dot(u));
  out.by_ends = motion.gradient(by_xi);
  out.by_wrench = h_ * (rate - rate_ - rest_ * w - q_ * ad * u);
  if (!second) return;
  out.ends_ends = motion.hessian(by_xi, q_ / h_ * m * k_.asDiagonal() * m);
  out.wrench_wrench = -h_ * flexibility(ad);
  out.ends_wrench = motion.slope() * (Mat6::Identity() + q_ * (adjoint(u).transpose() + m * k_.asDiagonal() * ad.transpose()));
}

}  // namespace tendril::dress_pack
