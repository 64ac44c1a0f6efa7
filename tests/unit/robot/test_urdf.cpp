// Robots from URDF files: what is read, and what every kind of mistake is answered with.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/write_file.h"
#include "geometry/mesh_export.h"
#include "robot/load_robot.h"
#include "robot/package_path.h"
#include "robot/urdf.h"
#include "unit/robot/robots.h"

using namespace tendril;
using namespace tendril::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string two_links = "<robot name='r'>\n<link name='a'/>\n<link name='b'/>\n";

std::shared_ptr<const Robot> parsed(const std::string& text) { return parse_urdf(text, "r.urdf"); }

struct Folder {
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tendril_urdf_XXXXXX").string();
    REQUIRE(::mkdtemp(pattern.data()) != nullptr);
    path = pattern;
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

Mesh tetrahedron() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

}  // namespace

TEST_CASE("urdf: joints, limits, axes, mimicry and order", "[robot]") {
  const auto robot = parsed(R"(<?xml version="1.0"?>
<robot name="arm">
  <joint name="wrist" type="continuous"><parent link="fore"/><child link="hand"/><axis xyz="0 0 2"/><limit velocity="3"/></joint>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="fore"/><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>
    <axis xyz="0 1 0"/><limit lower="-0.5" upper="+1.5" velocity="0" effort="7"/></joint>
  <joint name="finger" type="revolute"><parent link="hand"/><child link="tip"/><limit lower="-1" upper="1" velocity="2"/>
    <mimic joint="wrist" multiplier="0.5" offset="0.1"/></joint>
  <joint name="glue" type="fixed"><parent link="base"/><child link="plate"/></joint>
  <link name="tip"/><link name="hand"/><link name="fore"/><link name="base"/><link name="plate"/>
</robot>)");
  CHECK(robot->name() == "arm");
  std::vector<std::string> links, joints;
  for (const Link& link : robot->links()) links.push_back(link.name);
  for (const Joint& joint : robot->joints()) joints.push_back(joint.name);
  CHECK(links == std::vector<std::string>{"base", "fore", "hand", "tip", "plate"});
  CHECK(joints == std::vector<std::string>{"slide", "wrist", "finger", "glue"});
  CHECK(robot->size() == 2);
  CHECK(robot->links()[robot->tip()].name == "tip");
  const Joint& slide = robot->joints()[0];
  CHECK(slide.kind == JointKind::prismatic);
  CHECK(slide.lower == -0.5);
  CHECK(slide.upper == 1.5);
  CHECK(std::isinf(slide.velocity));
  // rpy: about the fixed x, then y, then z.
  const Mat3 expected =
      (Eigen::AngleAxisd(0.3, Vec3::UnitZ()) * Eigen::AngleAxisd(0.2, Vec3::UnitY()) * Eigen::AngleAxisd(0.1, Vec3::UnitX()))
          .toRotationMatrix();
  CHECK((slide.origin.rotation.toRotationMatrix() - expected).norm() < 1e-15);
  CHECK(slide.origin.at == Vec3(1, 2, 3));
  CHECK(robot->joints()[1].axis == Vec3::UnitZ());
  CHECK(robot->joints()[1].velocity == 3);
  CHECK(std::isinf(robot->joints()[1].upper));
  CHECK(robot->joints()[2].axis == Vec3::UnitX());
  CHECK(robot->joints()[2].mimics == 1);
  CHECK(robot->joints()[2].factor == 0.5);
  CHECK(robot->upper()[1] == Approx(1.8));  // from the finger that follows
}

TEST_CASE("urdf: bodies", "[robot]") {
  const auto robot = parsed(R"(<robot name="r"><link name="a">
    <visual><origin xyz="1 0 0"/><geometry><box size="1 2 3"/></geometry></visual>
    <visual><geometry><cylinder radius="0.5" length="2"/></geometry></visual>
    <collision><geometry><sphere radius="0.25"/></geometry></collision></link></robot>)");
  REQUIRE(robot->links()[0].visual.size() == 2);
  CHECK(std::get<Box>(std::get<Solid>(robot->links()[0].visual[0].shape)).size == Vec3(1, 2, 3));
  CHECK(robot->links()[0].visual[0].pose.at == Vec3(1, 0, 0));
  CHECK(std::get<Cylinder>(std::get<Solid>(robot->links()[0].visual[1].shape)).length == 2);
  CHECK(std::get<Sphere>(std::get<Solid>(robot->links()[0].collision[0].shape)).radius == 0.25);
  CHECK(robot->size() == 0);
  CHECK(robot->tip() == 0);
  CHECK(robot->link_frame(0, {}).at.norm() == 0);
}

TEST_CASE("urdf: every mistake is told with file and line", "[robot]") {
  const auto refused = [](const std::string& text, const std::string& line, const std::string& why) {
    CAPTURE(text);
    CHECK_THROWS_WITH(parsed(text), StartsWith("robot 'r.urdf" + line + "': ") && Contains(why));
    CHECK_THROWS_AS(parsed(text), UsageError);
  };
  refused("", "", "the file is empty");
  refused(" \n ", "", "the file is empty");
  refused("<robot>\n<link name='a'>\n</robot>", ":3", "no well-formed XML");
  refused("hello", ":1", "XML");
  refused("<sdf/>", ":1", "got <sdf>, expected <robot>");
  refused("<robot>\n<xacro:macro/></robot>", ":2", "turn the xacro file into URDF first");
  refused("<robot name='r'/>", ":1", "no links");
  refused("<robot>\n<link/></robot>", ":2", "<link> has no 'name'");
  refused("<robot>\n<link name=''/></robot>", ":2", "without a name");
  refused("<robot>\n<link name='a'/>\n<link name='a'/></robot>", ":3", "'a' is there twice");
  const auto joint = [](const std::string& inner, const std::string& kind = "revolute") {
    return two_links + "<joint name='j' type='" + kind + "'>\n" + inner + "\n</joint></robot>";
  };
  const std::string ends = "<parent link='a'/><child link='b'/>", limit = "<limit lower='-1' upper='1' velocity='1'/>";
  CHECK(parsed(joint(ends + limit))->size() == 1);
  refused(joint(ends), ":4", "'j' is revolute and has no <limit>");
  refused(joint(ends, "prismatic"), ":4", "'j' is prismatic and has no <limit>");
  refused(joint(ends + limit, "floating"), ":4", "of the kind 'floating', expected fixed, revolute, continuous or prismatic");
  refused(joint("<child link='b'/>" + limit), ":4", "has no <parent>");
  refused(joint("<parent link='a'/>" + limit), ":4", "has no <child>");
  refused(joint("<parent link='a'/>\n<child link='bb'/>" + limit), ":6", "unknown link 'bb'; did you mean 'b'?");
  refused(joint("<parent link='a'/><child link='a'/>" + limit), ":4", "joins 'a' to itself");
  refused(joint(ends + "\n<limit lower='nan' upper='1' velocity='1'/>"), ":6",
          "'lower' of <limit> is 'nan', expected a finite number");
  refused(joint(ends + "\n<limit lower='-inf' upper='1' velocity='1'/>"), ":6", "'lower'");
  refused(joint(ends + "\n<limit lower='1rad' upper='1' velocity='1'/>"), ":6", "'1rad'");
  refused(joint(ends + "\n<limit lower='' upper='1' velocity='1'/>"), ":6", "'lower'");
  refused(joint(ends + "\n<limit lower='2' upper='1' velocity='1'/>"), ":6",
          "lower limit 2 of joint 'j' lies above the upper one, 1");
  refused(joint(ends + "\n<limit lower='0' upper='1' velocity='-1'/>"), ":6", "less than 0");
  refused(joint(ends + limit + "\n<axis xyz='0 0 0'/>"), ":6", "axis of joint 'j' is zero");
  refused(joint(ends + limit + "\n<axis xyz='0 0'/>"), ":6", "three numbers");
  refused(joint(ends + limit + "\n<axis xyz='0 0 1 2'/>"), ":6", "three numbers");
  refused(joint(ends + limit + "\n<axis xyz='0 x 1'/>"), ":6", "finite number");
  refused(joint(ends + limit + "\n<origin rpy='0 0 inf'/>"), ":6", "finite number");
  refused(joint(ends + limit + "\n<origin rpy='0 0 1e200'/>"), ":6", "expected numbers of at most 1e9");
  refused(joint(ends + limit + "\n<mimic joint='k'/>"), ":6", "unknown joint 'k'");
  refused(joint(ends + limit + "\n<mimic joint='j'/>"), "", "mimic another joint");
  refused(two_links + "</robot>", ":3", "no joint carries 'a' nor 'b'");
  refused(
      two_links + "<joint name='j' type='fixed'>" + ends + "</joint>\n<joint name='j' type='fixed'>" + ends + "</joint></robot>",
      ":5", "there twice");
  refused(
      two_links + "<joint name='j' type='fixed'>" + ends + "</joint>\n<joint name='k' type='fixed'>" + ends + "</joint></robot>",
      ":5", "which 'j' carries already");
  refused(two_links + "<joint name='j' type='fixed'>" + ends +
              "</joint>\n<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
          ":4", "circle");
  refused("<robot><link name='o'/><link name='a'/><link name='b'/>\n<joint name='j' type='fixed'>" + ends +
              "</joint><joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
          ":2", "circle: 'b' does not hang on the base 'o'");
  const auto body = [](const std::string& inner) {
    return "<robot><link name='a'>\n<visual>" + inner + "</visual></link></robot>";
  };
  refused(body(""), ":2", "<visual> has no <geometry>");
  refused(body("<geometry/>"), ":2", "<geometry> is empty");
  refused(body("<geometry><torus/></geometry>"), ":2", "<torus> is not known");
  refused(body("<geometry><box/></geometry>"), ":2", "<box> has no 'size'");
  refused(body("<geometry><box size='1 1 0'/></geometry>"), ":2", "box");
  refused(body("<geometry><sphere radius='-1'/></geometry>"), ":2", "sphere");
  refused(body("<geometry><cylinder radius='1'/></geometry>"), ":2", "<cylinder> has no 'length'");
  refused(body("<geometry><mesh filename='none.stl'/></geometry>"), ":2", "there is no mesh file");
  refused(body("<geometry><mesh/></geometry>"), ":2", "<mesh> has no 'filename'");
  refused(body("<geometry><mesh filename=''/></geometry>"), ":2", "without a file name");
  refused(body("<geometry><mesh filename='package://nowhere/a.stl'/></geometry>"), ":2", "there is no package 'nowhere'");
  refused(body("<geometry><mesh filename='package://nowhere'/></geometry>"), ":2", "names no file");
  refused(body("<geometry><mesh filename='x.stl' scale='1 0 1'/></geometry>"), ":2", "'scale' of <mesh> holds a 0");
  CHECK_THROWS_WITH(load_urdf("no/such.urdf"), "robot 'no/such.urdf': there is no such file");
  CHECK_THROWS_WITH(load_urdf("/tmp"), Contains("it is a folder"));
  CHECK_THROWS_WITH(load_urdf(""), Contains("no file name"));
}

TEST_CASE("urdf: thousands of nested elements and of links", "[robot]") {
  std::string deep = "<robot>", closing;
  for (int i = 0; i < 100'000; ++i) deep += "<x>", closing += "</x>";
  CHECK_THROWS_WITH(parsed(deep + closing + "</robot>"), Contains("no links"));
  std::string chain = "<robot name='r'><link name='l0'/>";
  for (int i = 1; i < 2000; ++i)
    chain += "<link name='l" + std::to_string(i) + "'/><joint name='j" + std::to_string(i) +
             "' type='continuous'><parent link='l" + std::to_string(i - 1) + "'/><child link='l" + std::to_string(i) +
             "'/><origin xyz='0 0 1'/></joint>";
  const auto robot = parsed(chain + "</robot>");
  CHECK(robot->size() == 1999);
  CHECK(robot->link_frame(robot->tip(), std::vector<double>(1999, 0.0)).at.z() == 1999);
}

TEST_CASE("urdf: meshes lie beside the file, in packages, in packages without their upper folders", "[robot]") {
  const Folder folder;
  const auto write = [&](const std::string& name) { save_mesh((folder.path / name).string(), tetrahedron()); };
  write("pack/meshes/arm/a.stl");
  write("pack/urdf/beside.stl");
  write_file((folder.path / "pack/package.xml").string(), "<package>\n <name> the_pack </name></package>");
  const std::string file = (folder.path / "pack/urdf/r.urdf").string();
  const auto at = [&](const std::string& name) { return (folder.path / name).string(); };
  CHECK(resolve_mesh_path("package://the_pack/meshes/arm/a.stl", file) == at("pack/meshes/arm/a.stl"));
  CHECK(resolve_mesh_path("package://the_pack/share/the_pack/meshes/arm/a.stl", file) == at("pack/meshes/arm/a.stl"));
  CHECK(resolve_mesh_path("package://pack/meshes/arm/a.stl", file) == at("pack/meshes/arm/a.stl"));
  CHECK(resolve_mesh_path("beside.stl", file) == at("pack/urdf/beside.stl"));
  CHECK(resolve_mesh_path("../meshes/arm/a.stl", file) == at("pack/meshes/arm/a.stl"));
  CHECK(resolve_mesh_path("file://" + at("pack/urdf/beside.stl"), file) == at("pack/urdf/beside.stl"));
  CHECK_THROWS_WITH(resolve_mesh_path("package://the_pack/meshes/arm/b.stl", file),
                    Contains("no file 'meshes/arm/b.stl' in the package 'the_pack'"));
  CHECK_THROWS_WITH(resolve_mesh_path("package://pack/else/a.stl", file), Contains("no file"));

  write_file(file,
             "<robot name='r'><link name='a'><visual><geometry><mesh filename='beside.stl' scale='0.001 0.001 "
             "-0.001'/></geometry></visual>"
             "<collision><geometry><mesh filename='beside.stl'/></geometry></collision></link></robot>");
  const auto robot = load_urdf(file);
  const auto& small = std::get<0>(robot->links()[0].visual[0].shape)->surface()->mesh();
  CHECK(small.volume() == Approx(1e-9 / 6).epsilon(1e-6));  // mirrored, and still outside out
  CHECK(small.box().min().z() == Approx(-0.001));
  CHECK(std::get<0>(robot->links()[0].collision[0].shape)->surface()->mesh().volume() == Approx(1.0 / 6));
  // A file that is there and no mesh: told when it is needed.
  write_file(at("pack/urdf/beside.stl"), "nothing");
  const auto broken = load_urdf(file);
  CHECK_THROWS_WITH(std::get<0>(broken->links()[0].visual[0].shape)->surface(), Contains("beside.stl"));
}

TEST_CASE("a package's name", "[robot]") {
  CHECK(package_name("<package><name>abc</name></package>") == "abc");
  CHECK(package_name("<package/>").empty());
  CHECK(package_name("<name>open").empty());
  CHECK(package_name("<name> \n</name>").empty());
}

TEST_CASE("builtin robots: unknown and missing ones", "[robot]") {
  CHECK_THROWS_WITH(load_robot("builtin:six_axes"), Contains("did you mean 'six_axis'"));
  ::setenv("TENDRIL_ASSETS", "/no/such/folder", 1);
  CHECK_THROWS_WITH(load_robot("builtin:six_axis"),
                    Contains("/no/such/folder/six_axis/six_axis.urdf") && Contains("TENDRIL_ASSETS"));
  ::unsetenv("TENDRIL_ASSETS");
}

TEST_CASE("a real robot: its package's meshes are found, its axes stand where its maker's drawing has them", "[robot][real]") {
  const std::string file = real_robot();
  if (file.empty()) {
    WARN("no shared robots here: skipped");
    return;
  }
  const auto robot = load_urdf(file);
  CHECK(robot->size() == 6);
  CHECK(robot->links()[robot->tip()].name == "tool0");
  const std::vector<double> zero(6, 0.0);
  const Frame tool = robot->link_frame(robot->tip(), zero);
  CHECK((tool.at - Vec3(0.322 - 0.275 + 1.67 + 0.153 + 0.055, 0.03 - 0.2 + 0.181, 0.227 + 0.551 + 1.07 + 0.2)).norm() < 1e-12);
  CHECK((tool.d3() - Vec3::UnitX()).norm() < 1e-10);
  for (const Link& link : robot->links())
    for (const auto* shapes : {&link.visual, &link.collision})
      for (const LinkShape& body : *shapes) CHECK(std::get<0>(body.shape)->surface()->mesh().triangles.size() > 100);
}
