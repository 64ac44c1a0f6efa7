#include "statics/staggered_system.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace tendril {

StaggeredSystem::StaggeredSystem(const RodProblem& problem, RodMesh mesh, ClampRule rule)
    : RodSystem(problem, std::move(mesh)), rule_(rule) {
  nodes_ = mesh_.vertices() + 1;
  held_.assign(nodes_, 0);
  node_length_.assign(nodes_, 0);
  make_stretches();
  place_holds();
  make_cells();
  place_loads();
}

void StaggeredSystem::make_stretches() {
  const bool heavy = !problem_.gravity.isZero(0) && problem_.rod.mass() > 0;
  if (heavy) weight_.assign(nodes_, Vec3::Zero());
  for (std::size_t j = 0; j < mesh_.segments.size(); ++j) {
    const MeshSegment& from = mesh_.segments[j];
    Stretch stretch;
    stretch.segment.h = from.length;
    stretch.segment.stiffness = {from.section.GA1, from.section.GA2, from.section.EA};
    stretch.segment.reference = from.to_middle.conjugate() * from.reference.at / from.length;
    stretches_.push_back(stretch);
    node_length_[j] += 0.5 * from.length;
    node_length_[j + 1] += 0.5 * from.length;
    if (!heavy) continue;
    const Vec3 half = 0.5 * from.length * from.section.mass * problem_.gravity;
    weight_[j] += half;
    weight_[j + 1] += half;
  }
  node_length_[nodes_ - 1] = node_length_[0];
}

void StaggeredSystem::place_holds() {
  const int last = mesh_.vertices() - 1;
  orientation_hold_.assign(mesh_.vertices(), -1);
  auto take = [&](int node, HeldMask mask, const Frame& frame) {
    held_[node] |= mask;
    targets_.push_back({node, mask, frame});
  };
  held_[nodes_ - 1] |= held_position;  // the last ghost has no place of its own
  for (std::size_t k = 0; k < problem_.holds.size(); ++k) {
    const Hold& hold = problem_.holds[k];
    const int vertex = mesh_.hold_vertex[k];
    if (hold.position) take(vertex, held_position, hold.frame);
    if (!hold.orientation) continue;
    orientation_hold_[vertex] = static_cast<int>(k);
    const bool ghost = rule_ == ClampRule::half_cell;
    if (vertex == 0) take(ghost ? 0 : 1, held_rotation, hold.frame);
    if (vertex == last) take(ghost ? nodes_ - 1 : last, held_rotation, hold.frame);
  }
  if (rule_ == ClampRule::thesis) {
    held_[0] |= held_rotation;
    held_[nodes_ - 1] |= held_rotation;
  }
}

StaggeredSystem::Cell StaggeredSystem::cell_at(int vertex) const {
  const int last = mesh_.vertices() - 1;
  Cell cell;
  cell.a = vertex;
  cell.b = vertex + 1;
  cell.held = Quat::Identity();
  Quat reference = Quat::Identity();
  Vec3 flexibility = Vec3::Zero();
  auto add_half = [&](const MeshSegment& segment) {
    cell.bend.ds += 0.5 * segment.length;
    flexibility += 0.5 * segment.length * Vec3(1 / segment.section.EI1, 1 / segment.section.EI2, 1 / segment.section.GJ);
  };
  if (vertex > 0) {
    const MeshSegment& before = mesh_.segments[vertex - 1];
    reference = before.to_middle.conjugate() * before.reference.rotation;
    add_half(before);
  }
  if (vertex < last) {
    const MeshSegment& after = mesh_.segments[vertex];
    reference = reference * after.to_middle;
    add_half(after);
  }
  cell.bend.stiffness = cell.bend.ds * flexibility.cwiseInverse();
  cell.bend.reference = log_rotation(reference) / cell.bend.ds;
  return cell;
}

void StaggeredSystem::make_cells() {
  const int last = mesh_.vertices() - 1;
  for (int vertex = 0; vertex <= last; ++vertex) {
    const bool end = vertex == 0 || vertex == last;
    if (end && rule_ == ClampRule::thesis) continue;
    Cell cell = cell_at(vertex);
    if (end || orientation_hold_[vertex] < 0) {
      cells_.push_back(cell);
      continue;
    }
    // A held orientation inside the rod: two half cells that meet in the held frame.
    cell.hold = orientation_hold_[vertex];
    cell.held = problem_.holds[cell.hold].frame.rotation;
    const MeshSegment &before = mesh_.segments[vertex - 1], &after = mesh_.segments[vertex];
    Cell left = cell, right = cell;
    left.b = -1;
    right.a = -1;
    left.bend = {0.5 * before.length, {before.section.EI1, before.section.EI2, before.section.GJ}, Vec3::Zero()};
    right.bend = {0.5 * after.length, {after.section.EI1, after.section.EI2, after.section.GJ}, Vec3::Zero()};
    left.bend.reference = log_rotation(before.to_middle.conjugate() * before.reference.rotation) / left.bend.ds;
    right.bend.reference = log_rotation(after.to_middle) / right.bend.ds;
    cells_.push_back(left);
    cells_.push_back(right);
  }
}

void StaggeredSystem::place_loads() {
  const int last = mesh_.vertices() - 1;
  for (std::size_t k = 0; k < problem_.loads.size(); ++k) {
    const PointLoad& load = problem_.loads[k];
    const int vertex = mesh_.load_vertex[k];
    if (!load.force.isZero(0)) forces_.push_back({vertex, load.force});
    if (load.moment.isZero(0)) continue;
    const bool ghost = rule_ == ClampRule::half_cell;
    if (vertex == 0)
      moments_.push_back({ghost ? 0 : 1, load.moment});
    else if (vertex == last)
      moments_.push_back({ghost ? nodes_ - 1 : last, load.moment});
    else
      for (const int node : {vertex, vertex + 1}) moments_.push_back({node, 0.5 * load.moment});
  }
}

void StaggeredSystem::cap_stretch_stiffness(double limit) {
  for (int j = 0; j < segments(); ++j) {
    const Section& section = mesh_.segments[j].section;
    stretches_[j].segment.stiffness = Vec3(section.GA1, section.GA2, section.EA).cwiseMin(limit);
  }
}

RodState StaggeredSystem::state_from(const std::vector<Frame>& vertices) const {
  RodState state;
  state.r.resize(nodes_);
  state.q.resize(nodes_);
  for (int j = 0; j < mesh_.vertices(); ++j) {
    state.r[j] = vertices[j].at;
    state.q[j] = j == 0 ? vertices[0].rotation : vertices[j - 1].rotation.slerp(0.5, vertices[j].rotation);
  }
  state.r[nodes_ - 1] = vertices.back().at;
  state.q[nodes_ - 1] = vertices.back().rotation;
  return state;
}

std::vector<Frame> StaggeredSystem::frames_of(StateView state) const {
  const int last = mesh_.vertices() - 1;
  const bool ghosts = rule_ == ClampRule::half_cell;
  std::vector<Frame> frames(mesh_.vertices());
  for (int j = 0; j <= last; ++j) {
    frames[j].at = state.r[j];
    if (j == 0)
      frames[j].rotation = state.q[ghosts ? 0 : 1];
    else if (j == last)
      frames[j].rotation = state.q[ghosts ? nodes_ - 1 : last];
    else if (orientation_hold_[j] >= 0)
      frames[j].rotation = problem_.holds[orientation_hold_[j]].frame.rotation;
    else
      frames[j].rotation = state.q[j].slerp(0.5, state.q[j + 1]);
  }
  return frames;
}

RodSystem::SectionNodes StaggeredSystem::section_at(int vertex) const {
  const int last = mesh_.vertices() - 1;
  const bool ghosts = rule_ == ClampRule::half_cell;
  if (vertex == 0) return {0, ghosts ? 0 : 1};
  if (vertex == last) return {last, ghosts ? nodes_ - 1 : last};
  throw UsageError("the staggered element joins rods at their ends only; use the se3 element or cut the rod in two");
}

double StaggeredSystem::assemble_elements(StateView state, Stress stress, BlockView system) {
  for (int i = 0; i < nodes_; ++i) {
    system.gradient[i].setZero();
    system.diagonal[i].setZero();
    if (i + 1 < nodes_) system.upper[i].setZero();
  }
  const Vec3 nothing = Vec3::Zero();
  auto geometric = [&](const Vec3& predicted) {
    return stress == Stress::actual ? nullptr : stress == Stress::zero ? &nothing : &predicted;
  };
  double energy = 0;
  for (int j = 0; j < segments(); ++j) {
    Stretch& s = stretches_[j];
    const auto t = s.segment.evaluate(state.r[j + 1] - state.r[j], state.q[j + 1], geometric(s.predicted));
    energy += t.energy;
    s.actual = s.segment.stress(t.strain);
    s.geometric = stress == Stress::actual ? s.actual : stress == Stress::zero ? nothing : s.predicted;
    s.rate_r = t.rate_r;
    s.rate_theta = t.rate_theta;
    system.gradient[j].head<3>() -= t.force;
    system.gradient[j + 1].head<3>() += t.force;
    system.gradient[j + 1].tail<3>() += t.theta;
    system.diagonal[j].topLeftCorner<3, 3>() += t.rr;
    Mat6& d = system.diagonal[j + 1];
    d.topLeftCorner<3, 3>() += t.rr;
    d.topRightCorner<3, 3>() += t.rt;
    d.bottomLeftCorner<3, 3>() += t.rt.transpose();
    d.bottomRightCorner<3, 3>() += t.tt;
    system.upper[j].topLeftCorner<3, 3>() -= t.rr;
    system.upper[j].topRightCorner<3, 3>() -= t.rt;
  }
  for (Cell& c : cells_) {
    const auto t = c.bend.evaluate(rotation_a(c, state), rotation_b(c, state), geometric(c.predicted));
    energy += t.energy;
    c.actual = c.bend.moment(t.curvature);
    c.geometric = stress == Stress::actual ? c.actual : stress == Stress::zero ? nothing : c.predicted;
    c.rate_a = t.rate_a;
    c.rate_b = t.rate_b;
    if (c.a >= 0) {
      system.gradient[c.a].tail<3>() += t.theta_a;
      system.diagonal[c.a].bottomRightCorner<3, 3>() += t.aa;
    }
    if (c.b >= 0) {
      system.gradient[c.b].tail<3>() += t.theta_b;
      system.diagonal[c.b].bottomRightCorner<3, 3>() += t.bb;
    }
    if (c.a >= 0 && c.b >= 0) system.upper[c.a].bottomRightCorner<3, 3>() += t.ab;
  }
  return energy;
}

double StaggeredSystem::element_gradient(StateView state, Vec6* gradient) {
  double energy = 0;
  for (int j = 0; j < segments(); ++j) {
    const auto t = stretches_[j].segment.evaluate(state.r[j + 1] - state.r[j], state.q[j + 1], nullptr);
    energy += t.energy;
    gradient[j].head<3>() -= t.force;
    gradient[j + 1].head<3>() += t.force;
    gradient[j + 1].tail<3>() += t.theta;
  }
  for (const Cell& c : cells_) {
    const auto t = c.bend.evaluate(rotation_a(c, state), rotation_b(c, state), nullptr);
    energy += t.energy;
    if (c.a >= 0) gradient[c.a].tail<3>() += t.theta_a;
    if (c.b >= 0) gradient[c.b].tail<3>() += t.theta_b;
  }
  return energy;
}

void StaggeredSystem::predict(const Vec6* step, double share) {
  auto balanced = [&](const Vec3& actual, const Vec3& change, const Vec3& geometric, const Vec3& turn) {
    return Vec3(exp_rotation(-share * turn) * (actual + change + turn.cross(geometric)));
  };
  for (int j = 0; j < segments(); ++j) {
    Stretch& s = stretches_[j];
    const Vec3 move = step[j + 1].head<3>() - step[j].head<3>(), turn = step[j + 1].tail<3>();
    s.predicted = balanced(s.actual, s.rate_r * move + s.rate_theta * turn, s.geometric, turn);
  }
  for (Cell& c : cells_) {
    const Vec3 ta = c.a < 0 ? Vec3(Vec3::Zero()) : Vec3(step[c.a].tail<3>());
    const Vec3 tb = c.b < 0 ? Vec3(Vec3::Zero()) : Vec3(step[c.b].tail<3>());
    c.predicted = balanced(c.actual, c.rate_a * ta + c.rate_b * tb, c.geometric, 0.5 * (ta + tb));
  }
}

void StaggeredSystem::describe(StateView state, Equilibrium& out) {
  const int n = segments();
  out.forces.resize(n);
  out.strains.resize(n);
  out.curvatures.assign(n, Vec3::Zero());
  out.curvature_changes.assign(n, Vec3::Zero());
  out.moments.assign(n, Vec3::Zero());
  for (int j = 0; j < n; ++j) {
    const StretchSegment& s = stretches_[j].segment;
    const auto t = s.evaluate(state.r[j + 1] - state.r[j], state.q[j + 1], nullptr);
    out.forces[j] = t.force;
    out.strains[j] = t.strain;
    const Vec3 parts = 0.5 * s.h * t.strain.cwiseAbs2().cwiseProduct(s.stiffness);
    out.energy.shear += parts.x() + parts.y();
    out.energy.stretch += parts.z();
  }
  // A segment's curvature is the mean of those at its two ends; at an end without a cell, that of the other.
  std::vector<int> seen(n, 0);
  for (const Cell& c : cells_) {
    const auto t = c.bend.evaluate(rotation_a(c, state), rotation_b(c, state), nullptr);
    const Vec3 change = t.curvature - c.bend.reference;
    const Vec3 parts = 0.5 * c.bend.ds * change.cwiseAbs2().cwiseProduct(c.bend.stiffness);
    out.energy.bend += parts.x() + parts.y();
    out.energy.twist += parts.z();
    for (const int node : {c.a, c.b}) {
      const int segment = node - 1;
      if (segment < 0 || segment >= n) continue;
      ++seen[segment];
      out.curvatures[segment] += t.curvature;
      out.curvature_changes[segment] += change;
      out.moments[segment] += c.bend.moment(t.curvature);
    }
  }
  for (int j = 0; j < n; ++j) {
    if (seen[j] == 0) continue;
    out.curvatures[j] /= seen[j];
    out.curvature_changes[j] /= seen[j];
    out.moments[j] /= seen[j];
  }
  describe_loads(state, out.energy);
}

void StaggeredSystem::add_reaction(int hold, StateView state, const Vec6* gradient, Reaction& out) const {
  const Hold& held = problem_.holds[hold];
  const int vertex = mesh_.hold_vertex[hold], last = mesh_.vertices() - 1;
  if (held.position) out.force += gradient[vertex].head<3>();
  if (!held.orientation) return;
  const bool ghosts = rule_ == ClampRule::half_cell;
  if (vertex == 0 || vertex == last) {
    const int node = vertex == 0 ? (ghosts ? 0 : 1) : (ghosts ? nodes_ - 1 : last);
    out.moment += state.q[node] * Vec3(gradient[node].tail<3>());
    return;
  }
  for (const Cell& c : cells_) {
    if (c.hold != hold) continue;
    const auto t = c.bend.evaluate(rotation_a(c, state), rotation_b(c, state), nullptr);
    out.moment += c.held * (c.a < 0 ? t.theta_a : t.theta_b);
  }
}

}  // namespace tendril
