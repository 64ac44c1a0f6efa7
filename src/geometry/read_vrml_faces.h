// The polygons of a VRML97 IndexedFaceSet as triangles.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"

namespace tendril {

/// What an IndexedFaceSet says of its faces.
struct VrmlFaces {
  std::vector<int> corners;       ///< indices of points from 0; -1 ends a face
  std::string_view corners_text;  ///< the text that begins with them, to find the line of a bad one
  int corners_line = 1;           ///< the line where that begins
  bool counter_clockwise = true;
};

/// Cuts faces into triangles. One for many face sets: its memory is kept.
class VrmlCutter {
 public:
  /// Only the points that triangles use become vertices, so that many small face sets can share a large list of points.
  /// Faces of fewer than three corners are dropped and added to `short_faces`. Throws UsageError through fail_mesh for
  /// an index out of range and a face of more than most_corners corners, with the line of the corner at fault.
  Mesh cut(const VrmlFaces& faces, const std::vector<Vec3>& points, const std::string& name, int& short_faces);

 private:
  std::vector<int> own_;  ///< by point: the vertex it became, -1 for none; all -1 between calls
};

/// Reverses all triangles.
void turn_inside_out(Mesh& mesh);

}  // namespace tendril
