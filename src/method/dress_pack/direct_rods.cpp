#include "method/dress_pack/direct_rods.h"

#include <cmath>

#include "statics/se3_packs.h"

namespace tendril::dress_pack {
namespace {

/// (1 - cos t)/t^2, (t - sin t)/t^3 and their derivatives by u = t^2.
struct RateCoefficients {
  double a, b, a1, b1;
  explicit RateCoefficients(double u) {
    if (u < 1e-2) {
      a = 0.5 - u * (1.0 / 24 - u * (1.0 / 720 - u * (1.0 / 40320 - u / 3628800)));
      b = 1.0 / 6 - u * (1.0 / 120 - u * (1.0 / 5040 - u * (1.0 / 362880 - u / 39916800)));
      a1 = -1.0 / 24 + u * (1.0 / 360 - u * (1.0 / 13440 - u / 907200));
      b1 = -1.0 / 120 + u * (1.0 / 2520 - u * (1.0 / 120960 - u / 9979200));
      return;
    }
    const double t = std::sqrt(u), sine = std::sin(t), cosine = std::cos(t);
    a = (1 - cosine) / u;
    b = (t - sine) / (u * t);
    a1 = (0.5 * sine / t - a) / u;
    b1 = (0.5 * (1 - cosine) / u - 1.5 * b) / u;
  }
};

/// d(T(e)^T g)/de for a constant g, its symmetric part: the second derivative of g . increments.
Mat3 rate_curvature(const Vec3& e, const Vec3& g) {
  const RateCoefficients k(e.squaredNorm());
  const Vec3 once = e.cross(g), twice = e.cross(once);
  const Mat3 all = 2 * (k.a1 * once + k.b1 * twice) * e.transpose() +
                   k.b * (e * g.transpose() + e.dot(g) * Mat3::Identity() - 2 * g * e.transpose());
  return 0.5 * (all + all.transpose());
}

Se3Segment<double> one_of(const std::vector<Se3Segment<Pack>>& packs, int i) {
  const Se3Segment<Pack>& from = packs[i / 4];
  const int l = i % 4;
  Se3Segment<double> out{lane(from.h, l), lane(from.q, l), {}, {}, {}, {}};
  const auto take = [l](V3<double>& to, const V3<Pack>& all) { to = {lane(all.x, l), lane(all.y, l), lane(all.z, l)}; };
  take(out.flexibility_v, from.flexibility_v);
  take(out.flexibility_phi, from.flexibility_phi);
  take(out.rate_v, from.rate_v);
  take(out.rate_phi, from.rate_phi);
  take(out.slope_phi, from.slope_phi);
  out.varies = from.varies;
  return out;
}

}  // namespace

Mat3 rotation_rate(const Vec3& e) {
  const RateCoefficients k(e.squaredNorm());
  const Mat3 cross = cross_matrix(e);
  return Mat3::Identity() - k.a * cross + k.b * cross * cross;
}

Mat3 inverse_rotation_rate(const Vec3& e) { return rotation_rate(e).inverse(); }

MixedRods::MixedRods(const PackStatics& statics, const PackDemands& demands)
    : network_(statics.network()), demands_(demands), nodes_(network_.nodes()) {
  for (int r = 0; r < network_.rods(); ++r) {
    const RodMesh& mesh = network_.rod(r).mesh();
    const std::vector<Se3Segment<Pack>> packs = se3_segments(mesh, true);
    for (std::size_t i = 0; i < mesh.segments.size(); ++i) {
      const MeshSegment& cut = mesh.segments[i];
      segments_.push_back({network_.first_node(r) + static_cast<int>(i), r, MixedSegment(one_of(packs, static_cast<int>(i))), cut.length,
                           cut.length / network_.rod(r).length(), log_rotation(cut.reference.rotation).z() / cut.length});
    }
  }
  state_.r.resize(nodes_);
  state_.q.resize(nodes_);
  turned_.resize(nodes_);
}

Eigen::VectorXd MixedRods::numbers_of(const RodState& state) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(size());
  for (int i = 0; i < nodes_; ++i) out.segment<3>(6 * i) = state.r[i];
  for (int k = 0; k < segments(); ++k) {
    const int a = segments_[k].node;
    const SegmentMotion motion(state.r[a], state.q[a], state.r[a + 1], state.q[a + 1]);
    out.segment<6>(wrench_at(k)) = segments_[k].mixed.wrench(motion);
  }
  return out;
}

bool MixedRods::terms(const RodState& reference, const Eigen::Ref<const Eigen::VectorXd>& numbers, Part part, bool second,
                      StepTerms& out) {
  for (int i = 0; i < nodes_; ++i) {
    const Vec3 e = numbers.segment<3>(6 * i + 3);
    if (!(e.norm() < largest_rotation_vector)) return false;
    state_.r[i] = numbers.segment<3>(6 * i);
    state_.q[i] = (reference.q[i] * exp_rotation(e)).normalized();
    turned_[i] = {state_.q[i], e, rotation_rate(e)};
  }
  out.value = 0;
  out.gradient.setZero(size());
  if (second) {
    out.node.assign(nodes_, Mat6::Zero());
    for (auto* list : {&out.link, &out.near, &out.far, &out.wrench}) list->assign(segments(), Mat6::Zero());
  }
  add_segments(numbers, part, second, out);
  if (part == Part::functional) add_loads(second, out);
  to_rotation_vectors(second, out);
  return true;
}

void MixedRods::add_segments(const Eigen::Ref<const Eigen::VectorXd>& numbers, Part part, bool second, StepTerms& out) {
  MixedTerms one;
  if (part == Part::shape && std::isinf(demands_.twist.limit) && std::isinf(demands_.curvature.limit)) return;
  for (int k = 0; k < segments(); ++k) {
    const Segment& segment = segments_[k];
    const int a = segment.node;
    const SegmentMotion motion(state_.r[a], state_.q[a], state_.r[a + 1], state_.q[a + 1]);
    if (part == Part::functional) {
      segment.mixed.terms(motion, numbers.segment<6>(wrench_at(k)), second, one);
      out.gradient.segment<6>(wrench_at(k)) = one.by_wrench;
      if (second) {
        out.near[k] = one.ends_wrench.topRows<6>();
        out.far[k] = one.ends_wrench.bottomRows<6>();
        out.wrench[k] = one.wrench_wrench;
      }
    } else {
      add_shape(segment, motion, second, one);
    }
    out.value += one.value;
    out.gradient.segment<12>(6 * a) += one.by_ends;
    if (!second) continue;
    out.node[a] += one.ends_ends.topLeftCorner<6, 6>();
    out.node[a + 1] += one.ends_ends.bottomRightCorner<6, 6>();
    out.link[k] = one.ends_ends.topRightCorner<6, 6>();
  }
}

void MixedRods::add_shape(const Segment& segment, const SegmentMotion& motion, bool second, MixedTerms& out) const {
  const Vec3 rate = motion.xi().tail<3>() / segment.length;
  const double twist = rate.z() - segment.rest_twist, bend = std::hypot(rate.x(), rate.y());
  const SoftExcess t = soft_excess(std::abs(twist), demands_.twist), c = soft_excess(bend, demands_.curvature);
  out.value = 0.5 * segment.share * (t.value * t.value + c.value * c.value);
  const double scale = segment.share / segment.length;
  Vec6 by_xi = Vec6::Zero();
  by_xi[5] = scale * std::copysign(t.value * t.slope, twist);
  const Eigen::Vector2d way = bend > 0 ? Eigen::Vector2d(rate.head<2>() / bend) : Eigen::Vector2d::Zero();
  by_xi.segment<2>(3) = scale * c.value * c.slope * way;
  out.by_ends = motion.gradient(by_xi);
  if (!second) return;
  Mat6 twice = Mat6::Zero();
  twice(5, 5) = scale / segment.length * (t.slope * t.slope + t.value * t.bend);
  const Eigen::Matrix2d along = way * way.transpose();
  twice.block<2, 2>(3, 3) = scale / segment.length * (c.slope * c.slope + c.value * c.bend) * along;
  if (bend > 0) twice.block<2, 2>(3, 3) += scale / segment.length * c.value * c.slope / bend * (Eigen::Matrix2d::Identity() - along);
  out.ends_ends = motion.hessian(by_xi, twice);
}

void MixedRods::add_loads(bool second, StepTerms& out) {
  load_gradient_.assign(nodes_, Vec6::Zero());
  load_diagonal_.assign(nodes_, Mat6::Zero());
  for (int r = 0; r < network_.rods(); ++r) {
    const int first = network_.first_node(r);
    out.value += network_.rod(r).add_loads(network_.of_rod(r, state_), &load_gradient_[first], &load_diagonal_[first]);
  }
  for (int i = 0; i < nodes_; ++i) {
    out.gradient.segment<6>(6 * i) += load_gradient_[i];
    if (second) out.node[i] += load_diagonal_[i];
  }
}

/// From increments in the sections' axes to rotation vectors.
void MixedRods::to_rotation_vectors(bool second, StepTerms& out) const {
  for (int i = 0; i < nodes_; ++i) {
    const Mat3& rate = turned_[i].rate;
    const Vec3 by_turn = out.gradient.segment<3>(6 * i + 3);
    out.gradient.segment<3>(6 * i + 3) = rate.transpose() * by_turn;
    if (!second) continue;
    out.node[i].bottomRows<3>() = (rate.transpose() * out.node[i].bottomRows<3>()).eval();
    out.node[i].rightCols<3>() = (out.node[i].rightCols<3>() * rate).eval();
    out.node[i].bottomRightCorner<3, 3>() += rate_curvature(turned_[i].e, by_turn);
  }
  if (!second) return;
  for (int k = 0; k < segments(); ++k) {
    const Mat3 a = turned_[segments_[k].node].rate.transpose(), b = turned_[segments_[k].node + 1].rate;
    out.link[k].bottomRows<3>() = (a * out.link[k].bottomRows<3>()).eval();
    out.link[k].rightCols<3>() = (out.link[k].rightCols<3>() * b).eval();
    out.near[k].bottomRows<3>() = (a * out.near[k].bottomRows<3>()).eval();
    out.far[k].bottomRows<3>() = (b.transpose() * out.far[k].bottomRows<3>()).eval();
  }
}

}  // namespace tendril::dress_pack
