#include "statics/rod_slopes.h"

#include "base/error.h"
#include "statics/se3_packs.h"
#include "statics/se3_system.h"

namespace tendril {
namespace {

Wrench<double> get(const Wrench<Pack>& w, int i) { return {in_lanes(get(w.n, i)), in_lanes(get(w.m, i))}; }

/// Adds one lane of the derivatives by the parameters.
void add_lane(const Se3Parameters<Pack>& p, int i, SegmentChange& to) {
  to.length += lane(p.h, i);
  to.flexibility.head<3>() += get(p.flexibility_v, i);
  to.flexibility.tail<3>() += get(p.flexibility_phi, i);
  to.rate.head<3>() += get(p.rate_v, i);
  to.rate.tail<3>() += get(p.rate_phi, i);
}

/// Adds one lane of a gradient to the segment's two nodes.
void add_lane(const SegmentGradient<Pack>& g, int i, Vec6* nodes) {
  const Vec3 force = get(g.force, i);
  nodes[0].head<3>() -= force;
  nodes[0].tail<3>() += get(g.theta_a, i);
  nodes[1].head<3>() += force;
  nodes[1].tail<3>() += get(g.theta_b, i);
}

/// Change of R e3 under a rotation increment.
Vec3 turned_normal(const Quat& q, const Vec6& step) { return q * Vec3(step[4], -step[3], 0); }

}  // namespace

SegmentChange& SegmentChange::operator+=(const SegmentChange& other) {
  length += other.length;
  flexibility += other.flexibility;
  rate += other.rate;
  mass += other.mass;
  radius += other.radius;
  return *this;
}

double SegmentChange::dot(const SegmentChange& other) const {
  return length * other.length + flexibility.dot(other.flexibility) + rate.dot(other.rate) + mass * other.mass +
         radius * other.radius;
}

void WrenchSlopes::add(int segment, const Wrench<double>& by_wrench, const Wrench<double>& by_rate) {
  const int p = segment / 4, l = segment % 4;
  used_[p] = 1;
  for (int c = 0; c < 3; ++c) {
    lane(by_wrench_[p].n[c], l) += by_wrench.n[c];
    lane(by_wrench_[p].m[c], l) += by_wrench.m[c];
    lane(by_rate_[p].n[c], l) += by_rate.n[c];
    lane(by_rate_[p].m[c], l) += by_rate.m[c];
  }
}

RodDerivatives::RodDerivatives(const RodSystem& system)
    : system_(&system), count_(system.mesh().vertices() - 1), packs_(se3_segments(system.mesh(), true)), state_(RodState()) {
  if (!dynamic_cast<const Se3System*>(&system))
    throw UsageError("sensitivity: got a rod of staggered elements, expected the se3 element; solve with element = \"se3\"");
}

void RodDerivatives::stand_at(StateView state) {
  state_ = state;
  slopes_.clear();
  slopes_.reserve(packs_.size());
  for (int p = 0; p < packs(); ++p) slopes_.emplace_back(packs_[p], se3_ends(state, count_, p));
}

Se3Segment<double> RodDerivatives::segment(int i) const {
  const Se3Segment<Pack>& from = packs_[i / 4];
  const int l = i % 4;
  return {lane(from.h, l), lane(from.q, l), in_lanes(get(from.flexibility_v, l)), in_lanes(get(from.flexibility_phi, l)),
          in_lanes(get(from.rate_v, l)), in_lanes(get(from.rate_phi, l)), in_lanes(get(from.slope_phi, l)), from.varies};
}

Wrench<double> RodDerivatives::wrench(int i) const { return get(slopes_[i / 4].wrench(), i % 4); }
Wrench<double> RodDerivatives::rate(int i) const { return get(slopes_[i / 4].rate(), i % 4); }
Wrench<double> RodDerivatives::variation(int i) const { return get(slopes_[i / 4].variation(), i % 4); }
Vec3 RodDerivatives::force(int i) const { return get(slopes_[i / 4].force(), i % 4); }

/// The weight's work over one segment, per unit of mass and gravity: mass gravity . g is its part of step . gradient.
struct RodDerivatives::WeightSlopes {
  Vec3 g, by_length;
};

RodDerivatives::WeightSlopes RodDerivatives::weight_of(int i, const Vec6* step) const {
  const double h = system_->mesh().segments[i].length;
  const Vec3 moved = step[i].head<3>() + step[i + 1].head<3>();
  const Vec3 turned = turned_normal(state_.q[i + 1], step[i + 1]) - turned_normal(state_.q[i], step[i]);
  return {-0.5 * h * moved + h * h / 12 * turned, -0.5 * moved + h / 6 * turned};
}

void RodDerivatives::add_work(const Vec6* step, RodSlopes& out) const {
  for (int p = 0; p < packs(); ++p) {
    Se3Step<Pack> four{};
    for (int l = 0; l < lanes_in(p); ++l) {
      const Vec6 &a = step[4 * p + l], &b = step[4 * p + l + 1];
      put(four.dr, b.head<3>() - a.head<3>(), l);
      put(four.theta_a, a.tail<3>(), l);
      put(four.theta_b, b.tail<3>(), l);
    }
    const Se3Parameters<Pack> slopes = slopes_[p].of_work(four);
    for (int l = 0; l < lanes_in(p); ++l) add_lane(slopes, l, out.segments[4 * p + l]);
  }
  const Vec3& gravity = system_->problem().gravity;
  for (int i = 0; i < count_; ++i) {
    const double mass = system_->mesh().segments[i].section.mass;
    const WeightSlopes weight = weight_of(i, step);
    out.segments[i].length += mass * gravity.dot(weight.by_length);
    out.segments[i].mass += gravity.dot(weight.g);
    out.gravity += mass * weight.g;
  }
}

void RodDerivatives::add_gradient_change(std::span<const SegmentChange> changes, Vec6* gradient) const {
  for (int p = 0; p < packs(); ++p) {
    Se3Parameters<Pack> four{};
    for (int l = 0; l < lanes_in(p); ++l) {
      const SegmentChange& change = changes[4 * p + l];
      lane(four.h, l) = change.length;
      put(four.flexibility_v, change.flexibility.head<3>(), l);
      put(four.flexibility_phi, change.flexibility.tail<3>(), l);
      put(four.rate_v, change.rate.head<3>(), l);
      put(four.rate_phi, change.rate.tail<3>(), l);
    }
    const SegmentGradient<Pack> g = slopes_[p].change_of_gradient(four);
    for (int l = 0; l < lanes_in(p); ++l) add_lane(g, l, gradient + 4 * p + l);
  }
  const Vec3& gravity = system_->problem().gravity;
  for (int i = 0; i < count_; ++i) {
    const MeshSegment& segment = system_->mesh().segments[i];
    const double h = segment.length, mass = segment.section.mass;
    const double half = 0.5 * (changes[i].length * mass + h * changes[i].mass);
    const double slope = h / 6 * changes[i].length * mass + h * h / 12 * changes[i].mass;
    add_weight(i, half * gravity, slope * gravity, gradient);
  }
}

void RodDerivatives::add_gradient_change(const Vec3& by_gravity, Vec6* gradient) const {
  for (int i = 0; i < count_; ++i) {
    const MeshSegment& segment = system_->mesh().segments[i];
    const double h = segment.length, mass = segment.section.mass;
    add_weight(i, 0.5 * h * mass * by_gravity, h * h / 12 * mass * by_gravity, gradient);
  }
}

/// Gradient of a weight `half` at both ends, and of slope . (R_b - R_a) e3.
void RodDerivatives::add_weight(int i, const Vec3& half, const Vec3& slope, Vec6* gradient) const {
  for (const int node : {i, i + 1}) {
    gradient[node].head<3>() -= half;
    const Vec3 b = state_.q[node].conjugate() * (node == i ? Vec3(-slope) : slope);
    gradient[node].tail<3>() += Vec3(-b.y(), b.x(), 0);
  }
}

void RodDerivatives::add_pull_back(const WrenchSlopes& slopes, Vec6* by_state, RodSlopes& out) const {
  for (int p = 0; p < packs(); ++p) {
    if (!slopes.used_[p]) continue;
    SegmentGradient<Pack> ends;
    Se3Parameters<Pack> parameters;
    slopes_[p].pull_back(slopes.by_wrench_[p], slopes.by_rate_[p], ends, parameters);
    for (int l = 0; l < lanes_in(p); ++l) {
      add_lane(ends, l, by_state + 4 * p + l);
      add_lane(parameters, l, out.segments[4 * p + l]);
    }
  }
}

void RodDerivatives::add_force(int i, const Vec3& weight, Vec6* by_state, RodSlopes& out) const {
  // The force is the gradient by r_b: its derivatives are a row of the segment's second derivative and of its work.
  const V3<double> w = in_lanes(weight);
  SegmentHessian<double> hessian;
  WrenchRate<double> rate;
  se3_element<double>(segment(i), {in_lanes(state_.q[i]), in_lanes(state_.q[i + 1]), in_lanes(state_.r[i]), in_lanes(state_.r[i + 1])},
                      nullptr, hessian, rate);
  const Vec3 by_way = from_lanes(hessian.dd * w);
  by_state[i].head<3>() -= by_way;
  by_state[i + 1].head<3>() += by_way;
  by_state[i].tail<3>() += from_lanes(transposed_times(hessian.da, w));
  by_state[i + 1].tail<3>() += from_lanes(transposed_times(hessian.db, w));
  Se3Step<Pack> four{};
  put(four.dr, weight, i % 4);
  add_lane(slopes_[i / 4].of_work(four), i % 4, out.segments[i]);
}

}  // namespace tendril
