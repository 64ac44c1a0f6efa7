#include "method/dress_pack/pack_gaps.h"

#include <algorithm>
#include <cmath>

namespace tendril::dress_pack {
namespace {

constexpr double look_ahead = 0.3;  // m, beyond what is asked: saves later queries

}  // namespace

PackGaps::PackGaps(const PackBodies& bodies, const RodNetwork& network, Compared what) : bodies_(bodies) {
  for (int k = 0; k < network.rods(); ++k) {
    std::vector<double> radii;
    for (const MeshSegment& segment : network.rod(k).mesh().segments) radii.push_back(segment.section.radius());
    add_rod(network.rod(k).mesh().s, std::move(radii));
  }
  finish(what);
}

PackGaps::PackGaps(const PackBodies& bodies, const SystemEquilibrium& equilibrium, Compared what) : bodies_(bodies) {
  for (const Equilibrium& rod : equilibrium.rods) add_rod(rod.s, rod.radii);
  finish(what);
}

void PackGaps::add_rod(std::vector<double> s, std::vector<double> radii) {
  const int k = static_cast<int>(rods_.size()), first_point = static_cast<int>(points_.size());
  const int first_node = rods_.empty() ? 0 : rods_.back().first_node + static_cast<int>(rods_.back().s.size());
  const std::vector<ContactPoint> points = contact_points(s, radii, Element::se3);
  const int first_segment = static_cast<int>(segments_.size());
  for (const ContactPoint& point : points) {
    if (static_cast<int>(segments_.size()) == first_segment + point.segment)
      segments_.push_back({k, static_cast<int>(points_.size()), static_cast<int>(points_.size()), 0});
    points_.push_back(point);
    rod_of_.push_back(k);
    segments_.back().last_point = static_cast<int>(points_.size());
    segments_.back().radius = std::max(segments_.back().radius, point.radius);
  }
  rods_.push_back({first_node, first_segment, first_point, std::move(s), std::move(radii)});
}

void PackGaps::finish(Compared what) {
  compared_.assign(points_.size() * bodies(), 0);
  segment_compared_.assign(segments_.size() * bodies(), 0);
  for (int g = 0; g < static_cast<int>(segments_.size()); ++g)
    for (int p = segments_[g].first_point; p < segments_[g].last_point; ++p)
      for (int b = 0; b < bodies(); ++b) {
        compared_[p * bodies() + b] = bodies_.compared(rod_of_[p], points_[p].s, b, what);
        segment_compared_[g * bodies() + b] |= compared_[p * bodies() + b];
      }
}

void PackGaps::place(const RodState& state, const JointVector& q, PackPlaces& out) const {
  bodies_.poses(q, out.bodies);
  out.points.resize(points_.size());
  out.middles.resize(segments_.size());
  out.halves.resize(segments_.size());
  for (const Rod& rod : rods_) {
    const VertexShape shape{{state.r.data() + rod.first_node, rod.s.size()}, {state.q.data() + rod.first_node, rod.s.size()}};
    const int segments = static_cast<int>(rod.radii.size());
    for (int i = 0; i < segments; ++i) {
      const int g = rod.first_segment + i;
      out.middles[g] = 0.5 * (shape.points[i] + shape.points[i + 1]);
      double square = 0;
      for (int p = segments_[g].first_point; p < segments_[g].last_point; ++p) {
        out.points[p] = position_of(points_[p], shape);
        square = std::max(square, (out.points[p] - out.middles[g]).squaredNorm());
      }
      out.halves[g] = std::sqrt(square);
    }
  }
}

/// A distance that the middle of a segment is not below; exact enough to tell whether it is below `needed`.
double PackGaps::segment_bound(int g, int b, const Vec3& in_body, double needed, Memory& memory) const {
  Known& known = memory.segments[g * bodies() + b];
  const double bound = known.distance - (in_body - known.at).norm();
  if (bound >= needed) return bound;
  known = {in_body, bodies_.distance(b, in_body, needed + look_ahead).distance};
  return known.distance;
}

/// The same of a point. `found`: what is nearest, when the distance is below `needed`.
double PackGaps::point_bound(int p, int b, const Vec3& in_body, double needed, Memory& memory, BodyDistance* found) const {
  Known& known = memory.points[p * bodies() + b];
  const double bound = known.distance - (in_body - known.at).norm();
  if (bound >= needed) return bound;
  const BodyDistance fresh = bodies_.distance(b, in_body, needed + look_ahead);
  known = {in_body, fresh.distance};
  if (found) *found = fresh;
  return fresh.distance;
}

PackGaps::Lowest PackGaps::lowest_at(int p, int body, const RodState& state, const PackPlaces& places) const {
  const BodyPose& pose = places.bodies[body];
  const auto look = [&](const ContactPoint& point, const Vec3& at) {
    Lowest out{point, at, bodies_.distance(body, pose.to_body(at), 1e9), 0};
    out.gap = out.found.distance - point.radius;
    return out;
  };
  const Lowest here = look(points_[p], places.points[p]);
  const int rod = rod_of_[p];
  for (const int next : {p - 1, p + 1})
    if (next < 0 || next >= points() || rod_of_[next] != rod || !compared_[next * bodies() + body]) return here;
  const double back = points_[p].s - points_[p - 1].s, on = points_[p + 1].s - points_[p].s;
  // Slopes to both sides.
  const double a = (look(points_[p - 1], places.points[p - 1]).gap - here.gap) / back, c = (look(points_[p + 1], places.points[p + 1]).gap - here.gap) / on;
  if (!(a + c > 0)) return here;
  const double s = points_[p].s + std::clamp(0.5 * (on - c * (back + on) / (a + c)), -back, on);
  const Rod& r = rods_[rod];
  const int segment = points_[s < points_[p].s ? p - 1 : p].segment;
  const VertexShape shape{{state.r.data() + r.first_node, r.s.size()}, {state.q.data() + r.first_node, r.s.size()}};
  const double share = std::clamp((s - r.s[segment]) / (r.s[segment + 1] - r.s[segment]), 0.0, 1.0);
  const ContactPoint point = contact_point_at(r.s, r.radii, Element::se3, segment, share);
  const Lowest between = look(point, position_of(point, shape));
  return between.gap < here.gap ? between : here;
}

PackGaps::Nearest PackGaps::smallest(int rod, const RodState& state, const PackPlaces& places, double limit, Memory& memory) const {
  memory.segments.resize(segments_.size() * bodies());
  memory.points.resize(points_.size() * bodies());
  Nearest best;
  const int end = rod + 1 < static_cast<int>(rods_.size()) ? rods_[rod + 1].first_segment : static_cast<int>(segments_.size());
  for (int b = 0; b < bodies(); ++b)
    for (int g = rods_[rod].first_segment; g < end; ++g) {
      if (!segment_compared_[g * bodies() + b]) continue;
      const Segment& segment = segments_[g];
      const double needed = std::min(limit, best.gap) + segment.radius + places.halves[g];
      if (segment_bound(g, b, places.bodies[b].to_body(places.middles[g]), needed, memory) >= needed) continue;
      for (int p = segment.first_point; p < segment.last_point; ++p) {
        if (!compared_[p * bodies() + b]) continue;
        const double reach = std::min(limit, best.gap) + points_[p].radius;
        const double distance = point_bound(p, b, places.bodies[b].to_body(places.points[p]), reach, memory, nullptr);
        if (distance < reach) best = {distance - points_[p].radius, b, p, points_[p].s};
      }
    }
  if (best.body < 0) return best;
  const Lowest lowest = lowest_at(best.point, best.body, state, places);
  best.gap = lowest.gap;
  best.s = lowest.point.s;
  return best;
}

/// Whether both the segment's places lie within a ball that is free of the body, so that the way between them does too.
bool PackGaps::segment_stays_clear(int g, int b, const PackPlaces& before, const PackPlaces& after, double margin, Memory& memory) const {
  const Vec3 from = before.bodies[b].to_body(before.middles[g]), to = after.bodies[b].to_body(after.middles[g]);
  const double half = std::max(before.halves[g], after.halves[g]) + segments_[g].radius + margin;
  const double needed = half + (to - from).norm();
  const Known& known = memory.segments[g * bodies() + b];
  const auto within = [&](const Vec3& x) { return known.distance - (x - known.at).norm() > half; };
  if (within(from) && within(to)) return true;
  return segment_bound(g, b, to, needed, memory) >= needed || (within(from) && within(to));
}

PackGaps::Watch PackGaps::watch(const PackPlaces& before, const PackPlaces& after, double touch, Memory& memory) const {
  memory.segments.resize(segments_.size() * bodies());
  memory.points.resize(points_.size() * bodies());
  Watch out;
  for (int b = 0; b < bodies(); ++b)
    for (int g = 0; g < static_cast<int>(segments_.size()); ++g) {
      const Segment& segment = segments_[g];
      if (!segment_compared_[g * bodies() + b] || segment_stays_clear(g, b, before, after, touch * segment.radius, memory)) continue;
      for (int p = segment.first_point; p < segment.last_point; ++p) {
        if (!compared_[p * bodies() + b]) continue;
        const Vec3 from = before.bodies[b].to_body(before.points[p]), to = after.bodies[b].to_body(after.points[p]);
        const double near = (1 + touch) * points_[p].radius, way = (to - from).norm();
        const double distance = point_bound(p, b, to, near + way, memory, nullptr);
        if (distance >= near + way) continue;
        if (distance >= near && !bodies_.passes(b, from, to)) continue;
        out.clear = false;
        out.move = std::max(out.move, way / points_[p].radius);
      }
    }
  return out;
}

double PackGaps::haste(const PackPlaces& before, const PackPlaces& after, Memory& memory) const {
  memory.segments.resize(segments_.size() * bodies());
  memory.points.resize(points_.size() * bodies());
  double worst = 0;
  for (int b = 0; b < bodies(); ++b)
    for (int g = 0; g < static_cast<int>(segments_.size()); ++g) {
      if (!segment_compared_[g * bodies() + b] || segment_stays_clear(g, b, before, after, 0, memory)) continue;
      for (int p = segments_[g].first_point; p < segments_[g].last_point; ++p) {
        if (!compared_[p * bodies() + b]) continue;
        const Vec3 from = before.bodies[b].to_body(before.points[p]), to = after.bodies[b].to_body(after.points[p]);
        const double radius = points_[p].radius, way = (to - from).norm();
        if (way <= 0.5 * radius) continue;
        const double gap = point_bound(p, b, from, 2 * way + radius, memory, nullptr) - radius;
        worst = std::max(worst, way / std::max(0.5 * radius, 0.5 * gap));
      }
    }
  return worst;
}

}  // namespace tendril::dress_pack
