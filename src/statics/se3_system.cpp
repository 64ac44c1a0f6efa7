#include "statics/se3_system.h"

#include <algorithm>
#include <cmath>

#include "statics/se3_packs.h"

namespace tendril {
namespace {

/// Sets or adds a 3x3 block of one lane in a column-major 6x6 matrix.
enum class Put { set, set_minus, add, add_minus };
template <int row, int column, Put put, bool transpose = false>
inline void block(double* to, const M3<Pack>& m, int i) {
#pragma GCC unroll 3
  for (int r = 0; r < 3; ++r)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      double& entry = to[row + r + 6 * (column + c)];
      const double value = lane(transpose ? m(c, r) : m(r, c), i);
      if constexpr (put == Put::set) entry = value;
      if constexpr (put == Put::set_minus) entry = -value;
      if constexpr (put == Put::add) entry += value;
      if constexpr (put == Put::add_minus) entry -= value;
    }
}

}  // namespace

Se3System::Se3System(const RodProblem& problem, RodMesh mesh, bool fourth_order)
    : RodSystem(problem, std::move(mesh)), fourth_order_(fourth_order) {
  nodes_ = mesh_.vertices();
  const int segments = nodes_ - 1;
  held_.assign(nodes_, 0);
  node_length_.assign(nodes_, 0);
  for (std::size_t k = 0; k < problem_.holds.size(); ++k) {
    const Hold& hold = problem_.holds[k];
    const int mask = (hold.position ? held_position : 0) | (hold.orientation ? held_rotation : 0);
    held_[mesh_.hold_vertex[k]] |= mask;
    targets_.push_back({mesh_.hold_vertex[k], static_cast<HeldMask>(mask), hold.frame});
  }
  for (std::size_t k = 0; k < problem_.loads.size(); ++k) {
    const int node = mesh_.load_vertex[k];
    if (!problem_.loads[k].force.isZero(0)) forces_.push_back({node, problem_.loads[k].force});
    if (!problem_.loads[k].moment.isZero(0)) moments_.push_back({node, problem_.loads[k].moment});
  }
  const bool heavy = !problem_.gravity.isZero(0) && problem_.rod.mass() > 0;
  if (heavy) {
    weight_.assign(nodes_, Vec3::Zero());
    if (fourth_order) weight_slope_.assign(nodes_, Vec3::Zero());
  }
  segments_ = se3_segments(mesh_, fourth_order);
  for (int i = 0; i < segments; ++i) {
    const MeshSegment& from = mesh_.segments[i];
    const double h = from.length;
    node_length_[i] += 0.5 * h;
    node_length_[i + 1] += 0.5 * h;
    if (!heavy) continue;
    const Vec3 w = from.section.mass * problem_.gravity;
    weight_[i] += 0.5 * h * w;
    weight_[i + 1] += 0.5 * h * w;
    if (!fourth_order) continue;
    weight_slope_[i] -= h * h / 12 * w;
    weight_slope_[i + 1] += h * h / 12 * w;
  }
  if (heavy && fourth_order) {
    // Between equal segments the terms of both sides cancel up to rounding; clear them so that they cost nothing.
    for (int i = 1; i < segments; ++i)
      if (weight_slope_[i].norm() < 1e-12 * weight_slope_[0].norm()) weight_slope_[i].setZero();
  }
  actual_.resize(packs());
  predicted_.resize(packs());
  geometric_.resize(packs());
  rates_.resize(packs());
}

double Se3System::false_stress() const {
  if (!fourth_order_) return 0;
  double largest = 0;
  for (int p = 0; p < packs(); ++p) {
    const V3<Pack> off = actual_[p].n - predicted_[p].n;
    const Pack scale = segments_[p].h * segments_[p].h * segments_[p].flexibility_phi.x * (1.0 / 12);
    largest = std::max(largest, largest_lane(scale * scale * dot(off, off)));
  }
  return std::sqrt(largest);
}

void Se3System::expect(StateView state, const std::vector<Vec3>& forces, const std::vector<Vec3>& moments) {
  for (int i = 0; i + 1 < nodes_; ++i) {
    const Quat middle = state.q[i].slerp(0.5, state.q[i + 1]);
    put(predicted_[i / 4].n, middle.conjugate() * forces[i], i % 4);
    put(predicted_[i / 4].m, moments[i], i % 4);
  }
}

void Se3System::cap_stretch_stiffness(double limit) {
  for (int i = 0; i < 4 * packs(); ++i) {
    const Section& section = mesh_.segments[std::min(i, nodes_ - 2)].section;
    put(segments_[i / 4].flexibility_v,
        Vec3(1 / std::min(limit, section.GA1), 1 / std::min(limit, section.GA2), 1 / std::min(limit, section.EA)), i % 4);
  }
}

RodState Se3System::state_from(const std::vector<Frame>& vertices) const {
  RodState state;
  state.r.reserve(nodes_);
  state.q.reserve(nodes_);
  for (const Frame& frame : vertices) {
    state.r.push_back(frame.at);
    state.q.push_back(frame.rotation);
  }
  return state;
}

std::vector<Frame> Se3System::frames_of(StateView state) const {
  std::vector<Frame> frames(nodes_);
  for (int i = 0; i < nodes_; ++i) frames[i] = {state.r[i], state.q[i]};
  return frames;
}

Se3Ends<Pack> Se3System::ends(StateView state, int pack) const { return se3_ends(state, nodes_ - 1, pack); }

double Se3System::assemble_elements(StateView state, Stress stress, BlockView system) {
  // Each segment sets the blocks of its far end and adds to those of its near end; only the first is cleared.
  system.gradient[0].setZero();
  system.diagonal[0].setZero();
  const Wrench<Pack> nothing{};
  double energy = 0;
  for (int p = 0; p < packs(); ++p) {
    const Wrench<Pack>* w =
        stress == Stress::zero ? &nothing : stress == Stress::actual ? nullptr : &predicted_[p];
    const bool corrected = fourth_order_ && (stress == Stress::predicted || stress == Stress::actual);
    const Pack q = segments_[p].h * segments_[p].h * (1.0 / 12);
    segments_[p].q = corrected ? q : Pack{};
    SegmentHessian<Pack> h;
    const bool deferred = fourth_order_ && stress == Stress::deferred;
    const SegmentGradient<Pack> g =
        se3_element(segments_[p], ends(state, p), w, h, rates_[p], deferred ? &q : nullptr);
    actual_[p] = g.wrench;
    geometric_[p] = w ? *w : g.wrench;
    for (int l = 0; l < lanes_in(p); ++l) {
      const int a = 4 * p + l, b = a + 1;
      energy += lane(g.energy, l);
      const Vec3 f = get(g.force, l);
      system.gradient[a].head<3>() -= f;
      system.gradient[a].tail<3>() += get(g.theta_a, l);
      system.gradient[b].head<3>() = f;
      system.gradient[b].tail<3>() = get(g.theta_b, l);
      double* da = system.diagonal[a].data();
      double* db = system.diagonal[b].data();
      double* u = system.upper[a].data();
      block<0, 0, Put::add>(da, h.dd, l);
      block<0, 3, Put::add_minus>(da, h.da, l);
      block<3, 0, Put::add_minus, true>(da, h.da, l);
      block<3, 3, Put::add>(da, h.aa, l);
      block<0, 0, Put::set>(db, h.dd, l);
      block<0, 3, Put::set>(db, h.db, l);
      block<3, 0, Put::set, true>(db, h.db, l);
      block<3, 3, Put::set>(db, h.bb, l);
      block<0, 0, Put::set_minus>(u, h.dd, l);
      block<0, 3, Put::set_minus>(u, h.db, l);
      block<3, 0, Put::set, true>(u, h.da, l);
      block<3, 3, Put::set>(u, h.ab, l);
    }
  }
  return energy;
}

double Se3System::element_gradient(StateView state, Vec6* gradient) {
  double energy = 0;
  for (int p = 0; p < packs(); ++p) {
    const SegmentGradient<Pack> g = se3_gradient(segments_[p], ends(state, p));
    for (int l = 0; l < lanes_in(p); ++l) {
      const int a = 4 * p + l, b = a + 1;
      energy += lane(g.energy, l);
      const Vec3 f = get(g.force, l);
      gradient[a].head<3>() -= f;
      gradient[b].head<3>() += f;
      gradient[a].tail<3>() += get(g.theta_a, l);
      gradient[b].tail<3>() += get(g.theta_b, l);
    }
  }
  return energy;
}

void Se3System::predict(const Vec6* step, double share) {
  const Pack half = filled<Pack>(0.5), turned = filled<Pack>(share);
  for (int p = 0; p < packs(); ++p) {
    V3<Pack> dr{}, ta{}, tb{};
    for (int l = 0; l < lanes_in(p); ++l) {
      const Vec6 &a = step[4 * p + l], &b = step[4 * p + l + 1];
      put(dr, b.head<3>() - a.head<3>(), l);
      put(ta, a.tail<3>(), l);
      put(tb, b.tail<3>(), l);
    }
    const Wrench<Pack> change = rates_[p].change(dr, ta, tb);
    const V3<Pack> turn = half * (ta + tb), back = turned * turn;
    predicted_[p] = {turned_back(back, actual_[p].n + change.n + cross(turn, geometric_[p].n)),
                     turned_back(back, actual_[p].m + change.m + cross(turn, geometric_[p].m))};
  }
}

void Se3System::describe(StateView state, Equilibrium& out) {
  const int segments = nodes_ - 1;
  out.forces.resize(segments);
  out.strains.resize(segments);
  out.curvatures.resize(segments);
  out.curvature_changes.resize(segments);
  out.moments.resize(segments);
  for (int p = 0; p < packs(); ++p) {
    const Se3Segment<Pack>& s = segments_[p];
    const Se3Ends<Pack> e = ends(state, p);
    const detail::Se3Strain<Pack> x(s, e);
    const SegmentGradient<Pack> g = se3_gradient(s, e);
    Wrench<Pack> u;
    const Wrench<Pack> strained = strained_by(s, g.wrench);
    detail::force_on_xi(s, s.q, x, strained, u);
    for (int l = 0; l < lanes_in(p); ++l) {
      const int i = 4 * p + l;
      const Section& section = mesh_.segments[i].section;
      const double h = mesh_.segments[i].length;
      const double q = lane(s.q, l);
      const Vec3 n = get(strained.n, l), m = get(strained.m, l), un = get(u.n, l), um = get(u.m, l);
      const Vec3 kv(section.GA1, section.GA2, section.EA), kp(section.EI1, section.EI2, section.GJ);
      out.forces[i] = get(g.force, l);
      out.moments[i] = m;
      out.strains[i] = n.cwiseQuotient(kv);
      out.curvature_changes[i] = m.cwiseQuotient(kp);
      out.curvatures[i] = out.curvature_changes[i] + get(s.rate_phi, l);
      // Mid-segment strain and its variation along the segment, both by component.
      const Vec3 stretch = 0.5 * h * (n.cwiseAbs2().cwiseQuotient(kv) + q * un.cwiseAbs2().cwiseProduct(kv));
      const Vec3 turn = 0.5 * h * (m.cwiseAbs2().cwiseQuotient(kp) + q * um.cwiseAbs2().cwiseProduct(kp));
      out.energy.shear += stretch.x() + stretch.y();
      out.energy.stretch += stretch.z();
      out.energy.bend += turn.x() + turn.y();
      out.energy.twist += turn.z();
    }
  }
  describe_loads(state, out.energy);
}

void Se3System::add_reaction(int hold, StateView state, const Vec6* gradient, Reaction& out) const {
  const Target& target = targets_[hold];
  if (target.mask & held_position) out.force += gradient[target.node].head<3>();
  if (target.mask & held_rotation) out.moment += state.q[target.node] * Vec3(gradient[target.node].tail<3>());
}

}  // namespace tendril
