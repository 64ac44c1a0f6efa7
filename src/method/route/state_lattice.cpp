#include "method/route/state_lattice.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril::routing {

namespace {

using Triangles = std::vector<std::array<int, 3>>;

/// The corners of an icosahedron; triangles are the triples of neighbours.
std::vector<Vec3> icosahedron(Triangles& triangles) {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vec3> corners;
  for (int axis = 0; axis < 3; ++axis)
    for (const double one : {1.0, -1.0})
      for (const double other : {golden, -golden}) {
        Vec3 v = Vec3::Zero();
        v[(axis + 1) % 3] = one;
        v[(axis + 2) % 3] = other;
        corners.push_back(v.normalized());
      }
  const double edge = 1.1 * (corners[0] - corners[2]).norm();
  const auto near = [&](int a, int b) { return (corners[a] - corners[b]).norm() < std::min(edge, 1.2); };
  for (int a = 0; a < 12; ++a)
    for (int b = a + 1; b < 12; ++b)
      for (int c = b + 1; c < 12; ++c)
        if (near(a, b) && near(b, c) && near(a, c)) triangles.push_back({a, b, c});
  return corners;
}

}  // namespace

std::vector<Vec3> geodesic_directions(int times) {
  Triangles triangles;
  std::vector<Vec3> directions = icosahedron(triangles);
  for (int level = 0; level < times; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(directions.size()));
      if (is_new) directions.push_back((directions[a] + directions[b]).normalized());
      return at->second;
    };
    Triangles finer;
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  return directions;
}

StateLattice::StateLattice(double step, double radius, double spacing, int divisions, double longest)
    : step_(step), radius_(radius), directions_(geodesic_directions(divisions)) {
  // Neighbouring directions are some 36 degrees apart after one division: an arc of radius R needs 0.63 R for that, and the grid
  // some freedom more.
  longest_ = longest > 0 ? longest : std::max(4 * step, 1.6 * radius);
  if (longest_ / step > 60)
    throw UsageError("route: the grid's step of " + number_text(step) + " m is too small for a bend radius of " + number_text(radius) +
                     " m; a step of at least " + number_text(1.6 * radius / 60) + " m expected");
  primitives_.resize(directions_.size());
  for (int from = 0; from < static_cast<int>(directions_.size()); ++from)
    for (int to = 0; to < static_cast<int>(directions_.size()); ++to) add_primitives(from, to, spacing);
}

std::size_t StateLattice::primitives() const {
  std::size_t count = 0;
  for (const auto& list : primitives_) count += list.size();
  return count;
}

// Of all offsets that join the two directions: the shortest, the one that turns least, and the one that turns least among those
// that lead to another side.
void StateLattice::add_primitives(int from, int to, double spacing) {
  struct Found {
    Biarc arcs;
    std::array<int, 3> offset;
    double turn() const { return arcs.turns[0] + arcs.turns[1]; }
  };
  const Vec3 &a = directions_[from], &b = directions_[to];
  if (std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * radius_ > longest_) return;
  std::vector<Found> found;
  const int reach = static_cast<int>(std::floor(longest_ / step_));
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) {
        const Vec3 way = step_ * Vec3(x, y, z);
        if (way.norm() > longest_ || way.dot(a + b) <= 0) continue;
        const auto arcs = biarc(Vec3::Zero(), a, way, b);
        if (arcs && arcs->smallest_radius() >= radius_ * (1 - 1e-9) && arcs->length <= longest_) found.push_back({*arcs, {x, y, z}});
      }
  if (found.empty()) return;
  std::vector<const Found*> chosen;
  const auto choose = [&](auto&& less, auto&& admits) {
    const Found* best = nullptr;
    for (const Found& f : found)
      if (admits(f) && (!best || less(f, *best))) best = &f;
    if (best && std::find(chosen.begin(), chosen.end(), best) == chosen.end()) chosen.push_back(best);
  };
  const auto any = [](const Found&) { return true; };
  const auto shorter = [](const Found& f, const Found& g) { return f.arcs.length < g.arcs.length - 1e-12; };
  const auto turns_less = [](const Found& f, const Found& g) {
    return f.turn() < g.turn() - 1e-9 || (f.turn() < g.turn() + 1e-9 && f.arcs.length < g.arcs.length - 1e-12);
  };
  choose(shorter, any);
  choose(turns_less, any);
  choose(turns_less, [&](const Found& f) {
    const Eigen::Map<const Eigen::Vector3i> v(f.offset.data());
    return std::all_of(chosen.begin(), chosen.end(), [&](const Found* c) {
      const Eigen::Map<const Eigen::Vector3i> w(c->offset.data());
      return !v.cross(w).isZero();
    });
  });
  for (const Found* f : chosen) {
    Primitive primitive{f->offset, to, f->arcs.length, {}};
    const int pieces = std::max(1, static_cast<int>(std::ceil(f->arcs.length / spacing)));
    for (int i = 1; i <= pieces; ++i) primitive.samples.push_back(f->arcs.at(double(i) / pieces, Vec3::Zero(), a));
    primitives_[from].push_back(std::move(primitive));
  }
}

}  // namespace tendril::routing
