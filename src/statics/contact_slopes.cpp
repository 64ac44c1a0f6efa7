#include "statics/contact_slopes.h"

#include <algorithm>

namespace tendril {
namespace {

/// Weighted by the section normals of a point's two vertices: what its lever arms per metre of segment point at.
Vec3 along_normals(double at_a, double at_b, int a, const VertexShape& shape) {
  return at_a * (shape.rotations[a] * Vec3::UnitZ()) + at_b * (shape.rotations[a + 1] * Vec3::UnitZ());
}

/// One point in contact.
struct Touch {
  const ContactPoint& point;
  const PointContact& contact;
  double length;     ///< of its segment
  Vec3 by_length;    ///< how its place goes with that length
  Mat3 hessian;
  Vec3 by_radius;    ///< gradient's derivative by the radius: minus the sum of weight phi'' n

  Touch(const ContactPoint& p, const PointContact& c, std::span<const double> s, const VertexShape& shape)
      : point(p), contact(c), length(s[p.segment + 1] - s[p.segment]), hessian(c.material + c.curvature) {
    by_length = along_normals(p.ta / length, p.tb / length, p.segment, shape);
  }
};

/// Minus the sum of weight phi'' n over the terms at a point; `facing`: of those alone that lie against a direction.
Vec3 gradient_by_radius(const ContactTerms& contacts, const ContactPoint& p, const Vec3& x, double shift, const Vec3* facing) {
  std::vector<DistanceTerm> terms;
  const double reach = p.radius + shift;
  contacts.field().at(p.s).terms_kept(x, reach, p.keep, terms);
  Vec3 sum = Vec3::Zero();
  for (const DistanceTerm& t : terms)
    if (reach > t.distance && (!facing || faces(t, *facing)))
      sum -= (t.weight * p.weight * contacts.set().law.at(reach - t.distance).curvature) * t.normal;
  return sum;
}

/// How a sliding point answers: its energy's slope along the rod depends on the state by `at_a`, `at_b`, on the segment's
/// length and on the radius; divided by its curvature. Zero for a point that stands.
struct Slide {
  Vec6 at_a = Vec6::Zero(), at_b = Vec6::Zero();
  double by_length = 0, by_radius = 0;

  Slide(const SlidingContacts::Point& p, const Touch& t, std::span<const double> s, const VertexShape& shape) {
    if (p.bend >= 0) return;
    const ContactPoint slope = slope_of(p.at, s, Element::se3);
    add_point_force(p.at, shape, t.hessian * p.tangent, at_a, at_b);
    add_point_force(slope, shape, t.contact.gradient, at_a, at_b);
    // d/dh of e_xi = g . (h x'), over h^2 Phi''; the state's part has h once.
    const Vec3 turned = along_normals(slope.ta, slope.tb, p.at.segment, shape);
    const double mixed = t.length * p.tangent.dot(t.hessian * t.by_length) + t.contact.gradient.dot(turned);
    by_length = mixed / (t.length * p.bend);
    by_radius = p.tangent.dot(t.by_radius) / p.bend;
  }
};

/// Arc length of a contact point per unit change of the vertices around it.
double place_of(const ContactPoint& p, std::span<const double> s, std::span<const double> places) {
  const double share = (p.s - s[p.segment]) / (s[p.segment + 1] - s[p.segment]);
  return (1 - share) * places[p.segment] + share * places[p.segment + 1];
}

void add_place(const ContactPoint& p, std::span<const double> s, double slope, std::vector<double>& places) {
  const double share = (p.s - s[p.segment]) / (s[p.segment + 1] - s[p.segment]);
  places[p.segment] += (1 - share) * slope;
  places[p.segment + 1] += share * slope;
}

/// Change of the point's by_length under a step.
Vec3 turned(const Touch& t, const VertexShape& shape, std::span<const Vec6> step) {
  const int a = t.point.segment;
  Vec3 sum = Vec3::Zero();
  for (const auto& [node, weight] : {std::pair{a, t.point.ta}, std::pair{a + 1, t.point.tb}})
    if (weight != 0) sum += weight / t.length * (shape.rotations[node] * Vec3(step[node][4], -step[node][3], 0));
  return sum;
}

/// Calls f(touch, fixed point's number or -1, slide) for everything in contact.
template <class F>
void for_touches(const ContactTerms& contacts, std::span<const double> s, const VertexShape& shape, F f) {
  const ContactSet& set = contacts.set();
  for (int i = 0; i < set.size(); ++i) {
    if (!set.at(i)) continue;
    Touch t(set.points()[i], *set.at(i), s, shape);
    t.by_radius = gradient_by_radius(contacts, t.point, set.positions()[i], set.shifts()[i], nullptr);
    f(t, i, nullptr);
  }
  for (const SlidingContacts::Point& p : contacts.sliding().points()) {
    if (!p.active) continue;
    Touch t(p.at, p.contact, s, shape);
    t.by_radius = gradient_by_radius(contacts, p.at, p.x, p.shift, &p.direction);
    const Slide slide(p, t, s, shape);
    f(t, -1, &slide);
  }
}

}  // namespace

void add_contact_work(const ContactTerms& contacts, std::span<const double> s, const VertexShape& shape,
                      std::span<const Vec6> step, RodSlopes& out) {
  const std::vector<ContactPoint>& points = contacts.set().points();
  const int last = contacts.set().size() - 1;
  for_touches(contacts, s, shape, [&](const Touch& t, int i, const Slide* slide) {
    const int a = t.point.segment;
    const Vec3 way = displacement_of(t.point, shape, step);
    SegmentChange& segment = out.segments[a];
    segment.length += way.dot(t.hessian * t.by_length) + t.contact.gradient.dot(turned(t, shape, step));
    segment.radius += way.dot(t.by_radius);
    if (slide) {
      const double answer = slide->at_a.dot(step[a]) + slide->at_b.dot(step[a + 1]);
      segment.length -= answer * slide->by_length;
      segment.radius -= answer * slide->by_radius;
      return;
    }
    // A fixed point stands for half the way between its neighbours.
    const double by_weight = 0.5 * way.dot(t.contact.gradient) / t.point.weight;
    add_place(points[std::max(i - 1, 0)], s, -by_weight, out.places);
    add_place(points[std::min(i + 1, last)], s, by_weight, out.places);
  });
}

void add_contact_change(const ContactTerms& contacts, std::span<const double> s, const VertexShape& shape,
                        std::span<const double> places, std::span<const double> radii, std::span<Vec6> gradient) {
  const std::vector<ContactPoint>& points = contacts.set().points();
  const int last = contacts.set().size() - 1;
  for_touches(contacts, s, shape, [&](const Touch& t, int i, const Slide* slide) {
    const int a = t.point.segment;
    const double growth = places[a + 1] - places[a];
    Vec3 force = t.hessian * t.by_length * growth + radii[a] * t.by_radius;
    if (slide) {
      const double answer = slide->by_length * growth + slide->by_radius * radii[a];
      gradient[a] -= answer * slide->at_a;
      gradient[a + 1] -= answer * slide->at_b;
    } else {
      const double before = place_of(points[std::max(i - 1, 0)], s, places);
      const double after = place_of(points[std::min(i + 1, last)], s, places);
      force += 0.5 * (after - before) / t.point.weight * t.contact.gradient;
    }
    add_point_force(t.point, shape, force, gradient[a], gradient[a + 1]);
    // The lever arms grow with the segment.
    ContactPoint lever = t.point;
    lever.ra = lever.rb = 0;
    add_point_force(lever, shape, growth / t.length * t.contact.gradient, gradient[a], gradient[a + 1]);
  });
}

}  // namespace tendril
