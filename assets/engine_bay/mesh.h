// Triangle meshes of the parts, in mm.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include "base/frame.h"

namespace tendril::engine_bay {

using Vec2 = Eigen::Vector2d;

/// Triangles run anticlockwise seen from outside.
struct Mesh {
  std::vector<Vec3> points;  ///< mm
  std::vector<std::array<std::uint32_t, 3>> triangles;

  void append(const Mesh& other);
};

/// All of them in one mesh; nothing is welded.
Mesh together(std::initializer_list<Mesh> meshes);

/// Carried from local axes into the frame: local z along d3, local x along d1.
Mesh placed(Mesh mesh, const Frame& frame);
Mesh moved(Mesh mesh, const Vec3& by);

/// Mirrored in the plane x = `at`; the triangles are turned so that outside stays outside.
Mesh mirrored(Mesh mesh, double at);

/// Every point sent through `f`, which must keep the orientation.
Mesh mapped(Mesh mesh, const std::function<Vec3(const Vec3&)>& f);

/// A frame at `at` with local z along `along`.
inline Frame facing(const Vec3& at, const Vec3& along) { return Frame::looking(at, along); }

}  // namespace tendril::engine_bay
