#include "view/prepared_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace tendril {
namespace {

using Eigen::Vector3f;
using Triangle = std::array<std::uint32_t, 3>;

const float crease_cosine = static_cast<float>(std::cos(crease_angle));

/// Distinct places, and the triangles in terms of them.
struct Joined {
  std::vector<Vector3f> positions;
  std::vector<float> values;  ///< one a position, or none
  std::vector<Triangle> triangles;
  std::size_t left_out = 0;
};

/// For every vertex of the mesh the index of its place. Places closer than the grid's step (a few parts in a million of
/// the mesh's size) are one, unless a grid line runs between them.
std::vector<std::uint32_t> places(const std::vector<Vector3f>& points, std::vector<Vector3f>& distinct) {
  Vector3f low = Vector3f::Constant(INFINITY), high = Vector3f::Constant(-INFINITY);
  for (const Vector3f& p : points)
    if (p.allFinite()) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const float step = std::max(2e-6f * (high - low).maxCoeff(), 1e-30f);
  const std::size_t slots = std::bit_ceil(2 * points.size() + 1);
  struct Slot {
    std::uint64_t key;
    std::uint32_t place;
  };
  constexpr std::uint32_t empty = 0xffffffff;
  std::vector<Slot> table(slots, {0, empty});
  std::vector<std::uint32_t> place(points.size(), empty);
  distinct.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    const Vector3f cell = (points[i] - low) / step;  // below 2^19.9 in each direction: 21 bits hold it
    const auto bits = [](float x) { return static_cast<std::uint64_t>(x + 0.5f); };
    const std::uint64_t key = bits(cell.x()) << 42 | bits(cell.y()) << 21 | bits(cell.z());
    std::uint64_t hash = key * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 29;
    std::size_t slot = (hash * 0xbf58476d1ce4e5b9ull >> 20) & (slots - 1);
    while (table[slot].place != empty && table[slot].key != key) slot = (slot + 1) & (slots - 1);
    if (table[slot].place == empty) {
      table[slot] = {key, static_cast<std::uint32_t>(distinct.size())};
      distinct.push_back(points[i]);
    }
    place[i] = table[slot].place;
  }
  return place;
}

Joined joined(const PictureSurface& surface, const Vec3& origin) {
  const Mat3 turn = surface.pose.rotation.toRotationMatrix();
  const Vec3 shift = surface.pose.at - origin;
  std::vector<Vector3f> points(surface.vertices.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = (turn * surface.vertices[i] + shift).cast<float>();
  Joined result;
  const std::vector<std::uint32_t> place = places(points, result.positions);
  result.triangles.reserve(surface.triangles.size());
  if (!surface.values.empty()) result.values.assign(result.positions.size(), no_value);
  for (std::size_t i = 0; i < surface.values.size(); ++i)
    if (place[i] != 0xffffffff && std::isfinite(surface.values[i])) result.values[place[i]] = static_cast<float>(surface.values[i]);
  for (const std::array<std::int32_t, 3>& triangle : surface.triangles) {
    Triangle t{};
    bool good = true;
    for (int k = 0; k < 3 && good; ++k) {
      good =
          triangle[k] >= 0 && static_cast<std::size_t>(triangle[k]) < place.size() && place[triangle[k]] != 0xffffffff;
      if (good) t[k] = place[triangle[k]];
    }
    if (!good) ++result.left_out;
    else if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.triangles.push_back(t);
  }
  return result;
}

/// Twice the area along the unit normal.
std::vector<Vector3f> area_normals(const Joined& mesh) {
  std::vector<Vector3f> normals(mesh.triangles.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Vector3f& a = mesh.positions[t[0]];
    normals[i] = (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a);
  }
  return normals;
}

/// Corners (3 * triangle + k) around every place.
struct Corners {
  std::vector<std::uint32_t> start, corner;
};

Corners corners_of(const Joined& mesh) {
  Corners corners;
  corners.start.assign(mesh.positions.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t place : t) ++corners.start[place + 1];
  for (std::size_t i = 1; i < corners.start.size(); ++i) corners.start[i] += corners.start[i - 1];
  corners.corner.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(corners.start.begin(), corners.start.end() - 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) corners.corner[next[mesh.triangles[i][k]]++] = static_cast<std::uint32_t>(3 * i + k);
  return corners;
}

/// Vertices with normals: a place splits into one vertex for every bundle of triangles that runs on smoothly there.
void add_smooth_vertices(const Joined& mesh, const std::vector<Vector3f>& unit, const std::vector<Vector3f>& area,
                         const Corners& corners, PreparedMesh& result) {
  result.triangles.resize(3 * mesh.triangles.size());
  result.positions.reserve(mesh.positions.size() * 5 / 4);
  result.normals.reserve(mesh.positions.size() * 5 / 4);
  struct Bundle {
    Vector3f lead, sum;
    std::uint32_t vertex;
  };
  std::vector<Bundle> bundles;
  constexpr std::size_t most_bundles = 48;  // bounds the search at the apex of a wild fan
  for (std::size_t place = 0; place < mesh.positions.size(); ++place) {
    bundles.clear();
    for (std::uint32_t i = corners.start[place]; i < corners.start[place + 1]; ++i) {
      const std::uint32_t corner = corners.corner[i], face = corner / 3;
      Bundle* home = nullptr;
      for (std::size_t b = bundles.size() > most_bundles ? bundles.size() : 0; b < bundles.size() && !home; ++b)
        if (std::abs(bundles[b].lead.dot(unit[face])) >= crease_cosine) home = &bundles[b];
      if (!home) {
        bundles.push_back({unit[face], Vector3f::Zero(), static_cast<std::uint32_t>(result.positions.size())});
        result.positions.push_back(mesh.positions[place]);
        if (!mesh.values.empty()) result.values.push_back(mesh.values[place]);
        home = &bundles.back();
      }
      home->sum += home->lead.dot(unit[face]) < 0 ? Vector3f(-area[face]) : area[face];
      result.triangles[corner] = home->vertex;
    }
    for (const Bundle& bundle : bundles) {
      const float length = bundle.sum.norm();
      result.normals.push_back(octahedral(length > 0 ? Vector3f(bundle.sum / length) : Vector3f::UnitZ()));
    }
  }
}

/// One triangle's side that starts at the smaller of two places.
struct Side {
  std::uint32_t other, face, corner;
  bool forward;
};

/// Whether the triangles along one edge make it a feature.
bool is_feature(const Side* first, const Side* last, const std::vector<Vector3f>& unit) {
  const std::size_t count = static_cast<std::size_t>(last - first);
  if (count == 1) return true;
  const Vector3f& lead = unit[first->face];
  if (count == 2) {
    const float cosine = lead.dot(unit[first[1].face]);
    return (first->forward == first[1].forward ? -cosine : cosine) < crease_cosine;
  }
  return std::any_of(first + 1, last,
                     [&](const Side& side) { return std::abs(lead.dot(unit[side.face])) < crease_cosine; });
}

void add_edges(const Joined& mesh, const std::vector<Vector3f>& unit, const Corners& corners, PreparedMesh& result) {
  std::vector<Side> sides;
  for (std::uint32_t place = 0; place < mesh.positions.size(); ++place) {
    sides.clear();
    for (std::uint32_t i = corners.start[place]; i < corners.start[place + 1]; ++i) {
      const std::uint32_t corner = corners.corner[i], face = corner / 3, k = corner % 3;
      if (unit[face].isZero()) continue;  // no area, no say
      const Triangle& t = mesh.triangles[face];
      const std::uint32_t next = (k + 1) % 3, previous = (k + 2) % 3;
      if (t[next] > place) sides.push_back({t[next], face, 3 * face + next, true});
      if (t[previous] > place) sides.push_back({t[previous], face, 3 * face + previous, false});
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.other != b.other ? a.other < b.other : a.face < b.face; });
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t end = i + 1;
      while (end < sides.size() && sides[end].other == sides[i].other) ++end;
      if (is_feature(sides.data() + i, sides.data() + end, unit)) {
        const std::uint32_t k = sides[i].corner % 3;
        const std::uint32_t base = 3 * sides[i].face;
        const std::uint32_t here = sides[i].forward ? (k + 2) % 3 : (k + 1) % 3;
        result.edges.push_back(result.triangles[base + here]);
        result.edges.push_back(result.triangles[sides[i].corner]);
      }
      i = end;
    }
  }
}

/// Sorts groups of `size` indices by the grid cell of their middle, and lists the runs.
std::vector<MeshPiece> sort_into_pieces(const std::vector<Vector3f>& positions, std::vector<std::uint32_t>& indices,
                                        int size) {
  const std::size_t count = indices.size() / size;
  if (count == 0) return {};
  Vector3f low = Vector3f::Constant(INFINITY), high = Vector3f::Constant(-INFINITY);
  for (const Vector3f& p : positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const int cells = std::clamp(static_cast<int>(std::cbrt(count / 512.0)), 1, 12);
  const Vector3f scale = (cells * 0.99999f) * (high - low).cwiseMax(Vector3f::Constant(1e-30f)).cwiseInverse();
  std::vector<std::uint16_t> cell(count);
  std::vector<std::uint32_t> start(cells * cells * cells + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    Vector3f middle = Vector3f::Zero();
    for (int k = 0; k < size; ++k) middle += positions[indices[i * size + k]];
    // Limited before it is a whole number: across a flat mesh a rounding error is a huge number of cells.
    const Vector3f place = (middle / static_cast<float>(size) - low).cwiseProduct(scale);
    const Eigen::Vector3i at = place.cwiseMax(0.0f).cwiseMin(static_cast<float>(cells - 1)).cast<int>();
    cell[i] = static_cast<std::uint16_t>((at.z() * cells + at.y()) * cells + at.x());
    ++start[cell[i] + 1u];
  }
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  std::vector<MeshPiece> pieces;
  for (std::size_t c = 0; c + 1 < start.size(); ++c)
    if (start[c + 1] > start[c])
      pieces.push_back({start[c] * size, (start[c + 1] - start[c]) * size, Vector3f::Constant(INFINITY),
                        Vector3f::Constant(-INFINITY)});
  std::vector<std::uint32_t> sorted(indices.size());
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(&sorted[std::size_t{start[cell[i]]++} * size], &indices[i * size], size * sizeof(std::uint32_t));
  indices.swap(sorted);
  for (MeshPiece& piece : pieces)
    for (std::uint32_t i = piece.first; i < piece.first + piece.count; ++i) {
      piece.low = piece.low.cwiseMin(positions[indices[i]]);
      piece.high = piece.high.cwiseMax(positions[indices[i]]);
    }
  return pieces;
}

}  // namespace

std::array<std::int16_t, 2> octahedral(const Vector3f& normal) {
  const float size = std::abs(normal.x()) + std::abs(normal.y()) + std::abs(normal.z());
  float x = normal.x() / size, y = normal.y() / size;
  if (normal.z() < 0) {
    const float folded = (1 - std::abs(y)) * (x < 0 ? -1.0f : 1.0f);
    y = (1 - std::abs(x)) * (y < 0 ? -1.0f : 1.0f);
    x = folded;
  }
  const auto code = [](float v) { return static_cast<std::int16_t>(std::lround(std::clamp(v, -1.0f, 1.0f) * 32767)); };
  return {code(x), code(y)};
}

PreparedMesh prepare_mesh(const PictureSurface& surface, const Vec3& origin) {
  const Joined mesh = joined(surface, origin);
  PreparedMesh result;
  result.left_out = mesh.left_out;
  const std::vector<Vector3f> area = area_normals(mesh);
  std::vector<Vector3f> unit(area.size());
  for (std::size_t i = 0; i < area.size(); ++i) {
    const float length = area[i].norm();
    unit[i] = length > 0 ? Vector3f(area[i] / length) : Vector3f::Zero();
  }
  const Corners corners = corners_of(mesh);
  add_smooth_vertices(mesh, unit, area, corners, result);
  if (surface.edges) add_edges(mesh, unit, corners, result);
  result.triangle_pieces = sort_into_pieces(result.positions, result.triangles, 3);
  result.edge_pieces = sort_into_pieces(result.positions, result.edges, 2);
  return result;
}

}  // namespace tendril
