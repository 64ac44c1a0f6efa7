#include "method/route/biarc.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace tendril::routing {

namespace {

constexpr double largest_turn = 150 * units::deg;

/// The length d > 0 with |finish - start - d (start_along + finish_along)| = 2 d.
std::optional<double> tangent_length(const Vec3& way, const Vec3& sum) {
  const double square = way.squaredNorm();
  if (!(square > 0)) return std::nullopt;
  // (4 - |sum|^2) d^2 + 2 way.sum d - way.way = 0, solved so that nothing cancels and parallel tangents need no case of their own.
  const double a = std::max(0.0, 4 - sum.squaredNorm()), b = way.dot(sum);
  const double root = std::sqrt(b * b + a * square);
  const double d = b >= 0 ? square / (b + root) : a > 1e-12 ? (root - b) / a : std::numeric_limits<double>::infinity();
  if (!(d > 0) || !std::isfinite(d)) return std::nullopt;
  return d;
}

double angle(const Vec3& a, const Vec3& b) { return 2 * std::atan2((a - b).norm(), (a + b).norm()); }

/// On the arc that leaves `from` along `along` and bends towards `to` (unit), after an angle.
Vec3 on_arc(const Vec3& from, const Vec3& along, const Vec3& to, double turn, double tangent, double share) {
  if (turn < 1e-9) return from + 2 * tangent * share * along;
  const double radius = tangent / std::tan(0.5 * turn), angle = share * turn;
  const Vec3 inwards = (to - along * along.dot(to)).normalized();
  const double half = std::sin(0.5 * angle);
  return from + radius * (std::sin(angle) * along + 2 * half * half * inwards);
}

}  // namespace

Vec3 Biarc::at(double share, const Vec3& start, const Vec3& start_along) const {
  const auto arc_length = [&](int i) { return turns[i] < 1e-9 ? 2 * tangent : radii[i] * turns[i]; };
  const Vec3 middle = (vertices[1] - vertices[0]).normalized();
  const double s = std::clamp(share, 0.0, 1.0) * length, first = arc_length(0);
  if (s <= first) return on_arc(start, start_along, middle, turns[0], tangent, s / first);
  const Vec3 joint = 0.5 * (vertices[0] + vertices[1]);
  return on_arc(joint, middle, finish_along, turns[1], tangent, (s - first) / arc_length(1));
}

std::optional<Biarc> biarc(const Vec3& start, const Vec3& start_along, const Vec3& finish, const Vec3& finish_along) {
  const auto d = tangent_length(finish - start, start_along + finish_along);
  if (!d) return std::nullopt;
  Biarc result;
  result.tangent = *d;
  result.finish_along = finish_along;
  result.vertices[0] = start + *d * start_along;
  result.vertices[1] = finish - *d * finish_along;
  const Vec3 middle = (result.vertices[1] - result.vertices[0]).normalized();
  result.turns[0] = angle(start_along, middle);
  result.turns[1] = angle(middle, finish_along);
  for (int i = 0; i < 2; ++i) {
    if (result.turns[i] > largest_turn) return std::nullopt;
    const bool straight = result.turns[i] < 1e-9;
    result.radii[i] = straight ? std::numeric_limits<double>::infinity() : *d / std::tan(0.5 * result.turns[i]);
    result.length += straight ? 2 * *d : result.radii[i] * result.turns[i];
  }
  return result;
}

}  // namespace tendril::routing
