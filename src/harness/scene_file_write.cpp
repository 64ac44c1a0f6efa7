// Scene files: writing.
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/write_file.h"
#include "harness/json.h"
#include "harness/scene_file.h"
#include "scene/formed_rod.h"

namespace tendril {
namespace {

namespace fs = std::filesystem;

/// An object as it grows.
class Members {
 public:
  Members& add(const char* key, Json value) {
    object_.push_back({key, std::move(value)});
    return *this;
  }
  Members& add(const char* key, double value) { return add(key, Json{value}); }
  Members& add(const char* key, const std::string& value) { return add(key, Json{value}); }
  Members& add(const char* key, const char* value) { return add(key, Json{std::string(value)}); }
  Members& flag(const char* key, bool value) { return add(key, Json{value}); }
  Members& add_unless(const char* key, double value, double usual) { return value == usual ? *this : add(key, value); }
  Members& flag_unless(const char* key, bool value, bool usual) { return value == usual ? *this : flag(key, value); }
  operator Json() { return {std::move(object_)}; }

 private:
  Json::Object object_;
};

Json json_of(std::initializer_list<double> numbers) {
  Json::List list;
  for (const double x : numbers) list.push_back({x});
  return {std::move(list)};
}

Json json_of(const Vec3& v) { return json_of({v.x(), v.y(), v.z()}); }

Json json_of(const Frame& frame) {
  const Quat& q = frame.rotation;
  return Members().add("at", json_of(frame.at)).add("quaternion", json_of({q.w(), q.x(), q.y(), q.z()}));
}

template <class Values>
Json json_list(const Values& values) {
  Json::List list;
  for (const auto& value : values)
    if constexpr (std::is_convertible_v<decltype(value), double>) list.push_back({double(value)});
    else list.push_back(json_of(value));
  return {std::move(list)};
}

/// Names of files as the scene file at `path` should have them, and the files' checksums.
class Names {
 public:
  explicit Names(const std::string& path) : folder_(fs::absolute(path).lexically_normal().parent_path()) {}

  std::string relative(const std::string& file) const {
    const fs::path whole = fs::absolute(file).lexically_normal(), seen = whole.lexically_relative(folder_);
    constexpr int most_up = 2;
    int up = 0;
    fs::path common = folder_;
    for (const fs::path& part : seen) {
      if (part != "..") break;
      common = common.parent_path();
      ++up;
    }
    const bool near = !seen.empty() && up <= most_up && common != common.root_path();  // all have the root in common
    return (near ? seen : whole).generic_string();
  }

 private:
  fs::path folder_;
};

Json json_of(const Solid& solid) {
  if (const Box* box = std::get_if<Box>(&solid)) return Members().add("kind", "box").add("size", json_of(box->size));
  if (const Sphere* sphere = std::get_if<Sphere>(&solid)) return Members().add("kind", "sphere").add("radius", sphere->radius);
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&solid))
    return Members().add("kind", "cylinder").add("radius", cylinder->radius).add("length", cylinder->length);
  return Members().add("kind", "plane");
}

Json json_of(const Mesh& mesh) {
  Json::List triangles;
  for (const auto& t : mesh.triangles) triangles.push_back(json_of({t[0] + 1.0, t[1] + 1.0, t[2] + 1.0}));
  return Members().add("vertices", json_list(mesh.vertices)).add("triangles", Json{std::move(triangles)});
}

Json json_of(const PlacedObstacle& obstacle, const Names& names, const SaveSceneOptions& options) {
  Members members;
  members.add("name", obstacle.name);
  if (const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&obstacle.body.shape)) {
    if (obstacle.file && !options.embed) {
      std::string bytes;
      try {
        bytes = read_file(obstacle.file->path);
      } catch (const UsageError& gone) {
        throw UsageError("scene:save: obstacle '" + obstacle.name + "': " + gone.what() +
                         "; embed = true puts the meshes into the scene file itself");
      }
      members.add("mesh", Members().add("file", names.relative(obstacle.file->path)).add("unit", obstacle.file->unit)
                              .add("checksum", checksum_of(bytes)));
    } else {
      members.add("mesh", json_of((*surface)->mesh()));
    }
  } else {
    members.add("solid", json_of(std::get<Solid>(obstacle.body.shape)));
  }
  constexpr const char* preferences[] = {"neutral", "near", "avoid"};
  members.add("pose", json_of(obstacle.body.pose)).add("clearance", obstacle.clearance);
  return members.add("prefer", preferences[static_cast<int>(obstacle.prefer)]).flag("clip", obstacle.clip);
}

Json json_of(const PlacedRobot& robot, const Names& names) {
  const std::string& source = robot.robot->source();
  if (source.empty())
    throw UsageError("scene:save: robot '" + robot.name + "' was not loaded from a file, so that a scene file cannot name it");
  const bool builtin = source.starts_with("builtin:");
  Members members;
  members.add("name", robot.name).add("robot", builtin ? source : names.relative(source));
  if (!builtin) members.add("checksum", checksum_of(read_file(source)));
  return members.add("base", json_of(robot.base)).add("joints", json_list(robot.joints)).add("clearance", robot.clearance);
}

Json json_of(const Section& s) {
  Members members;
  members.add("outer", s.outer).add("inner", s.inner);
  if (const std::optional<Material> m = s.made_of())
    members.add("material", Members().add("young", m->young).add("shear", m->shear).add("density", m->density));
  members.add("EA", s.EA).add("GA", json_of({s.GA1, s.GA2})).add("EI", json_of({s.EI1, s.EI2}));
  return members.add("GJ", s.GJ).add("mass", s.mass);
}

Json json_of(const Curve& curve) {
  const Curve::Origin& origin = curve.origin();
  const std::string kind = curve.kind();
  Members members;
  members.add("kind", kind);
  if (kind == "helix")
    return members.add("radius", origin.radius).add("pitch", origin.pitch).add("turns", origin.turns)
        .flag("left_handed", origin.left_handed);
  members.add("points", json_list(origin.points));
  if (kind == "pcc") members.add("radii", json_list(origin.radii));
  if (origin.ends.start) members.add("start", json_of(*origin.ends.start));
  if (origin.ends.finish) members.add("finish", json_of(*origin.ends.finish));
  return members;
}

Json json_of(const FrameShape& shape) {
  Json::List stations;
  for (std::size_t k = 0; k < shape.s.size(); ++k) {
    const Vec3& p = shape.frames[k].at;
    const Quat& q = shape.frames[k].rotation;
    stations.push_back(json_of({shape.s[k], p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}));
  }
  return Members().add("kind", "frames").add("stations", Json{std::move(stations)});
}

Json shape_of(const PlacedRod& placed) {
  if (const FrameShape* frames = frames_of(placed.rod())) return json_of(*frames);
  const Curve* curve = curve_of(placed.rod());
  const auto fail = [&](const std::string& why) {
    throw UsageError("scene:save: rod '" + placed.name() + "' has a shape that a scene file cannot hold: " + why);
  };
  if (!curve) fail("it is given by a function, not by a curve");
  const std::string kind = curve->kind();
  if (kind != "polyline" && kind != "pcc" && kind != "spline" && kind != "helix") fail("a curve of kind \"" + kind + '"');
  if (std::abs(placed.rod().length - curve->length()) > 1e-9 * curve->length()) fail("its curve is not as long as the rod");
  check_bends(placed.rod(), *curve, "scene:save: rod '" + placed.name() + "'");
  return json_of(*curve);
}

Json json_of(const Hold& hold, const Attachment* attached, const Scene& scene) {
  Members members;
  members.add("at", hold.at);
  if (attached) {
    const PlacedRobot& robot = scene.robot(attached->robot);
    members.add("robot", robot.name).add("link", robot.robot->links()[attached->link].name);
  }
  members.add("frame", json_of(attached ? attached->in_link : hold.frame));
  members.flag_unless("position", hold.position, true).flag_unless("orientation", hold.orientation, true);
  return members.add_unless("turns", hold.turns, 0).flag_unless("slide", hold.slide, false).add_unless("cut_at", hold.cut_at, -1);
}

Json json_of(const PlacedRod& placed, const Scene& scene) {
  const Rod& rod = placed.rod();
  Json::List parts, holds, loads;
  for (const RodPart& part : rod.parts)
    parts.push_back(Members().add("upto", part.upto).add("section", json_of(part.section)));
  for (const Hold& hold : placed.holds()) holds.emplace_back(json_of(hold, placed.attachment_at(hold.at), scene));
  for (const PointLoad& load : placed.loads())
    loads.emplace_back(Members().add("at", load.at).add("force", json_of(load.force)).add("moment", json_of(load.moment)));
  Members members;
  members.add("name", placed.name()).add("length", rod.length).add("segments", rod.segments).add("parts", Json{std::move(parts)});
  if (rod.shape) members.add("shape", shape_of(placed));
  return members.add("holds", Json{std::move(holds)}).add("loads", Json{std::move(loads)});
}

Json json_of(const PlacedBranch& branch) {
  Json::List places;
  for (const JoinedPlace& place : branch.places)
    places.emplace_back(Members().add("rod", place.rod).add("at", place.at).add("relative", json_of(place.relative)));
  return Members().add("name", branch.name).add("places", Json{std::move(places)}).add("frame", json_of(branch.frame))
      .flag("position", branch.position).flag("orientation", branch.orientation);
}

}  // namespace

std::string scene_text(const Scene& scene, const std::string& path, const SaveSceneOptions& options) {
  const Names names(path);
  Json::List obstacles, robots, rods, branches;
  for (const PlacedObstacle& obstacle : scene.obstacles()) obstacles.emplace_back(json_of(obstacle, names, options));
  for (const PlacedRobot& robot : scene.robots()) robots.emplace_back(json_of(robot, names));
  for (const auto& rod : scene.rods()) rods.emplace_back(json_of(*rod, scene));
  for (const auto& branch : scene.branches()) branches.emplace_back(json_of(*branch));
  const Json file = Members().add("format", "tendril scene").add("version", scene_file_version).add("units", "m, kg, s, N, rad")
                       .add("gravity", json_of(scene.gravity())).add("obstacles", Json{std::move(obstacles)})
                       .add("robots", Json{std::move(robots)}).add("rods", Json{std::move(rods)})
                       .add("branches", Json{std::move(branches)});
  try {
    return json_text(file);
  } catch (const UsageError& wrong) {
    throw UsageError(std::string("scene:save: ") + wrong.what());
  }
}

void save_scene(const std::string& path, const Scene& scene, const SaveSceneOptions& options) {
  write_file(path, scene_text(scene, path, options));
}

std::string checksum_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3;
  std::string text(16, '0');
  for (int k = 15; k >= 0; --k, hash >>= 4) text[k] = "0123456789abcdef"[hash & 15];
  return text;
}

}  // namespace tendril
