// Scene files: reading.
#include <cmath>
#include <filesystem>
#include <map>

#include "base/nearest_name.h"
#include "base/number_text.h"
#include "base/write_file.h"
#include "geometry/import_mesh.h"
#include "harness/json_place.h"
#include "harness/scene_file.h"
#include "harness/scene_file_versions.h"
#include "robot/load_robot.h"
#include "scene/formed_rod.h"

namespace tendril {
namespace {

namespace fs = std::filesystem;

int one_of(const JsonPlace& place, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), place.text());
  if (found == names.end()) place.fail("unknown " + unknown_name(place.text(), "choices", names));
  return static_cast<int>(found - names.begin());
}

Material read_material(const JsonPlace& place) {
  place.only({"young", "shear", "density"});
  return place.guarded([&] {
    return Material::from_shear(place["young"].number(), place["shear"].number(), place["density"].number());
  });
}

/// One number for both axes, or two.
std::array<double, 2> read_pair(const JsonPlace& place) {
  const std::vector<double> values = place.numbers();
  if (values.size() != 2) place.fail("got a list of " + std::to_string(values.size()) + ", expected 2 numbers, of d1 and d2");
  return {values[0], values[1]};
}

Section read_section(const JsonPlace& place) {
  place.only({"outer", "inner", "material", "EA", "GA", "EI", "GJ", "mass"});
  const double outer = place["outer"].number(), inner = place.number_or("inner", 0);
  std::optional<Material> material;
  if (place.has("material")) {
    material = read_material(place["material"]);
    if (!place.has("EA") && !place.has("GA") && !place.has("EI") && !place.has("GJ") && !place.has("mass"))
      return place.guarded([&] { return Section::round(outer, inner, *material); });
  }
  Section section;
  section.outer = outer;
  section.inner = inner;
  section.EA = place["EA"].number();
  section.GJ = place["GJ"].number();
  section.mass = place["mass"].number();
  std::tie(section.GA1, section.GA2) = std::tuple_cat(read_pair(place["GA"]));
  std::tie(section.EI1, section.EI2) = std::tuple_cat(read_pair(place["EI"]));
  place.guarded([&] { section.check(); });
  section.material = material;
  if (material && !section.made_of())
    place.fail("the stiffnesses are not those of 'material'; change both, or leave 'material' or all stiffnesses and 'mass' out");
  return section;
}

FrameShape read_frame_shape(const JsonPlace& place) {
  place.only({"kind", "stations"});
  FrameShape shape;
  for (const JsonPlace& station : place["stations"].items()) {
    const std::vector<double> n = station.numbers();
    if (n.size() != 8) station.fail("got a list of " + std::to_string(n.size()) + ", expected 8 numbers: s, x, y, z, qw, qx, qy, qz");
    const Quat rotation(n[4], n[5], n[6], n[7]);
    if (!(std::abs(rotation.norm() - 1) <= 1e-9))
      station.fail("its quaternion's length is " + number_text(rotation.norm()) + ", expected 1");
    shape.s.push_back(n[0]);
    shape.frames.push_back({{n[1], n[2], n[3]}, rotation});
  }
  return shape;
}

Curve read_curve(const JsonPlace& place, int kind) {
  if (kind == 3) {
    place.only({"kind", "radius", "pitch", "turns", "left_handed"});
    return place.guarded([&] {
      return Curve::helix(place["radius"].number(), place["pitch"].number(), place["turns"].number(),
                          place.boolean_or("left_handed", false));
    });
  }
  std::vector<Vec3> points;
  for (const JsonPlace& point : place["points"].items()) points.push_back(point.vector());
  if (kind == 0) {
    place.only({"kind", "points"});
    return place.guarded([&] { return Curve::polyline(points); });
  }
  if (kind == 1) {
    place.only({"kind", "points", "radii"});
    return place.guarded([&] { return Curve::pcc(points, place["radii"].numbers()); });
  }
  place.only({"kind", "points", "start", "finish"});
  Curve::SplineEnds ends;
  if (place.has("start")) ends.start = place["start"].vector();
  if (place.has("finish")) ends.finish = place["finish"].vector();
  return place.guarded([&] { return Curve::spline(points, ends); });
}

void read_shape(const JsonPlace& place, double length, Rod& rod) {
  const int kind = one_of(place["kind"], {"polyline", "pcc", "spline", "helix", "frames"});
  if (kind == 4) {
    rod.length = length;
    return place.guarded([&] { form(rod, read_frame_shape(place)); });
  }
  const Curve curve = read_curve(place, kind);
  form(rod, curve);
  if (std::abs(curve.length() - length) > 1e-9 * curve.length())
    place.fail("it is " + number_text(curve.length()) + " m long, but the rod's length is " + number_text(length) + " m");
}

Rod read_design(const JsonPlace& place) {
  Rod rod;
  const double length = place["length"].number();
  if (place.has("segments")) rod.segments = place["segments"].whole(1, Rod::max_segments);
  for (const JsonPlace& part : place["parts"].items()) {
    part.only({"upto", "section"});
    rod.parts.push_back({part["upto"].number(), read_section(part["section"])});
  }
  if (place.has("shape")) read_shape(place["shape"], length, rod);
  rod.length = length;
  place.guarded([&] { rod.check(); });
  if (const Curve* curve = curve_of(rod)) place.guarded([&] { check_bends(rod, *curve, "rod.new"); });
  return rod;
}

Hold read_hold(const JsonPlace& place) {
  place.only({"at", "robot", "link", "frame", "position", "orientation", "turns", "slide", "cut_at"});
  Hold hold;
  hold.at = place["at"].number();
  hold.frame = place["frame"].frame();
  hold.position = place.boolean_or("position", true);
  hold.orientation = place.boolean_or("orientation", true);
  hold.turns = place.number_or("turns", 0);
  hold.slide = place.boolean_or("slide", false);
  hold.cut_at = place.number_or("cut_at", -1);
  return hold;
}

Mesh read_mesh_data(const JsonPlace& place, const std::string& name) {
  place.only({"vertices", "triangles"});
  Mesh mesh;
  mesh.name = name;
  for (const JsonPlace& vertex : place["vertices"].items()) mesh.vertices.push_back(vertex.vector());
  const int count = static_cast<int>(std::min<std::size_t>(mesh.vertices.size(), 1u << 30));
  for (const JsonPlace& triangle : place["triangles"].items()) {
    const std::vector<JsonPlace> corners = triangle.items();
    if (corners.size() != 3) triangle.fail("got " + std::to_string(corners.size()) + " corners, expected 3");
    mesh.triangles.push_back({corners[0].whole(1, count) - 1, corners[1].whole(1, count) - 1, corners[2].whole(1, count) - 1});
  }
  return mesh;
}

class Reader {
 public:
  Reader(const std::string& path, const RunContext& context) : folder_(fs::path(path).parent_path()), context_(context) {}

  LoadedScene read(const JsonPlace& root) {
    root.only({"format", "version", "units", "gravity", "obstacles", "robots", "rods", "branches"});
    if (root.has("units") && root["units"].text() != "m, kg, s, N, rad") root["units"].fail("expected \"m, kg, s, N, rad\"");
    const Vec3 gravity = root.has("gravity") ? root["gravity"].vector() : Vec3(Vec3::Zero());
    loaded_.scene = std::make_shared<Scene>(gravity);
    for (const JsonPlace& place : list(root, "obstacles")) add_obstacle(place);
    for (const JsonPlace& place : list(root, "robots")) add_robot(place);
    // Branch points take the place of holds, so that these come last; by then all rods are there.
    for (const JsonPlace& place : list(root, "rods")) add_rod(place);
    for (const JsonPlace& place : list(root, "branches")) add_branch(place);
    for (const JsonPlace& place : list(root, "rods")) hold_rod(place);
    return std::move(loaded_);
  }

 private:
  Scene& scene() { return *loaded_.scene; }

  static std::vector<JsonPlace> list(const JsonPlace& place, const char* key) {
    return place.has(key) ? place[key].items() : std::vector<JsonPlace>();
  }

  /// Where a file that is named here lies. Devices and pipes, which never end, are refused.
  std::string whole_path(const JsonPlace& place) const {
    const fs::path name = place.text();
    const std::string path = (name.is_absolute() ? name : folder_ / name).lexically_normal().string();
    std::error_code unknown;
    const fs::file_status status = fs::status(path, unknown);
    if (fs::exists(status) && !fs::is_regular_file(status)) place.fail("'" + path + "' is not a file");
    return path;
  }

  void compare(const JsonPlace& place, const std::string& path) {
    if (!place.has("checksum") || place["checksum"].text() == checksum_of(read_file(path))) return;
    loaded_.warnings.push_back("'" + path + "' has changed since the scene was saved");
  }

  std::shared_ptr<const TriangleSurface> read_mesh_file(const JsonPlace& place, const MeshFile& file) {
    auto& surface = surfaces_[{file.path, file.unit}];
    if (surface) return surface;
    place.guarded([&] {
      LoadedMesh mesh = load_mesh(file.path, file.unit, context_);
      if (mesh.status != Status::solved) throw UsageError("reading '" + file.path + "' was interrupted");
      if (!mesh.warning.empty()) loaded_.warnings.push_back(mesh.warning);
      compare(place, file.path);
      surface = std::make_shared<const TriangleSurface>(std::move(mesh.mesh));
    });
    return surface;
  }

  void read_mesh(const JsonPlace& place, PlacedObstacle& obstacle) {
    if (!place.has("file")) {
      obstacle.body.shape = place.guarded(
          [&] { return std::make_shared<const TriangleSurface>(read_mesh_data(place, obstacle.name)); });
      return;
    }
    place.only({"file", "unit", "checksum"});
    obstacle.file = MeshFile{whole_path(place["file"]), place["unit"].number()};
    obstacle.body.shape = read_mesh_file(place, *obstacle.file);
  }

  static Solid read_solid(const JsonPlace& place) {
    switch (one_of(place["kind"], {"box", "sphere", "cylinder", "plane"})) {
      case 0: place.only({"kind", "size"}); return Box{place["size"].vector()};
      case 1: place.only({"kind", "radius"}); return Sphere{place["radius"].number()};
      case 2: place.only({"kind", "radius", "length"}); return Cylinder{place["radius"].number(), place["length"].number()};
      default: place.only({"kind"}); return HalfSpace{};
    }
  }

  void add_obstacle(const JsonPlace& place) {
    place.only({"name", "solid", "mesh", "pose", "clearance", "prefer", "clip"});
    PlacedObstacle obstacle;
    obstacle.name = place["name"].text();
    if (place.has("solid") == place.has("mesh")) place.fail("expected exactly one of 'solid' and 'mesh'");
    if (place.has("solid")) {
      const Solid solid = read_solid(place["solid"]);
      place["solid"].guarded([&] { check(solid, "solid"); });
      obstacle.body.shape = solid;
    } else {
      read_mesh(place["mesh"], obstacle);
    }
    if (place.has("pose")) obstacle.body.pose = place["pose"].frame();
    obstacle.clearance = place.has("clearance") ? place["clearance"].at_least(0) : 0;
    if (place.has("prefer")) obstacle.prefer = Preference(one_of(place["prefer"], {"neutral", "near", "avoid"}));
    obstacle.clip = place.boolean_or("clip", true);
    place.guarded([&] { scene().add(std::move(obstacle)); });
  }

  void add_robot(const JsonPlace& place) {
    place.only({"name", "robot", "checksum", "base", "joints", "clearance"});
    PlacedRobot robot;
    robot.name = place["name"].text();
    const std::string& source = place["robot"].text();
    const bool builtin = source.starts_with("builtin:");
    const std::string path = builtin ? source : whole_path(place["robot"]);
    place["robot"].guarded([&] { robot.robot = load_robot(path); });
    if (!builtin) compare(place, path);
    if (place.has("base")) robot.base = place["base"].frame();
    if (place.has("joints")) robot.joints = place["joints"].numbers();
    robot.clearance = place.has("clearance") ? place["clearance"].at_least(0) : 0;
    place.guarded([&] { scene().add(std::move(robot)); });
  }

  void add_rod(const JsonPlace& place) {
    place.only({"name", "length", "segments", "parts", "shape", "holds", "loads"});
    const Rod design = read_design(place);
    place.guarded([&] { scene().add(PlacedRod(place["name"].text(), design, std::nullopt, std::nullopt)); });
  }

  void add_branch(const JsonPlace& place) {
    place.only({"name", "places", "frame", "position", "orientation"});
    std::vector<BranchPlace> joined;
    for (const JsonPlace& entry : place["places"].items()) {
      entry.only({"rod", "at", "relative"});
      BranchPlace one;
      entry["rod"].guarded([&] { one.rod = &scene().rod(entry["rod"].text()); });
      one.at = entry["at"].number();
      one.relative = entry["relative"].frame();
      joined.push_back(one);
    }
    const Frame frame = place["frame"].frame();
    const bool position = place["position"].boolean(), orientation = place["orientation"].boolean();
    place.guarded([&] {
      PlacedBranch& branch = scene().join(place["name"].text(), joined, frame);
      branch.position = position;
      branch.orientation = orientation;
    });
  }

  void attach(const JsonPlace& place, const PlacedRod& rod, const Hold& hold) {
    Attachment attachment{rod.name(), hold.at, place["robot"].text(), 0, hold.frame, hold.position, hold.orientation, hold.turns, hold.slide};
    place.guarded([&] {
      attachment.link = scene().robot(attachment.robot).robot->link(place["link"].text());
      scene().attach(attachment);
    });
  }

  void hold_rod(const JsonPlace& place) {
    PlacedRod& rod = scene().rod(place["name"].text());
    for (const JsonPlace& entry : list(place, "holds")) {
      const Hold hold = read_hold(entry);
      if (rod.hold_at(hold.at)) entry.fail("'" + rod.name() + "' is held at " + rod.describe(hold.at) + " twice");
      if (entry.has("robot") || entry.has("link")) attach(entry, rod, hold);
      else entry.guarded([&] { rod.hold(hold); });
    }
    for (const JsonPlace& entry : list(place, "loads")) {
      entry.only({"at", "force", "moment"});
      PointLoad load;
      load.at = entry["at"].number();
      if (entry.has("force")) load.force = entry["force"].vector();
      if (entry.has("moment")) load.moment = entry["moment"].vector();
      entry.guarded([&] { rod.load(load); });
    }
  }

  fs::path folder_;
  const RunContext& context_;
  LoadedScene loaded_;
  std::map<std::pair<std::string, double>, std::shared_ptr<const TriangleSurface>> surfaces_;
};

}  // namespace

LoadedScene parse_scene(std::string_view text, const std::string& path, const RunContext& context) {
  const std::string who = "scene.load: " + path;
  Json file = parse_json(text, who);
  bring_up_to_date(file, who);
  return Reader(path, context).read(JsonPlace(file, who));
}

LoadedScene load_scene(const std::string& path, const RunContext& context) {
  std::string text;
  try {
    text = read_file(path);
  } catch (const UsageError& missing) {
    throw UsageError(std::string("scene.load: ") + missing.what());
  }
  return parse_scene(text, path, context);
}

}  // namespace tendril
