#include "method/preform/end_seeds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "method/pcc/pcc_check.h"
#include "method/pcc/pcc_descent.h"
#include "method/preform/in_parallel.h"
#include "method/preform/pcc_filtering.h"

namespace tendril::preform {

namespace {

// Starts with 2, 3, ... bends: enough that more would rarely find better; see test_preform_optimization.cpp.
constexpr int starts[] = {16, 24, 24, 24, 24};

double share(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

Vec3 any_direction(std::mt19937& random) {
  const double z = 2 * share(random) - 1, angle = 2 * M_PI * share(random), r = std::sqrt(1 - z * z);
  return Vec3(r * std::cos(angle), r * std::sin(angle), z);
}

/// Axes that turn with the ends, so that the starts do.
Mat3 axes_of(const Ends& ends) {
  const Vec3 z = ends.start_along.normalized();
  Vec3 x = Vec3::Zero();
  for (const Vec3& towards : {Vec3(ends.finish - ends.start), ends.finish_along, z.unitOrthogonal()}) {
    x = towards - towards.dot(z) * z;
    if (x.norm() > 1e-6 * towards.norm()) break;
  }
  Mat3 axes;
  axes << x.normalized(), z.cross(x.normalized()), z;
  return axes;
}

/// Vertices on both ends' directions, as far out as bends of up to 160 degrees need, and between them others off the straight by
/// a few radii.
PccPoints start(const Options& options, const Mat3& axes, int bends, std::mt19937& random) {
  const Ends& ends = options.ends;
  const double radius = options.curve.radii.front();
  const auto end_distance = [&] { return options.curve.end_straight + radius * std::tan(1.4 * share(random)); };
  PccPoints seed{{ends.start}, std::vector<double>(bends, radius)};
  const Vec3 first = ends.start + end_distance() * ends.start_along, last = ends.finish - end_distance() * ends.finish_along;
  for (int i = 0; i < bends; ++i) {
    const double way = i / (bends - 1.0);
    Vec3 vertex = (1 - way) * first + way * last;
    if (i > 0 && i + 1 < bends) vertex += 4 * radius * share(random) * (axes * any_direction(random));
    seed.points.push_back(vertex);
  }
  seed.points.push_back(ends.finish);
  return seed;
}

}  // namespace

std::vector<PccPoints> end_seeds(const Options& options, int most, const RunContext& context) {
  const FreeSpace open(Scene(), {}, {options.ends.start, options.ends.finish}, 0);
  const Mat3 axes = axes_of(options.ends);
  std::mt19937 random(1);
  std::vector<PccPoints> from;
  for (int bends = 2; bends <= std::min(options.max_bends, 6); ++bends)
    for (int i = 0; i < starts[bends - 2]; ++i) from.push_back(start(options, axes, bends, random));
  struct Found {
    double rank = std::numeric_limits<double>::infinity();
    PccPoints points;
  };
  std::vector<Found> found(from.size());
  RunContext quiet = context;
  quiet.progress = nullptr;
  in_parallel(from.size(), quiet, "", [&](std::size_t i) {
    const routing::DescentResult r = descend(open, options.curve, options.ends, from[i], {}, context);
    if (!violations(open, options.curve, options.ends, r.curve, 1e-3 * options.curve.radii.front()).empty()) return;
    // Of curves of the same length the one with fewer bends.
    found[i] = {r.length * (1 + 1e-3 * r.curve.bends()), r.curve};
  });
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.rank < b.rank; });
  std::vector<PccPoints> seeds;
  for (const Found& f : found) {
    if (static_cast<int>(seeds.size()) == most || !std::isfinite(f.rank)) break;
    const auto same = [&](const PccPoints& seed) { return curve_distance(seed, f.points) < options.same; };
    if (std::none_of(seeds.begin(), seeds.end(), same)) seeds.push_back(f.points);
  }
  return seeds;
}

}  // namespace tendril::preform
