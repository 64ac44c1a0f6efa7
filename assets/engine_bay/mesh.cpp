#include "engine_bay/mesh.h"

namespace tendril::engine_bay {

void Mesh::append(const Mesh& other) {
  const auto first = static_cast<std::uint32_t>(points.size());
  points.insert(points.end(), other.points.begin(), other.points.end());
  for (const auto& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

Mesh together(std::initializer_list<Mesh> meshes) {
  Mesh all;
  for (const Mesh& mesh : meshes) all.append(mesh);
  return all;
}

Mesh placed(Mesh mesh, const Frame& frame) {
  const Mat3 turn = frame.rotation.toRotationMatrix();
  for (Vec3& p : mesh.points) p = frame.at + turn * p;
  return mesh;
}

Mesh moved(Mesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.points) p += by;
  return mesh;
}

Mesh mirrored(Mesh mesh, double at) {
  for (Vec3& p : mesh.points) p.x() = 2 * at - p.x();
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

Mesh mapped(Mesh mesh, const std::function<Vec3(const Vec3&)>& f) {
  for (Vec3& p : mesh.points) p = f(p);
  return mesh;
}

}  // namespace tendril::engine_bay
