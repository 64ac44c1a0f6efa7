// A triangle mesh made ready for drawing: joined vertices, smooth normals that stop at creases, feature edges, and
// pieces that lie together in space. Linear in the number of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "view/picture.h"

namespace tendril {

/// A run of triangles or edges that lie close together.
struct MeshPiece {
  std::uint32_t first = 0, count = 0;  ///< indices (not triangles) in the index array
  Eigen::Vector3f low, high;           ///< m, relative to the origin
};

struct PreparedMesh {
  std::vector<Eigen::Vector3f> positions;            ///< m, relative to the origin
  std::vector<std::array<std::int16_t, 2>> normals;  ///< octahedral; the sign is free (surfaces have no outside)
  std::vector<float> values;                         ///< one a position, `no_value` where unknown; empty: none
  std::vector<std::uint32_t> triangles;              ///< 3 a triangle, sorted into pieces
  std::vector<std::uint32_t> edges;                  ///< 2 an edge, sorted into pieces
  std::vector<MeshPiece> triangle_pieces, edge_pieces;
  std::size_t left_out = 0;  ///< triangles with missing or non-finite vertices
};

/// Stands for a value that is not known: everything above 1e30 does.
inline constexpr float no_value = 1e32f;

/// Creases sharper than this (rad) are edges, and normals do not run smoothly across them.
inline constexpr double crease_angle = 0.5235987755982988;

/// Positions are taken relative to `origin`, so that single precision suffices far from the world's origin.
/// An edge is a feature when it borders one triangle, or when two triangles meet there at more than the crease angle.
/// Turned-over neighbours and doubled (two-sided) triangles do not count as creases.
PreparedMesh prepare_mesh(const PictureSurface& surface, const Vec3& origin);

/// Octahedral code of a unit vector.
std::array<std::int16_t, 2> octahedral(const Eigen::Vector3f& normal);

}  // namespace tendril
