#include "geometry/tube_surface.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace tendril {

namespace {

void check(const std::vector<double>& rings, double outer, double inner, int sides) {
  if (!(std::isfinite(outer) && inner >= 0 && inner < outer))
    throw UsageError("tube: diameters of " + number_text(outer) + " m outside and " + number_text(inner) +
                     " m inside; 0 <= inside < outside expected");
  if (sides < 3) throw UsageError("tube: " + std::to_string(sides) + " sides; at least 3 expected");
  bool rise = rings.size() >= 2;
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) rise = rise && rings[i] < rings[i + 1];
  if (!rise) throw UsageError("tube: the rings' arc lengths do not rise; at least 2, each above the last, expected");
}

class TubeBuilder {
 public:
  TubeBuilder(int sides, Mesh& mesh) : sides_(sides), mesh_(mesh) {
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * units::pi * k / sides;
      circle_.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
  }

  /// Returns the index of its first vertex.
  int ring(const Frame& frame, double radius) {
    const int first = static_cast<int>(mesh_.vertices.size());
    for (const Vec3& p : circle_) mesh_.vertices.push_back(frame.at + frame.rotation * Vec3(radius * p));
    return first;
  }

  /// Between two rings; `outwards`: away from the curve.
  void wall(int from, int to, bool outwards) {
    for (int k = 0; k < sides_; ++k) {
      const int next = (k + 1) % sides_;
      quad(from + k, from + next, to + next, to + k, outwards);
    }
  }

  /// A flat end that faces along `frame`'s d3, or against it.
  void end(const Frame& frame, double outer, double inner, bool along) {
    const int rim = ring(frame, outer);
    if (inner > 0) {
      const int hole = ring(frame, inner);
      for (int k = 0; k < sides_; ++k) {
        const int next = (k + 1) % sides_;
        quad(rim + k, rim + next, hole + next, hole + k, along);
      }
      return;
    }
    const int middle = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.push_back(frame.at);
    for (int k = 0; k < sides_; ++k) triangle(rim + k, rim + (k + 1) % sides_, middle, along);
  }

 private:
  void triangle(int a, int b, int c, bool forwards) {
    mesh_.triangles.push_back(forwards ? std::array{a, b, c} : std::array{a, c, b});
  }
  void quad(int a, int b, int c, int d, bool forwards) {
    triangle(a, b, c, forwards);
    triangle(a, c, d, forwards);
  }

  int sides_;
  Mesh& mesh_;
  std::vector<Vec3> circle_;
};

}  // namespace

int sides_for(double radius, double tolerance) {
  const double share = std::clamp(tolerance / radius, 0.0, 1.0);
  const double half = 2 * std::asin(std::sqrt(0.5 * share));  // cos(half) = 1 - share
  if (!(half > 0)) return 512;
  return static_cast<int>(std::clamp(std::ceil(units::pi / half), 8.0, 512.0));
}

Mesh tube_surface(const Curve& curve, const std::vector<double>& rings, double outer, double inner, int sides) {
  check(rings, outer, inner, sides);
  Mesh mesh;
  mesh.name = "tube";
  TubeBuilder builder(sides, mesh);
  int last = -1, last_inside = -1;
  for (const double s : rings) {
    const Frame frame = curve.at(s);
    const int next = builder.ring(frame, 0.5 * outer);
    if (last >= 0) builder.wall(last, next, true);
    last = next;
    if (!(inner > 0)) continue;
    const int inside = builder.ring(frame, 0.5 * inner);
    if (last_inside >= 0) builder.wall(last_inside, inside, false);
    last_inside = inside;
  }
  builder.end(curve.at(rings.front()), 0.5 * outer, 0.5 * inner, false);
  builder.end(curve.at(rings.back()), 0.5 * outer, 0.5 * inner, true);
  return mesh;
}

Mesh tube_surface(const std::vector<Frame>& sections, const std::vector<double>& radii, int sides) {
  if (sections.size() < 2 || radii.size() != sections.size() || sides < 3)
    throw UsageError("tube: " + std::to_string(sections.size()) + " sections, " + std::to_string(radii.size()) + " radii and " +
                     std::to_string(sides) + " sides; at least 2 sections, a radius each and 3 sides expected");
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (!(std::isfinite(radii[i]) && radii[i] > 0 && sections[i].at.allFinite() && sections[i].rotation.coeffs().allFinite()))
      throw UsageError("tube: section " + std::to_string(i + 1) + " is not finite, or its radius of " + number_text(radii[i]) +
                       " m is not above 0");
  Mesh mesh;
  mesh.name = "tube";
  TubeBuilder builder(sides, mesh);
  int last = -1;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const int next = builder.ring(sections[i], radii[i]);
    if (last >= 0) builder.wall(last, next, true);
    last = next;
  }
  builder.end(sections.front(), radii.front(), 0, false);
  builder.end(sections.back(), radii.back(), 0, true);
  return mesh;
}

std::vector<int> section_of_vertex(int sections, int sides) {
  std::vector<int> of;
  for (int i = 0; i < sections; ++i) of.insert(of.end(), static_cast<std::size_t>(sides), i);
  of.insert(of.end(), static_cast<std::size_t>(sides + 1), 0);
  of.insert(of.end(), static_cast<std::size_t>(sides + 1), sections - 1);
  return of;
}

}  // namespace tendril
