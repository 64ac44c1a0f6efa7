// Meshes into files: binary STL, binary PLY, OBJ.
#pragma once

#include <string>

#include "geometry/mesh.h"

namespace tendril {

/// Writes the mesh in the format of the name's suffix (.stl, .ply, .obj, in any case of letters), whole or not at all;
/// missing folders are created. `unit`: metres in one unit of the file; coordinates are divided by it. STL holds single
/// precision, PLY and OBJ double. Throws UsageError for another suffix, a mesh that is not valid, a unit that is not
/// finite and positive, and a file that cannot be written.
void save_mesh(const std::string& path, const Mesh& mesh, double unit = 1);

/// The contents of such files.
std::string stl_of(const Mesh& mesh, double unit = 1);
std::string ply_of(const Mesh& mesh, double unit = 1);
std::string obj_of(const Mesh& mesh, double unit = 1);

}  // namespace tendril
