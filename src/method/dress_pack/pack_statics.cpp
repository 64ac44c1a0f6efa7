#include "method/dress_pack/pack_statics.h"

#include <cmath>

#include "base/error.h"

namespace tendril::dress_pack {
namespace {

constexpr int most_iterations = 12;
constexpr double largest_correction = 0.2;  // rad, and share of the length: beyond it the step was too long
constexpr double rough_stress = 1;          // see Newton: a false stress above this must stay out of the fourth-order terms
constexpr double rounding_step = 1e-6;      // steps below this that shrink no more are rounding

std::unique_ptr<RodNetwork> network_of(const PackProblem& pack) {
  if (pack.slides())
    throw UsageError("dress pack: a rod slides through a hold, which paths can be simulated with but not optimised; expected holds that grip");
  std::vector<int> segments;
  for (const RodProblem& rod : pack.rods) segments.push_back(rod.rod.segments);
  return std::make_unique<RodNetwork>(SystemProblem{pack.rods, {}}, SolveOptions{}, segments);
}

}  // namespace

PackStatics::PackStatics(const PackProblem& pack) : pack_(pack), network_(network_of(pack)), ldlt_(network_->pattern()) {
  for (const Attachment& a : pack.attachments)
    nodes_.push_back(network_->first_node(a.rod) + network_->rod(a.rod).mesh().hold_vertex[a.hold]);
  for (int i = 0; i < network_->nodes(); ++i)
    if (network_->held()[i]) held_nodes_.push_back(i);
  rows_.resize(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    int side = 0;
    for (const BlockPattern::Edge& edge : network_->pattern().edges)
      if (edge.a >= 0 && (edge.a == nodes_[k] || edge.b == nodes_[k])) rows_[k].node[side++] = edge.a == nodes_[k] ? edge.b : edge.a;
  }
}

RodState state_of(const SystemEquilibrium& equilibrium) {
  RodState state;
  for (const Equilibrium& rod : equilibrium.rods) {
    state.r.insert(state.r.end(), rod.points.begin(), rod.points.end());
    state.q.insert(state.q.end(), rod.rotations.begin(), rod.rotations.end());
  }
  return state;
}

SystemEquilibrium PackStatics::describe(const RodState& state) {
  SystemEquilibrium out;
  out.rods.resize(network_->rods());
  std::vector<Vec6> gradient;
  network_->gradient(state, gradient);
  double residual = 0;
  for (int i = 0; i < network_->nodes(); ++i)
    for (int c = 0; c < 6; ++c)
      if (!(network_->held()[i] >> c & 1)) residual = std::max(residual, std::abs(gradient[i][c]) / (c < 3 ? 1 : network_->size()));
  for (int k = 0; k < network_->rods(); ++k) {
    RodSystem& system = network_->rod(k);
    Equilibrium& rod = out.rods[k];
    const StateView own = network_->of_rod(k, state);
    rod.s = system.mesh().s;
    for (const Frame& frame : system.frames_of(own)) {
      rod.points.push_back(frame.at);
      rod.rotations.push_back(frame.rotation);
    }
    for (const MeshSegment& segment : system.mesh().segments) rod.radii.push_back(segment.section.radius());
    system.describe(own, rod);
    rod.reactions.resize(system.problem().holds.size());
    for (std::size_t h = 0; h < rod.reactions.size(); ++h) {
      rod.reactions[h].s = system.problem().holds[h].at;
      system.add_reaction(static_cast<int>(h), own, gradient.data() + network_->first_node(k), rod.reactions[h]);
    }
    rod.residual = residual;
  }
  return out;
}

bool PackStatics::stand_at(const RodState& state) {
  network_->assemble(state, Stress::actual, block_);
  gradient_ = block_.gradient;
  collect_rows();
  return clear_and_factor() == 0 && !ldlt_.broken();
}

void PackStatics::collect_rows() {
  const auto& edges = network_->pattern().edges;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    Row& row = rows_[k];
    const int node = nodes_[k];
    row.diagonal = block_.diagonal[node];
    row.diagonal.bottomRightCorner<3, 3>() += 0.5 * cross_matrix(gradient_[node].tail<3>());
    int side = 0;
    // Edges within a rod join neighbours: edge i is that of nodes i and i + 1.
    if (node > 0 && edges[node - 1].a >= 0) row.block[side++] = block_.upper[node - 1].transpose();
    if (node < static_cast<int>(edges.size()) && edges[node].a >= 0) row.block[side++] = block_.upper[node];
  }
}

/// Held rows and columns become those of the unit matrix. Returns the number of pivots that are not positive.
int PackStatics::clear_and_factor() {
  const auto& edges = network_->pattern().edges;
  for (const int node : held_nodes_)
    for (int k = 0; k < 6; ++k) {
      if (!(network_->held()[node] >> k & 1)) continue;
      block_.gradient[node][k] = 0;
      block_.diagonal[node].row(k).setZero();
      block_.diagonal[node].col(k).setZero();
      block_.diagonal[node](k, k) = 1;
      if (node > 0 && edges[node - 1].a >= 0) block_.upper[node - 1].col(k).setZero();
      if (node < static_cast<int>(edges.size()) && edges[node].a >= 0) block_.upper[node].row(k).setZero();
    }
  return ldlt_.factor(block_);
}

void PackStatics::zero_held(std::vector<Vec6>& x) const {
  for (const int node : held_nodes_)
    for (int k = 0; k < 6; ++k)
      if (network_->held()[node] >> k & 1) x[node][k] = 0;
}

void PackStatics::respond(const Eigen::VectorXd& c, std::vector<Vec6>& step) const {
  step.assign(network_->nodes(), Vec6::Zero());
  std::vector<Vec6> held(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    for (int i = 0; i < 6; ++i) held[k][i] = network_->held()[nodes_[k]] >> i & 1 ? c[6 * static_cast<int>(k) + i] : 0;
    const Row& row = rows_[k];
    // The symmetric part: the cross matrix of the moment belongs to held rotations alone, which are taken out.
    step[nodes_[k]] -= row.diagonal.transpose() * held[k];
    for (int side = 0; side < 2; ++side)
      if (row.node[side] >= 0) step[row.node[side]] -= row.block[side].transpose() * held[k];
  }
  zero_held(step);
  ldlt_.solve(step);
  for (std::size_t k = 0; k < nodes_.size(); ++k) step[nodes_[k]] += held[k];
}

Eigen::VectorXd PackStatics::load_change(const std::vector<Vec6>& step) const {
  Eigen::VectorXd out(6 * static_cast<int>(nodes_.size()));
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    Vec6 sum = rows_[k].diagonal * step[nodes_[k]];
    for (int side = 0; side < 2; ++side)
      if (rows_[k].node[side] >= 0) sum += rows_[k].block[side] * step[rows_[k].node[side]];
    out.segment<6>(6 * static_cast<int>(k)) = sum;
  }
  return out;
}

Eigen::VectorXd PackStatics::pull_back(const Eigen::VectorXd& by_load, std::vector<Vec6> by_node) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Vec6 weight = by_load.segment<6>(6 * static_cast<int>(k));
    by_node[nodes_[k]] += rows_[k].diagonal.transpose() * weight;
    for (int side = 0; side < 2; ++side)
      if (rows_[k].node[side] >= 0) by_node[rows_[k].node[side]] += rows_[k].block[side].transpose() * weight;
  }
  std::vector<Vec6> mu = by_node;
  zero_held(mu);
  ldlt_.solve(mu);
  Eigen::VectorXd out(6 * static_cast<int>(nodes_.size()));
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    Vec6 sum = by_node[nodes_[k]] - rows_[k].diagonal * mu[nodes_[k]];
    for (int side = 0; side < 2; ++side)
      if (rows_[k].node[side] >= 0) sum -= rows_[k].block[side] * mu[rows_[k].node[side]];
    for (int i = 0; i < 6; ++i) out[6 * static_cast<int>(k) + i] = network_->held()[nodes_[k]] >> i & 1 ? sum[i] : 0;
  }
  return out;
}

Vec6 PackStatics::increment(int attachment, const RodState& state, const Frame& pose) const {
  const int node = nodes_[attachment];
  return (Vec6() << pose.at - state.r[node], log_rotation(state.q[node].conjugate() * pose.rotation)).finished();
}

void PackStatics::place(const std::vector<Frame>& poses, RodState& state) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const HeldMask held = network_->held()[nodes_[k]];
    if (held & held_position) state.r[nodes_[k]] = poses[k].at;
    if (!(held & held_rotation)) continue;
    // A frame and its opposite are one rotation: the state keeps its side.
    const bool same = state.q[nodes_[k]].dot(poses[k].rotation) >= 0;
    state.q[nodes_[k]].coeffs() = same ? poses[k].rotation.coeffs() : Eigen::Vector4d(-poses[k].rotation.coeffs());
  }
}

PackStatics::Moved PackStatics::move(RodState& state, const std::vector<Frame>& poses, double tolerance) {
  Moved out;
  ++out.iterations;
  if (!stand_at(state)) return out;
  Eigen::VectorXd c(6 * attachments());
  for (int k = 0; k < attachments(); ++k) c.segment<6>(6 * k) = increment(k, state, poses[k]);
  std::vector<Vec6> step;
  respond(c, step);
  out.predicted = network_->size_of(step);
  if (!std::isfinite(out.predicted)) return out;
  RodState trial = state;
  network_->predict(step, 1);
  network_->apply(trial, step, 1);
  place(poses, trial);
  if (!correct(trial, tolerance, out)) return out;
  state = std::move(trial);
  out.ok = true;
  return out;
}

bool PackStatics::correct(RodState& state, double tolerance, Moved& out) {
  double before = INFINITY;
  for (int round = 0; round < most_iterations; ++round) {
    bool exact = true;
    network_->assemble(state, Stress::predicted, block_);
    if (network_->false_stress() > rough_stress) {
      network_->assemble(state, Stress::rough, block_);
      exact = false;
    }
    ++out.iterations;
    const bool positive = clear_and_factor() == 0;
    if (ldlt_.broken()) return false;
    ldlt_.newton_step(step_);
    const double size = network_->size_of(step_);
    if (!std::isfinite(size) || size > largest_correction) return false;
    network_->predict(step_, 1);
    network_->apply(state, step_, 1);
    out.corrected += size;
    // As in Newton::settled(): convergence is quadratic but for the predicted wrench, right to first order in the step before.
    const double left = before < 0.1 ? 10 * size * size * size / (before * before) + 0.3 * size * before : size;
    const bool at_rounding = size < rounding_step && size > 0.5 * before;
    if (exact && (std::min(size, left) < tolerance || at_rounding)) return positive;
    before = size;
  }
  return false;
}

}  // namespace tendril::dress_pack
