// Files of several parts, and binary glTF that moves, read back.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/json_text.h"
#include "geometry/glb_scene.h"
#include "geometry/import_mesh.h"
#include "geometry/mesh_topology.h"
#include "geometry/tube_surface.h"
#include "unit/geometry/glb_reader.h"
#include "unit/geometry/mesh_files.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using Catch::Contains;
using Catch::EndsWith;
using tendril::test::box_mesh;
using tendril::test::Folder;
using tendril::test::Glb;
using tendril::test::Json;
using tendril::test::Random;

namespace {

SurfacePart part(const std::string& name, const Mesh& mesh, const Frame& pose = {}) {
  SurfacePart part;
  part.name = name;
  part.mesh = std::make_shared<const Mesh>(mesh);
  part.pose = pose;
  return part;
}

Vec3 vec(const std::vector<double>& row) { return {row[0], row[1], row[2]}; }
Quat quat(const std::vector<double>& row) { return {row[3], row[0], row[1], row[2]}; }
std::vector<double> numbers(const Json& list) {
  std::vector<double> all;
  for (const Json& item : list.items) all.push_back(item.number);
  return all;
}
Vec3 z_up(const Vec3& v) { return {v.x(), -v.z(), v.y()}; }

/// A bent tube of `count` sections over a quarter circle of radius r, at a share of its bend.
std::vector<Frame> bent(int count, double share) {
  std::vector<Frame> sections;
  for (int i = 0; i < count; ++i) {
    const double s = 0.5 * i / (count - 1), k = 2 * share, angle = k * s;
    const Vec3 at = k > 0 ? Vec3(std::sin(angle) / k, 0, (1 - std::cos(angle)) / k) : Vec3(s, 0, 0);
    sections.push_back(Frame::looking(at, Vec3(std::cos(angle), 0, std::sin(angle)), Vec3::UnitY()));
  }
  return sections;
}

}  // namespace

TEST_CASE("a tube through sections is closed, outward, and knows its sections", "[glb]") {
  const int count = 41, sides = 24;
  const std::vector<Frame> sections = bent(count, 1);
  const Mesh tube = tube_surface(sections, std::vector<double>(count, 0.02), sides);
  const double polygon = 0.5 * sides * std::sin(2 * M_PI / sides) * 0.02 * 0.02;
  CHECK(tube.volume() == Approx(0.5 * polygon).epsilon(1e-3));  // Pappus: its area times the way of its middle
  CHECK(topology_of(welded(tube, 1e-9).mesh, 0).watertight());
  const std::vector<int> of = section_of_vertex(count, sides);
  REQUIRE(of.size() == tube.vertices.size());
  for (std::size_t i = 0; i < of.size(); ++i) {
    const Frame& section = sections[static_cast<std::size_t>(of[i])];
    const Vec3 local = section.rotation.conjugate() * (tube.vertices[i] - section.at);
    CHECK(std::abs(local.z()) < 1e-12);
    CHECK((local.norm() < 1e-12 || std::abs(local.norm() - 0.02) < 1e-12));
  }
  // A cone from 10 to 30 mm.
  std::vector<double> radii;
  for (int i = 0; i < count; ++i) radii.push_back(0.01 + 0.02 * i / (count - 1));
  CHECK(tube_surface(bent(count, 0), radii, 256).volume() == Approx(M_PI * 0.5 / 3 * (1e-4 + 3e-4 + 9e-4)).epsilon(1e-3));
  CHECK_THROWS_WITH(tube_surface({Frame()}, {0.1}, 8), "tube: 1 sections, 1 radii and 8 sides; at least 2 sections, a radius each and 3 sides expected");
  CHECK_THROWS_WITH(tube_surface(bent(3, 0), {0.1, 0, 0.1}, 8), "tube: section 2 is not finite, or its radius of 0 m is not above 0");
}

TEST_CASE("parts are written in every format and read back in their places", "[glb]") {
  const Folder folder;
  Random random(31);
  const std::vector<SurfacePart> parts = {part("first box", box_mesh({0.3, 0.4, 0.5}), {{1, 2, 3}, random.rotation()}),
                                          part("tube", tube_surface(bent(20, 1), std::vector<double>(20, 0.05), 16))};
  const Mesh all = joined(parts);
  const double volume = parts[0].mesh->volume() + parts[1].mesh->volume();
  CHECK(all.volume() == Approx(volume));
  for (const char* name : {"a.stl", "a.ply", "a.obj", "a.GLB"})
    for (const double unit : {1.0, 1e-3}) {
      CAPTURE(name, unit);
      const bool glb = std::string(name) == "a.GLB";
      if (glb && unit != 1) continue;
      save_surfaces(folder / name, parts, unit);
      Mesh mesh = load_mesh(folder / name, unit).mesh;
      if (glb)
        for (Vec3& v : mesh.vertices) v = z_up(v);
      CHECK(mesh.triangles.size() == all.triangles.size());
      CHECK(mesh.volume() == Approx(volume).epsilon(1e-5));
      CHECK((mesh.box().min() - all.box().min()).norm() < 1e-6);
      CHECK((mesh.box().max() - all.box().max()).norm() < 1e-6);
    }
  const std::string obj = obj_of(parts);
  CHECK(obj.find("\ng first_box\n") != obj.npos);
  CHECK(obj.find("\ng tube\n") != obj.npos);
  CHECK_THROWS_WITH(save_surfaces(folder / "b.glb", {}), EndsWith("b.glb': there is nothing to write"));
  CHECK_THROWS_WITH(save_surfaces(folder / "b.glb", parts, 1e-3), EndsWith("b.glb': glTF files are in metres; leave the unit out"));
  CHECK_THROWS_WITH(save_surfaces(folder / "b.stl", parts, -1), EndsWith("the unit is -1; a finite number of metres above 0 expected"));
  CHECK_THROWS_WITH(save_surfaces(folder / "b.step", parts), Contains("files of the suffix '.step' are not written"));
  CHECK_THROWS_AS(save_surfaces(folder / "b.glb", {part("nothing", Mesh{})}), UsageError);
}

TEST_CASE("binary glTF at rest: names, materials, bounds", "[glb]") {
  SurfacePart sheet = part("sheet \"A\"\\\n", box_mesh({0.3, 0.4, 0.5}), {{1, 2, 3}, Quat::Identity()});
  sheet.colour = {1, 0.5f, 0};
  sheet.opacity = 0.5f;
  sheet.double_sided = true;
  SurfacePart round = part("round", box_mesh({1, 1, 1}));
  round.smooth = true;
  const Glb glb(glb_of(std::vector{sheet, round}));
  CHECK(glb.json["asset"]["version"].text == "2.0");
  CHECK(numbers(glb.json["scenes"][0]["nodes"]) == std::vector<double>{0, 1});
  REQUIRE(glb.json["nodes"].size() == 2);
  CHECK(glb.json["nodes"][0]["name"].text == "sheet \"A\"\\u000a");  // as the test's reader leaves it
  CHECK(vec(numbers(glb.json["nodes"][0]["translation"])) == Vec3(1, 3, -2));
  const Json& material = glb.json["materials"][0];
  CHECK(material["alphaMode"].text == "BLEND");
  CHECK(material["doubleSided"].number == 1);
  const std::vector<double> colour = numbers(material["pbrMetallicRoughness"]["baseColorFactor"]);
  CHECK(colour[0] == 1);
  CHECK(colour[1] == Approx(0.2140).epsilon(1e-3));  // linear light of sRGB 0.5
  CHECK(colour[2] == 0);
  CHECK(colour[3] == 0.5);
  CHECK_FALSE(glb.json["materials"][1].has("alphaMode"));
  CHECK_FALSE(glb.json["materials"][1].has("doubleSided"));
  const Json& flat = glb.json["meshes"][0]["primitives"][0];
  CHECK_FALSE(flat["attributes"].has("NORMAL"));
  const Json& smooth = glb.json["meshes"][1]["primitives"][0];
  for (const auto& n : glb.rows(smooth["attributes"]["NORMAL"])) CHECK(vec(n).norm() == Approx(1));
  for (const Json* primitive : {&flat, &smooth}) {
    const auto positions = glb.rows((*primitive)["attributes"]["POSITION"]);
    const Json& accessor = glb.json["accessors"][(*primitive)["attributes"]["POSITION"].index()];
    Eigen::AlignedBox3d box;
    for (const auto& p : positions) box.extend(vec(p));
    CHECK(vec(numbers(accessor["min"])).cast<float>() == box.min().cast<float>());
    CHECK(vec(numbers(accessor["max"])).cast<float>() == box.max().cast<float>());
    const auto indices = glb.rows((*primitive)["indices"]);
    CHECK(indices.size() == 36);
    for (const auto& i : indices) CHECK(i[0] < static_cast<double>(positions.size()));
  }
  CHECK_FALSE(glb.json.has("animations"));
  CHECK_FALSE(glb.json.has("skins"));
}

TEST_CASE("binary glTF that moves plays what it was given", "[glb]") {
  Random random(32);
  const int count = 21, sides = 12;
  const std::vector<double> times = {0, 0.5, 2, 3};
  MovingPart hose, link, still;
  for (const double t : times) {
    hose.sections.push_back(bent(count, t / 3));
    link.poses.push_back({random.point(2), random.rotation()});
  }
  hose.part = part("hose", tube_surface(hose.sections[0], std::vector<double>(count, 0.02), sides));
  hose.part.smooth = true;
  hose.section_of_vertex = section_of_vertex(count, sides);
  link.part = part("link", box_mesh({0.1, 0.2, 0.3}), link.poses[0]);
  still.part = part("still", box_mesh({1, 1, 0.1}));
  const std::string bytes = glb_of({hose, link, still}, times);
  const Glb glb(bytes);

  const Json& animation = glb.json["animations"][0];
  CHECK(animation["channels"].size() == 2 * (count + 1));
  // What a viewer makes of it: for each node its translation and rotation at each time.
  std::map<int, std::vector<std::vector<double>>> translations, rotations;
  for (const Json& channel : animation["channels"].items) {
    const Json& sampler = animation["samplers"][channel["sampler"].index()];
    const auto input = glb.rows(sampler["input"]);
    REQUIRE(input.size() == times.size());
    for (std::size_t i = 0; i < times.size(); ++i) CHECK(input[i][0] == times[i]);
    CHECK(glb.json["accessors"][sampler["input"].index()]["min"][0].number == 0);
    CHECK(glb.json["accessors"][sampler["input"].index()]["max"][0].number == 3);
    CHECK_FALSE(sampler.has("interpolation"));  // linear
    auto& of = channel["target"]["path"].text == "translation" ? translations : rotations;
    of[static_cast<int>(channel["target"]["node"].number)] = glb.rows(sampler["output"]);
  }
  CHECK(translations.count(glb.node("still")) == 0);
  const auto place = [&](int node, std::size_t t) { return Frame{vec(translations.at(node)[t]), quat(rotations.at(node)[t])}; };

  const int box = glb.node("link");
  for (std::size_t t = 0; t < times.size(); ++t)
    for (const Vec3& v : link.part.mesh->vertices) {
      const Frame shown = place(box, t);
      CHECK((z_up(shown.at + shown.rotation * v) - (link.poses[t].at + link.poses[t].rotation * v)).norm() < 1e-6);
    }

  const Json& node = glb.json["nodes"][static_cast<std::size_t>(glb.node("hose"))];
  const Json& skin = glb.json["skins"][node["skin"].index()];
  const Json& attributes = glb.json["meshes"][node["mesh"].index()]["primitives"][0]["attributes"];
  const auto positions = glb.rows(attributes["POSITION"]), joints = glb.rows(attributes["JOINTS_0"]), weights = glb.rows(attributes["WEIGHTS_0"]);
  const auto inverses = glb.rows(skin["inverseBindMatrices"]);
  REQUIRE(skin["joints"].size() == count);
  REQUIRE(inverses.size() == count);
  for (std::size_t t = 0; t < times.size(); ++t) {
    const Mesh expected = tube_surface(hose.sections[t], std::vector<double>(count, 0.02), sides);
    double worst = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      CHECK(weights[i] == std::vector<double>{1, 0, 0, 0});
      const std::size_t joint = static_cast<std::size_t>(joints[i][0]);
      const Eigen::Map<const Eigen::Matrix4d> inverse(inverses[joint].data());
      const Frame shown = place(static_cast<int>(skin["joints"][joint].number), t);
      const Vec3 local = (inverse * Eigen::Vector4d(positions[i][0], positions[i][1], positions[i][2], 1)).head<3>();
      worst = std::max(worst, (z_up(shown.at + shown.rotation * local) - expected.vertices[i]).norm());
    }
    CHECK(worst < 1e-6);
  }
  for (const auto& [joint, all] : rotations)
    for (std::size_t t = 0; t < all.size(); ++t) {
      CHECK(quat(all[t]).norm() == Approx(1));
      if (t > 0) CHECK(quat(all[t]).dot(quat(all[t - 1])) >= 0);
    }
  // Without the animation: the first time.
  const Folder folder;
  Mesh first = load_mesh(folder.write("a.glb", bytes), 1).mesh;
  for (Vec3& v : first.vertices) v = z_up(v);
  const Mesh expected = joined({hose.part, link.part, still.part});
  CHECK(first.volume() == Approx(expected.volume()).epsilon(1e-5));
  CHECK((first.box().min() - expected.box().min()).norm() < 1e-6);
  CHECK((first.box().max() - expected.box().max()).norm() < 1e-6);
}

TEST_CASE("what cannot move so is refused", "[glb]") {
  MovingPart box;
  box.part = part("box", box_mesh({1, 1, 1}));
  const auto says = [&](const std::vector<double>& times, const std::string& why) { CHECK_THROWS_WITH(glb_of({box}, times), why); };
  const std::string rise = "glb: the times do not rise; at least two from 0 on, each above the last in single precision, expected";
  says({}, rise);
  says({0}, rise);
  says({0, 0}, rise);
  says({-1, 1}, rise);
  says({0, 1e60}, rise);
  says({1, 1 + 1e-12}, rise);
  box.poses.resize(3);
  says({0, 1}, "glb: part 'box': 3 poses at 2 times");
  box.sections = {{Frame()}, {Frame()}};
  says({0, 1}, "glb: part 'box': poses and sections are given; one of them expected");
  box.poses.clear();
  says({0, 1}, "glb: part 'box': a section for each vertex expected");
  box.section_of_vertex.assign(box.part.mesh->vertices.size(), 1);
  says({0, 1}, "glb: part 'box': a section for each vertex expected");
  box.sections = {{Frame()}, {}};
  says({0, 1}, "glb: part 'box': its sections do not fit; at each time the same 1 to 65535 expected");
}

TEST_CASE("text in JSON is quoted, and always UTF-8", "[glb]") {
  CHECK(json_string("a \"b\" \\ \n") == "\"a \\\"b\\\" \\\\ \\u000a\"");
  CHECK(json_string("Schl\xc3\xa4uche \xe2\x82\xac \xf0\x9f\x94\xa7") == "\"Schl\xc3\xa4uche \xe2\x82\xac \xf0\x9f\x94\xa7\"");
  for (const char* bad : {"\xe4", "\xc3", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe0\x80\x80", "\xf0\x80\x80\x80", "\xff"}) {
    const std::string text = json_string("a" + std::string(bad) + "b");
    for (const char c : text) CHECK(static_cast<unsigned char>(c) < 0x80);
    CHECK(text.size() == std::string(bad).size() + 4);
  }
}
