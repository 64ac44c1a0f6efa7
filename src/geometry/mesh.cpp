#include "geometry/mesh.h"

#include <cmath>
#include <cstdint>
#include <sstream>

#include "base/error.h"
#include "geometry/mesh_topology.h"

namespace tendril {

namespace {

// Vertices in cells a good deal larger than the tolerance, so that a vertex seldom looks into more than one cell.
class WeldGrid {
 public:
  WeldGrid(const std::vector<Vec3>& vertices, double tolerance)
      : vertices_(vertices), tolerance_(tolerance), next_(vertices.size(), -1) {
    double largest = 0;
    for (const Vec3& v : vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
    // Cell numbers must fit in 64 bits with room to spare, also for a tolerance of zero.
    cell_ = std::max({64 * tolerance, largest * 1e-12, 1e-300});
    std::size_t slots = 16;
    while (slots < 2 * vertices.size()) slots *= 2;
    heads_.assign(slots, -1);
  }

  /// The earlier vertex that vertex i coincides with, or i itself, which is then remembered.
  int weld(int i) {
    const Vec3& p = vertices_[i];
    std::int64_t low[3], high[3];
    for (int k = 0; k < 3; ++k) {
      low[k] = static_cast<std::int64_t>(std::floor((p[k] - tolerance_) / cell_));
      high[k] = static_cast<std::int64_t>(std::floor((p[k] + tolerance_) / cell_));
    }
    int best = -1;
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const int found = find(slot(x, y, z), p);
          if (found >= 0 && (best < 0 || found < best)) best = found;
        }
    if (best >= 0) return best;
    const auto cell = [&](int k) { return static_cast<std::int64_t>(std::floor(p[k] / cell_)); };
    int& head = heads_[slot(cell(0), cell(1), cell(2))];
    next_[i] = head;
    head = i;
    return i;
  }

 private:
  std::size_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ull;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(y)) * 0xBF58476D1CE4E5B9ull;
    h = (h ^ (h >> 31) ^ static_cast<std::uint64_t>(z)) * 0x94D049BB133111EBull;
    return (h ^ (h >> 30)) & (heads_.size() - 1);
  }
  int find(std::size_t at, const Vec3& p) const {
    int best = -1;
    for (int j = heads_[at]; j >= 0; j = next_[j])
      if ((vertices_[j] - p).squaredNorm() <= tolerance_ * tolerance_ && (best < 0 || j < best)) best = j;
    return best;
  }

  const std::vector<Vec3>& vertices_;
  double tolerance_, cell_ = 1;
  std::vector<int> heads_, next_;
};

}  // namespace

void Mesh::check() const {
  std::ostringstream said;
  said << "mesh '" << name << "': ";
  if (triangles.empty()) throw UsageError(said.str() + "no triangles; at least one expected");
  if (triangles.size() >= (1u << 30) || vertices.size() >= (1u << 30))
    throw UsageError(said.str() + "too large; fewer than 2^30 triangles and vertices expected");
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!(vertices[i].cwiseAbs().maxCoeff() <= largest_coordinate) || !all_finite(vertices[i])) {
      said << "vertex " << i + 1 << " is (" << vertices[i].transpose() << "); finite numbers within " << largest_coordinate
           << " m expected";
      throw UsageError(said.str());
    }
  const int count = static_cast<int>(vertices.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int index : triangles[t])
      if (index < 0 || index >= count) {
        said << "triangle " << t + 1 << " uses vertex " << index + 1 << "; there are " << count << " vertices";
        throw UsageError(said.str());
      }
}

Eigen::AlignedBox3d Mesh::box() const {
  Eigen::AlignedBox3d box;
  for (const auto& t : triangles)
    for (int i : t) box.extend(vertices[i]);
  return box;
}

double Mesh::area() const {
  double twice = 0;
  for (const auto& t : triangles)
    twice += (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]).norm();
  return 0.5 * twice;
}

double Mesh::volume() const {
  if (triangles.empty()) return 0;
  // Relative to a point of the mesh: far from the origin the tetrahedra would cancel badly.
  const Vec3 origin = vertices[triangles[0][0]];
  double six = 0;
  for (const auto& t : triangles)
    six += (vertices[t[0]] - origin).dot((vertices[t[1]] - origin).cross(vertices[t[2]] - origin));
  return six / 6;
}

Mesh Mesh::moved(const Vec3& at, const Quat& rotation, double scale) const {
  Mesh result = *this;
  const Mat3 linear = scale * rotation.toRotationMatrix();
  for (Vec3& v : result.vertices) v = linear * v + at;
  return result;
}

double weld_tolerance(const Mesh& mesh) {
  const Eigen::AlignedBox3d box = mesh.box();
  return box.isEmpty() ? 0 : 1e-7 * box.diagonal().norm();
}

std::vector<int> weld_map(const std::vector<Vec3>& vertices, double tolerance) {
  WeldGrid grid(vertices, tolerance);
  std::vector<int> map(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) map[i] = grid.weld(static_cast<int>(i));
  return map;
}

Welded welded(const Mesh& mesh, double tolerance) {
  Welded result;
  result.mesh.name = mesh.name;
  const std::vector<int> map = weld_map(mesh.vertices, tolerance);
  for (std::size_t i = 0; i < map.size(); ++i) result.merged_vertices += map[i] != static_cast<int>(i);

  std::vector<std::array<int, 3>> mapped(mesh.triangles.size());
  for (std::size_t t = 0; t < mapped.size(); ++t)
    for (int k = 0; k < 3; ++k) mapped[t][k] = map[mesh.triangles[t][k]];
  const std::vector<TriangleKind> kinds = classify(mapped, static_cast<int>(mesh.vertices.size()));

  std::vector<int> place(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mapped.size(); ++t) {
    result.degenerate_triangles += kinds[t] == TriangleKind::degenerate;
    result.repeated_triangles += kinds[t] == TriangleKind::repeated;
    if (kinds[t] != TriangleKind::regular) continue;
    for (int& index : mapped[t]) {
      if (place[index] < 0) {
        place[index] = static_cast<int>(result.mesh.vertices.size());
        result.mesh.vertices.push_back(mesh.vertices[index]);
      }
      index = place[index];
    }
    result.mesh.triangles.push_back(mapped[t]);
  }
  return result;
}

}  // namespace tendril
