#include "robot/link_mesh.h"

#include "geometry/import_mesh.h"

namespace tendril {

LinkMesh::LinkMesh(Mesh mesh) : surface_(std::make_shared<const TriangleSurface>(std::move(mesh))) {}

LinkMesh::LinkMesh(std::string path, const Vec3& scale) : path_(std::move(path)), scale_(scale) {}

const std::shared_ptr<const TriangleSurface>& LinkMesh::surface() const {
  const std::lock_guard lock(mutex_);  // a file that cannot be read is tried again by the next call
  if (surface_) return surface_;
  Mesh mesh = load_mesh(path_, 1).mesh;
  for (Vec3& v : mesh.vertices) v = v.cwiseProduct(scale_);
  if (scale_.prod() < 0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  surface_ = std::make_shared<const TriangleSurface>(std::move(mesh));
  return surface_;
}

}  // namespace tendril
