#include "method/assembly/path_smoothing.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

constexpr int samples = 400;
constexpr double may_lose = 0.005;  // of the radius
// A window may not grow faster than this along the path, or averages overtake each other.
constexpr double steepest_window = 1.0;
// Out of a corner a grip gets by several corrections.
constexpr int most_corrections = 8;

/// One grip at evenly spaced times.
using Poses = std::vector<Frame>;

Frame averaged(const Poses& raw, int middle, int half) {
  Vec3 place = Vec3::Zero();
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  for (int i = middle - half; i <= middle + half; ++i) {
    place += raw[i].at;
    const Eigen::Vector4d q = raw[i].rotation.coeffs();
    turn += q.dot(raw[middle].rotation.coeffs()) < 0 ? Eigen::Vector4d(-q) : q;
  }
  Frame frame{place / (2 * half + 1), Quat(turn.normalized())};
  return frame;
}

double distance_at(const InstalledSystem& system, const Vec3& at, double limit) {
  return system.surroundings ? system.surroundings->closest(at, limit).distance : limit;
}

Poses smoothed_grip(const InstalledSystem& system, const Poses& raw, int widest) {
  const int last = static_cast<int>(raw.size()) - 1;
  std::vector<int> half(raw.size());
  for (int i = 0; i <= last; ++i) {
    half[i] = std::min({widest, i, last - i});
    const double keep = distance_at(system, raw[i].at, system.radius) - may_lose * system.radius;
    while (half[i] > 0 && distance_at(system, averaged(raw, i, half[i]).at, system.radius) < keep) half[i] /= 2;
  }
  const int slope = std::max(1, static_cast<int>(steepest_window));
  for (int i = 1; i <= last; ++i) half[i] = std::min(half[i], half[i - 1] + slope);
  for (int i = last - 1; i >= 0; --i) half[i] = std::min(half[i], half[i + 1] + slope);
  Poses smooth(raw.size());
  for (int i = 0; i <= last; ++i) {
    smooth[i] = averaged(raw, i, half[i]);
    // A narrower window than the one that was tested may come nearer.
    const double keep = distance_at(system, raw[i].at, system.radius) - may_lose * system.radius;
    if (distance_at(system, smooth[i].at, system.radius) < keep) smooth[i] = raw[i];
  }
  return smooth;
}

/// m: from surfaces a grip keeps its rod's radius, but near the routed place only what it has there.
double wanted_distance(const InstalledSystem& system, const Grip& grip, const Vec3& routed, const Vec3& at) {
  const double radius = grip.rod < 0 ? system.radius : system.free.rods[grip.rod].rod.section_at(grip.at).radius();
  return std::min(radius, distance_at(system, routed, radius) + (at - routed).norm());
}

}  // namespace

Manipulation kept_clear(const InstalledSystem& system, const Manipulation& raw) {
  Manipulation clear = raw;
  if (!system.surroundings) return clear;
  for (std::size_t g = 0; g < clear.grips.size(); ++g) {
    const Vec3 routed = raw.poses[g].back().at;
    for (Frame& pose : clear.poses[g])
      for (int again = 0; again < most_corrections; ++again) {
        const double wanted = wanted_distance(system, clear.grips[g], routed, pose.at);
        const ClosestPoint closest = system.surroundings->closest(pose.at, wanted);
        if (closest.obstacle < 0 || closest.distance >= wanted - may_lose * system.radius) break;
        const Vec3 away = closest.distance > 0 ? Vec3(pose.at - closest.point) : Vec3(closest.point - pose.at);
        if (away.norm() < 1e-9 * wanted) break;
        pose.at += (wanted - closest.distance) * away.normalized();
      }
  }
  return clear;
}

Manipulation smoothed(const InstalledSystem& system, const Manipulation& raw, double window) {
  Manipulation even;
  even.grips = raw.grips;
  for (int i = 0; i <= samples; ++i) even.times.push_back(static_cast<double>(i) / samples);
  const int widest = static_cast<int>(0.5 * window * samples);
  for (std::size_t g = 0; g < raw.grips.size(); ++g) {
    Poses poses;
    for (const double t : even.times) poses.push_back(raw.pose(static_cast<int>(g), t));
    even.poses.push_back(smoothed_grip(system, poses, widest));
  }
  return even;
}

}  // namespace tendril::assembly
