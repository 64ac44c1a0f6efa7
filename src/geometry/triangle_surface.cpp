#include "geometry/triangle_surface.h"

namespace tendril {

TriangleSurface::TriangleSurface(Mesh mesh) : mesh_(std::move(mesh)) {
  mesh_.check();
  box_ = mesh_.box();
}

const DistanceTree& TriangleSurface::tree() const {
  if (!has_tree())
    std::call_once(tree_once_, [this] {
      tree_ = std::make_unique<const DistanceTree>(mesh_);
      tree_ready_.store(true, std::memory_order_release);
    });
  return *tree_;
}

const MeshTopology& TriangleSurface::topology() const {
  if (!has_topology())
    std::call_once(topology_once_, [this] {
      topology_ = std::make_unique<const MeshTopology>(topology_of(mesh_, weld_tolerance(mesh_)));
      topology_ready_.store(true, std::memory_order_release);
    });
  return *topology_;
}

}  // namespace tendril
