#include "method/assembly/manipulation.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

constexpr double metres_per_radian = 0.05;

}  // namespace

double travel(const Frame& a, const Frame& b) {
  return (a.at - b.at).norm() + metres_per_radian * a.rotation.angularDistance(b.rotation);
}

Frame Manipulation::pose(int grip, double t) const {
  const std::vector<Frame>& path = poses[grip];
  const auto after = std::upper_bound(times.begin(), times.end(), t);
  if (after == times.begin()) return path.front();
  if (after == times.end()) return path.back();
  const std::size_t i = after - times.begin();
  const double share = (t - times[i - 1]) / (times[i] - times[i - 1]);
  const Frame &a = path[i - 1], &b = path[i];
  return {a.at + share * (b.at - a.at), a.rotation.slerp(share, b.rotation)};
}

double Manipulation::moved(double from, double to) const {
  double farthest = 0;
  for (std::size_t g = 0; g < grips.size(); ++g) {
    // Along the path, corners included.
    double way = 0;
    Frame last = pose(static_cast<int>(g), from);
    for (auto t = std::upper_bound(times.begin(), times.end(), from); t != times.end() && *t < to; ++t) {
      const Frame& corner = poses[g][t - times.begin()];
      way += travel(last, corner);
      last = corner;
    }
    farthest = std::max(farthest, way + travel(last, pose(static_cast<int>(g), to)));
  }
  return farthest;
}

Manipulation Manipulation::reversed() const {
  Manipulation back = *this;
  std::reverse(back.times.begin(), back.times.end());
  for (double& t : back.times) t = 1 - t;
  for (std::vector<Frame>& path : back.poses) std::reverse(path.begin(), path.end());
  return back;
}

}  // namespace tendril::assembly
