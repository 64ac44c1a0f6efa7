// How far apart two curves of straights and arcs are.
#pragma once

#include <vector>

#include "method/pcc/pcc_curve.h"

namespace tendril::routing {

/// Places at equal arc lengths, both ends included; `count` of them, at least 2.
std::vector<Vec3> places_along(const PccPoints& curve, int count, double from, double to);

/// 48 points at equal shares of the arc length, m.
std::vector<Vec3> compared_places(const PccPoints& curve);

/// The largest distance between points at equal shares, m.
double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b);
inline double curve_distance(const PccPoints& a, const PccPoints& b) {
  return largest_distance(compared_places(a), compared_places(b));
}

}  // namespace tendril::routing
