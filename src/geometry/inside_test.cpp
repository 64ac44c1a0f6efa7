#include "geometry/inside_test.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tendril {
namespace {

/// Whether a b > c d, exactly for all but numbers near the smallest that there are.
bool product_greater(double a, double b, double c, double d) {
  const double ab = a * b, cd = c * d;
  if (ab != cd) return ab > cd;
  constexpr double up = 0x1p400;  // keeps what the products lose from being lost again
  const double p = (up * a) * (up * b), q = (up * c) * (up * d);
  return p != q ? p > q : std::fma(up * a, up * b, -p) > std::fma(up * c, up * d, -q);
}

/// The side of the line a-b, seen along x, that p lies on. The same pair of places gives the same bits in either order
/// but for the sign, and a point on the line counts to one side for both orders. A corner enters by its rounded difference
/// from p alone, which is the same for all triangles there: the ray meets one closed surface, moved by less than rounding.
bool left_of(const std::vector<Vec3>& vertices, int a, int b, const Vec3& p) {
  const bool swapped = std::pair(vertices[a].y(), vertices[a].z()) > std::pair(vertices[b].y(), vertices[b].z());
  if (swapped) std::swap(a, b);
  const Vec3 &u = vertices[a], &v = vertices[b];
  return product_greater(u.y() - p.y(), v.z() - p.z(), u.z() - p.z(), v.y() - p.y()) != swapped;
}

bool ray_crosses(const Mesh& mesh, int triangle, const Vec3& p) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const bool side = left_of(mesh.vertices, a, b, p);
  if (left_of(mesh.vertices, b, c, p) != side || left_of(mesh.vertices, c, a, p) != side) return false;
  const Vec3& corner = mesh.vertices[a];
  const auto [least, most] = std::minmax({corner.x(), mesh.vertices[b].x(), mesh.vertices[c].x()});
  if (p.x() < least || p.x() > most) return p.x() < least;
  const Vec3 normal = (mesh.vertices[b] - corner).cross(mesh.vertices[c] - corner);
  // Where the plane is hit along +x: p + t x, t n_x = n . (corner - p); n_x > 0 where p is left of all sides.
  const double ahead = normal.dot(corner - p);
  return side ? ahead > 0 : ahead < 0;
}

}  // namespace

InsideTest::InsideTest(const Mesh& mesh) : mesh_(mesh), box_(mesh.box()) {
  const double columns = std::clamp(std::sqrt(static_cast<double>(mesh.triangles.size())), 1.0, 2048.0);
  for (int k = 0; k < 2; ++k) {
    size_[k] = static_cast<int>(columns);
    cell_[k] = std::max(box_.sizes()[k + 1] / size_[k], 1e-300);
  }
  const auto each = [&](const auto& visit) {
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      int low[2], high[2];
      for (int k = 0; k < 2; ++k) {
        const auto at = [&](int corner) { return mesh.vertices[mesh.triangles[t][corner]][k + 1]; };
        const auto [least, most] = std::minmax({at(0), at(1), at(2)});
        low[k] = std::clamp(static_cast<int>((least - box_.min()[k + 1]) / cell_[k]), 0, size_[k] - 1);
        high[k] = std::clamp(static_cast<int>((most - box_.min()[k + 1]) / cell_[k]), 0, size_[k] - 1);
      }
      for (int z = low[1]; z <= high[1]; ++z)
        for (int y = low[0]; y <= high[0]; ++y) visit(z * size_[0] + y, t);
    }
  };
  first_.assign(size_[0] * size_[1] + 1, 0);
  each([&](int column, int) { ++first_[column + 1]; });
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  triangles_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  each([&](int column, int triangle) { triangles_[next[column]++] = triangle; });
}

int InsideTest::column(double y, double z) const {
  const int at[2] = {std::clamp(static_cast<int>((y - box_.min().y()) / cell_[0]), 0, size_[0] - 1),
                     std::clamp(static_cast<int>((z - box_.min().z()) / cell_[1]), 0, size_[1] - 1)};
  return at[1] * size_[0] + at[0];
}

bool InsideTest::inside(const Vec3& p) const {
  if (!box_.contains(p)) return false;
  const int at = column(p.y(), p.z());
  bool inside = false;
  for (int i = first_[at]; i < first_[at + 1]; ++i) inside ^= ray_crosses(mesh_, triangles_[i], p);
  return inside;
}

}  // namespace tendril
