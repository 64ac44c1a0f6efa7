// The nodes of a VRML97 file that place or hold surfaces, and how its text becomes them (ISO/IEC 14772-1:1997).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"

namespace tendril {

enum class VrmlKind : unsigned char {
  group,       ///< Group, Anchor, Billboard, Collision and the file itself: all children
  transform,   ///< all children, moved by places[data]
  chosen,      ///< Switch: child number `data` from 0, none when there is no such child
  finest,      ///< LOD: the first child
  shape,       ///< its geometry, the first child
  inlined,     ///< another file: links[data]
  surface,     ///< triangles: surfaces[data]
  points,      ///< Coordinate: points[data]
  unread,      ///< draws what is not read: names[data] is its type
  nothing      ///< draws nothing: a light, an appearance, lines
};

struct VrmlNode {
  VrmlKind kind = VrmlKind::nothing;
  int data = -1;
  std::vector<int> children;  ///< indices of nodes
};

/// x -> linear * x + offset, in the file's unit.
struct VrmlPlace {
  Mat3 linear = Mat3::Identity();
  Vec3 offset = Vec3::Zero();
};

/// The addresses of an Inline, in order of preference.
struct VrmlLink {
  std::vector<std::string> addresses;
  int file = -1;  ///< index of the file it stands in
  int line = 0;
};

/// The nodes of all files read so far. Those that USE names share: no node leads back to itself within a file.
struct VrmlNodes {
  std::vector<VrmlNode> nodes;
  std::vector<VrmlPlace> places;
  std::vector<VrmlLink> links;
  std::vector<Mesh> surfaces;  ///< only the vertices that their triangles use
  std::vector<std::vector<Vec3>> points;
  std::vector<std::string> names;
  bool animated = false;    ///< something has a ROUTE or a Script
  int short_polygons = 0;   ///< dropped: of fewer than three corners
};

/// Reads a file's text into nodes and returns the index of the one that holds them all. Nodes of unknown types are
/// skipped with what is in them, except for what DEF names there; PROTO, EXTERNPROTO and Script are skipped whole.
/// Nesting costs memory, not stack. Throws UsageError through fail_mesh(name, "line N: ...").
int parse_vrml_nodes(std::string_view content, const std::string& name, int file, VrmlNodes& nodes);

/// Box, Cylinder, Cone, Sphere about the origin (the axis is y) and ElevationGrid, closed where they are closed, with
/// outward triangles. Round ones have 32 sides; their corners lie on the true surface.
Mesh vrml_box(const Vec3& size);
Mesh vrml_cylinder(double radius, double height, bool side, bool bottom, bool top);
Mesh vrml_cone(double radius, double height, bool side, bool bottom);
Mesh vrml_sphere(double radius);
/// `columns` x `rows` heights, row by row along z. Upward triangles. At least 2 x 2 expected, else it is empty.
Mesh vrml_elevation(int columns, int rows, double column_spacing, double row_spacing, const std::vector<double>& heights);

}  // namespace tendril
