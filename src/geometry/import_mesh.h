// Meshes from files: OBJ, STL, PLY and VRML97 by readers of our own, glTF, COLLADA, 3MF and X3D through the assimp module.
#pragma once

#include <string>
#include <vector>

#include "base/run_context.h"
#include "geometry/mesh.h"

namespace tendril {

/// What was in a file. With a status other than `solved` (cancelled, timeout) the mesh is empty.
struct LoadedMesh {
  Status status = Status::solved;
  Mesh mesh;                     ///< welded, in m, named after the path
  std::string warning;           ///< empty, or what of the file is not read, and why its size is unlikely and which unit
                                 ///< would make it likely
  int triangles_in_file = 0;     ///< polygons count as the triangles they were cut into
  int degenerate_triangles = 0;  ///< dropped: two corners in one place
  int repeated_triangles = 0;    ///< dropped: the same corners as another triangle
};

/// Reads the triangles of a file, with the transforms of its scene graph applied; points, lines, colours and the rest
/// are left out. `unit`: metres in one unit of the file, always the caller's word: nothing in the file overrides it, and
/// axes stay those of the file. The suffix of the name tells the format, in any case of letters.
///
/// Throws UsageError naming the file: missing, a folder, not readable, empty, truncated, of another kind than its suffix
/// says, of a suffix that is not read (the message lists those that are), without triangles, with vertices that are not
/// finite; and for a unit that is not finite and positive.
LoadedMesh load_mesh(const std::string& path, double unit, const RunContext& context = {});

/// The suffixes load_mesh reads, with their dots.
const std::vector<std::string>& mesh_suffixes();

/// Why a mesh with a box this long across (m) is of an unlikely size (less than 1 mm or more than 1 km), and the unit of
/// the file that would make it likely; empty when it is likely. `unit`: the one it was read with.
std::string unlikely_size(double diagonal, double unit);

}  // namespace tendril
