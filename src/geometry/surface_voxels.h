// The voxels around a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "base/run_context.h"
#include "geometry/distance_transform.h"
#include "geometry/mesh.h"

namespace tendril {

/// A point of a voxel is never farther from its centre than this share of its edge: half its diagonal, and a little more so that
/// rounding leaves no voxel out.
inline constexpr double voxel_reach = 0.8661;

/// Sets marks[node] to 1 for exactly those nodes that lie within voxel_reach * spacing of a triangle of `mesh`, placed by
/// x -> axes * x + at: among them every node whose voxel the surface passes through. Threads; the same for any number of them.
void mark_surface(const Mesh& mesh, const Mat3& axes, const Vec3& at, const NodeLattice& lattice, std::vector<std::uint8_t>& marks,
                  const RunContext& context = {});

}  // namespace tendril
