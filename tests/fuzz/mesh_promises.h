// What holds for every mesh that a reader gives.
#pragma once

#include <cmath>
#include <cstring>

#include "fuzz_target.h"
#include "geometry/mesh.h"
#include "geometry/mesh_export.h"

namespace tendril::fuzz {

inline void expect_indices(const Mesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle)
      expect(corner >= 0 && corner < static_cast<int>(mesh.vertices.size()), "corners index vertices");
}

inline bool same_bits(const Mesh& a, const Mesh& b) {
  if (a.vertices.size() != b.vertices.size() || a.triangles != b.triangles) return false;
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    if (std::memcmp(a.vertices[i].data(), b.vertices[i].data(), sizeof(Vec3)) != 0) return false;
  return true;
}

/// The corners of the triangles, one after the other: what STL keeps of a mesh.
inline Mesh unshared(const Mesh& mesh) {
  Mesh out;
  for (const auto& triangle : mesh.triangles) {
    const int first = static_cast<int>(out.vertices.size());
    for (const int corner : triangle) out.vertices.push_back(mesh.vertices[corner].cast<float>().cast<double>());
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

/// What is done with a mesh that was read: checked, welded, measured. Whatever passes the check is finite and welds to finite
/// vertices within the box.
inline void expect_usable(const Mesh& mesh) {
  expect_indices(mesh);
  if (!accepts("mesh ", [&] { mesh.check(); })) return;
  const Welded clean = welded(mesh, weld_tolerance(mesh));
  expect_indices(clean.mesh);
  expect(clean.mesh.triangles.size() + clean.degenerate_triangles + clean.repeated_triangles == mesh.triangles.size(),
         "welding counts every triangle");
  for (const Vec3& v : clean.mesh.vertices) expect(v.allFinite(), "vertices are finite");
  expect(std::isfinite(mesh.area()) && std::isfinite(mesh.volume()), "area and volume are finite");
  for (const std::string& text : {glb_of(mesh), stl_of(mesh)}) expect(!text.empty(), "a checked mesh can be written");
}

}  // namespace tendril::fuzz
