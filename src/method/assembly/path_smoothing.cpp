#include "method/assembly/path_smoothing.h"

#include <algorithm>
#include <cmath>

namespace tendril::assembly {

namespace {

// Of a path: how far apart they are, in radii.
constexpr double closest_samples = 0.25;
constexpr int least_samples = 100, most_samples = 2000;
constexpr double may_lose = 0.005;  // of the radius
// A window may not grow faster than this along the path, or averages overtake each other.
constexpr double steepest_window = 1.0;
// Out of a corner a grip gets by several corrections.
constexpr int most_corrections = 8;

/// One grip at evenly spaced times.
using Poses = std::vector<Frame>;

/// Means of places and orientations over windows, from sums.
class Averages {
 public:
  explicit Averages(const Poses& raw) : raw_(raw), places_(1, Vec3::Zero()), turns_(1, Eigen::Vector4d::Zero()) {
    Eigen::Vector4d last = raw.front().rotation.coeffs();
    for (const Frame& pose : raw) {
      // Of the two quaternions of an orientation the one nearer to that before it.
      Eigen::Vector4d turn = pose.rotation.coeffs();
      if (turn.dot(last) < 0) turn = -turn;
      places_.push_back(places_.back() + pose.at);
      turns_.push_back(turns_.back() + turn);
      last = turn;
    }
  }
  Frame at(int middle, int half) const {
    if (half == 0) return raw_[middle];
    const int begin = middle - half, end = middle + half + 1;
    return {(places_[end] - places_[begin]) / (end - begin), Quat((turns_[end] - turns_[begin]).normalized())};
  }

 private:
  const Poses& raw_;
  std::vector<Vec3> places_;
  std::vector<Eigen::Vector4d> turns_;
};

double distance_at(const InstalledSystem& system, const Vec3& at, double limit) {
  return system.surroundings ? system.surroundings->closest(at, limit).distance : limit;
}

/// m: from surfaces a grip keeps its rod's radius, but near the routed place only what it has there.
double wanted_distance(const InstalledSystem& system, const Grip& grip, const Vec3& routed, const Vec3& at) {
  const double radius = grip.rod < 0 ? system.radius : system.free.rods[grip.rod].rod.section_at(grip.at).radius();
  return std::min(radius, distance_at(system, routed, radius) + (at - routed).norm());
}

/// Moved out of what is nearer than wanted; out of corners by several corrections.
Vec3 cleared(const InstalledSystem& system, Vec3 at, double wanted) {
  for (int again = 0; again < most_corrections; ++again) {
    const ClosestPoint closest = system.surroundings->closest(at, wanted);
    if (closest.obstacle < 0 || closest.distance >= wanted - may_lose * system.radius) break;
    const Vec3 away = closest.distance > 0 ? Vec3(at - closest.point) : Vec3(closest.point - at);
    if (away.norm() < 1e-9 * wanted) break;
    at += (wanted - closest.distance) * away.normalized();
  }
  return at;
}

/// `raw` keeps the distance that is wanted, as far as it can.
Poses smoothed_grip(const InstalledSystem& system, const Grip& grip, const Poses& raw, int widest) {
  const int last = static_cast<int>(raw.size()) - 1;
  std::vector<int> half(raw.size());
  const Averages averages(raw);
  for (int i = 0; i <= last; ++i) {
    half[i] = std::min({widest, i, last - i});
    const double wanted = wanted_distance(system, grip, raw.back().at, raw[i].at) - may_lose * system.radius;
    while (half[i] > 0 && distance_at(system, averages.at(i, half[i]).at, wanted) < wanted) half[i] /= 2;
  }
  const int slope = std::max(1, static_cast<int>(steepest_window));
  for (int i = 1; i <= last; ++i) half[i] = std::min(half[i], half[i - 1] + slope);
  for (int i = last - 1; i >= 0; --i) half[i] = std::min(half[i], half[i + 1] + slope);
  Poses smooth(raw.size());
  for (int i = 0; i <= last; ++i) {
    smooth[i] = averages.at(i, half[i]);
    // A narrower window than the one that was tested may come nearer.
    if (system.surroundings && half[i] > 0) smooth[i].at = cleared(system, smooth[i].at, wanted_distance(system, grip, raw.back().at, smooth[i].at));
  }
  return smooth;
}

/// At times so close together that straights between poses cut no corners, not even of thin edges.
Manipulation sampled(const InstalledSystem& system, const Manipulation& raw) {
  const int samples = std::clamp(static_cast<int>(raw.moved(0, 1) / (closest_samples * system.radius)), least_samples, most_samples);
  Manipulation even;
  even.grips = raw.grips;
  for (int i = 0; i <= samples; ++i) even.times.push_back(static_cast<double>(i) / samples);
  for (std::size_t g = 0; g < raw.grips.size(); ++g) {
    even.poses.emplace_back();
    for (const double t : even.times) even.poses.back().push_back(raw.pose(static_cast<int>(g), t));
  }
  return even;
}

}  // namespace

Manipulation kept_clear(const InstalledSystem& system, const Manipulation& raw) {
  Manipulation clear = sampled(system, raw);
  if (!system.surroundings) return clear;
  for (std::size_t g = 0; g < clear.grips.size(); ++g) {
    const Vec3 routed = raw.poses[g].back().at;
    for (Frame& pose : clear.poses[g]) pose.at = cleared(system, pose.at, wanted_distance(system, clear.grips[g], routed, pose.at));
  }
  return clear;
}

Manipulation smoothed(const InstalledSystem& system, const Manipulation& raw, double window) {
  Manipulation smooth = sampled(system, raw);
  const int widest = static_cast<int>(0.5 * window * static_cast<double>(smooth.times.size() - 1));
  for (std::size_t g = 0; g < raw.grips.size(); ++g) smooth.poses[g] = smoothed_grip(system, smooth.grips[g], smooth.poses[g], widest);
  return smooth;
}

}  // namespace tendril::assembly
