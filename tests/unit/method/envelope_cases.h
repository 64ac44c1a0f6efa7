// Rods for the tests of envelopes, and the points of their surfaces.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "base/units.h"
#include "geometry/inside_test.h"
#include "geometry/mesh_topology.h"
#include "method/envelope/envelope.h"

namespace tendril::test {

/// Outcomes of rods given by their vertices: three numbers each.
struct Places {
  std::vector<EnvelopeRod> rods;
  std::vector<std::vector<double>> numbers;  ///< by outcome * rods + rod

  int outcomes() const { return static_cast<int>(numbers.size() / rods.size()); }
  std::span<const double> operator()(int outcome, int rod) const { return numbers[outcome * rods.size() + rod]; }
  Vec3 vertex(int outcome, int rod, int v) const {
    const auto n = (*this)(outcome, rod);
    return {n[3 * v], n[3 * v + 1], n[3 * v + 2]};
  }
  void add(const std::vector<Vec3>& vertices) {
    std::vector<double> rod;
    for (const Vec3& v : vertices) rod.insert(rod.end(), {v.x(), v.y(), v.z()});
    numbers.push_back(std::move(rod));
  }
};

inline EnvelopeOutcomes collected(const Places& places, EnvelopeOutcomes::Keep keep = EnvelopeOutcomes::Keep::hull) {
  EnvelopeOutcomes outcomes(places.rods, keep);
  outcomes.add_points(places.outcomes(), places);
  return outcomes;
}

/// Curved rods that smooth random modes move.
inline Places random_places(unsigned seed, int rods, int segments, int outcomes, double radius, double spread) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) { return Vec3(size * normal(random), size * normal(random), size * normal(random)); };
  Places places;
  places.rods.assign(rods, {std::vector<double>(segments, radius), 1});
  std::vector<Vec3> from, to;
  for (int r = 0; r < rods; ++r) from.push_back(vector(0.1)), to.push_back(from[r] + vector(0.15));
  for (int k = 0; k < outcomes; ++k)
    for (int r = 0; r < rods; ++r) {
      const Vec3 modes[2] = {vector(spread), vector(0.5 * spread)};
      std::vector<Vec3> vertices;
      for (int i = 0; i <= segments; ++i) {
        const double s = static_cast<double>(i) / segments;
        vertices.push_back(from[r] + s * (to[r] - from[r]) + Vec3(0, 0, 0.1 * s * (1 - s)) +
                           std::sin(units::pi * s) * modes[0] + std::sin(2 * units::pi * s) * modes[1]);
      }
      places.add(vertices);
    }
  return places;
}

/// A point of a capsule's surface about the segment a-b.
inline Vec3 capsule_point(const Vec3& a, const Vec3& b, double radius, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
  const Vec3 along = (b - a).normalized();
  const double lean = along.dot(direction);
  if (random() % 3 == 0) return (lean > 0 ? b : a) + radius * direction;  // an end
  const double share = std::uniform_real_distribution<double>(0, 1)(random);
  return a + share * (b - a) + radius * (direction - lean * along).normalized();
}

/// How many of `samples` points of the outcomes' surfaces lie outside the mesh.
template <class Use>
int points_outside(const Envelope& envelope, const Places& places, int samples, unsigned seed, const Use& use) {
  const InsideTest test(envelope.mesh);
  std::mt19937 random(seed);
  int outside = 0;
  for (int i = 0; i < samples; ++i) {
    const int outcome = static_cast<int>(random() % places.outcomes()), rod = static_cast<int>(random() % places.rods.size());
    if (!use(outcome)) continue;
    const int segment = static_cast<int>(random() % places.rods[rod].radii.size());
    outside += !test.inside(capsule_point(places.vertex(outcome, rod, segment), places.vertex(outcome, rod, segment + 1),
                                          places.rods[rod].radii[segment], random));
  }
  return outside;
}

inline int points_outside(const Envelope& envelope, const Places& places, int samples, unsigned seed) {
  return points_outside(envelope, places, samples, seed, [](int) { return true; });
}

inline bool closed_and_manifold(const Mesh& mesh) {
  const MeshTopology topology = topology_of(mesh, weld_tolerance(mesh));
  return topology.watertight() && topology.degenerate_triangles == 0 && topology.repeated_triangles == 0;
}

}  // namespace tendril::test
