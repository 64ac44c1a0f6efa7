// Scenes, at rest and moving, as binary glTF 2.0 (ISO/IEC 12113:2022).
#pragma once

#include <string>
#include <vector>

#include "geometry/surface_parts.h"

namespace tendril {

/// A part that moves. At most one of `poses` and `sections` is given; neither: it rests at its pose.
struct MovingPart {
  SurfacePart part;                          ///< as it is at the first time
  std::vector<Frame> poses;                  ///< at each time: it moves as a rigid body
  std::vector<std::vector<Frame>> sections;  ///< at each time: it bends, each of its sections moves as a rigid body
  std::vector<int> section_of_vertex;        ///< of the mesh's vertices, where it bends
};

/// A node, a mesh and a material each. Lengths are metres, and glTF's y axis points up: nodes are turned by it, (x, y, z) -> (x, z, -y).
/// Parts that are not smooth have no normals, which glTF defines as flat shading. Numbers are single precision; a mesh keeps
/// its own axes, so that what is far from the origin loses nothing. Throws UsageError for files beyond glTF's 4 GB.
std::string glb_of(const std::vector<SurfacePart>& parts);

/// The same with one animation that takes `times` (s, at least two, rising by steps that single precision tells apart). Rigid parts
/// have their node's translation and rotation animated. Parts that bend are skinned, a joint a section and one joint a vertex:
/// between two times each section moves straight and turns evenly, so that a tube keeps its thickness. Skins and linear
/// animation of nodes belong to glTF's core and need no extension: viewers that play any glTF animation play this one. A reader
/// that knows no animation sees the first time. Throws UsageError for lists that do not fit the times or the mesh.
std::string glb_of(const std::vector<MovingPart>& parts, const std::vector<double>& times);

}  // namespace tendril
