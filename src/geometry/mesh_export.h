// Meshes into files: binary STL, binary PLY, OBJ, binary glTF.
#pragma once

#include <string>

#include "geometry/mesh.h"

namespace tendril {

/// Writes the mesh in the format of the name's suffix (.stl, .ply, .obj, .glb, in any case of letters), whole or not at
/// all; missing folders are created. `unit`: metres in one unit of the file; coordinates are divided by it. STL and GLB
/// hold single precision, PLY and OBJ double. Throws UsageError for another suffix, a mesh that is not valid, a unit that
/// is not finite and positive, a GLB in another unit than metres, and a file that cannot be written.
void save_mesh(const std::string& path, const Mesh& mesh, double unit = 1);

/// The contents of such files.
std::string stl_of(const Mesh& mesh, double unit = 1);
std::string ply_of(const Mesh& mesh, double unit = 1);
std::string obj_of(const Mesh& mesh, double unit = 1);

/// Binary glTF 2.0: one mesh with positions, smooth normals (of the triangles at a vertex, weighted by area) and 32-bit
/// indices. glTF is in metres, and its y axis points up: positions are rotated in the file, (x, y, z) -> (x, z, -y), so
/// that what is up here is up in a viewer. Whoever reads the file as it stands gets it lying on its back. What does not
/// fit the format's 4 GB is refused.
std::string glb_of(const Mesh& mesh);

/// Of each vertex, weighted by the area of the triangles around it; z where there are none.
std::vector<Vec3> smooth_normals(const Mesh& mesh);

}  // namespace tendril
