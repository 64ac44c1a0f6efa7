#include "statics/contact_slopes.h"

namespace tendril {
namespace {

/// One point in contact, and how its place goes with the length of its segment.
struct Touch {
  const ContactPoint& point;
  const PointContact& contact;
  double length;
  Vec3 by_length = Vec3::Zero();

  Touch(const ContactSet& set, int i, std::span<const double> s, const VertexShape& shape)
      : point(set.points()[i]), contact(*set.at(i)) {
    const int a = point.segment;
    length = s[a + 1] - s[a];
    if (point.ta != 0) by_length += point.ta / length * (shape.rotations[a] * Vec3::UnitZ());
    if (point.tb != 0) by_length += point.tb / length * (shape.rotations[a + 1] * Vec3::UnitZ());
  }
  Mat3 hessian() const { return contact.material + contact.curvature; }
};

/// Sum of weight phi'' n over the terms at the point: minus the gradient's derivative by the reach.
Vec3 gradient_by_reach(const ContactSet& set, int i, std::vector<DistanceTerm>& terms) {
  const ContactPoint& p = set.points()[i];
  const double reach = p.radius + set.shifts()[i];
  terms.clear();
  set.field().terms(set.positions()[i], reach, terms);
  Vec3 sum = Vec3::Zero();
  for (const DistanceTerm& t : terms)
    if (reach > t.distance) sum -= (t.weight * p.weight * set.law.at(reach - t.distance).curvature) * t.normal;
  return sum;
}

/// Arc length of a contact point per unit change of the vertices around it; the weight of point i is half the way between
/// its neighbours.
double place_of(const ContactSet& set, int i, std::span<const double> s, std::span<const double> places) {
  const ContactPoint& p = set.points()[i];
  const double share = (p.s - s[p.segment]) / (s[p.segment + 1] - s[p.segment]);
  return (1 - share) * places[p.segment] + share * places[p.segment + 1];
}

void add_place(const ContactSet& set, int i, std::span<const double> s, double slope, std::vector<double>& places) {
  const ContactPoint& p = set.points()[i];
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

/// What a force at the point is at the nodes, the lever of the section normals scaled by `lever`.
void add_force(const ContactPoint& p, const VertexShape& shape, const Vec3& force, double straight, double lever,
               std::span<Vec6> gradient) {
  const int a = p.segment;
  gradient[a].head<3>() += straight * p.ra * force;
  gradient[a + 1].head<3>() += straight * p.rb * force;
  if (p.ta != 0) gradient[a].tail<3>() += lever * p.ta * Vec3::UnitZ().cross(shape.rotations[a].conjugate() * force);
  if (p.tb != 0) gradient[a + 1].tail<3>() += lever * p.tb * Vec3::UnitZ().cross(shape.rotations[a + 1].conjugate() * force);
}

}  // namespace

void add_contact_work(const ContactSet& set, std::span<const double> s, const VertexShape& shape, std::span<const Vec6> step,
                      RodSlopes& out) {
  std::vector<DistanceTerm> terms;
  for (int i = 0; i < set.size(); ++i) {
    if (!set.at(i)) continue;
    const Touch t(set, i, s, shape);
    const Vec3 way = displacement_of(t.point, shape, step);
    SegmentChange& segment = out.segments[t.point.segment];
    segment.length += way.dot(t.hessian() * t.by_length) + t.contact.gradient.dot(turned(t, shape, step));
    segment.radius += way.dot(gradient_by_reach(set, i, terms));
    const double by_weight = way.dot(t.contact.gradient) / t.point.weight;
    if (i > 0) add_place(set, i - 1, s, -0.5 * by_weight, out.places);
    if (i + 1 < set.size()) add_place(set, i + 1, s, 0.5 * by_weight, out.places);
    if (i == 0 || i + 1 == set.size()) add_place(set, i, s, (i == 0 ? -0.5 : 0.5) * by_weight, out.places);
  }
}

void add_contact_change(const ContactSet& set, std::span<const double> s, const VertexShape& shape,
                        std::span<const double> places, std::span<const double> radii, std::span<Vec6> gradient) {
  std::vector<DistanceTerm> terms;
  for (int i = 0; i < set.size(); ++i) {
    if (!set.at(i)) continue;
    const Touch t(set, i, s, shape);
    const int a = t.point.segment;
    if (!places.empty()) {
      const double growth = places[a + 1] - places[a];
      const double before = place_of(set, std::max(i - 1, 0), s, places);
      const double after = place_of(set, std::min(i + 1, set.size() - 1), s, places);
      const double heavier = 0.5 * (after - before) / t.point.weight;
      add_force(t.point, shape, heavier * t.contact.gradient + t.hessian() * t.by_length * growth, 1, 1, gradient);
      add_force(t.point, shape, t.contact.gradient, 0, growth / t.length, gradient);
    }
    if (!radii.empty()) add_force(t.point, shape, radii[a] * gradient_by_reach(set, i, terms), 1, 1, gradient);
  }
}

}  // namespace tendril
