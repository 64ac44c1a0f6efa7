#include "statics/contact_sliding.h"

#include <algorithm>
#include <cmath>

namespace tendril {

namespace {

constexpr int most_slides = 24;          // places looked at for one shape
constexpr double longest_slide = 0.5;    // radii, between two looks
constexpr double at_rest = 1e-10;        // radii: a slide this short is none
constexpr double flat = 1e-6;            // slope over force: above it the point stands at a kink, not at a maximum

double share_of(const Vec3& predicted, const Vec3& actual, bool exact) {
  if (exact) return 1;
  const double size2 = actual.squaredNorm();
  return size2 > 0 ? std::clamp(predicted.dot(actual) / size2, 0.0, 1.0) : 0.0;
}

}  // namespace

void SlidingContacts::add(double s, double length, double shift, const Vec3& direction) {
  const int last = static_cast<int>(s_.size()) - 2;
  const auto after = std::upper_bound(s_.begin(), s_.end(), s);
  const int segment = std::clamp(static_cast<int>(after - s_.begin()) - 1, 0, last);
  const double xi = std::clamp((s - s_[segment]) / (s_[segment + 1] - s_[segment]), 0.0, 1.0);
  Point point;
  point.at = contact_point_at(s_, radii_, element_, segment, xi);
  point.at.weight = length;
  point.at.keep = keep_;
  point.shift = shift;
  point.direction = direction;
  points_.push_back(point);
}

/// The point of the rod at an arc length, looked for from a segment on.
ContactPoint SlidingContacts::place(int near, double s) const {
  int segment = near;
  while (segment > 0 && s < s_[segment]) --segment;
  while (segment + 2 < static_cast<int>(s_.size()) && s > s_[segment + 1]) ++segment;
  ContactPoint point =
      contact_point_at(s_, radii_, element_, segment, (s - s_[segment]) / (s_[segment + 1] - s_[segment]));
  point.s = s;
  return point;
}

/// The distance of the nearest surface that lies against a direction; `limit` when there is none nearer.
double SlidingContacts::distance_facing(const ContactField& field, const Vec3& x, const Vec3& direction, double limit) {
  // Mostly the closest point is the one: far cheaper than all that lies within the limit.
  const ClosestPoint c = field.closest_kept(x, limit, keep_);
  if (c.obstacle < 0 || c.distance >= limit) return limit;
  const double from_surface = c.distance + std::min(field.clearance(c.obstacle), keep_);
  if (from_surface != 0 && faces({1, c.distance, (x - c.point) / from_surface, Mat3::Zero(), c.obstacle}, direction))
    return c.distance;
  terms_.clear();
  field.terms_kept(x, limit, keep_, terms_);
  double nearest = limit;
  for (const DistanceTerm& t : terms_)
    if (faces(t, direction)) nearest = std::min(nearest, t.distance);
  return nearest;
}

double SlidingContacts::sharpness_of(const Point& p, const VertexShape& shape) {
  const double aside = 0.5 * p.at.radius;
  double rise = 0;
  for (double side : {-aside, aside}) {
    const ContactPoint there = place(p.at.segment, std::clamp(p.at.s + side, s_.front(), s_.back()));
    rise += distance_facing(field_.at(there.s), position_of(there, shape), p.direction, 2 * p.at.radius) - p.contact.distance;
  }
  return rise * p.at.radius / (aside * aside);
}

/// Puts the point at `s` and evaluates its contact there; returns the slope Phi'(s).
double SlidingContacts::look_at(Point& p, double s, const VertexShape& shape, const ContactLaw& law) {
  const double weight = p.at.weight;
  p.at = place(p.at.segment, s);
  p.at.weight = weight;
  p.at.keep = keep_;
  p.x = position_of(p.at, shape);
  const double reach = p.at.radius + p.shift;
  terms_.clear();
  field_.at(s).terms_kept(p.x, reach, keep_, terms_);
  std::erase_if(terms_, [&](const DistanceTerm& t) { return !faces(t, p.direction); });
  p.contact = contact_at(terms_, reach, p.at.weight, law);
  p.active = p.contact.distance < reach;
  p.bend = 0;
  if (!p.active) return 0;
  p.tangent = position_of(slope_of(p.at, s_, element_), shape);
  const Vec3 bent = position_of(curvature_of(p.at, s_, element_), shape);
  p.bend = p.tangent.dot((p.contact.material + p.contact.curvature) * p.tangent) + p.contact.gradient.dot(bent);
  return p.contact.gradient.dot(p.tangent);
}

void SlidingContacts::slide(Point& p, const VertexShape& shape, const ContactLaw& law) {
  const double start = s_.front(), end = s_.back();
  double low = start, high = end;  // the place lies between them
  double slope = look_at(p, p.at.s, shape, law);
  for (int look = 0; look < most_slides && p.active; ++look) {
    (slope > 0 ? low : high) = p.at.s;
    // Phi grows like the 5/2th power of the overlap, whose own maximum Newton's method finds more directly.
    const double bend = p.bend - 0.6 * slope * slope / p.contact.energy;
    const double longest = longest_slide * p.at.radius;
    double way = bend < 0 ? -slope / bend : std::copysign(longest, slope);
    way = std::clamp(way, -longest, longest);
    double next = p.at.s + way;
    if (next <= low || next >= high) next = slope > 0 && high == end ? end : slope < 0 && low == start ? start : 0.5 * (low + high);
    if (std::abs(next - p.at.s) <= at_rest * p.at.radius) break;
    const Point before = p;
    slope = look_at(p, next, shape, law);
    if (!p.active) {  // slid off: the place lies in between
      (next > before.at.s ? high : low) = next;
      slope = before.contact.gradient.dot(before.tangent);
      p = before;
    }
  }
  if (p.active && (p.bend >= 0 || std::abs(slope) > flat * p.contact.gradient.norm())) p.bend = 0;
}

double SlidingContacts::evaluate(const VertexShape& shape, const ContactLaw& law) {
  double energy = 0;
  for (Point& p : points_) {
    slide(p, shape, law);
    if (p.active) energy += p.contact.energy;
  }
  return energy;
}

void SlidingContacts::add_to(const VertexShape& shape, bool exact, BlockView system) const {
  for (const Point& p : points_) {
    if (!p.active) continue;
    const Vec3& g = p.contact.gradient;
    const double share = share_of(p.predicted, g, exact);
    const Mat3 hessian = p.contact.material + share * p.contact.curvature;
    add_point_energy(p.at, shape, g, hessian, share * g, system);
    if (p.bend >= 0) continue;
    // v, in the order of the unknowns of the segment's two vertices.
    Vec6 va = Vec6::Zero(), vb = Vec6::Zero();
    add_point_force(p.at, shape, (p.contact.material + p.contact.curvature) * p.tangent, va, vb);
    add_point_force(slope_of(p.at, s_, element_), shape, g, va, vb);
    const double scale = -share / p.bend;
    system.diagonal[p.at.segment] += scale * va * va.transpose();
    system.diagonal[p.at.segment + 1] += scale * vb * vb.transpose();
    system.upper[p.at.segment] += scale * va * vb.transpose();
  }
}

void SlidingContacts::predict(const VertexShape& shape, std::span<const Vec6> step, double share) {
  for (Point& p : points_)
    p.predicted = p.active ? Vec3(p.contact.gradient + share * p.contact.material * displacement_of(p.at, shape, step))
                           : Vec3::Zero();
}

void SlidingContacts::predict_standing() {
  for (Point& p : points_) p.predicted = p.active ? p.contact.gradient : Vec3::Zero();
}

void SlidingContacts::forget_prediction() {
  for (Point& p : points_) p.predicted.setZero();
}

void SlidingContacts::update_shifts() {
  for (Point& p : points_)
    p.shift = p.active ? std::max(0.0, p.shift + p.at.radius - p.contact.distance) : 0.0;
}

bool SlidingContacts::tidy() {
  const std::size_t before = points_.size();
  std::erase_if(points_, [](const Point& p) { return !p.active && p.shift == 0; });
  std::sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) { return a.at.s < b.at.s; });
  for (Point& p : points_)
    if (p.active) p.direction = p.contact.normal;
  return points_.size() != before;
}

std::vector<SlidingContacts::Point> SlidingContacts::take_flat(double sharpness, const VertexShape& shape) {
  return take_if([&](const Point& p) { return p.active && sharpness_of(p, shape) < sharpness; });
}

double SlidingContacts::deepest() const {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Point& p : points_)
    if (p.active) deepest = std::max(deepest, p.at.radius - p.contact.distance);
  return deepest;
}

}  // namespace tendril
