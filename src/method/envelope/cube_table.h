// Which triangles a cell of a grid holds, by which of its corners are inside: generated, not typed in.
#pragma once

#include <array>
#include <cstdint>

namespace tendril::envelope {

/// Corner x + 2 y + 4 z of a cell. Edge 4 * axis + i starts at the corner that edge_corner gives and runs along its axis.
int edge_corner(int edge);

struct CubeCase {
  static constexpr int most = 12;
  int triangles = 0;
  std::array<std::uint8_t, 3 * most> edges{};  ///< three a triangle, counter-clockwise from outside
};

/// The 256 cases. On a face with two opposite corners inside, these are joined: two cells that share the face agree. No
/// two triangles of one cell meet along a line within a face of the cell, so that every line of the surface has two
/// triangles. Loops around different parts of the outside are never connected.
const std::array<CubeCase, 256>& cube_table();

}  // namespace tendril::envelope
