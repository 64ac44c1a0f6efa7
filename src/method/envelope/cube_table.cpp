#include "method/envelope/cube_table.h"

#include <vector>

namespace tendril::envelope {
namespace {

/// The edge between two corners that differ in one axis.
int edge_between(int a, int b) {
  const int axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2, low = a & b;
  const int x = low & 1, y = low >> 1 & 1, z = low >> 2;
  return 4 * axis + (axis == 0 ? y + 2 * z : axis == 1 ? x + 2 * z : x + 2 * y);
}

/// The corners of a face, counter-clockwise from outside. Face 2 * axis + side.
std::array<int, 4> face_corners(int face) {
  const int axis = face / 2, side = face % 2, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
  const int at = side << axis;
  if (side == 1) return {at, at + u, at + u + v, at + v};
  return {at, at + v, at + u + v, at + u};
}

/// The two faces of an edge, as bits.
int faces_of(int edge) {
  int faces = 0;
  const int from = edge_corner(edge), to = from + (1 << edge / 4);
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, side = face % 2;
    if ((from >> axis & 1) == side && (to >> axis & 1) == side) faces |= 1 << face;
  }
  return faces;
}

/// For each edge the next one of its loop, or -1: each face cuts off its runs of outside corners.
std::array<int, 12> loops_of(int inside) {
  std::array<int, 12> next;
  next.fill(-1);
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> corner = face_corners(face);
    const auto in = [&](int i) { return inside >> corner[i % 4] & 1; };
    for (int i = 0; i < 4; ++i) {
      if (!in(i) || in(i + 1)) continue;  // from i to i + 1 the face is left
      int j = i + 1;
      while (!in(j + 1)) ++j;
      next[edge_between(corner[j % 4], corner[(j + 1) % 4])] = edge_between(corner[i % 4], corner[(i + 1) % 4]);
    }
  }
  return next;
}

/// Cuts the polygon from corner `first` to `last` into triangles whose new sides lie within no face. False if none does.
bool cut(const std::vector<int>& loop, int first, int last, std::vector<std::array<int, 3>>& out) {
  if (last - first < 2) return true;
  const int size = static_cast<int>(loop.size());
  const auto allowed = [&](int a, int b) {
    const bool side = b - a == 1 || (a == 0 && b == size - 1);
    return side || !(faces_of(loop[a]) & faces_of(loop[b]));
  };
  const std::size_t before = out.size();
  for (int k = first + 1; k < last; ++k) {
    if (!allowed(first, k) || !allowed(k, last)) continue;
    out.push_back({loop[first], loop[k], loop[last]});
    if (cut(loop, first, k, out) && cut(loop, k, last, out)) return true;
    out.resize(before);
  }
  return false;
}

CubeCase case_of(int inside) {
  std::array<int, 12> next = loops_of(inside);
  CubeCase result;
  std::vector<std::array<int, 3>> triangles;
  for (int start = 0; start < 12; ++start) {
    std::vector<int> loop;
    for (int edge = start; next[edge] >= 0;) {
      loop.push_back(edge);
      const int following = next[edge];
      next[edge] = -1;
      edge = following;
    }
    if (!loop.empty()) cut(loop, 0, static_cast<int>(loop.size()) - 1, triangles);
  }
  for (const std::array<int, 3>& triangle : triangles) {
    for (int k = 0; k < 3; ++k) result.edges[3 * result.triangles + k] = static_cast<std::uint8_t>(triangle[k]);
    ++result.triangles;
  }
  return result;
}

}  // namespace

int edge_corner(int edge) {
  const int axis = edge / 4, a = edge % 2, b = edge / 2 % 2;
  return axis == 0 ? 2 * a + 4 * b : axis == 1 ? a + 4 * b : a + 2 * b;
}

const std::array<CubeCase, 256>& cube_table() {
  static const std::array<CubeCase, 256> table = [] {
    std::array<CubeCase, 256> cases;
    for (int inside = 0; inside < 256; ++inside) cases[inside] = case_of(inside);
    return cases;
  }();
  return table;
}

}  // namespace tendril::envelope
