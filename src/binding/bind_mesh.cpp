// mesh: triangles to measure, to save and to place as obstacles.
#include "binding/bind_mesh.h"

#include <cstdio>

#include "base/units.h"
#include "binding/bind_obstacle.h"
#include "binding/card.h"
#include "binding/lua_class.h"
#include "binding/open.h"
#include "geometry/import_mesh.h"
#include "geometry/mesh_export.h"

namespace tendril::lua {
namespace {

using MeshSource = std::variant<std::string, Mesh>;

Option unit_option(const char* text) {
  return option<std::string>("unit", "", text).one_of({"mm", "cm", "m", "in"});
}

MeshValue read_mesh(lua_State* L, const MeshSource& source, const Options& o) {
  if (const Mesh* data = std::get_if<Mesh>(&source)) {
    const double scale = metres_per(o.maybe<std::string>("unit").value_or("m"));
    Mesh mesh = *data;
    for (Vec3& v : mesh.vertices) v *= scale;
    return make_mesh_value(std::move(mesh));
  }
  if (!o.has("unit"))
    throw UsageError("scene.mesh: 'unit' is missing: files do not say it, and it is never guessed; give unit = \"mm\", \"cm\", \"m\" or \"in\"");
  MeshValue mesh;
  mesh.file = MeshFile{std::get<std::string>(source), metres_per(o.get<std::string>("unit"))};
  mesh.surface = surface_from_file(L, "scene.mesh", mesh.file->path, mesh.file->unit);
  return mesh;
}

/// Triangles with corners counted from 1, as in {points =, triangles =}.
std::vector<std::array<int, 3>> corners_from_one(const Mesh& mesh) {
  std::vector<std::array<int, 3>> triangles = mesh.triangles;
  for (auto& triangle : triangles)
    for (int& corner : triangle) ++corner;
  return triangles;
}

bool contains(MeshValue& mesh, const Vec3& point) {
  if (!mesh.surface->topology().watertight())
    throw UsageError("mesh:contains: the mesh has open borders or edges of three triangles and more, so that it has no inside");
  if (!mesh.inside) mesh.inside = std::make_shared<const InsideTest>(mesh.mesh());
  return mesh.inside->inside(point);
}

const char* const tetrahedron =
    "local m = scene.mesh({points = {{0,0,0}, {1,0,0}, {0,1,0}, {0,0,1}}, triangles = {{1,3,2}, {1,2,4}, {1,4,3}, {2,3,4}}}, {unit = \"m\"})\n";

}  // namespace

MeshValue make_mesh_value(Mesh mesh) { return {std::make_shared<const TriangleSurface>(std::move(mesh))}; }

double metres_per(const std::string& unit) {
  if (unit == "mm") return units::mm;
  if (unit == "cm") return units::cm;
  if (unit == "in") return 25.4 * units::mm;
  return units::m;
}

std::shared_ptr<const TriangleSurface> surface_from_file(lua_State* L, const char* who, const std::string& path, double unit) {
  LoadedMesh loaded = load_mesh(path, unit, run_context(L));
  if (loaded.status != Status::solved) throw UsageError(std::string(who) + ": reading '" + path + "' was interrupted");
  if (!loaded.warning.empty()) std::fprintf(stderr, "warning: %s\n", loaded.warning.c_str());
  return std::make_shared<const TriangleSurface>(std::move(loaded.mesh));
}

void bind_mesh(lua_State* L, Module& scene) {
  Class<MeshValue>(L, "Triangles over shared vertices; it never changes")
      .property("vertices", "m", "Places; a new list each time", [](const MeshValue& m) { return m.mesh().vertices; })
      .property("triangles", "", "Three vertex numbers each, counted from 1; a new list each time",
                [](const MeshValue& m) { return corners_from_one(m.mesh()); })
      .property("vertex_count", "", "Number of vertices", [](const MeshValue& m) { return m.mesh().vertices.size(); })
      .property("triangle_count", "", "Number of triangles", [](const MeshValue& m) { return m.mesh().triangles.size(); })
      .property("volume", "m^3", "Within the mesh, when it is watertight with normals outwards", [](const MeshValue& m) { return m.mesh().volume(); })
      .property("area", "m^2", "Of all triangles", [](const MeshValue& m) { return m.mesh().area(); })
      .property("watertight", "", "Every edge has exactly two triangles", [](const MeshValue& m) { return m.surface->topology().watertight(); })
      .method("contains", {.takes = {"point"}, .does = "Whether a point lies inside a watertight mesh.",
                           .example = std::string(tetrahedron) + "print(m:contains({0.2, 0.2, 0.2}))  --> true"},
              [](MeshValue& m, const Vec3& point) { return contains(m, point); })
      .method("save", {.takes = {"path"}, .options = {unit_option("Length unit of the file; default \"m\". A .glb is always in m")},
                       .does = "Writes it as .stl, .ply, .obj or .glb (in which y points up: it is turned for that); a missing folder is created.",
                       .example = std::string(tetrahedron) + "m:save(\"tetrahedron.stl\", {unit = \"mm\"})"},
              [](const MeshValue& m, const std::string& path, const Options& o) {
                save_mesh(path, m.mesh(), metres_per(o.maybe<std::string>("unit").value_or("m")));
              })
      .tostring([](const MeshValue& m) {
        const bool watertight = m.surface->topology().watertight();
        Card card("mesh");
        card.row("vertices", std::to_string(m.mesh().vertices.size())).row("triangles", std::to_string(m.mesh().triangles.size()));
        card.row("watertight", watertight ? "yes" : "no").row("area", m.mesh().area(), "m^2");
        if (watertight) card.row("volume", m.mesh().volume(), "m^3");
        return card.text();
      });
  scene.function("mesh", {.takes = {"source"}, .options = {unit_option("Length unit of the file or data; a file must be given one, data are in m otherwise")},
                          .does = "A mesh from a file, or from {points =, triangles =}.",
                          .example = std::string(tetrahedron) + "print(m.volume * 6)  --> 1.0"},
                 read_mesh);
}

}  // namespace tendril::lua
