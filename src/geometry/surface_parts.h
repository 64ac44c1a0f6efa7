// Named meshes in their places, at rest or moving, and files of them.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/frame.h"
#include "geometry/mesh.h"

namespace tendril {

/// A mesh in its place, as files show it.
struct SurfacePart {
  std::string name;
  std::shared_ptr<const Mesh> mesh;          ///< m, in its own axes
  Frame pose;                                ///< of these, in world axes
  std::array<float, 3> colour{0.7f, 0.7f, 0.7f};  ///< sRGB, each 0 ... 1
  float opacity = 1;                         ///< 0 ... 1
  bool double_sided = false;                 ///< an open sheet is seen from behind too
  bool smooth = false;                       ///< shaded round; else flat
};

/// All parts as one mesh in world axes.
Mesh joined(const std::vector<SurfacePart>& parts);

/// Writes the parts in the format of the name's suffix, whole or not at all; missing folders are created. `.glb`: a node and a
/// material each, see glb_scene.h; `.obj`: a group each, under its name with blanks as underscores; `.stl`, `.ply`: one mesh.
/// `unit`: metres in one unit of the file. Throws UsageError as save_mesh does, and for no parts.
void save_surfaces(const std::string& path, const std::vector<SurfacePart>& parts, double unit = 1);

/// The contents of an OBJ file with a group each.
std::string obj_of(const std::vector<SurfacePart>& parts, double unit = 1);

}  // namespace tendril
