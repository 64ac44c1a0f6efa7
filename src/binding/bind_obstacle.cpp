#include "binding/bind_obstacle.h"

#include "binding/card.h"

namespace tendril::lua {
namespace {

/// The list under `field` of the table at `index`, entry by entry: `read` gets the entry's place on the stack and its
/// number from 1.
template <class Read>
void for_each_entry(lua_State* L, int index, const char* field, Read read) {
  lua_getfield(L, index, field);
  const lua_Integer size = luaL_len(L, -1);
  for (lua_Integer i = 1; i <= size; ++i) {
    lua_geti(L, -1, i);
    read(lua_gettop(L), i);
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
}

[[noreturn]] void bad_entry(const char* field, lua_Integer i, const std::string& got, const std::string& expected) {
  throw UsageError(std::string("scene:obstacle: '") + field + "' entry " + std::to_string(i) + " is " + got + ", expected " +
                   expected);
}

std::string wrong_mesh(lua_State* L, int index) {
  if (!lua_istable(L, index)) return describe(L, index);
  for (const char* field : {"points", "triangles"}) {
    const int type = lua_getfield(L, index, field);
    lua_pop(L, 1);
    if (type != LUA_TTABLE) return std::string("a table without a list '") + field + "'";
  }
  return "";
}

Preference preference_of(const std::string& name) {
  if (name == "near") return Preference::near;
  if (name == "avoid") return Preference::avoid;
  return Preference::neutral;
}

}  // namespace

const Kind& Value<Mesh>::kind() {
  static const Kind kind{"a table {points =, triangles =}", "{points: vec[], triangles: integer[][]}", &wrong_mesh};
  return kind;
}

Mesh Value<Mesh>::read(lua_State* L, int index) {
  index = lua_absindex(L, index);
  Mesh mesh;
  for_each_entry(L, index, "points", [&](int at, lua_Integer i) {
    const std::string got = Value<Vec3>::kind().wrong(L, at);
    if (!got.empty()) bad_entry("points", i, got, Value<Vec3>::kind().expected);
    mesh.vertices.push_back(Value<Vec3>::read(L, at));
  });
  for_each_entry(L, index, "triangles", [&](int at, lua_Integer i) {
    using Corners = std::array<int, 3>;
    const std::string got = Value<Corners>::kind().wrong(L, at);
    if (!got.empty()) bad_entry("triangles", i, got, "a list of 3 whole numbers");
    Corners corners = Value<Corners>::read(L, at);
    for (int& corner : corners) --corner;
    mesh.triangles.push_back(corners);
  });
  return mesh;
}

Schema obstacle_options() {
  return {
      option<std::string>("unit", "", "Length unit of the file or data; a file must be given one").one_of({"mm", "cm", "m", "in"}),
      option<Frame>("pose", "", "Where its own axes lie: d1, d2, d3 are its x, y, z; default: the world's"),
      option<double>("clearance", "m", "Required gap to rods: judged in reports and pictures; kept with s:solve{clearance = \"push\"}")
          .at_least(0).preset(0),
      option<std::string>("prefer", "", "Whether routes should keep near it or away").one_of({"neutral", "near", "avoid"}).preset("neutral"),
      option<bool>("clip", "", "Rods may be fastened to it").preset(true),
  };
}

decltype(Obstacle::shape) make_shape(lua_State* L, const std::string& name, const ObstacleSource& source, const Options& o) {
  if (const SolidValue* solid = std::get_if<SolidValue>(&source)) {
    if (o.has("unit")) throw UsageError(o.who() + ": 'unit' belongs to files and mesh data; a solid's sizes are in m");
    return solid->solid;
  }
  if (const MeshValue* mesh = std::get_if<MeshValue>(&source)) {
    if (o.has("unit")) throw UsageError(o.who() + ": 'unit' belongs to files and mesh data; a mesh is in m");
    return mesh->surface;
  }
  const double scale = metres_per(o.maybe<std::string>("unit").value_or("m"));
  if (const Mesh* data = std::get_if<Mesh>(&source)) {
    Mesh mesh = *data;
    mesh.name = name;
    for (Vec3& v : mesh.vertices) v *= scale;
    return std::make_shared<const TriangleSurface>(std::move(mesh));
  }
  const std::string& path = std::get<std::string>(source);
  if (!o.has("unit"))
    throw UsageError(o.who() + ": 'unit' is missing: files do not say it, and it is never guessed; give unit = \"mm\", \"cm\", \"m\" or \"in\"");
  return surface_from_file(L, o.who().c_str(), path, scale);
}

PlacedObstacle make_obstacle(lua_State* L, const std::string& name, const ObstacleSource& source, const Options& o) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  if (const Frame* pose = o.find<Frame>("pose")) obstacle.body.pose = *pose;
  obstacle.clearance = o.get<double>("clearance");
  obstacle.prefer = preference_of(o.get<std::string>("prefer"));
  obstacle.clip = o.get<bool>("clip");
  obstacle.body.shape = make_shape(L, name, source, o);
  if (const MeshValue* mesh = std::get_if<MeshValue>(&source)) obstacle.file = mesh->file;
  if (const std::string* path = std::get_if<std::string>(&source))
    obstacle.file = MeshFile{*path, metres_per(o.get<std::string>("unit"))};
  return obstacle;
}

void add_solids(lua_State* L, Module& scene) {
  Class<SolidValue>(L, "A box, sphere, cylinder or half-space to place with scene:obstacle")
      .tostring([](const SolidValue& value) -> std::string {
        if (const Box* box = std::get_if<Box>(&value.solid))
          return "box " + quantity(box->size.x(), "m") + " x " + quantity(box->size.y(), "m") + " x " + quantity(box->size.z(), "m");
        if (const Sphere* sphere = std::get_if<Sphere>(&value.solid)) return "sphere of radius " + quantity(sphere->radius, "m");
        if (const Cylinder* cylinder = std::get_if<Cylinder>(&value.solid))
          return "cylinder of radius " + quantity(cylinder->radius, "m") + ", length " + quantity(cylinder->length, "m");
        return "half-space below its plane";
      });
  scene
      .function("box", {.options = {option<Vec3>("size", "m", "Edge lengths along its x, y, z; its middle is the pose's place").required()},
                        .does = "A box.", .example = "print(scene.box{size = {1, 0.5, 0.2}})"},
                [](const Options& o) {
                  const SolidValue box{Box{o.get<Vec3>("size")}};
                  check(box.solid, "scene.box");
                  return box;
                })
      .function("sphere", {.options = {option<double>("radius", "m", "Radius; its middle is the pose's place").required().above(0)},
                           .does = "A sphere.",
                         .example = "print(scene.sphere{radius = 0.2})  --> sphere of radius 200 mm"},
                [](const Options& o) { return SolidValue{Sphere{o.get<double>("radius")}}; })
      .function("cylinder",
                {.options = {option<double>("radius", "m", "Radius").required().above(0),
                             option<double>("length", "m", "Length along its z; its middle is the pose's place").required().above(0)},
                 .does = "A cylinder with flat ends.",
                         .example = "print(scene.cylinder{radius = 0.1, length = 2})  --> cylinder of radius 100 mm, length 2 m"},
                [](const Options& o) { return SolidValue{Cylinder{o.get<double>("radius"), o.get<double>("length")}}; })
      .function("plane", {.does = "Everything below a plane: solid where its own z is less than 0. `pose = frame{at =, along = normal}` places it.",
                         .example = "local s = scene.new{}\n"
                         "s:obstacle(\"floor\", scene.plane{}, {pose = frame{at = {0, 0, -1}, along = {0, 0, 1}}})"},
                [](const Options&) { return SolidValue{HalfSpace{}}; });
}

}  // namespace tendril::lua
