// A six-axis industrial robot of our own: dimensions, joints and bodies. Axes: x to the front, y to the left, z up; mm. In
// the zero position the upper arm stands upright and the forearm lies level, to the front.
#pragma once

#include <string>
#include <vector>

#include "engine_bay/detail.h"
#include "engine_bay/mesh.h"

namespace tendril::six_axis {

using engine_bay::Detail;
using engine_bay::Mesh;

struct Joint {
  const char *name, *parent, *child;
  Vec3 at;              ///< of the child in the parent's axes
  Vec3 axis;            ///< of the child
  double lower, upper;  ///< rad
  double velocity;      ///< rad/s
};

/// Six that turn. Reach of the wrist centre from the first axis: 2.51 m.
const std::vector<Joint>& joints();

/// From the last link to the flange's face, along its x.
inline constexpr double flange = 85;

struct Body {
  const char* link;
  Mesh mesh;  ///< closed parts, which may overlap, in the link's axes
};

/// One for each link, the base first.
std::vector<Body> bodies(const Detail& detail);

/// 1,000 to 5,000 triangles a link.
inline Detail usual() { return {130, 18 * units::deg, true}; }

/// Binary STL, in m.
std::string stl(const Mesh& mesh);

/// The description as URDF: a package with package.xml and meshes/LINK.stl.
std::string urdf();
std::string package_xml();

}  // namespace tendril::six_axis
