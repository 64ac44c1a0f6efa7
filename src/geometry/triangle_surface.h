// A mesh ready for queries, shared by all who place it: what they need is built when it is first needed, once.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "geometry/distance_tree.h"
#include "geometry/mesh_topology.h"

namespace tendril {

/// An immutable mesh with its distance tree and its topology. Drawing needs neither, clearance the tree, contact both.
/// Safe from several threads. Neither copied nor moved: share it by shared_ptr.
class TriangleSurface {
 public:
  /// Throws UsageError for a mesh that is not valid (Mesh::check).
  explicit TriangleSurface(Mesh mesh);
  TriangleSurface(const TriangleSurface&) = delete;
  TriangleSurface& operator=(const TriangleSurface&) = delete;

  const Mesh& mesh() const { return mesh_; }
  const Eigen::AlignedBox3d& box() const { return box_; }  ///< m

  const DistanceTree& tree() const;      ///< built by the first call
  const MeshTopology& topology() const;  ///< built by the first call; vertices within weld_tolerance() are one

  bool has_tree() const { return tree_ready_.load(std::memory_order_acquire); }
  bool has_topology() const { return topology_ready_.load(std::memory_order_acquire); }

 private:
  Mesh mesh_;
  Eigen::AlignedBox3d box_;
  mutable std::once_flag tree_once_, topology_once_;
  mutable std::unique_ptr<const DistanceTree> tree_;
  mutable std::unique_ptr<const MeshTopology> topology_;
  mutable std::atomic<bool> tree_ready_{false}, topology_ready_{false};
};

}  // namespace tendril
