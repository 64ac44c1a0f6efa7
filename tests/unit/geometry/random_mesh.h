// Random inputs for the tests of geometry. A failure is repeated by the seed it prints.
#pragma once

#include "geometry/mesh.h"
#include "unit/base/random_numbers.h"

namespace tendril::test {

/// Unconnected triangles within a cube of half-length 1; a share of them slivers, needles and points.
inline Mesh triangle_soup(int count, double size, Random& random) {
  Mesh mesh;
  mesh.name = "soup";
  for (int i = 0; i < count; ++i) {
    const Vec3 a = random.point(1), along = size * random.direction();
    Vec3 b = a + along, c = a + size * random.direction();
    const int kind = random.below(12);
    if (kind == 0) c = a + random.in(-0.5, 1.5) * along + 1e-7 * random.direction();
    if (kind == 1) c = a + random.in(0, 1) * along;
    if (kind == 2) b = c = a;
    if (kind == 3) c = b;
    if (kind == 4) b = a + 10 * along;
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// A box of edge lengths 2 x `half` with outward triangles, each face cut into n x n quadrilaterals, unwelded.
inline Mesh box_mesh(const Vec3& half, int n = 1) {
  Mesh mesh;
  mesh.name = "box";
  for (int axis = 0; axis < 3; ++axis)
    for (int sign : {-1, 1}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3, first = static_cast<int>(mesh.vertices.size());
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          Vec3 p;
          p[axis] = sign * half[axis];
          p[u] = half[u] * (2.0 * i / n - 1);
          p[v] = half[v] * (2.0 * j / n - 1);
          mesh.vertices.push_back(p);
        }
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const int a = first + j * (n + 1) + i, b = a + n + 1;
          if (sign > 0) {
            mesh.triangles.push_back({a, a + 1, b + 1});
            mesh.triangles.push_back({a, b + 1, b});
          } else {
            mesh.triangles.push_back({a, b + 1, a + 1});
            mesh.triangles.push_back({a, b, b + 1});
          }
        }
    }
  return mesh;
}

}  // namespace tendril::test
