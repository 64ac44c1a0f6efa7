#include "method/dress_pack/pack_cost.h"

#include <cmath>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril::dress_pack {
namespace {

constexpr double softness = 0.2;  // of the scale

void check(const Demand& demand, const char* what, const char* unit) {
  if (!(demand.limit >= 0))
    throw UsageError(std::string("dress pack: the limit of ") + what + " is " + number_text(demand.limit) + unit + ", expected at least 0");
  if (!(demand.scale > 0) || !std::isfinite(demand.scale))
    throw UsageError(std::string("dress pack: the scale of ") + what + " is " + number_text(demand.scale) + unit + ", expected more than 0");
}

/// d log(Ra^T Rb) = A^T theta_b - A theta_a, theta in the sections' own axes.
Mat3 inverse_left_jacobian_at(const Vec3& phi) {
  const double square = phi.squaredNorm(), angle = std::sqrt(square);
  const double c = square < 1e-4 ? 1.0 / 12 + square / 720 + square * square / 30240
                                 : 1 / square - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  const Mat3 cross = cross_matrix(phi);
  return Mat3::Identity() - 0.5 * cross + c * cross * cross;
}

}  // namespace

void PackDemands::check() const {
  dress_pack::check(force, "force", " N");
  dress_pack::check(twist, "twist", " rad/m");
  dress_pack::check(curvature, "curvature", " 1/m");
  for (const double one : {clearance, robot_clearance})
    if (!std::isfinite(one)) throw UsageError("dress pack: a clearance of " + number_text(one) + " m, expected a finite number");
}

SoftExcess soft_excess(double v, const Demand& demand) {
  if (std::isinf(demand.limit)) return {};
  const double z = (v - demand.limit) / (demand.scale * softness);
  // log(1 + e^z), without overflow.
  const double value = softness * (z > 0 ? z + std::log1p(std::exp(-z)) : std::log1p(std::exp(z)));
  const double share = 1 / (1 + std::exp(-z));
  return {value, 1 / ((1 + std::exp(-z)) * demand.scale), share * (1 - share) / (softness * demand.scale * demand.scale)};
}

PackCost::PackCost(const PackStatics& statics, const PackDemands& demands) : demands_(demands) {
  for (int k = 0; k < statics.network().rods(); ++k) {
    const RodSystem& system = statics.network().rod(k);
    const std::vector<MeshSegment>& cut = system.mesh().segments;
    for (std::size_t i = 0; i < cut.size(); ++i)
      segments_.push_back({statics.network().first_node(k) + static_cast<int>(i), cut[i].length, cut[i].length / system.length(),
                           log_rotation(cut[i].reference.rotation).z() / cut[i].length});
  }
}

double PackCost::value(const PackStatics& statics, const RodState& state) const { return add(statics, state, nullptr, nullptr); }

double PackCost::slopes(const PackStatics& statics, const RodState& state, Eigen::VectorXd& by_load, std::vector<Vec6>& by_node) const {
  by_load.setZero(6 * statics.attachments());
  by_node.assign(statics.network().nodes(), Vec6::Zero());
  return add(statics, state, &by_load, &by_node);
}

double PackCost::add(const PackStatics& statics, const RodState& state, Eigen::VectorXd* by_load, std::vector<Vec6>* by_node) const {
  double sum = 0;
  for (int k = 0; k < statics.attachments(); ++k) {
    if (!(statics.network().held()[statics.node_of(k)] & held_position)) continue;
    const Vec3 force = statics.end_load(k).head<3>();
    const double size = force.norm();
    const SoftExcess s = soft_excess(size, demands_.force);
    sum += 0.5 * s.value * s.value;
    if (by_load && size > 0) by_load->segment<3>(6 * k) += s.value * s.slope / size * force;
  }
  return sum + add_shape(state, by_node);
}

double PackCost::add_shape(const RodState& state, std::vector<Vec6>* by_node) const {
  if (std::isinf(demands_.twist.limit) && std::isinf(demands_.curvature.limit)) return 0;
  double sum = 0;
  for (const Segment& segment : segments_) {
    const Vec3 phi = log_rotation(state.q[segment.node].conjugate() * state.q[segment.node + 1]);
    const double twist = phi.z() / segment.length - segment.rest_twist, bend = std::hypot(phi.x(), phi.y()) / segment.length;
    const SoftExcess t = soft_excess(std::abs(twist), demands_.twist), c = soft_excess(bend, demands_.curvature);
    sum += 0.5 * segment.share * (t.value * t.value + c.value * c.value);
    if (!by_node) continue;
    Vec3 by_phi = Vec3::Zero();
    by_phi.z() = std::copysign(t.value * t.slope, twist) / segment.length;
    if (bend > 0) by_phi.head<2>() = c.value * c.slope / (bend * segment.length * segment.length) * phi.head<2>();
    const Mat3 a = inverse_left_jacobian_at(phi);
    (*by_node)[segment.node + 1].tail<3>() += segment.share * (a * by_phi);
    (*by_node)[segment.node].tail<3>() -= segment.share * (a.transpose() * by_phi);
  }
  return sum;
}

}  // namespace tendril::dress_pack
