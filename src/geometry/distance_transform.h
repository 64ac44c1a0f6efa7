// The exact Euclidean distance from every node of a regular grid to the nearest marked one, axis after axis.
#pragma once

#include <cstdint>
#include <vector>

#include "base/run_context.h"
#include "base/vectors.h"

namespace tendril {

/// Nodes at origin + spacing * (i, j, k), x fastest in memory.
struct NodeLattice {
  Vec3 origin = Vec3::Zero();  ///< m
  double spacing = 1;          ///< m
  Eigen::Array3i size = {0, 0, 0};

  std::size_t count() const {
    return static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()) * static_cast<std::size_t>(size.z());
  }
  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) + size.x() * (static_cast<std::size_t>(j) + size.y() * static_cast<std::size_t>(k));
  }
  Vec3 node(int i, int j, int k) const { return origin + spacing * Vec3(i, j, k); }
  Eigen::AlignedBox3d box() const { return {origin, node(size.x() - 1, size.y() - 1, size.z() - 1)}; }
};

/// Squared distances in units of the spacing, by node; infinite where nothing is marked. Along x by counting, along y and z as
/// the lower envelope of parabolas (Felzenszwalb and Huttenlocher, Theory of Computing 8, 2012): time linear in the nodes.
/// The same bits for any number of threads. Stopped by `context` it is of no use: ask the context.
std::vector<float> squared_distances(const std::vector<std::uint8_t>& marks, const Eigen::Array3i& size,
                                     const RunContext& context = {});

}  // namespace tendril
