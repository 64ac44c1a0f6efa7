// Obstacles from a script: mesh files, mesh data and solids.
#pragma once

#include <variant>

#include "binding/bind_mesh.h"
#include "binding/lua_class.h"
#include "binding/scene_classes.h"
#include "geometry/mesh.h"

namespace tendril::lua {

/// {points = {{x, y, z}, ...}, triangles = {{1, 2, 3}, ...}}.
template <>
struct Value<Mesh> {
  static const Kind& kind();
  static Mesh read(lua_State* L, int index);
};

/// A file's name, a solid, a mesh, or mesh data.
using ObstacleSource = std::variant<std::string, SolidValue, MeshValue, Mesh>;

Schema obstacle_options();

/// What is given, with options 'unit' among `o`; `name`: of the mesh. Reads the file when there is one. Throws UsageError for a file
/// that is missing, broken, or given without its unit.
decltype(Obstacle::shape) make_shape(lua_State* L, const std::string& name, const ObstacleSource& source, const Options& o);

/// Reads the file when there is one. Throws UsageError for a file that is missing, broken, or given without its unit.
PlacedObstacle make_obstacle(lua_State* L, const std::string& name, const ObstacleSource& source, const Options& o);

/// scene.mesh and the class it makes.
void bind_mesh(lua_State* L, Module& scene);

/// scene.box, scene.sphere, scene.cylinder, scene.plane.
void add_solids(lua_State* L, Module& scene);

}  // namespace tendril::lua
