#include "method/assembly/straight_way.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

using routing::FreeSpace;

// Balls that are tried, in radii, the largest first.
constexpr double balls[] = {4, 3, 2};
// So many arms out there must be room; what rests on a surface is a little nearer to it than its radius.
constexpr double farthest = 3, resting = 2e-3;

/// How far along a straight no surface is nearer than the arm, m; negative: nowhere. Distances grow by no more than a metre in a metre.
double room_from(const FreeSpace& space, const Vec3& from, const Vec3& direction, const HandlePathOptions& options) {
  for (double way = 0; way <= farthest * options.arm;) {
    const double distance = space.gap(from + way * direction, options.arm).value + options.radius;
    if (distance >= options.arm) return way;
    way += std::max(options.arm - distance, 0.1 * options.radius);
  }
  return -1;
}

}  // namespace

std::vector<HandlePath> straight_ways(const FreeSpace& space, const Frame& handle, const HandlePathOptions& options) {
  std::vector<HandlePath> ways;
  if (options.exit || !space.has_obstacles()) return ways;
  for (const double side : {1.0, -1.0}) {
    const double length = room_from(space, handle.at, side * handle.d3(), options);
    if (length <= 0) continue;
    const Vec3 out = handle.at + side * length * handle.d3();
    for (const double ball : balls) {
      if (!space.is_free(handle.at, out, (ball - 1 - resting) * options.radius)) continue;
      ways.push_back({{handle.at, out}, ball * options.radius, length});
      break;
    }
  }
  std::stable_sort(ways.begin(), ways.end(), [](const HandlePath& a, const HandlePath& b) { return a.clearance > b.clearance; });
  return ways;
}

}  // namespace tendril::assembly
