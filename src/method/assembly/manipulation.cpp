#include "method/assembly/manipulation.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

constexpr double metres_per_radian = 0.05;
// Less is no motion, m.
constexpr double still = 1e-9;

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

double Manipulation::moved(double from, double to) const { return Travelled(*this)(from, to); }

Manipulation Manipulation::reversed() const {
  Manipulation back = *this;
  std::reverse(back.times.begin(), back.times.end());
  for (double& t : back.times) t = 1 - t;
  for (std::vector<Frame>& path : back.poses) std::reverse(path.begin(), path.end());
  return back;
}

Travelled::Travelled(const Manipulation& manipulation) : times_(manipulation.times), ways_(times_.size(), 0.0) {
  for (std::size_t i = 1; i < times_.size(); ++i) {
    double farthest = 0;
    for (const std::vector<Frame>& path : manipulation.poses) farthest = std::max(farthest, travel(path[i - 1], path[i]));
    ways_[i] = ways_[i - 1] + farthest;
  }
}

// Between two times places and orientations change evenly.
double Travelled::until(double t) const {
  const auto after = std::upper_bound(times_.begin(), times_.end(), t);
  if (after == times_.begin()) return ways_.empty() ? 0 : ways_.front();
  if (after == times_.end()) return ways_.back();
  const std::size_t i = after - times_.begin();
  return ways_[i - 1] + (t - times_[i - 1]) / (times_[i] - times_[i - 1]) * (ways_[i] - ways_[i - 1]);
}

double Manipulation::rests_from(int grip) const {
  std::size_t first = times.size() - 1;
  while (first > 0 && travel(poses[grip][first - 1], poses[grip].back()) <= still) --first;
  return times[first];
}

int Manipulation::hands(double t) const {
  int count = 0;
  for (std::size_t g = 0; g < grips.size(); ++g)
    if (!grips[g].connection || t < rests_from(static_cast<int>(g))) ++count;
  return count;
}

}  // namespace tendril::assembly
