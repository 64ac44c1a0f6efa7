// Scene files: saved and loaded bit-equal, older versions, other folders, and what no file may do.
#include <catch2/catch.hpp>

#include <cstring>

#include "base/error.h"
#include "base/write_file.h"
#include "geometry/import_mesh.h"
#include "geometry/mesh_export.h"
#include "harness/scene_file.h"
#include "robot/load_robot.h"
#include "unit/geometry/mesh_files.h"
#include "unit/harness/random_scene.h"

using namespace tendril;
using namespace tendril::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const char* const two_axes = R"(<robot name="arm"><link name="base"/>
  <link name="upper"><collision><geometry><box size="0.1 0.1 0.6"/></geometry></collision></link><link name="fore"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="1"/></joint>
  <joint name="bend" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 0.6"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1.5" velocity="1"/></joint></robot>)";

bool same_bits(const Vec3& a, const Vec3& b) { return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0; }
bool same_bits(const Quat& a, const Quat& b) { return std::memcmp(a.coeffs().data(), b.coeffs().data(), sizeof(double) * 4) == 0; }
bool same_bits(const Frame& a, const Frame& b) { return same_bits(a.at, b.at) && same_bits(a.rotation, b.rotation); }

template <class T>
bool all_same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return same_bits(x, y); });
}

/// Two rods at a branch point over a box, one of them preformed, clips that slide, a load.
Scene forked() {
  Scene scene(testing::earth);
  scene.add(testing::solid("box", Box{{1, 1, 0.1}}, {0.4, 0, 0.7}, 0.004));
  scene.add(testing::sheet("sheet", {0, 0, -1}));
  Rod bent;
  form(bent, Curve::pcc({{0, 0, 0}, {0.4, 0, 0}, {0.4, 0.5, 0}}, 0.1));
  bent.parts = {{bent.length, testing::soft_section()}};
  PlacedRod& trunk = scene.add(testing::sagging_hose("trunk"));
  trunk.release(trunk.rod().length);
  PlacedRod& left = scene.add(PlacedRod("left", bent, std::nullopt, Frame::looking({1.2, 0.5, 1}, {0, 1, 0})));
  scene.join("branch", {{&trunk, trunk.rod().length, std::nullopt}, {&left, 0, std::nullopt}}, std::nullopt);
  trunk.hold({0.6, Frame::looking({0.45, 0, 0.9}, {1, 0, 0}), true, true, 0, true});
  trunk.load({0.3, {0, 0.2, -0.1}, {0, 0, 0.01}});
  return scene;
}

/// What loading a changed text of forked() says.
std::string error_of(const std::string& from, const std::string& to) {
  std::string text = scene_text(forked(), "study.scene.json");
  const std::size_t at = text.find(from);
  REQUIRE(at != text.npos);
  text.replace(at, from.size(), to);
  try {
    parse_scene(text, "study.scene.json");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("scene file: random scenes are saved, loaded and saved again to the same bytes") {
  const Folder folder;
  const auto robot = load_robot(folder.write("arm.urdf", two_axes));
  for (unsigned seed = 1; seed <= 300; ++seed) {
    INFO("seed " << seed);
    const Scene scene = random_scene(seed, robot);
    const std::string text = scene_text(scene, folder / "a.scene.json");
    const LoadedScene loaded = parse_scene(text, folder / "a.scene.json");
    CHECK(loaded.warnings.empty());
    CHECK(scene_text(*loaded.scene, folder / "a.scene.json") == text);
    REQUIRE(loaded.scene->rods().size() == scene.rods().size());
    for (std::size_t k = 0; k < scene.rods().size(); ++k) {
      const PlacedRod &a = *scene.rods()[k], &b = *loaded.scene->rods()[k];
      std::vector<Frame> there, back;
      for (const Hold& hold : a.holds()) there.push_back(hold.frame);
      for (const Hold& hold : b.holds()) back.push_back(hold.frame);
      CHECK(all_same_bits(there, back));
      CHECK(a.attachments().size() == b.attachments().size());
      CHECK(a.rod().shape_breaks == b.rod().shape_breaks);
      CHECK(a.rod().parts.front().section.made_of().has_value() == b.rod().parts.front().section.made_of().has_value());
    }
  }
}

TEST_CASE("scene file: a loaded scene solves to the same bits") {
  const Scene scene = forked();
  const LoadedScene loaded = parse_scene(scene_text(scene, "x.json"), "x.json");
  const SceneEquilibrium a = scene.solve(), b = loaded.scene->solve();
  REQUIRE(a.rods.size() == 2);
  CHECK(a.status() == Status::solved);
  for (std::size_t k = 0; k < a.rods.size(); ++k) {
    CHECK(a.rods[k].equilibrium.points.size() > 10);
    CHECK(all_same_bits(a.rods[k].equilibrium.points, b.rods[k].equilibrium.points));
    CHECK(all_same_bits(a.rods[k].equilibrium.rotations, b.rods[k].equilibrium.rotations));
  }
}

TEST_CASE("scene file: meshes and robots in files are found from another folder, and a changed file is told") {
  const Folder folder;
  std::filesystem::create_directories(folder / "study/assets");
  Mesh sheet = std::get<std::shared_ptr<const TriangleSurface>>(testing::sheet("sheet", {0, 0, 0}).body.shape)->mesh();
  save_mesh(folder / "study/assets/sheet.stl", sheet, units::mm);
  write_file(folder / "study/assets/arm.urdf", two_axes);
  Scene scene;
  PlacedObstacle obstacle = testing::sheet("sheet", {0, 0, -1});
  obstacle.body.shape = std::make_shared<const TriangleSurface>(load_mesh(folder / "study/assets/sheet.stl", units::mm).mesh);
  obstacle.file = MeshFile{folder / "study/assets/sheet.stl", units::mm};
  scene.add(obstacle);
  obstacle.name = "again";
  scene.add(obstacle);
  scene.add(PlacedRobot{"arm", load_robot(folder / "study/assets/arm.urdf"), {}});
  save_scene(folder / "study/a.scene.json", scene);
  CHECK_THAT(read_file(folder / "study/a.scene.json"), Contains("\"file\": \"assets/sheet.stl\"") && Contains("\"robot\": \"assets/arm.urdf\""));

  // The study moves as a whole.
  std::filesystem::rename(folder / "study", folder / "moved");
  const LoadedScene loaded = load_scene(folder / "moved/a.scene.json");
  CHECK(loaded.warnings.empty());
  const auto& shapes = loaded.scene->obstacles();
  CHECK(std::get<0>(shapes[0].body.shape) == std::get<0>(shapes[1].body.shape));  // one mesh, two places
  CHECK(std::get<0>(shapes[0].body.shape)->mesh().vertices == std::get<0>(obstacle.body.shape)->mesh().vertices);
  CHECK(loaded.scene->robot("arm").robot->name() == "arm");

  // From the working directory with a bare name, and from a folder below.
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "moved");
  CHECK(load_scene("a.scene.json").warnings.empty());
  std::filesystem::current_path(before);
  save_scene(folder / "moved/below/deep/b.scene.json", *loaded.scene);
  CHECK_THAT(read_file(folder / "moved/below/deep/b.scene.json"), Contains("\"../../assets/sheet.stl\""));
  save_scene(folder / "moved/below/deep/er/c.scene.json", *loaded.scene);
  CHECK_THAT(read_file(folder / "moved/below/deep/er/c.scene.json"), Contains("\"" + (folder / "moved/assets/sheet.stl") + "\""));

  // What has nothing but the root in common is named by its whole path.
  CHECK_THAT(scene_text(*loaded.scene, "/nowhere.scene.json"), Contains("\"" + (folder / "moved/assets/sheet.stl") + "\""));

  // Inside the file itself the mesh needs no other file.
  save_scene(folder / "embedded.scene.json", *loaded.scene, {.embed = true});
  save_mesh(folder / "moved/assets/sheet.stl", sheet.moved({0, 0, 1}, Quat::Identity()), units::mm);
  write_file(folder / "moved/assets/arm.urdf", std::string(two_axes) + "\n");
  const LoadedScene changed = load_scene(folder / "moved/a.scene.json");
  REQUIRE(changed.warnings.size() == 2);
  CHECK(changed.warnings[0] == "'" + (folder / "moved/assets/sheet.stl") + "' has changed since the scene was saved");
  CHECK_THAT(changed.warnings[1], Contains("arm.urdf' has changed"));
  std::filesystem::remove(folder / "moved/assets/sheet.stl");
  CHECK_THROWS_WITH(load_scene(folder / "moved/a.scene.json"),
                    StartsWith("scene.load: " + (folder / "moved/a.scene.json") + ": obstacles[1].mesh: ") && Contains("sheet.stl"));
  CHECK_THROWS_WITH(save_scene(folder / "d.scene.json", *loaded.scene), Contains("obstacle 'sheet'") && Contains("embed = true"));
  CHECK_FALSE(std::filesystem::exists(folder / "d.scene.json"));
  CHECK(load_scene(folder / "embedded.scene.json").scene->obstacles().size() == 2);
}

TEST_CASE("scene file: samples of every version load to the same scene") {
  const LoadedScene first = load_scene("tests/unit/harness/files/version_0.scene.json");
  const LoadedScene now = load_scene("tests/unit/harness/files/version_1.scene.json");
  CHECK(scene_text(*first.scene, "x.json") == scene_text(*now.scene, "x.json"));
  CHECK(scene_text(*now.scene, "x.json") == read_file("tests/unit/harness/files/version_1.scene.json"));
  const Rod& hose = now.scene->rod("hose").rod();
  REQUIRE(hose.parts.size() == 1);
  CHECK(hose.parts[0].upto == 1.2);
  CHECK(hose.parts[0].section.EI1 == Approx(6e6 * units::pi / 64 * (std::pow(0.02, 4) - std::pow(0.01, 4))));
  CHECK(hose.parts[0].section.made_of()->young == 6e6);
  CHECK(now.scene->solve().status() == Status::solved);
}

TEST_CASE("scene file: a newer version and other files are refused") {
  CHECK(error_of("\"version\": 1", "\"version\": 2") ==
        "scene.load: study.scene.json: version: the file is of version 2, this program reads versions up to 1; a newer one is needed");
  CHECK_THAT(error_of("\"version\": 1", "\"version\": 0.5"), Contains("version: got 0.5, expected a whole number"));
  CHECK_THAT(error_of("\"version\": 1,", ""), Contains("'version' is missing"));
  CHECK_THAT(error_of("tendril scene", "other"), Contains("this is no scene file"));
  CHECK_THROWS_WITH(parse_scene("{}", "x"), Contains("this is no scene file"));
  CHECK_THROWS_WITH(parse_scene("[1]", "x"), Contains("this is no scene file"));
  CHECK_THROWS_WITH(load_scene("no/such/file.json"), StartsWith("scene.load: cannot read 'no/such/file.json'"));
  // An old file's own mistakes are told as well.
  CHECK_THROWS_WITH(parse_scene("{\"format\": \"tendril scene\", \"version\": 0, \"rods\": [{\"name\": \"a\", \"section\": 1}]}", "x"),
                    Contains("rods[1]"));
  CHECK_THROWS_WITH(parse_scene("{\"format\": \"tendril scene\", \"version\": 0, \"rods\": 3}", "x"), Contains("rods: got 3, expected a list"));
}

TEST_CASE("scene file: what is wrong is told by its place") {
  CHECK(error_of("\"segments\": 40", "\"segments\": \"many\"") ==
        "scene.load: study.scene.json: rods[1].segments: got \"many\", expected a number");
  CHECK_THAT(error_of("\"segments\": 40", "\"segments\": 4.5"), Contains("rods[1].segments: got 4.5, expected a whole number from 1 to 1000000"));
  CHECK_THAT(error_of("\"segments\": 40", "\"segmants\": 40"), Contains("rods[1]: unknown key 'segmants'; did you mean 'segments'?"));
  CHECK_THAT(error_of("\"at\": 0.6", "\"at\": 7"), Contains("rods[1].holds[2]: ") && Contains("0 to 1.2 m"));
  CHECK_THAT(error_of("\"at\": 0.6", "\"at\": 0"), Contains("rods[1].holds[2]: 'trunk' is held at its start twice"));
  CHECK_THAT(error_of("\"at\": 0.6", "\"at\": 1e999"), Contains("1e999"));
  CHECK_THAT(error_of("\"at\": 0.6", "\"at\": NaN"), Contains("line "));
  CHECK_THAT(error_of("\"at\": 0.6", "\"at\": null"), Contains("rods[1].holds[2].at: got null, expected a number"));
  CHECK_THAT(error_of("\"at\": 0.6,", ""), Contains("rods[1].holds[2]: 'at' is missing"));
  CHECK_THAT(error_of("\"slide\": true", "\"slide\": 1"), Contains("rods[1].holds[2].slide: got 1, expected true or false"));
  CHECK_THAT(error_of("\"name\": \"left\"", "\"name\": \"trunk\""), Contains("rods[2]: ") && Contains("already has a rod 'trunk'"));
  CHECK_THAT(error_of("\"name\": \"left\"", "\"name\": \"\""), Contains("rods[2]: ") && Contains("the name is empty"));
  CHECK_THAT(error_of("\"name\": \"sheet\"", "\"name\": \"box\""), Contains("obstacles[2]: ") && Contains("already has an obstacle 'box'"));
  CHECK_THAT(error_of("\"rod\": \"left\"", "\"rod\": \"lefd\""), Contains("branches[1].places[2].rod: ") && Contains("did you mean 'left'?"));
  CHECK_THAT(error_of("\"kind\": \"box\"", "\"kind\": \"bix\""), Contains("obstacles[1].solid.kind: unknown 'bix'; did you mean 'box'?"));
  CHECK_THAT(error_of("\"size\": [1, 1, 0.1]", "\"size\": [1, 1, -0.1]"), Contains("obstacles[1].solid: "));
  CHECK_THAT(error_of("\"clearance\": 0.004", "\"clearance\": -1"), Contains("obstacles[1].clearance: got -1, expected a number of at least 0"));
  CHECK_THAT(error_of("\"prefer\": \"neutral\"", "\"prefer\": \"far\""), Contains("obstacles[1].prefer: unknown 'far'"));
  CHECK_THAT(error_of("\"triangles\": [", "\"triangles\": [\n[1, 2, 9],"), Contains("obstacles[2].mesh.triangles[1][3]: got 9, expected a whole number from 1 to 4"));
  CHECK_THAT(error_of("\"triangles\": [", "\"triangles\": [\n[1, 2],"), Contains("obstacles[2].mesh.triangles[1]: got 2 corners, expected 3"));
  CHECK_THAT(error_of("\"solid\":", "\"mesh\": {}, \"solid\":"), Contains("obstacles[1]: expected exactly one of 'solid' and 'mesh'"));
  CHECK_THAT(error_of("\"EA\": ", "\"EA\": 1"), Contains("rods[1].parts[1].section: the stiffnesses are not those of 'material'"));
  CHECK_THAT(error_of("\"EA\": ", "\"EA\": -"), Contains("rods[1].parts[1].section: ") && Contains("'EA' is -"));
  CHECK_THAT(error_of("\"GA\": [", "\"GA\": [1, "), Contains("rods[1].parts[1].section.GA: got a list of 3, expected 2 numbers"));
  CHECK_THAT(error_of("\"young\": 6000000", "\"young\": 0"), Contains("rods[1].parts[1].section.material: ") && Contains("'young' is 0"));
  CHECK_THAT(error_of("\"radii\": [0.1]", "\"radii\": [3]"), Contains("rods[2].shape: curve.pcc: "));
  CHECK_THAT(error_of("\"radii\": [0.1]", "\"radii\": [0.2]"), Contains("rods[2].shape: it is ") && Contains("but the rod's length is"));
  CHECK_THAT(error_of("\"kind\": \"pcc\"", "\"kind\": \"bezier\""), Contains("rods[2].shape.kind: unknown 'bezier'"));
  CHECK_THAT(error_of("\"length\": 1.2", "\"length\": 0"), Contains("rods[1]: ") && Contains("length"));
  CHECK_THAT(error_of("\"gravity\": [0, 0, -9.81]", "\"gravity\": [0, -9.81]"), Contains("gravity: got a list of 2, expected a list of 3 numbers"));
  CHECK_THAT(error_of("m, kg, s, N, rad", "mm"), Contains("units: expected \"m, kg, s, N, rad\""));
  CHECK_THAT(error_of("\"rods\": [", "\"rods\": [7, "), Contains("rods[1]: got 7, expected an object"));
  CHECK_THAT(error_of("\"rods\": [", "\"rods\": " + std::string(100'000, '[')), Contains("nested deeper than 32"));
  CHECK_THAT(error_of("\"force\": [0, 0.2, -0.1]", "\"force\": [0, 0.2, true]"), Contains("rods[1].loads[1].force[3]: got true, expected a number"));
  CHECK_THAT(error_of("\"slide\": true", "\"robot\": \"arm\", \"link\": \"x\""), Contains("rods[1].holds[2]: ") && Contains("unknown robot 'arm'"));
  CHECK_THAT(error_of("\"robots\": []", "\"robots\": [{\"name\": \"a\", \"robot\": \"/dev/zero\"}]"),
             Contains("robots[1].robot: '/dev/zero' is not a file"));
  CHECK_THAT(error_of("\"solid\": {\"kind\": \"box\", \"size\": [1, 1, 0.1]}", "\"mesh\": {\"file\": \"/dev\", \"unit\": 1}"),
             Contains("obstacles[1].mesh.file: '/dev' is not a file"));
  CHECK(error_of("\"name\": \"left\"", "\"na\\u001bme\": \"left\"").find('\x1b') == std::string::npos);
  CHECK_THAT(error_of("\"robots\": []", "\"robots\": [{\"name\": \"a\", \"robot\": \"builtin:none\"}]"), Contains("robots[1].robot: ") && Contains("'none'"));
}

TEST_CASE("scene file: shapes through frames") {
  Scene scene;
  Rod rod = Rod::uniform(1, testing::soft_section(), 20);
  form(rod, FrameShape{{0, 0.3, 1}, {Frame{}, Frame{{0.01, 0, 0.29}, Quat(0.8, 0, 0.6, 0)}, Frame{{0.6, 0, 0.5}, Quat(0.6, 0, 0.8, 0)}}});
  scene.add(PlacedRod("drawn", rod, Frame{}, std::nullopt));
  const std::string text = scene_text(scene, "x.json");
  const LoadedScene loaded = parse_scene(text, "x.json");
  CHECK(scene_text(*loaded.scene, "x.json") == text);
  CHECK(same_bits(loaded.scene->rod("drawn").rod().shape(0.7), rod.shape(0.7)));
  CHECK(loaded.scene->rod("drawn").rod().shape_breaks == std::vector<double>{0.3});
  const auto error = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    CHECK_THROWS_WITH(parse_scene(changed, "x.json"), StartsWith("scene.load: x.json: rods[1].shape"));
  };
  error("[0.3, ", "[0, ");
  error("[0.3, ", "[1.3, ");
  error("[0.3, ", "[");
  error("0.8, 0, 0.6, 0]", "0.9, 0, 0.6, 0]");
  error("\"stations\"", "\"station\"");
}

TEST_CASE("scene file: a truncated file is refused wherever it ends") {
  const std::string text = scene_text(forked(), "x.json");
  for (std::size_t size = 0; size + 2 < text.size(); size += 7)
    CHECK_THROWS_AS(parse_scene(std::string_view(text).substr(0, size), "x.json"), UsageError);
}

TEST_CASE("scene file: random damage never does more than throw") {
  const std::string text = scene_text(forked(), "x.json");
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    std::string damaged = text;
    for (int k = 1 + random.below(3); k > 0; --k) {
      const std::size_t at = static_cast<std::size_t>(random.below(int(damaged.size())));
      if (random.below(2)) damaged[at] = "0123456789.-e[]{},:\"tfnx\\ "[random.below(26)];
      else damaged.erase(at, 1 + random.below(8));
    }
    try {
      const LoadedScene loaded = parse_scene(damaged, "x.json");
      for (const auto& rod : loaded.scene->rods()) rod->rod().check();
    } catch (const UsageError& error) {
      CHECK_THAT(error.what(), StartsWith("scene.load: x.json: "));
    }
  }
}

TEST_CASE("scene file: what a file cannot hold is named") {
  Scene scene;
  Rod rod = Rod::uniform(1, testing::soft_section());
  rod.shape = [](double s) { return Frame{{0, 0, s}, Quat::Identity()}; };
  scene.add(PlacedRod("odd", rod, Frame{}, std::nullopt));
  CHECK_THROWS_WITH(scene_text(scene, "x.json"),
                    "scene:save: rod 'odd' has a shape that a scene file cannot hold: it is given by a function, not by a curve");
  Scene stretched;
  form(rod, Curve::polyline({{0, 0, 0}, {1, 0, 0}}));
  rod.length = rod.parts.back().upto = 0.5;
  stretched.add(PlacedRod("half", rod, Frame{}, std::nullopt));
  CHECK_THROWS_WITH(scene_text(stretched, "x.json"), Contains("rod 'half'") && Contains("not as long as the rod"));
  Scene latin;
  latin.add(PlacedRod("caf\xe9", Rod::uniform(1, testing::soft_section()), Frame{}, std::nullopt));
  CHECK_THROWS_WITH(scene_text(latin, "x.json"), StartsWith("scene:save: ") && Contains("is not UTF-8"));
  Scene robots;
  robots.add(PlacedRobot{"arm", std::make_shared<const Robot>(planar_arm({1})), {}});
  CHECK_THROWS_WITH(scene_text(robots, "x.json"), Contains("robot 'arm' was not loaded from a file"));
}

TEST_CASE("scene file: checksums are those of FNV-1a") {
  CHECK(checksum_of("") == "cbf29ce484222325");
  CHECK(checksum_of("a") == "af63dc4c8601ec8c");
  CHECK(checksum_of("foobar") == "85944171f73967e8");
}

TEST_CASE("section: remembers its material as long as it says all") {
  const Material rubber = Material::from_poisson(5e6, 0.5, 1100);
  Section section = Section::round(0.02, 0.01, rubber);
  REQUIRE(section.made_of());
  CHECK(section.made_of()->young == 5e6);
  section.EI1 *= 1.01;
  CHECK_FALSE(section.made_of());
  CHECK_FALSE(Section::round(0.02, 0.01, rubber, 0.5).made_of());
  CHECK_FALSE(Section{}.made_of());
}
