// Pairs of places in the engine bay that hoses may join, and random polylines between them; for benchmarks of routing.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "geometry/import_mesh.h"
#include "method/pcc/pcc_check.h"
#include "method/pcc/pcc_descent.h"
#include "scene/scene.h"

namespace tendril::bench {

/// The engine bay of over a million triangles; assets/engine_bay.ply beside the program.
inline const Scene& engine_bay() {
  static const Scene scene = [] {
    const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "assets";
    PlacedObstacle bay;
    bay.name = "bay";
    bay.body.shape = std::make_shared<const TriangleSurface>(load_mesh((folder / "engine_bay.ply").string(), 1e-3).mesh);
    Scene built;
    built.add(std::move(bay));
    return built;
  }();
  return scene;
}

/// Object radius plus clearance of 20 mm, bends of 50 mm, straights of 20 mm.
inline routing::SpaceDemands bay_space() {
  routing::SpaceDemands demands;
  demands.radius = 0.012;
  demands.clearance = 0.008;
  return demands;
}
inline routing::PccDemands bay_curve() {
  routing::PccDemands demands;
  demands.radii = {0.05};
  demands.min_straight = demands.end_straight = 0.02;
  return demands;
}

inline Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return Vec3(x, y, z).normalized();
}

/// Both places with 100 mm of free straight before them, 0.6 to 1.3 m apart.
inline routing::Ends random_ends(const routing::FreeSpace& space, std::mt19937_64& random) {
  const Eigen::AlignedBox3d box = space.surroundings().box();
  const auto end = [&](double sign, Vec3& at, Vec3& along) {
    std::uniform_real_distribution<> share(0, 1);
    do {
      for (int k = 0; k < 3; ++k) at[k] = box.min()[k] + share(random) * box.sizes()[k];
      along = random_direction(random);
    } while (!space.is_free(at, Vec3(at + sign * 0.1 * along), 1e-3));
  };
  routing::Ends ends;
  double apart;
  do {
    end(1, ends.start, ends.start_along);
    end(-1, ends.finish, ends.finish_along);
    apart = (ends.finish - ends.start).norm();
  } while (apart < 0.6 || apart > 1.3);
  return ends;
}

/// A polyline of 2 to 6 vertices about the way from start to finish, in order along it.
inline routing::PccPoints random_seed(const routing::Ends& ends, double radius, std::mt19937_64& random) {
  const int bends = std::uniform_int_distribution<>(2, 6)(random);
  std::uniform_real_distribution<> share(0, 1);
  std::vector<double> shares(bends);
  for (double& s : shares) s = share(random);
  std::sort(shares.begin(), shares.end());
  const double apart = (ends.finish - ends.start).norm();
  routing::PccPoints seed;
  seed.points.push_back(ends.start);
  for (const double s : shares) {
    const double off = 0.3 * apart * share(random);
    seed.points.push_back(ends.start + s * (ends.finish - ends.start) + off * random_direction(random));
    seed.radii.push_back(radius);
  }
  seed.points.push_back(ends.finish);
  return seed;
}

/// Feasible local optima from `seeds` random polylines between the ends.
inline std::vector<routing::PccPoints> random_optima(const routing::FreeSpace& space, const routing::Ends& ends, int seeds,
                                                     std::mt19937_64& random) {
  std::vector<routing::PccPoints> found;
  for (int k = 0; k < seeds; ++k) {
    const routing::PccPoints seed = random_seed(ends, bay_curve().radii.front(), random);
    const routing::PccPoints curve = routing::descend(space, bay_curve(), ends, seed).curve;
    if (violations(space, bay_curve(), ends, curve).empty()) found.push_back(curve);
  }
  return found;
}

}  // namespace tendril::bench
