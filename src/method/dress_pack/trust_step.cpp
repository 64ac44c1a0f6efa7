#include "method/dress_pack/trust_step.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace tendril::dress_pack {
namespace {

constexpr double touching = 1e-12;  // slack below it is none

class ActiveSet {
 public:
  explicit ActiveSet(const LinearLimits& limits) : limits_(limits), active_(limits.rows.rows(), 0) {}

  /// An orthonormal basis of the directions that leave the active rows as they are.
  Eigen::MatrixXd free_directions(int size) const {
    if (list_.empty()) return Eigen::MatrixXd::Identity(size, size);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns(size));
    const Eigen::MatrixXd q = qr.householderQ();
    return q.rightCols(size - qr.rank());
  }

  void add(int row) {
    active_[row] = 1;
    list_.push_back(row);
  }
  bool has(int row) const { return active_[row]; }

  /// Lets go the row that the slope pulls away from most. False: none.
  bool release(const Eigen::VectorXd& slope) {
    if (list_.empty()) return false;
    const Eigen::VectorXd pressure = columns(static_cast<int>(slope.size())).colPivHouseholderQr().solve(-slope);
    Eigen::Index worst;
    if (pressure.minCoeff(&worst) >= -1e-9 * (1 + slope.norm())) return false;
    active_[list_[worst]] = 0;
    list_.erase(list_.begin() + worst);
    return true;
  }

 private:
  Eigen::MatrixXd columns(int size) const {
    Eigen::MatrixXd out(size, list_.size());
    for (std::size_t k = 0; k < list_.size(); ++k) out.col(static_cast<int>(k)) = limits_.rows.row(list_[k]).transpose();
    return out;
  }

  const LinearLimits& limits_;
  std::vector<char> active_;
  std::vector<int> list_;
};

/// -(|H| + mu)^-1 g within the radius.
Eigen::VectorXd saddle_free(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian, double radius, bool& at_edge) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(hessian);
  const Eigen::VectorXd g = eigen.eigenvectors().transpose() * gradient;
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  const Eigen::ArrayXd size = eigen.eigenvalues().array().abs().max(1e-12 * std::max(largest, 1e-30));
  const auto length = [&](double mu) { return (g.array() / (size + mu)).matrix().norm(); };
  double mu = 0;
  at_edge = length(0) > radius;
  if (at_edge) {
    // The reciprocal of the length is nearly linear in mu: Newton's method from below, each step short of the root.
    for (int round = 0; round < 60; ++round) {
      const double now = length(mu);
      if (now <= radius * (1 + 1e-6)) break;
      const double rate = (g.array().square() / (size + mu).cube()).sum() / (now * now);
      mu += (now / radius - 1) / rate;
    }
  }
  const Eigen::VectorXd y = -(g.array() / (size + mu)).matrix();
  return eigen.eigenvectors() * (std::min(1.0, radius / std::max(y.norm(), 1e-300)) * y);
}

}  // namespace

TrustStep trust_step(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian, const LinearLimits& limits, const Eigen::VectorXd& x,
                     double radius) {
  const int size = static_cast<int>(x.size()), rows = static_cast<int>(limits.rows.rows());
  TrustStep out;
  out.step = Eigen::VectorXd::Zero(size);
  ActiveSet active(limits);
  for (int round = 0; round < 4 * (size + rows) && size > 0; ++round) {
    const Eigen::VectorXd slope = gradient + hessian * out.step;
    const Eigen::MatrixXd free = active.free_directions(size);
    const Eigen::VectorXd reduced = free.transpose() * slope;
    const double left = radius - out.step.norm();
    if (left <= 1e-9 * radius) break;
    const bool flat = reduced.size() == 0 || reduced.norm() <= 1e-10 * (1e-30 + gradient.norm());
    if (flat) {
      if (!active.release(slope)) break;
      continue;
    }
    bool cut = false;
    const Eigen::VectorXd way = free * saddle_free(reduced, free.transpose() * hessian * free, left, cut);
    double share = 1;
    int met = -1;
    const Eigen::VectorXd rate = limits.rows * way, slack = limits.most - limits.rows * (x + out.step);
    for (int i = 0; i < rows; ++i) {
      if (active.has(i) || rate[i] <= 1e-14 * way.norm()) continue;
      const double room = slack[i] <= touching ? 0 : slack[i] / rate[i];
      if (room < share) share = room, met = i;
    }
    out.step += share * way;
    if (out.slope == 0 && share > 0) out.slope = reduced.cwiseAbs().maxCoeff();
    if (met < 0) {
      out.at_edge = cut;
      break;
    }
    active.add(met);
  }
  out.reduction = -(gradient.dot(out.step) + 0.5 * out.step.dot(hessian * out.step));
  return out;
}

}  // namespace tendril::dress_pack
