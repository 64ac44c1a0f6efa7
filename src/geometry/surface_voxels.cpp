#include "geometry/surface_voxels.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "geometry/closest_point.h"

namespace tendril {
namespace {

/// More candidates than this, and a triangle is divided: the box of a sloping one is mostly far from it.
constexpr double many_nodes = 150;

class Marker {
 public:
  Marker(const NodeLattice& lattice, std::vector<std::uint8_t>& marks)
      : lattice_(lattice), marks_(marks), reach_(voxel_reach * lattice.spacing) {}

  void mark(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 low = (a.cwiseMin(b).cwiseMin(c).array() - reach_).matrix(), high = (a.cwiseMax(b).cwiseMax(c).array() + reach_).matrix();
    std::array<int, 3> first, last;
    double nodes = 1;
    for (int k = 0; k < 3; ++k) {
      const double from = std::ceil((low[k] - lattice_.origin[k]) / lattice_.spacing);
      const double to = std::floor((high[k] - lattice_.origin[k]) / lattice_.spacing);
      if (!(to >= 0 && from <= lattice_.size[k] - 1)) return;
      nodes *= to - from + 1;
      first[k] = static_cast<int>(std::max(from, 0.0));
      last[k] = static_cast<int>(std::min(to, lattice_.size[k] - 1.0));
    }
    if (nodes > many_nodes) divide(a, b, c);
    else mark(a, b, c, first, last);
  }

 private:
  /// At the middle of the longest side. Needles thinner than a voxel end as pieces of a voxel's length.
  void divide(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    if (bc > ab && bc >= ca) return divide(b, c, a);
    if (ca > ab && ca > bc) return divide(c, a, b);
    const Vec3 middle = 0.5 * (a + b);
    mark(a, middle, c);
    mark(middle, b, c);
  }

  void mark(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<int, 3>& first, const std::array<int, 3>& last) {
    const Vec3 across = (b - a).cross(c - a), middle = (a + b + c) / 3;
    // The normal of a sliver is rounding only: nothing can be said by its plane.
    const double near = reach_ * reach_, longest = std::max((b - a).squaredNorm(), (c - a).squaredNorm());
    const bool has_plane = across.squaredNorm() > 1e-14 * longest * longest;
    const double off_plane = has_plane ? near * across.squaredNorm() * (1 + 1e-5) : std::numeric_limits<double>::infinity();
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          // Other threads may set the same mark: to the same value.
          std::atomic_ref<std::uint8_t> mark(marks_[lattice_.index(i, j, k)]);
          if (mark.load(std::memory_order_relaxed)) continue;
          const Vec3 p = lattice_.node(i, j, k);
          const double height = across.dot(p - a);
          if (height * height > off_plane) continue;
          if ((p - middle).squaredNorm() <= near || closest_on_triangle(p, a, b, c).squared <= near)
            mark.store(1, std::memory_order_relaxed);
        }
  }

  const NodeLattice& lattice_;
  std::vector<std::uint8_t>& marks_;
  double reach_;  ///< m
};

}  // namespace

void mark_surface(const Mesh& mesh, const Mat3& axes, const Vec3& at, const NodeLattice& lattice, std::vector<std::uint8_t>& marks,
                  const RunContext& context) {
  constexpr int chunk = 4096;
  const int triangles = static_cast<int>(mesh.triangles.size()), chunks = (triangles + chunk - 1) / chunk;
  std::atomic<int> next = 0;
  run_workers(std::min(thread_count(context.threads), chunks), [&](int) {
    Marker marker(lattice, marks);
    const auto placed = [&](int vertex) { return Vec3(axes * mesh.vertices[vertex] + at); };
    for (int c; (c = next++) < chunks && !context.stop();)
      for (int t = c * chunk; t < std::min(triangles, (c + 1) * chunk); ++t) {
        const auto& corners = mesh.triangles[t];
        marker.mark(placed(corners[0]), placed(corners[1]), placed(corners[2]));
      }
  });
}

}  // namespace tendril
