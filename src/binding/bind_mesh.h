// Meshes as scripts hold them.
#pragma once

#include <memory>

#include "binding/lua_value.h"
#include "geometry/inside_test.h"
#include "geometry/triangle_surface.h"
#include "scene/placed_obstacle.h"

namespace tendril::lua {

/// A mesh that never changes, shared with the scenes it is placed in.
struct MeshValue {
  std::shared_ptr<const TriangleSurface> surface;
  std::shared_ptr<const InsideTest> inside = nullptr;  ///< made by the first question
  std::optional<MeshFile> file = std::nullopt;         ///< that it was read from
  const Mesh& mesh() const { return surface->mesh(); }
};

template <> inline constexpr const char* class_name<MeshValue> = "mesh";

/// Throws UsageError for a mesh that is not valid.
MeshValue make_mesh_value(Mesh mesh);

/// Metres per "mm", "cm", "m" or "in".
double metres_per(const std::string& unit);

/// The mesh of a file. Throws UsageError for one that is missing or broken; `who` asks.
std::shared_ptr<const TriangleSurface> surface_from_file(lua_State* L, const char* who, const std::string& path, double unit);

}  // namespace tendril::lua
