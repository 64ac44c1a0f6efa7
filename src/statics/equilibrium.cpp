#include "statics/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace tendril {

double Equilibrium::contact_length() const {
  double sum = 0;
  for (const ContactForce& contact : contacts) sum += contact.length;
  return sum;
}

Frame Equilibrium::frame_at(double arc_length) const {
  const auto above = std::upper_bound(s.begin(), s.end(), arc_length);
  const int i = std::clamp<int>(static_cast<int>(above - s.begin()) - 1, 0, static_cast<int>(s.size()) - 2);
  const double h = s[i + 1] - s[i];
  const double t = std::clamp((arc_length - s[i]) / h, 0.0, 1.0), u = 1 - t;
  // Cubic through both vertices along the directors, turned on evenly: what the element's contact points use too.
  const Vec3 ta = h * (rotations[i] * Vec3::UnitZ()), tb = h * (rotations[i + 1] * Vec3::UnitZ());
  const Vec3 at = (1 + 2 * t) * u * u * points[i] + t * t * (3 - 2 * t) * points[i + 1] + t * u * u * ta - t * t * u * tb;
  const Vec3 turn = log_rotation(rotations[i].conjugate() * rotations[i + 1]);
  return {at, (rotations[i] * exp_rotation(t * turn)).normalized()};
}

std::vector<Equilibrium::Sample> Equilibrium::sampled(double spacing) const {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    const double h = s[i + 1] - s[i];
    const int count = std::clamp(static_cast<int>(std::ceil(h / spacing)), 1, 10000);
    for (int k = 0; k < count; ++k) samples.push_back({s[i] + h * k / count, frame_at(s[i] + h * k / count)});
  }
  if (!s.empty()) samples.push_back({s.back(), {points.back(), rotations.back()}});
  return samples;
}

std::vector<double> Equilibrium::bend_radii() const {
  std::vector<double> radii_of_bend(s.size(), INFINITY);
  for (std::size_t i = 0; i < s.size(); ++i) {
    // Curvature is known at mid-segments; a vertex takes the mean of its neighbours, an end carries on linearly.
    auto bend = [&](std::size_t k) { return Vec3(curvatures[k].x(), curvatures[k].y(), 0); };
    const std::size_t last = curvatures.size() - 1;
    Vec3 k;
    if (i > 0 && i <= last)
      k = 0.5 * (bend(i - 1) + bend(i));
    else if (last == 0)
      k = bend(0);
    else
      k = i == 0 ? Vec3(1.5 * bend(0) - 0.5 * bend(1)) : Vec3(1.5 * bend(last) - 0.5 * bend(last - 1));
    if (k.norm() > 0) radii_of_bend[i] = 1 / k.norm();
  }
  return radii_of_bend;
}

double Equilibrium::smallest_bend_radius() const {
  const std::vector<double> all = bend_radii();
  return all.empty() ? INFINITY : *std::min_element(all.begin(), all.end());
}

double Equilibrium::largest_tension() const {
  double largest = -INFINITY;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Quat middle = rotations[i].slerp(0.5, rotations[i + 1]);
    largest = std::max(largest, forces[i].dot(middle * Vec3::UnitZ()));
  }
  return largest;
}

double Equilibrium::largest_strain() const {
  double largest = 0;
  for (std::size_t i = 0; i < strains.size(); ++i) {
    const Vec3 change = curvature_changes[i];
    largest = std::max(largest, std::abs(strains[i].z()) + radii[i] * std::hypot(change.x(), change.y()));
  }
  return largest;
}

double Equilibrium::settled_length() const {
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    // Arc of a circle through both directors: exact to fourth order.
    const double chord = (points[i + 1] - points[i]).norm();
    const double cosine = std::clamp((rotations[i] * Vec3::UnitZ()).dot(rotations[i + 1] * Vec3::UnitZ()), -1.0, 1.0);
    const double angle = std::acos(cosine);
    length += angle > 1e-4 ? chord * 0.5 * angle / std::sin(0.5 * angle) : chord * (1 + angle * angle / 24);
  }
  return length;
}

}  // namespace tendril
