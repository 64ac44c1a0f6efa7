#include "statics/contact_energy.h"

#include <cmath>

namespace tendril {

ContactLaw::Value ContactLaw::at(double delta) const {
  if (!(delta > 0)) return {};
  const double x = delta < knee ? delta : knee;
  const double root = std::sqrt(x);
  Value v{stiffness * x * x * root, 2.5 * stiffness * x * root, 3.75 * stiffness * root};
  const double beyond = delta - x;
  v.energy += beyond * (v.slope + 0.5 * beyond * v.curvature);
  v.slope += beyond * v.curvature;
  return v;
}

ContactLaw ContactLaw::for_overlap(double force_per_length, double radius, double softness) {
  const double overlap = softness * radius;
  return {force_per_length / (2.5 * overlap * std::sqrt(overlap)), 4 * overlap};
}

PointContact contact_at(std::span<const DistanceTerm> terms, double reach, double length, const ContactLaw& law) {
  PointContact sum;
  for (const DistanceTerm& t : terms) {
    if (t.distance < sum.distance) {
      sum.distance = t.distance;
      sum.normal = t.normal;
      sum.obstacle = t.obstacle;
    }
    const double delta = reach - t.distance;
    if (delta <= 0 || t.weight == 0) continue;
    const ContactLaw::Value v = law.at(delta);
    const double w = t.weight * length;
    sum.energy += w * v.energy;
    sum.gradient -= (w * v.slope) * t.normal;
    sum.material += (w * v.curvature) * t.normal * t.normal.transpose();
    sum.curvature -= (w * v.slope) * t.hessian;
  }
  return sum;
}

}  // namespace tendril
