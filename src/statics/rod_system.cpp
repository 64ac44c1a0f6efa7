#include "statics/rod_system.h"

#include <algorithm>
#include <cmath>

namespace tendril {

void RodState::apply(const std::vector<Vec6>& step, double share) {
  for (std::size_t i = 0; i < r.size(); ++i) {
    r[i] += share * step[i].head<3>();
    const Vec3 theta = share * step[i].tail<3>();
    const double square = theta.squaredNorm();
    // exp by its series where it is exact to rounding, then one Newton step of normalisation: no square root.
    const Quat turn = square < 1e-2
                          ? Quat(1 - square * (1.0 / 8 - square * (1.0 / 384 - square * (1.0 / 46080 - square / 10321920))),
                                 0, 0, 0)
                          : exp_rotation(theta);
    if (square < 1e-2) {
      const double scale = 0.5 - square * (1.0 / 48 - square * (1.0 / 3840 - square * (1.0 / 645120 - square / 185794560)));
      const Quat small(turn.w(), scale * theta.x(), scale * theta.y(), scale * theta.z());
      q[i] = q[i] * small;
    } else {
      q[i] = q[i] * turn;
    }
    q[i].coeffs() *= 1.5 - 0.5 * q[i].squaredNorm();
  }
}

RodSystem::RodSystem(const RodProblem& problem, RodMesh mesh) : problem_(problem), mesh_(std::move(mesh)) {
  double softest = INFINITY;
  for (const RodPart& part : problem.rod.parts)
    softest = std::min({softest, part.section.EI1, part.section.EI2});
  bending_scale_ = softest / (length() * length());
  double stiffest = 0, shortest = length();
  for (const RodPart& part : problem.rod.parts) stiffest = std::max(stiffest, part.section.EA);
  for (const MeshSegment& segment : mesh_.segments) shortest = std::min(shortest, segment.length);
  for (const MeshSegment& segment : mesh_.segments)
    stretch_stiffness_ = std::max(stretch_stiffness_, segment.length * segment.length * segment.section.EA /
                                                          (12 * std::min(segment.section.EI1, segment.section.EI2)));
  const double cells = length() / shortest;
  neutral_shift_ = std::clamp(1e-15 * stiffest / bending_scale_ * cells * cells, 1e-3, 0.1);
}

double RodSystem::assemble(StateView state, Stress stress, BlockView system) {
  const double energy = assemble_elements(state, stress, system);
  return energy + add_loads(state, system.gradient, system.diagonal);
}

double RodSystem::gradient(StateView state, Vec6* gradient) {
  std::fill(gradient, gradient + nodes_, Vec6::Zero());
  const double energy = element_gradient(state, gradient);
  return energy + add_loads(state, gradient, nullptr);
}

double RodSystem::add_loads(StateView state, Vec6* gradient, Mat6* diagonal) const {
  double energy = 0;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    gradient[i].head<3>() -= weight_[i];
    energy -= weight_[i].dot(state.r[i]);
  }
  for (std::size_t i = 0; i < weight_slope_.size(); ++i) {
    if (weight_slope_[i].isZero(0)) continue;
    const Vec3 b = state.q[i].conjugate() * weight_slope_[i];
    energy += b.z();
    gradient[i].tail<3>() += Vec3(-b.y(), b.x(), 0);
    if (!diagonal) continue;
    auto block = diagonal[i].bottomRightCorner<3, 3>();
    block(0, 0) -= b.z();
    block(1, 1) -= b.z();
    block(0, 2) += 0.5 * b.x();
    block(2, 0) += 0.5 * b.x();
    block(1, 2) += 0.5 * b.y();
    block(2, 1) += 0.5 * b.y();
  }
  for (const Force& load : forces_) {
    gradient[load.node].head<3>() -= load.force;
    energy -= load.force.dot(state.r[load.node]);
  }
  for (const Moment& load : moments_)
    gradient[load.node].tail<3>() -= state.q[load.node].conjugate() * load.moment;
  return energy + add_springs(state, gradient, diagonal);
}

void RodSystem::place_springs() {
  for (std::size_t k = 0; k < problem_.springs.size(); ++k) {
    const PoseSpring& spring = problem_.springs[k];
    if (spring.position > 0 || spring.rotation > 0)
      springs_.push_back({section_at(mesh_.spring_vertex[k]), spring.frame, spring.position, spring.rotation});
  }
}

// With M = R*^T R the turning part is rotation (3 - tr M) / 2; a turn by theta changes it by rotation axial(M) . theta, and
// rotation / 2 (tr M I - sym M) is its second derivative.
double RodSystem::add_springs(StateView state, Vec6* gradient, Mat6* diagonal) const {
  for (const Spring& spring : springs_) {
    gradient[spring.nodes.position].head<3>() += spring.position * (state.r[spring.nodes.position] - spring.frame.at);
    const Mat3 turned = (spring.frame.rotation.conjugate() * state.q[spring.nodes.rotation]).toRotationMatrix();
    const Vec3 axial(turned(2, 1) - turned(1, 2), turned(0, 2) - turned(2, 0), turned(1, 0) - turned(0, 1));
    gradient[spring.nodes.rotation].tail<3>() += 0.5 * spring.rotation * axial;
    if (!diagonal) continue;
    diagonal[spring.nodes.position].topLeftCorner<3, 3>() += spring.position * Mat3::Identity();
    const Mat3 symmetric = 0.5 * (turned + turned.transpose());
    diagonal[spring.nodes.rotation].bottomRightCorner<3, 3>() += 0.5 * spring.rotation * (turned.trace() * Mat3::Identity() - symmetric);
  }
  return spring_energy(state);
}

double RodSystem::spring_energy(StateView state) const {
  double energy = 0;
  for (const Spring& spring : springs_) {
    energy += 0.5 * spring.position * (state.r[spring.nodes.position] - spring.frame.at).squaredNorm();
    // 1 - cos phi = 2 |vector part|^2, which keeps its digits where phi is small.
    energy += 2 * spring.rotation * (spring.frame.rotation.conjugate() * state.q[spring.nodes.rotation]).vec().squaredNorm();
  }
  return energy;
}

void RodSystem::describe_loads(StateView state, Energy& energy) const {
  for (std::size_t i = 0; i < weight_.size(); ++i) energy.gravity -= weight_[i].dot(state.r[i]);
  for (std::size_t i = 0; i < weight_slope_.size(); ++i)
    energy.gravity += weight_slope_[i].dot(state.q[i] * Vec3::UnitZ());
  for (const Force& load : forces_) energy.load -= load.force.dot(state.r[load.node]);
  energy.spring += spring_energy(state);
}

void RodSystem::scale_moments(double share) {
  for (Moment& load : moments_) load.moment *= share / moment_share_;
  moment_share_ = share;
}

std::vector<RodSystem::MomentTerm> RodSystem::moment_terms(StateView state) const {
  std::vector<MomentTerm> terms;
  for (const Moment& load : moments_)
    if (!(held_[load.node] & held_rotation))
      terms.push_back({load.node, state.q[load.node].conjugate() * load.moment});
  return terms;
}

}  // namespace tendril
