#include "statics/joints.h"

#include <algorithm>

namespace tendril {
namespace {

/// The components of `mask` of a vector or of the rows of a matrix; the others become zero.
template <class M>
M rows_of(HeldMask mask, M m) {
  for (int k = 0; k < 6; ++k)
    if (!(mask >> k & 1)) m.row(k).setZero();
  return m;
}

Mat6 columns_of(HeldMask mask, const Mat6& m) { return rows_of<Mat6>(mask, m.transpose()).transpose(); }

constexpr HeldMask others(HeldMask mask) { return static_cast<HeldMask>(held_all & ~mask); }

bool has_lever(const Joints::Joint& joint) { return (joint.part & held_position) && !joint.relative.at.isZero(0); }

}  // namespace

Joints::Joints(std::vector<Joint> joints, BlockPattern& pattern) : joints_(std::move(joints)) {
  if (joints_.empty()) return;
  std::vector<std::vector<int>> at_node(pattern.nodes);
  for (int e = 0; e < static_cast<int>(pattern.edges.size()); ++e)
    if (pattern.edges[e].a >= 0)
      for (const int node : {pattern.edges[e].a, pattern.edges[e].b}) at_node[node].push_back(e);
  auto edge_between = [&](int a, int b) {
    for (const int e : at_node[a])
      if (pattern.edges[e].a == b || pattern.edges[e].b == b) return e;
    pattern.edges.push_back({a, b});
    const int e = static_cast<int>(pattern.edges.size()) - 1;
    at_node[a].push_back(e);
    at_node[b].push_back(e);
    return e;
  };
  for (const Joint& joint : joints_) {
    Plan plan;
    const std::vector<int> incident = at_node[joint.section];
    for (const int e : incident) {
      const BlockPattern::Edge edge = pattern.edges[e];
      const int other = edge.a == joint.section ? edge.b : edge.a;
      Move move{e, other, edge.a == joint.section, -1, false};
      if (other != joint.branch) {
        move.to = edge_between(other, joint.branch);
        move.branch_is_row = pattern.edges[move.to].a == joint.branch;
      }
      plan.moves.push_back(move);
      if (joint.part != held_all) continue;
      pattern.edges[e] = {};  // nothing is left of it
      std::erase(at_node[edge.a], e);
      std::erase(at_node[edge.b], e);
    }
    if (joint.part != held_all) {
      plan.own = edge_between(joint.section, joint.branch);
      plan.own_branch_is_row = pattern.edges[plan.own].a == joint.branch;
    }
    plans_.push_back(std::move(plan));
  }
  force_rates_.resize(joints_.size());
  forces_.resize(joints_.size(), Vec3::Zero());
}

Mat6 Joints::transform(const Joint& joint, StateView state) const {
  Mat6 t = Mat6::Zero();
  t.topLeftCorner<3, 3>().setIdentity();
  t.topRightCorner<3, 3>() = -(state.q[joint.branch].toRotationMatrix() * cross_matrix(joint.relative.at));
  t.bottomRightCorner<3, 3>() = joint.relative.rotation.toRotationMatrix().transpose();
  return rows_of(joint.part, t);
}

/// The term of the second derivative that the force at a lever makes.
void Joints::add_lever(Joint& joint, StateView state, Stress stress, const Vec3& force, BlockSystem& system) {
  joint.geometric_force = stress == Stress::actual ? force : stress == Stress::zero ? Vec3(Vec3::Zero()) : joint.predicted_force;
  const Vec3 f = state.q[joint.branch].conjugate() * joint.geometric_force;
  const Mat3 fg = f * joint.relative.at.transpose();
  system.diagonal[joint.branch].bottomRightCorner<3, 3>() +=
      0.5 * (fg + fg.transpose()) - f.dot(joint.relative.at) * Mat3::Identity();
}

void Joints::join(StateView state, Stress stress, BlockSystem& system) {
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    Joint& joint = joints_[k];
    const Plan& plan = plans_[k];
    const Mat6 t = transform(joint, state);
    Vec6& g = system.gradient[joint.section];
    Mat6& d = system.diagonal[joint.section];
    Mat6& branch = system.diagonal[joint.branch];
    const HeldMask free = others(joint.part);
    const bool lever = has_lever(joint);
    forces_[k] = g.head<3>();
    force_rates_[k].clear();
    if (lever) force_rates_[k].push_back({d.topRows<3>(), joint.section});
    system.gradient[joint.branch] += t.transpose() * g;
    branch += t.transpose() * d * t;
    if (plan.own >= 0) {
      const Mat6 block = rows_of(free, Mat6(d * t));
      Mat6& own = system.upper[plan.own];
      own += plan.own_branch_is_row ? Mat6(block.transpose()) : block;
    }
    for (const Move& move : plan.moves) {
      Mat6& from = system.upper[move.from];
      const Mat6 by_section = move.section_is_row ? from : Mat6(from.transpose());  // rows: section
      const Mat6 block = t.transpose() * by_section;                               // rows: branch point
      if (lever) force_rates_[k].push_back({by_section.topRows<3>(), move.other});
      if (move.to < 0) {
        branch += block + block.transpose();
      } else {
        Mat6& to = system.upper[move.to];
        to += move.branch_is_row ? block : Mat6(block.transpose());
      }
      from = move.section_is_row ? rows_of(free, from) : columns_of(free, from);
    }
    g = rows_of(free, g);
    d = columns_of(free, rows_of(free, d));
    for (int c = 0; c < 6; ++c)
      if (joint.part >> c & 1) d(c, c) = 1;
    if (lever) add_lever(joint, state, stress, forces_[k], system);
  }
}

void Joints::join_gradient(StateView state, std::vector<Vec6>& gradient) const {
  for (const Joint& joint : joints_) {
    gradient[joint.branch] += transform(joint, state).transpose() * gradient[joint.section];
    gradient[joint.section] = rows_of(others(joint.part), gradient[joint.section]);
  }
}

void Joints::complete(StateView state, std::vector<Vec6>& step) const {
  for (const Joint& joint : joints_)
    step[joint.section] = rows_of(others(joint.part), step[joint.section]) + transform(joint, state) * step[joint.branch];
}

void Joints::predict(const std::vector<Vec6>& step) {
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    joints_[k].predicted_force = forces_[k];
    for (const ForceRate& rate : force_rates_[k]) joints_[k].predicted_force += rate.block * step[rate.node];
  }
}

void Joints::put_in_place(RodState& state) const {
  for (const Joint& joint : joints_) {
    const Frame frame = Frame{state.r[joint.branch], state.q[joint.branch]} * joint.relative;
    if (joint.part & held_position) state.r[joint.section] = frame.at;
    if (joint.part & held_rotation) state.q[joint.section] = frame.rotation;
  }
}

}  // namespace tendril
