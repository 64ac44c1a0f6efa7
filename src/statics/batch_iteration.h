// One mixed-stress Newton iteration of a system of rods over a lane type T: segments are assembled from the leaves to the
// roots and each node is eliminated as soon as it is complete; then the steps come back from the roots to the leaves.
//
// A section at a branch point (r, R) with the frame (g, Q) seen from it moves by dr_s = dr - R [g] theta, theta_s = Q^T theta.
#pragma once

#include <type_traits>

#include "rod/se3_element.h"
#include "statics/batch_elimination.h"
#include "statics/batch_kernel.h"

namespace TENDRIL_LANES_NAMESPACE {

/// Gradient and second derivative of one end of a segment, in (position, rotation) of the node that it belongs to.
template <class T>
struct EndTerms {
  V3<T> force, moment;
  M3<T> rr, rt, tt;
};

/// Rows of the start's node, columns of the end's.
template <class T>
struct Coupling {
  M3<T> rr, rt, tr, tt;
};

template <class T>
class BatchIteration {
 public:
  BatchIteration(const tendril::BatchStructure& structure, const tendril::BatchLanes& lanes)
      : s_(structure),
        parameters_(reinterpret_cast<const T*>(lanes.parameters)),
        frames_(reinterpret_cast<T*>(lanes.frames)),
        wrenches_(reinterpret_cast<T*>(lanes.wrenches)),
        reactions_(reinterpret_cast<T*>(lanes.reactions)),
        deferred_(*reinterpret_cast<const T*>(lanes.deferred)),
        shift_(*reinterpret_cast<const T*>(lanes.shift)),
        shifted_(largest_lane(shift_) > 0) {
    char* next = reinterpret_cast<char*>(lanes.scratch);
    auto take = [&next](auto*& array, int count) {
      array = reinterpret_cast<std::remove_reference_t<decltype(array)>>(next);
      next += count * sizeof *array;
    };
    take(factors_, s_.node_count);
    take(segments_, s_.segment_count);
    take(steps_, 6 * s_.node_count);
    take(held_, held_nodes());
    take(slots_, 0);
  }

  static int scratch_size(const tendril::BatchStructure& s, int held, int slots) {
    return static_cast<int>((s.node_count * (sizeof(NodeFactor<T>) + 6 * sizeof(T)) + s.segment_count * sizeof(Segment) +
                             held * sizeof(Held) + slots * sizeof(NodeTerms<T>)) /
                            sizeof(T));
  }

  void run(T& size, T& positive) {
    positive_ = filled<T>(1);
    for (int i = 0; i < s_.segment_count; ++i) assemble(i);
    for (int k = 0; k < s_.root_count; ++k) close_root(k);
    for (int i = s_.segment_count - 1; i >= 0; --i) back(i);
    size = step_size();
    const T one = filled<T>(1), nothing{};
    share_ = size > filled<T>(s_.largest_step) ? filled<T>(s_.largest_step) / size : one;
    share_ = (positive_ > nothing) & (size == size) ? share_ : nothing;
    for (int i = 0; i < s_.segment_count; ++i) predict(i);
    for (int i = 0; i < s_.node_count; ++i) move(i);
    positive = positive_;
  }

 private:
  /// Kept from the assembly for the prediction of the wrench.
  struct Segment {
    WrenchRate<T> rate;
    Wrench<T> actual, geometric;
    M3<T> start_lever, end_lever;  ///< -R [g] where there is a joint
  };
  /// A held node's rows before they are taken out, and its way to the target.
  struct Held {
    NodeTerms<T> terms;
    T u[36];
    T way[6];
  };
  struct End {
    V3<T> r;
    Q4<T> q;
  };

  int held_nodes() const {
    int count = 0;
    for (int i = 0; i < s_.node_count; ++i) count += s_.nodes[i].held != 0;
    return count;
  }

  V3<T> vector(const T* from) const { return {from[0], from[1], from[2]}; }
  End frame(const T* from) const { return {vector(from), {from[3], vector(from + 4)}}; }
  M3<T> turned_joint(int joint) const {
    return rotation_matrix(frame(parameters_ + joint).q);
  }

  /// The section's frame, and -R [g] of its joint.
  End section(int node, int joint, M3<T>& lever) const {
    const End at = frame(frames_ + 7 * node);
    if (joint < 0) return at;
    const End relative = frame(parameters_ + joint);
    const M3<T> axes = rotation_matrix(at.q);
    lever = -(axes * cross_matrix_of(relative.r));
    const V3<T> c = cross(at.q.v, relative.q.v);
    return {at.r + axes * relative.r,
            {at.q.w * relative.q.w - dot(at.q.v, relative.q.v), at.q.w * relative.q.v + relative.q.w * at.q.v + c}};
  }

  Se3Segment<T> element_of(const tendril::BatchSegment& segment, T& deferred) const;
  void assemble(int index);
  void add_weight(const Se3Segment<T>& segment, const V3<T>& weight, const T& sign, bool slope, const End& at,
                  EndTerms<T>& end, V3<T>& geometric) const;
  struct GeometricForces {
    V3<T> start, end;
  };
  void join(const tendril::BatchSegment& segment, const Segment& kept, const GeometricForces& forces, EndTerms<T>& start,
            EndTerms<T>& end, Coupling<T>& coupling) const;
  void take_to_branch(int node, int joint, const M3<T>& lever, const V3<T>& geometric, EndTerms<T>& end) const;
  template <bool fresh>
  static void gather(const EndTerms<T>& end, NodeTerms<T>& slot);
  static void gather(const EndTerms<T>& end, bool fresh, NodeTerms<T>& slot);
  template <bool reversed>
  static void place(const Coupling<T>& coupling, T* u);
  void take_out_held(int node, NodeTerms<T>& own, T* u, NodeTerms<T>* parent);
  void close_root(int k);
  void back(int index);
  void react(int node, const T* parent);
  void predict(int index);
  T step_size() const;
  void move(int node);

  const tendril::BatchStructure& s_;
  const T* parameters_;
  T* frames_;
  T* wrenches_;
  T* reactions_;
  const T deferred_, shift_;
  const bool shifted_;
  T positive_, share_;  ///< share: of the step that is made
  NodeFactor<T>* factors_;
  Segment* segments_;
  T* steps_;
  Held* held_;
  NodeTerms<T>* slots_;
};

template <class T>
void BatchIteration<T>::add_weight(const Se3Segment<T>& segment, const V3<T>& weight, const T& sign, bool slope,
                                   const End& at, EndTerms<T>& end, V3<T>& geometric) const {
  const V3<T> half = filled<T>(0.5) * segment.h * weight;
  end.force = end.force - half;
  geometric = geometric - half;
  if (!slope) return;
  // Energy b . e3 with b the moment sign h^2/12 w in the section's axes.
  const V3<T> b = transposed_times(rotation_matrix(at.q), sign * segment.h * segment.h * filled<T>(1.0 / 12) * weight);
  const T half_x = filled<T>(0.5) * b.x, half_y = filled<T>(0.5) * b.y;
  end.moment.x -= b.y;
  end.moment.y += b.x;
  end.tt(0, 0) -= b.z;
  end.tt(1, 1) -= b.z;
  end.tt(0, 2) += half_x;
  end.tt(2, 0) += half_x;
  end.tt(1, 2) += half_y;
  end.tt(2, 1) += half_y;
}

template <class T>
void BatchIteration<T>::take_to_branch(int node, int joint, const M3<T>& lever, const V3<T>& geometric,
                                       EndTerms<T>& end) const {
  const M3<T> turn = turned_joint(joint);  // theta_s = turn^T theta
  const M3<T> axes = rotation_matrix(frame(frames_ + 7 * node).q);
  const V3<T> g = vector(parameters_ + joint);
  end.moment = transposed_times(lever, end.force) + turn * end.moment;
  const M3<T> rt_turned = end.rt * transposed(turn);
  const M3<T> mixed = transposed(lever) * rt_turned;
  const V3<T> f = transposed_times(axes, geometric);
  const M3<T> fg = outer(f, g);
  M3<T> tt = transposed(lever) * (end.rr * lever) + mixed + transposed(mixed) + turn * (end.tt * transposed(turn)) +
             filled<T>(0.5) * (fg + transposed(fg));
  add_to_diagonal(tt, -dot(f, g));
  end.rt = end.rr * lever + rt_turned;
  end.tt = tt;
}

/// Sets or adds one end's terms.
template <class T>
template <bool fresh>
inline void BatchIteration<T>::gather(const EndTerms<T>& end, NodeTerms<T>& slot) {
  auto put = [](T& to, const T& value) {
    if constexpr (fresh) to = value;
    else to += value;
  };
#pragma GCC unroll 3
  for (int r = 0; r < 3; ++r) {
#pragma GCC unroll 3
    for (int c = 0; c <= r; ++c) {
      put(slot.d[lower(r, c)], end.rr(r, c));
      put(slot.d[lower(3 + r, 3 + c)], end.tt(r, c));
    }
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) put(slot.d[lower(3 + r, c)], end.rt(c, r));
    put(slot.g[r], end.force[r]);
    put(slot.g[3 + r], end.moment[r]);
  }
}

template <class T>
inline void BatchIteration<T>::gather(const EndTerms<T>& end, bool fresh, NodeTerms<T>& slot) {
  if (fresh) gather<true>(end, slot);
  else gather<false>(end, slot);
}

/// The coupling as rows of the child and columns of the parent.
template <class T>
template <bool reversed>
inline void BatchIteration<T>::place(const Coupling<T>& coupling, T* u) {
#pragma GCC unroll 3
  for (int r = 0; r < 3; ++r)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      u[6 * r + c] = reversed ? coupling.rr(c, r) : coupling.rr(r, c);
      u[6 * r + 3 + c] = reversed ? coupling.tr(c, r) : coupling.rt(r, c);
      u[18 + 6 * r + c] = reversed ? coupling.rt(c, r) : coupling.tr(r, c);
      u[21 + 6 * r + c] = reversed ? coupling.tt(c, r) : coupling.tt(r, c);
    }
}

/// Expresses the ends that belong to branch points by those points' unknowns.
template <class T>
[[gnu::noinline]] void BatchIteration<T>::join(const tendril::BatchSegment& segment, const Segment& kept,
                                               const GeometricForces& forces, EndTerms<T>& start, EndTerms<T>& end,
                                               Coupling<T>& coupling) const {
  const int start_node = segment.reversed ? segment.parent : segment.child;
  const int end_node = segment.reversed ? segment.child : segment.parent;
  if (segment.start_joint >= 0) {
    take_to_branch(start_node, segment.start_joint, kept.start_lever, forces.start, start);
    const M3<T> turn = turned_joint(segment.start_joint);
    coupling.tr = transposed_times(kept.start_lever, coupling.rr) + turn * coupling.tr;
    coupling.tt = transposed_times(kept.start_lever, coupling.rt) + turn * coupling.tt;
  }
  if (segment.end_joint >= 0) {
    take_to_branch(end_node, segment.end_joint, kept.end_lever, forces.end, end);
    const M3<T> turn_t = transposed(turned_joint(segment.end_joint));
    coupling.rt = coupling.rr * kept.end_lever + coupling.rt * turn_t;
    coupling.tt = coupling.tr * kept.end_lever + coupling.tt * turn_t;
  }
}

/// What a segment is, and how much of its fourth-order correction comes from the predicted wrench.
template <class T>
inline Se3Segment<T> BatchIteration<T>::element_of(const tendril::BatchSegment& segment, T& deferred) const {
  const T* p = parameters_ + segment.stiffness;
  Se3Segment<T> element;
  element.h = p[0];
  const T q = p[0] * p[0] * filled<T>(1.0 / 12);
  deferred = deferred_ * q;
  element.q = q - deferred;
  element.flexibility_v = vector(p + 1);
  element.flexibility_phi = vector(p + 4);
  if (segment.rates >= 0) {
    element.rate_v = vector(parameters_ + segment.rates);
    element.rate_phi = vector(parameters_ + segment.rates + 3);
    element.slope_phi = vector(parameters_ + segment.rates + 6);
    element.varies = true;
  } else {
    element.rate_v = {T{}, T{}, filled<T>(1)};
    element.rate_phi = {T{}, T{}, T{}};
  }
  return element;
}

template <class T>
[[gnu::flatten]] void BatchIteration<T>::assemble(int index) {
  const tendril::BatchSegment& segment = s_.segments[index];
  const int start_node = segment.reversed ? segment.parent : segment.child;
  const int end_node = segment.reversed ? segment.child : segment.parent;
  Segment& kept = segments_[index];
  const End a = section(start_node, segment.start_joint, kept.start_lever);
  const End b = section(end_node, segment.end_joint, kept.end_lever);

  T deferred;
  const Se3Segment<T> element = element_of(segment, deferred);
  T* w = wrenches_ + tendril::BatchBlocks::wrench * index;
  kept.geometric = {vector(w), vector(w + 3)};
  SegmentHessian<T> h;
  const SegmentGradient<T> gradient =
      se3_element<T>(element, {a.q, b.q, a.r, b.r}, &kept.geometric, h, kept.rate, &deferred);
  kept.actual = gradient.wrench;

  EndTerms<T> start{-gradient.force, gradient.theta_a, h.dd, -h.da, h.aa};
  EndTerms<T> end{gradient.force, gradient.theta_b, h.dd, h.db, h.bb};
  Coupling<T> coupling{-h.dd, -h.db, transposed(h.da), h.ab};
  V3<T> start_force = -h.geometric_force, end_force = h.geometric_force;
  const V3<T> weight = vector(parameters_ + segment.stiffness + 7);
  add_weight(element, weight, filled<T>(-1), segment.start_slope, a, start, start_force);
  add_weight(element, weight, filled<T>(1), segment.end_slope, b, end, end_force);
  if (segment.start_force >= 0) {
    start.force = start.force - vector(parameters_ + segment.start_force);
    start_force = start_force - vector(parameters_ + segment.start_force);
  }
  if (segment.end_force >= 0) {
    end.force = end.force - vector(parameters_ + segment.end_force);
    end_force = end_force - vector(parameters_ + segment.end_force);
  }
  if (shifted_) {
    const T turn = filled<T>(0.5) * shift_ * element.h, way = turn * (0.01 / (s_.length * s_.length));
    add_to_diagonal(start.rr, way);
    add_to_diagonal(start.tt, turn);
    add_to_diagonal(end.rr, way);
    add_to_diagonal(end.tt, turn);
  }
  if (segment.start_joint >= 0 || segment.end_joint >= 0)
    join(segment, kept, {start_force, end_force}, start, end, coupling);

  T u[36];
  NodeTerms<T>& own = slots_[segment.child_slot];
  NodeTerms<T>& parent = slots_[segment.parent_slot];
  if (segment.reversed) {
    place<true>(coupling, u);
    gather(end, segment.child_fresh, own);
    gather(start, segment.parent_fresh, parent);
  } else {
    place<false>(coupling, u);
    gather(start, segment.child_fresh, own);
    gather(end, segment.parent_fresh, parent);
  }
  const int held = s_.nodes[segment.child].held;
  if (held) take_out_held(segment.child, own, u, &parent);
  if (held == 3) return;
  eliminate<T, true>(own, u, &parent, factors_[segment.child], positive_);
}

/// Known steps of held unknowns go to the other side; their rows become x = way.
template <class T>
[[gnu::noinline]] void BatchIteration<T>::take_out_held(int node, NodeTerms<T>& own, T* u, NodeTerms<T>* parent) {
  const tendril::BatchNode& n = s_.nodes[node];
  Held& held = held_[n.held_index];
  held.terms = own;
  const End at = frame(frames_ + 7 * node), target = frame(parameters_ + n.target);
  JacobianCoefficients<T> unused;
  const V3<T> way = target.r - at.r, turn = rotation_log(conjugate_times(at.q, target.q), unused);
  const int from = n.held & 1 ? 0 : 3, to = n.held & 2 ? 6 : 3;
  for (int k = 0; k < 6; ++k)
    held.way[k] = k < from || k >= to ? T{} : k < 3 ? way[k] : turn[k - 3];
  for (int k = from; k < to; ++k)
    for (int r = 0; r < 6; ++r) own.g[r] += own.d[symmetric(r, k)] * held.way[k];
  if (parent) {
    for (int i = 0; i < 36; ++i) held.u[i] = u[i];
    for (int k = from; k < to; ++k)
      for (int c = 0; c < 6; ++c) {
        parent->g[c] += u[6 * k + c] * held.way[k];
        u[6 * k + c] = T{};
      }
  }
  for (int k = from; k < to; ++k) {
    for (int r = 0; r < 6; ++r) own.d[symmetric(r, k)] = T{};
    own.d[lower(k, k)] = filled<T>(1);
    own.g[k] = -held.way[k];
  }
}

template <class T>
void BatchIteration<T>::close_root(int k) {
  const int node = s_.roots[k];
  NodeTerms<T>& own = slots_[s_.root_slots[k]];
  const int held = s_.nodes[node].held;
  T* x = steps_ + 6 * node;
  if (held) take_out_held(node, own, nullptr, nullptr);
  if (held == 3) {
    for (int i = 0; i < 6; ++i) x[i] = held_[s_.nodes[node].held_index].way[i];
  } else {
    eliminate<T, false>(own, nullptr, nullptr, factors_[node], positive_);
    substitute<T>(factors_[node], nullptr, x);
  }
  if (held) react(node, nullptr);
}

template <class T>
void BatchIteration<T>::back(int index) {
  const tendril::BatchSegment& segment = s_.segments[index];
  const T* parent = steps_ + 6 * segment.parent;
  T* x = steps_ + 6 * segment.child;
  const tendril::BatchNode& node = s_.nodes[segment.child];
  if (node.held == 3)
    for (int i = 0; i < 6; ++i) x[i] = held_[node.held_index].way[i];
  else
    substitute<T>(factors_[segment.child], parent, x);
  if (node.held) react(segment.child, parent);
}

/// The gradient at a held node after the step, by its linearisation.
template <class T>
void BatchIteration<T>::react(int node, const T* parent) {
  const int index = s_.nodes[node].held_index;
  const Held& held = held_[index];
  const T* x = steps_ + 6 * node;
  for (int r = 0; r < 6; ++r) {
    T sum = held.terms.g[r];
    for (int c = 0; c < 6; ++c) sum += held.terms.d[symmetric(r, c)] * x[c];
    for (int c = 0; parent && c < 6; ++c) sum += held.u[6 * r + c] * parent[c];
    reactions_[6 * index + r] = sum;
  }
}

/// The wrench that the linearised step leads to, in the sections' axes after the step.
template <class T>
void BatchIteration<T>::predict(int index) {
  const tendril::BatchSegment& segment = s_.segments[index];
  const Segment& kept = segments_[index];
  const T* xa = steps_ + 6 * (segment.reversed ? segment.parent : segment.child);
  const T* xb = steps_ + 6 * (segment.reversed ? segment.child : segment.parent);
  V3<T> ra = vector(xa), rb = vector(xb), ta = vector(xa + 3), tb = vector(xb + 3);
  if (segment.start_joint >= 0) {
    ra = ra + kept.start_lever * ta;
    ta = transposed_times(turned_joint(segment.start_joint), ta);
  }
  if (segment.end_joint >= 0) {
    rb = rb + kept.end_lever * tb;
    tb = transposed_times(turned_joint(segment.end_joint), tb);
  }
  const Wrench<T> change = kept.rate.change(rb - ra, ta, tb);
  const V3<T> turn = filled<T>(0.5) * (ta + tb);
  const V3<T> back = share_ * turn;
  const V3<T> n = turned_back(back, kept.actual.n + change.n + cross(turn, kept.geometric.n));
  const V3<T> m = turned_back(back, kept.actual.m + change.m + cross(turn, kept.geometric.m));
  T* w = wrenches_ + tendril::BatchBlocks::wrench * index;
  const auto moves = share_ > T{};
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    w[i] = moves ? n[i] : w[i];
    w[3 + i] = moves ? m[i] : w[3 + i];
  }
}

template <class T>
T BatchIteration<T>::step_size() const {
  T largest{};
  for (int i = 0; i < s_.node_count; ++i) {
    const V3<T> dr = vector(steps_ + 6 * i), theta = vector(steps_ + 6 * i + 3);
    const T turned = dot(theta, theta), moved = dot(dr, dr) * (1 / (s_.length * s_.length));
    largest = (turned > largest) | (turned != turned) ? turned : largest;
    largest = (moved > largest) | (moved != moved) ? moved : largest;
  }
  T size;
  for (int i = 0; i < lanes_of<T>; ++i) lane(size, i) = __builtin_sqrt(lane(largest, i));
  return size;
}

/// r <- r + dr, R <- R exp(theta); exp by its series, which is exact to rounding up to 1 rad.
template <class T>
void BatchIteration<T>::move(int node) {
  const T* x = steps_ + 6 * node;
  T* to = frames_ + 7 * node;
  const auto moves = share_ > T{};
  V3<T> dr, theta;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    dr[i] = moves ? share_ * x[i] : T{};
    theta[i] = moves ? share_ * x[3 + i] : T{};
  }
  const T turned = dot(theta, theta);
  const T u = filled<T>(0.25) * turned;
  constexpr double sines[7] = {1, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800, 1.0 / 6227020800};
  constexpr double cosines[7] = {1, -0.5, 1.0 / 24, -1.0 / 720, 1.0 / 40320, -1.0 / 3628800, 1.0 / 479001600};
  T sine = filled<T>(-1.0 / 1307674368000), cosine = filled<T>(-1.0 / 87178291200);
#pragma GCC unroll 7
  for (int k = 6; k >= 0; --k) {
    sine = sine * u + sines[k];
    cosine = cosine * u + cosines[k];
  }
  const V3<T> t = filled<T>(0.5) * sine * theta;
  const Q4<T> q{to[3], vector(to + 4)};
  T w = q.w * cosine - dot(q.v, t);
  V3<T> v = q.w * t + cosine * q.v + cross(q.v, t);
  const T normal = filled<T>(1.5) - filled<T>(0.5) * (w * w + dot(v, v));
  w *= normal;
  v = normal * v;
  to[0] += dr.x;
  to[1] += dr.y;
  to[2] += dr.z;
  to[3] = w;
  to[4] = v.x;
  to[5] = v.y;
  to[6] = v.z;
}

template <class T>
void iterate_lanes(const tendril::BatchStructure& structure, const tendril::BatchLanes& lanes) {
  BatchIteration<T> iteration(structure, lanes);
  T size, positive;
  iteration.run(size, positive);
  for (int i = 0; i < lanes_of<T>; ++i) {
    lanes.size[i] = lane(size, i);
    lanes.positive[i] = lane(positive, i);
  }
}

}  // namespace TENDRIL_LANES_NAMESPACE
