#include "statics/sensitivity.h"

#include <Eigen/LU>
#include <string>

#include "base/error.h"

namespace tendril {

Sensitivity::Sensitivity(RodNetwork& network, const RodState& state, ContactNetwork* contacts)
    : network_(network), contacts_(contacts), ldlt_(network.pattern()) {
  for (int k = 0; k < network.rods(); ++k) {
    rods_.emplace_back(network.rod(k));
    breaks_.push_back(break_vertices(network.rod(k)));
    parts_.push_back(segment_parts(network.rod(k)));
  }
  stand_at(state);
}

void Sensitivity::stand_at(const RodState& state) {
  state_ = state;
  for (int k = 0; k < network_.rods(); ++k) rods_[k].stand_at({state_, network_.first_node(k)});
  network_.assemble(state_, Stress::actual, block_);
  if (contacts_) {
    contacts_->stand_at(state_);
    for (const ContactNetwork::Rod& rod : contacts_->rods()) rod.terms->add_to(state_, true, block_);
  }
  gradient_ = block_.gradient;
  if (!network_.problem().branches.empty()) unjoined_ = block_;
  network_.join(state_, Stress::actual, block_);
  joined_gradient_ = block_.gradient;
  keep_held_rows();
  take_out_held();
  ldlt_.factor(block_);
  ok_ = !ldlt_.broken();
  prepare_moments();
}

void Sensitivity::keep_held_rows() {
  held_rows_.clear();
  std::vector<char> done(network_.nodes(), 0);
  for (std::size_t k = 0; k < network_.targets().size(); ++k) {
    const int node = network_.targets()[k].node;
    if (done[node]++) continue;
    held_rows_.push_back({node, node, block_.diagonal[node]});
    for (const int e : network_.edges_at(static_cast<int>(k))) {
      const BlockPattern::Edge edge = network_.pattern().edges[e];
      if (edge.a == node)
        held_rows_.push_back({node, edge.b, block_.upper[e]});
      else
        held_rows_.push_back({node, edge.a, block_.upper[e].transpose()});
    }
  }
}

/// Held rows and columns become those of the unit matrix.
void Sensitivity::take_out_held() {
  auto clear = [&](int node, const std::vector<int>& edges) {
    for (int k = 0; k < 6; ++k) {
      if (!(network_.held()[node] >> k & 1)) continue;
      block_.diagonal[node].row(k).setZero();
      block_.diagonal[node].col(k).setZero();
      block_.diagonal[node](k, k) = 1;
      for (const int e : edges)
        if (network_.pattern().edges[e].a == node)
          block_.upper[e].row(k).setZero();
        else
          block_.upper[e].col(k).setZero();
    }
  };
  for (std::size_t k = 0; k < network_.targets().size(); ++k)
    clear(network_.targets()[k].node, network_.edges_at(static_cast<int>(k)));
  for (const int node : network_.dummies()) clear(node, {});
}

void Sensitivity::clear_held(std::vector<Vec6>& x) const {
  for (int i = 0; i < network_.nodes(); ++i)
    for (int k = 0; k < 6; ++k)
      if (network_.held()[i] >> k & 1) x[i][k] = 0;
}

/// K = S + U A U^T with A = -[b]/2 at every dead moment b = R^T m: the moment's own rate, -[b], and half of the elastic
/// gradient's, which equals b and which the symmetric second derivative leaves out. K^-1 x = y - Z (I + A Z_u)^-1 A y_u
/// with y = S^-1 x, Z = S^-1 U, and A^T for the transposed matrix.
void Sensitivity::prepare_moments() {
  moments_.clear();
  if (!ok_) return;
  for (const RodSystem::MomentTerm& term : network_.moment_terms(state_))
    moments_.push_back({term.node, -0.5 * cross_matrix(term.body_moment)});
  const int m = 3 * static_cast<int>(moments_.size());
  if (m == 0) return;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(m, m), zu(m, m);
  moment_columns_.assign(m, std::vector<Vec6>(network_.nodes(), Vec6::Zero()));
  for (int k = 0; k < m; ++k) {
    moment_columns_[k][moments_[k / 3].node][3 + k % 3] = 1;
    ldlt_.solve(moment_columns_[k]);
    for (int i = 0; i < m; ++i) zu(i, k) = moment_columns_[k][moments_[i / 3].node][3 + i % 3];
  }
  for (int k = 0; k < m / 3; ++k) a.block<3, 3>(3 * k, 3 * k) = moments_[k].block;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(m, m), at = a.transpose();
  moment_forward_ = (one + a * zu).partialPivLu().solve(a);
  moment_backward_ = (one + at * zu).partialPivLu().solve(at);
}

void Sensitivity::solve(std::vector<Vec6>& x, bool transposed) const {
  ldlt_.solve(x);
  if (moments_.empty()) return;
  const int m = 3 * static_cast<int>(moments_.size());
  Eigen::VectorXd xu(m);
  for (int k = 0; k < m; ++k) xu[k] = x[moments_[k / 3].node][3 + k % 3];
  const Eigen::VectorXd c = (transposed ? moment_backward_ : moment_forward_) * xu;
  for (int k = 0; k < m; ++k)
    for (int i = 0; i < network_.nodes(); ++i) x[i] -= c[k] * moment_columns_[k][i];
}

/// Joined matrix times x at the nodes with held unknowns; zero elsewhere.
std::vector<Vec6> Sensitivity::rows_times(const std::vector<Vec6>& x) const {
  std::vector<Vec6> out(network_.nodes(), Vec6::Zero());
  for (const HeldRow& row : held_rows_) out[row.node] += row.block * x[row.other];
  return out;
}

/// A row of the matrix before it was joined, times x; `node` lies in a rod.
Vec6 Sensitivity::section_row_times(int node, const std::vector<Vec6>& x) const {
  int k = 0;
  while (k + 1 < network_.rods() && network_.first_node(k + 1) <= node) ++k;
  const int first = network_.first_node(k), last = first + network_.rod(k).nodes() - 1;
  Vec6 sum = unjoined_.diagonal[node] * x[node];
  if (node > first) sum += unjoined_.upper[node - 1].transpose() * x[node - 1];
  if (node < last) sum += unjoined_.upper[node] * x[node + 1];
  return sum;
}

bool Sensitivity::in_same_rod(int a, int b) const {
  for (int k = 0; k < network_.rods(); ++k) {
    const int first = network_.first_node(k), end = first + network_.rod(k).nodes();
    if (b >= first && b < end) return a >= first && a < end;
  }
  return false;
}

/// The dead moment on a section, in its own axes.
Vec3 Sensitivity::moment_on(int section) const {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < network_.rods(); ++k) {
    const RodSystem& system = network_.rod(k);
    const std::vector<PointLoad>& loads = system.problem().loads;
    for (std::size_t i = 0; i < loads.size(); ++i)
      if (network_.first_node(k) + system.mesh().load_vertex[i] == section) sum += loads[i].moment;
  }
  return state_.q[section].conjugate() * sum;
}

VertexShape Sensitivity::shape_of(int rod) const {
  const std::size_t first = network_.first_node(rod), count = network_.rod(rod).mesh().s.size();
  return {std::span(state_.r).subspan(first, count), std::span(state_.q).subspan(first, count)};
}

MeasureSlopes Sensitivity::measure(const Measure& measure) const {
  return slopes_of(measure, network_, rods_, state_, joined_gradient_);
}

}  // namespace tendril
