#include "method/route/route_guess.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "scene/formed_rod.h"

namespace tendril::routing {
namespace {

/// The turn about `frame`'s tangent that brings its d1 nearest to that of `like`.
double turn_to(const Frame& frame, const Frame& like) {
  return std::atan2(like.d1().dot(frame.d2()) - like.d2().dot(frame.d1()), like.d1().dot(frame.d1()) + like.d2().dot(frame.d2()));
}

Way along(const Curve& curve, const Design& design) {
  const double first = turn_to(curve.at(0), design.from), last = turn_to(curve.at(curve.length()), design.to);
  const double twist = std::remainder(last - first, 2 * units::pi) + 2 * units::pi * design.turns;
  return [curve, first, twist, length = design.rod.length](double s) {
    const double share = std::clamp(s / length, 0.0, 1.0);
    Frame frame = curve.at(share * curve.length());
    frame.rotation = frame.rotation * exp_rotation((first + share * twist) * Vec3::UnitZ());
    return frame;
  };
}

std::optional<Way> along_shape(const Rod& rod, const Frame& from, const Frame& to) {
  if (!rod.shape) return std::nullopt;
  const Frame place = from * rod.shape(0).inverse();
  if (((place * rod.shape(rod.length)).at - to.at).norm() > 0.1 * rod.length) return std::nullopt;
  return [place, shape = rod.shape](double s) { return place * shape(s); };
}

}  // namespace

std::optional<Way> way_of(const Design& design) {
  if (design.route) return along(*design.route, design);
  return along_shape(design.rod, design.from, design.to);
}

std::optional<Equilibrium> guess_along_route(const Design& design) {
  const std::optional<Way> way = way_of(design);
  if (!way) return std::nullopt;
  Equilibrium out;
  const int segments = std::max(design.rod.segments, 2);
  for (int i = 0; i <= segments; ++i) {
    const double s = design.rod.length * i / segments;
    const Frame frame = (*way)(s);
    out.s.push_back(s);
    out.points.push_back(frame.at);
    out.rotations.push_back(frame.rotation);
  }
  return out;
}

}  // namespace tendril::routing
