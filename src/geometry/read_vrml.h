// VRML97 files (.wrl, .vrml) as meshes.
#pragma once

#include <string>

#include "base/run_context.h"
#include "geometry/mesh.h"

namespace tendril {

/// Reads the surfaces of the file `path`, whose content is given, in the file's own unit and axes (ISO/IEC 14772-1:1997):
/// IndexedFaceSet, Box, Sphere, Cylinder, Cone and ElevationGrid within Group, Transform, Switch (what it chooses), LOD (the
/// finest level), Anchor, Billboard, Collision and Inline, with DEF and USE. A Billboard stays as it is in the file. What is
/// placed with a mirroring scale keeps its outside outside. Inline reads files beside the one it stands in, 16 deep at most;
/// one that leads back to itself is refused; of network addresses nothing is read.
///
/// `left_out` says what the mesh lacks, empty for nothing: Extrusion, instances of PROTO, other unknown nodes, files on a
/// network, faces of fewer than three corners, animation. A file cannot grow beyond 4 million triangles, or as many as it has bytes, by repeated USE
/// or Inline. Throws UsageError through fail_mesh: "mesh 'x.wrl': line 17: ...", also for VRML 1.0 and compressed files.
/// Stopped by the context it returns what it has.
Mesh parse_vrml(std::string_view content, const std::string& path, const RunContext& context, std::string& left_out);

}  // namespace tendril
