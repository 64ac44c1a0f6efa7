// VRML97: every node that places or holds surfaces, what is left out, what is refused.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <sstream>

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/import_mesh.h"
#include "geometry/mesh_topology.h"
#include "geometry/read_vrml.h"
#include "unit/geometry/mesh_files.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using Catch::Contains;
using tendril::test::box_mesh;
using tendril::test::Folder;
using tendril::test::Random;

namespace {

const std::string header = "#VRML V2.0 utf8\n";

Mesh read(const std::string& text, std::string* left_out = nullptr) {
  std::string said;
  const Mesh mesh = parse_vrml(header + text, "x.wrl", {}, said);
  if (left_out) *left_out = said;
  return mesh;
}

/// The same with the number of lines of `text` counted from 1, as in an editor.
void fails(const std::string& text, const std::string& why) {
  std::string left_out;
  CAPTURE(text.substr(0, 200));
  CHECK_THROWS_WITH(parse_vrml(header + text, "x.wrl", {}, left_out), "mesh 'x.wrl': " + why);
}

/// A mesh as an IndexedFaceSet.
std::string faces_of(const Mesh& mesh, const std::string& more = "") {
  std::ostringstream out;
  out.precision(17);
  out << "IndexedFaceSet { " << more << " coord Coordinate { point [";
  for (const Vec3& v : mesh.vertices) out << v.transpose() << ",\n";
  out << "] } coordIndex [";
  for (const auto& t : mesh.triangles) out << t[0] << ", " << t[1] << ", " << t[2] << ", -1,\n";
  out << "] }";
  return out.str();
}
std::string shape_of(const Mesh& mesh, const std::string& more = "") {
  return "Shape { appearance Appearance { material Material { diffuseColor 1 0 .5 } } geometry " + faces_of(mesh, more) + " }\n";
}

/// Volume 1, box 0 0 0 ... 1 2 3.
const std::string tetrahedron =
    "Shape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 2 0, 0 0 3] }\n"
    "coordIndex [0 2 1 -1 0 1 3 -1 0 3 2 -1 1 2 3] } }\n";

void check_box(const Mesh& mesh, const Vec3& low, const Vec3& high) {
  CHECK((mesh.box().min() - low).norm() < 1e-12);
  CHECK((mesh.box().max() - high).norm() < 1e-12);
}

}  // namespace

TEST_CASE("VRML: faces, comments, commas, signs and exponents", "[vrml]") {
  const Mesh mesh = read("# a comment [ { \"\nShape{geometry IndexedFaceSet{coordIndex[0,2,1,-1 0 1 3 -1,,0 3 2 -1 #}\n1 2 3 -1]"
                         "coord Coordinate{point[0 0 0,+1 0 0,0 2.0e0 0.,0 0 30e-1]}solid FALSE convex FALSE creaseAngle .5}}");
  CHECK(mesh.vertices.size() == 4);
  CHECK(mesh.triangles.size() == 4);
  CHECK(mesh.volume() == Approx(1));
  check_box(mesh, {0, 0, 0}, {1, 2, 3});
  CHECK(read("Shape { geometry IndexedFaceSet { ccw FALSE coord Coordinate { point [0 0 0, 1 0 0, 0 2 0, 0 0 3] }\n"
             "coordIndex [0 2 1 -1 0 1 3 -1 0 3 2 -1 1 2 3 -1] } }").volume() == Approx(-1));
  // Only the points that faces use.
  CHECK(read("Shape { geometry IndexedFaceSet { coord Coordinate { point [9 9 9, 0 0 0, 1 0 0, 0 1 0, 8 8 8] } coordIndex [1 2 3] } }")
            .vertices.size() == 3);
  // Carriage returns alone end comments, too.
  CHECK(read("#c\rShape { geometry Box {} }\r#c\r\n").triangles.size() == 12);
}

TEST_CASE("VRML: polygons are cut along their own sides", "[vrml]") {
  const Mesh ell = read("Shape { geometry IndexedFaceSet { convex FALSE\n"
                        "coord Coordinate { point [0 0 5, 2 0 5, 2 1 5, 1 1 5, 1 2 5, 0 2 5] } coordIndex [0 1 2 3 4 5 -1] } }");
  CHECK(ell.triangles.size() == 4);
  CHECK(ell.area() == Approx(3));
  std::string left_out;
  const Mesh some = read("Shape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0] }\n"
                         "coordIndex [0 1 -1 2 -1 -1 0 1 2 -1] } }", &left_out);
  CHECK(some.triangles.size() == 1);
  CHECK(left_out == "left out: 2 faces of fewer than three corners");
}

TEST_CASE("VRML: groups of every kind, names and uses", "[vrml]") {
  std::string left_out;
  for (const char* kind : {"Group { bboxSize 1 1 1 children", "Anchor { url \"a b\" parameter [ \"x\" ] description \"{\" children",
                           "Billboard { axisOfRotation 0 0 1 children", "Collision { collide FALSE proxy Shape { geometry Box {} } children",
                           "Transform { children"}) {
    CAPTURE(kind);
    CHECK(read(std::string(kind) + " [ " + tetrahedron + " ] }", &left_out).volume() == Approx(1));
    CHECK(read(std::string(kind) + " " + tetrahedron + " }").volume() == Approx(1));  // a single child without brackets
    CHECK(left_out.empty());
  }
  // A whole shape, a geometry and a list of points used again; the last DEF of a name counts.
  CHECK(read("DEF T " + tetrahedron + "Transform { translation 10 0 0 children USE T } Group { children [ USE T, USE T ] }").volume() ==
        Approx(4));
  CHECK(read("Shape { geometry DEF b Box { size 1 1 1 } } Shape { geometry USE b } Transform { children Shape { geometry USE b } }")
            .volume() == Approx(3));
  CHECK(read("DEF a Shape { geometry Box { size 1 1 1 } } DEF a Shape { geometry Box { size 2 2 2 } } USE a").volume() == Approx(17));
  const Mesh shared = read(
      "Shape { geometry IndexedLineSet { coord DEF points Coordinate { point [0 0 0, 1 0 0, 0 2 0, 0 0 3] } coordIndex [0 1 -1] } }\n"
      "Shape { geometry IndexedFaceSet { coord USE points coordIndex [0 2 1 -1] } }\n"
      "Shape { geometry IndexedFaceSet { coord USE points coordIndex [0 1 3 -1 0 3 2 -1 1 2 3 -1] } }");
  CHECK(shared.vertices.size() == 7);
  CHECK(shared.volume() == Approx(1));
}

TEST_CASE("VRML: transforms compose as the standard says", "[vrml]") {
  Random random(97);
  const Mesh mesh = box_mesh({0.3, 0.4, 0.5});
  for (int trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    Eigen::Affine3d expected = Eigen::Affine3d::Identity();
    std::ostringstream text;
    text.precision(17);
    const int depth = 1 + random.below(4);
    for (int k = 0; k < depth; ++k) {
      const Vec3 c = random.point(2), t = random.point(3), axis = random.direction(), scale_axis = random.direction();
      const Vec3 s(random.in(0.3, 2), random.in(-2, -0.3), random.in(0.3, 2));  // mirrors
      const double angle = random.in(-4, 4), scale_angle = random.in(-4, 4), length = random.in(0.1, 9);
      using Eigen::AngleAxisd, Eigen::Translation3d;
      expected = expected * Translation3d(t) * Translation3d(c) * AngleAxisd(angle, axis) * AngleAxisd(scale_angle, scale_axis) *
                 Eigen::Scaling(s) * AngleAxisd(-scale_angle, scale_axis) * Translation3d(-c);
      text << "Transform { translation " << t.transpose() << " rotation " << (length * axis).transpose() << " " << angle << "\ncenter "
           << c.transpose() << " scale " << s.transpose() << " scaleOrientation " << scale_axis.transpose() << " " << scale_angle
           << " bboxCenter 0 0 0 children [\n";
    }
    text << shape_of(mesh);
    for (int k = 0; k < depth; ++k) text << "] }";
    const Mesh read_back = read(text.str());
    REQUIRE(read_back.triangles.size() == mesh.triangles.size());
    // Outward whatever is mirrored.
    CHECK(read_back.volume() == Approx(mesh.volume() * std::abs(expected.linear().determinant())));
    Eigen::AlignedBox3d box;
    for (const Vec3& v : mesh.vertices) box.extend(expected * v);
    CHECK((read_back.box().min() - box.min()).norm() < 1e-12 * (1 + box.diagonal().norm()));
    CHECK((read_back.box().max() - box.max()).norm() < 1e-12 * (1 + box.diagonal().norm()));
  }
  // An axis of zeros is no rotation when the angle is zero.
  check_box(read("Transform { rotation 0 0 0 0 children " + tetrahedron + "}"), {0, 0, 0}, {1, 2, 3});
}

TEST_CASE("VRML: Switch shows its choice, LOD its finest level", "[vrml]") {
  const auto box = [](double size) { return "Shape { geometry Box { size 1 1 " + number_text(size) + " } }"; };
  const std::string choice = "choice [ " + box(1) + box(2) + box(3) + " ] }";
  CHECK(read("Switch { whichChoice 0 " + choice).volume() == Approx(1));
  CHECK(read("Switch { whichChoice 2 " + choice).volume() == Approx(3));
  for (const char* none : {"", "whichChoice -1", "whichChoice 3", "whichChoice -7"})
    CHECK(read("Switch { " + std::string(none) + " " + choice).triangles.empty());
  CHECK(read("Switch { choice [ " + box(1) + " ] whichChoice 0 }").volume() == Approx(1));
  CHECK(read("LOD { range [ 1, 10 ] center 0 0 0 level [ " + box(3) + " " + box(2) + " Group {} ] }").volume() == Approx(3));
  CHECK(read("LOD { level [ ] }").triangles.empty());
}

TEST_CASE("VRML: solids and height grids are closed and as large as they should be", "[vrml]") {
  const double share = 32 * std::sin(2 * M_PI / 32) / (2 * M_PI);  // of a circle's area, its polygon
  const auto closed = [](const Mesh& mesh) { return topology_of(welded(mesh, 1e-9).mesh, 0).watertight(); };
  const Mesh box = read("Shape { geometry Box { size 1 2 3 } }");
  CHECK(box.volume() == Approx(6));
  check_box(box, {-0.5, -1, -1.5}, {0.5, 1, 1.5});
  CHECK(closed(box));
  CHECK(read("Shape { geometry Box {} }").volume() == Approx(8));
  const Mesh cylinder = read("Shape { geometry Cylinder { radius 2 height 3 } }");
  CHECK(cylinder.volume() == Approx(M_PI * 4 * 3 * share));
  CHECK(closed(cylinder));
  const Mesh cone = read("Shape { geometry Cone { bottomRadius 2 height 3 } }");
  CHECK(cone.volume() == Approx(M_PI * 4 * share));
  check_box(cone, {-2, -1.5, -2}, {2, 1.5, 2});
  CHECK(closed(cone));
  const Mesh sphere = read("Shape { geometry Sphere { radius 2 } }");
  CHECK(sphere.volume() == Approx(32 * M_PI / 3).epsilon(0.02));
  for (const Vec3& v : sphere.vertices) CHECK(v.norm() == Approx(2));
  CHECK(closed(sphere));
  CHECK(read("Shape { geometry Cylinder { side FALSE } }").area() == Approx(2 * M_PI * share));
  CHECK(read("Shape { geometry Cylinder { top FALSE bottom FALSE } }").triangles.size() == 64);
  CHECK(read("Shape { geometry Cone { bottom FALSE } }").triangles.size() == 32);
  CHECK(read("Shape { geometry Cone { side FALSE } }").area() == Approx(M_PI * share));
  const std::string grid = "xDimension 3 zDimension 2 xSpacing 2 zSpacing 5 height [0 1 2 0 1 2] } }";
  const Mesh slope = read("Shape { geometry ElevationGrid { " + grid);
  check_box(slope, {0, 0, 0}, {4, 2, 5});
  CHECK(slope.area() == Approx(5 * std::sqrt(20.0)));
  for (const auto& [a, b, c] : slope.triangles)  // y is up
    CHECK((slope.vertices[b] - slope.vertices[a]).cross(slope.vertices[c] - slope.vertices[a]).y() > 0);
  const Mesh under = read("Shape { geometry ElevationGrid { ccw FALSE " + grid);
  for (const auto& [a, b, c] : under.triangles)
    CHECK((under.vertices[b] - under.vertices[a]).cross(under.vertices[c] - under.vertices[a]).y() < 0);
}

TEST_CASE("VRML: what is not read is skipped and named", "[vrml]") {
  std::string left_out;
  const std::string text =
      "PROTO Bolt [ field SFFloat size 1 exposedField MFNode parts [ Shape { geometry Box {} } ] eventIn SFBool on ]\n"
      "{ Transform { scale IS size children Shape { geometry Cone {} } } }\n"
      "EXTERNPROTO Nut [ field SFFloat size ] [ \"nut.wrl#Nut\", \"]\" ]\nEXTERNPROTO Pin [ ] \"pin.wrl\"\n"
      "Bolt { size 3 } Group { children [ Bolt { size 2 } Nut { parts [ Shape { geometry Box {} } ] } ] }\n"
      "Shape { geometry Extrusion { crossSection [ 1 1, 1 -1 ] spine [0 0 0, 0 1 0] beginCap FALSE } }\n"
      "WorldInfo { info [ \"a \\\" ] } quote\" ] } Viewpoint { position 0 0 1e1 } NavigationInfo { type [ \"ANY\" ] }\n"
      "Shape { geometry IndexedLineSet { coord Coordinate { point [ ] } } } Shape { geometry NULL appearance NULL }\n"
      "Shape { appearance Appearance { texture PixelTexture { image 2 1 3 0xFF0000 0x00FF00 } } geometry Box { size 1 1 1 } }\n"
      "DEF S Script { url \"javascript: function f() { a = [; }\" field SFNode n DEF hidden Group { } eventIn SFTime t }\n"
      "DEF clock TimeSensor { cycleInterval 5 loop TRUE } ROUTE clock.fraction_changed TO S.t\n"
      "Group { children [ USE hidden Strange { a b { } c [ d { e 1 2 3 } \"f\" TRUE 4 ] g IS h } ] ROUTE a.b TO c.d }\n";
  CHECK(read(text, &left_out).volume() == Approx(1));
  CHECK(left_out == "left out: 2 Bolt, 1 Extrusion, 1 Nut, 1 Strange, 1 node within a Script, its animation");
  // What an unknown node holds under a name can be used.
  CHECK(read("Strange { part DEF p Shape { geometry Box { size 1 1 1 } } list [ DEF q " + tetrahedron + " ] } USE p USE q").volume() ==
        Approx(2));
  // Unknown fields of known nodes.
  CHECK(read("Group { novel DEF p Shape { geometry Box {} } odd [ 1 2 TRUE ] children USE p other FALSE }").volume() == Approx(8));
}

TEST_CASE("VRML: errors name the line", "[vrml]") {
  std::string ignored;
  CHECK_THROWS_WITH(parse_vrml("#VRML V1.0 ascii\nSeparator {}", "x.wrl", {}, ignored),
                    "mesh 'x.wrl': it is in VRML 1.0, which is not read; export it as VRML97, also called VRML 2.0");
  CHECK_THROWS_WITH(parse_vrml("Group {}", "x.wrl", {}, ignored),
                    "mesh 'x.wrl': not a VRML97 file: it does not begin with '#VRML V2.0 utf8'");
  CHECK_THROWS_WITH(parse_vrml("\x1f\x8b\x08", "x.wrl", {}, ignored),
                    "mesh 'x.wrl': it is compressed with gzip; unpack it first: gunzip < packed > unpacked");
  fails("Group {\nchildren [\n", "line 4: the file ends within what line 3 begins; is it truncated?");
  fails("Group {\n", "line 3: the file ends within what line 2 begins; is it truncated?");
  fails("Script { a [", "line 2: the file ends within what line 2 begins; is it truncated?");
  fails("PROTO A [", "line 2: the file ends within what line 2 begins; is it truncated?");
  fails("WorldInfo { title \"abc\n} ", "line 2: a string that does not end; is the file truncated?");
  fails("Inline { url [ \"abc ] }", "line 2: a string that does not end; is the file truncated?");
  fails("Inline { url [ 3 ] }", "line 2: '3' where an address in quotation marks is expected");
  fails("\n]", "line 3: ']' without a '[' before it");
  fails("\n}", "line 3: '}' where a node is expected");
  fails("Group { children [ [ ] ] }", "line 2: '[' where a node is expected");
  fails("Group { children [ 3 ] }", "line 2: '3' where a node is expected");
  fails("Group { { } }", "line 2: '{' where the name of a field is expected");
  fails("Group { children }", "line 2: '}' where the value of 'children' is expected");
  fails("Group { children {} }", "line 2: '{' where the value of 'children' is expected");
  fails("Group\n[ ]", "line 2: '[' after 'Group', where '{' is expected");
  fails("Group", "line 2: the end of the file after 'Group', where '{' is expected");
  fails("DEF a", "line 2: DEF without a name and a node");
  fails("\nUSE a", "line 3: USE of 'a', which no DEF before it names");
  fails("ROUTE a.b FROM c.d", "line 2: a ROUTE that does not read 'ROUTE node.event TO node.event'");
  fails("PROTO A { }", "line 2: '{' where the '[' of a PROTO is expected");
  fails("PROTO A [ ] Group {}", "line 2: 'Group' where the '{' of a PROTO is expected");
  fails("EXTERNPROTO A [ ] Group {}", "line 2: 'Group' where the address of an EXTERNPROTO is expected");
  fails("Transform {\ntranslation 1 2\n}", "line 4: '}' where a number of 'translation' is expected");
  fails("Transform { rotation 0 0 0 1 }", "line 2: 'rotation' about an axis without a direction; x y z angle expected");
  fails("Switch { whichChoice x }", "line 2: 'x' where a number of 'whichChoice' is expected");
  fails("Shape { geometry Cone { side 1 } }", "line 2: '1' where TRUE or FALSE of 'side' is expected");
  fails("Shape { geometry Box { size 1 0 1 } }", "line 2: a solid whose size is not above 0");
  fails("Shape { geometry Sphere { radius -1 } }", "line 2: a solid whose size is not above 0");
  fails("Shape { geometry ElevationGrid {\nxDimension 2 zDimension 3 height [1 2 3 4 5] } }",
        "line 2: an ElevationGrid of 2 x 3 with 5 heights");
  const auto set = [](const std::string& points, const std::string& corners) {
    return "Shape { geometry IndexedFaceSet {\ncoord Coordinate { point [" + points + "] }\ncoordIndex [" + corners + "] } }";
  };
  fails(set("0 0 0 1", "0"), "line 3: 'point' has 4 numbers; a multiple of 3 expected");
  fails(set("0 0 0, 1 O 0", "0"), "line 3: 'O' where a number of 'point' is expected");
  fails(set("0 0 0, 1 0 0, 0 1 0", "0 1 2 -1\n0 1\n3 -1"), "line 6: a face uses point 3; there are 3, counted from 0");
  fails(set("0 0 0, 1 0 0, 0 1 0", "0 1 -2"), "line 4: a face uses point -2; there are 3, counted from 0");
  fails(set("0 0 0, 1 0 0, 0 1 0", "0 1 99999999999999999999"), "line 4: a face uses point 2147483647; there are 3, counted from 0");
  fails(set("0 0 0, 1 0 0, 0 1 0", "0 1 2.5"), "line 4: '.5' where a number of 'coordIndex' is expected");
  std::string many;
  for (int i = 0; i < 1001; ++i) many += "0 ";
  fails(set("0 0 0", "\n" + many), "line 5: a face of more than 1000 corners");
  fails("Shape { geometry IndexedFaceSet { coordIndex [0 1 2] } }", "line 2: an IndexedFaceSet whose 'coord' is no Coordinate node");
  fails("Shape { geometry IndexedFaceSet { coord Box {} coordIndex [0 1 2] } }",
        "line 2: an IndexedFaceSet whose 'coord' is no Coordinate node");
}

TEST_CASE("VRML: loops, endless growth and deep nesting do no harm", "[vrml]") {
  fails("DEF a Group { children [ USE a ] }", "line 2: USE of 'a' within its own DEF: a loop");
  fails("DEF a Group { children\nTransform { children [ Shape { geometry DEF b Box {} } USE a ] } }",
        "line 3: USE of 'a' within its own DEF: a loop");
  // Doubled forty times: more than 10^12 boxes, or as many groups without any.
  for (const char* leaf : {"Shape { geometry Box {} }", "Group {}"}) {
    std::string text = std::string("DEF n0 ") + leaf;
    for (int k = 1; k <= 40; ++k) {
      const std::string last = "USE n" + std::to_string(k - 1);
      text += "\nDEF n" + std::to_string(k) + " Group { children [ " + last + " " + last + " ] }";
    }
    fails(text, "with all that USE and Inline repeat it is larger than 4000000 triangles, vertices or nodes");
  }
  fails(std::string(100000, '['), "line 2: '[' where a node is expected");
  fails(std::string(100000, '{'), "line 2: '{' where a node is expected");
  std::string deep, end;
  for (int k = 0; k < 100000; ++k) deep += "Group{children[", end += "]}";
  fails(deep, "line 2: the file ends within what line 2 begins; is it truncated?");
  CHECK(read(deep + tetrahedron + end).volume() == Approx(1));
  std::string single, braces;
  for (int k = 0; k < 100000; ++k) single += "Odd{f Transform{children ", braces += "}}";
  fails(single, "line 2: the end of the file where the value of 'children' is expected");
  CHECK(read(single + "Group{}" + braces + tetrahedron).volume() == Approx(1));
  CHECK(read("Script { a " + std::string(100000, '[') + std::string(100000, ']') + "}" + tetrahedron).volume() == Approx(1));
}

TEST_CASE("VRML: other files are read by Inline", "[vrml]") {
  const Folder folder;
  std::filesystem::create_directory(folder / "parts");
  folder.write("parts/tetrahedron.wrl", header + tetrahedron);
  folder.write("parts/two.wrl", header + "Inline { url \"tetrahedron.wrl\" } Transform { translation 0 0 10 children Inline { url [\"tetrahedron.wrl\"] } }");
  const std::string main = folder.write(
      "main.WRL", header + "Inline { url \"parts/two.wrl\" } Transform { scale 2 2 2 children [ Inline { bboxSize 1 1 1 url [ \"https://a/b.wrl\" "
                           "\"missing.wrl\" \"parts/two.wrl\" ] } ] }\nInline { } Inline { url \"http://a.b/c.wrl\" }");
  const LoadedMesh loaded = load_mesh(main, 1);
  CHECK(loaded.mesh.volume() == Approx(2 + 16));
  CHECK(loaded.warning == "mesh '" + main + "': left out: 1 Inline of a network address");
  check_box(loaded.mesh, {0, 0, 0}, {2, 4, 26});
  CHECK(load_mesh(folder.write("absolute.wrl", header + "Inline { url \"file://" + folder / "parts/two.wrl" + "\" }"), 1).mesh.volume() == Approx(2));

  const auto says = [&](const std::string& name, const std::string& text, const std::string& what) {
    CHECK_THROWS_WITH(load_mesh(folder.write(name, header + text), 1), Contains(what));
  };
  says("a.wrl", "\nInline { url \"none.wrl\" }", "a.wrl': line 3: Inline of '" + folder / "none.wrl" + "': there is no such file");
  says("a.wrl", "Inline { url \"parts\" }", "there is no such file");
  says("self.wrl", "Inline { url \"self.wrl\" }", "self.wrl': line 2: Inline of '" + folder / "self.wrl" + "' leads back to where it comes from");
  folder.write("parts/back.wrl", header + tetrahedron + "Inline { url \"../loop.wrl\" }");
  says("loop.wrl", "Inline { url \"parts/two.wrl\" } Inline { url \"parts/back.wrl\" }",
       "back.wrl': line 4: Inline of '" + folder / "loop.wrl" + "' leads back to where it comes from");
  folder.write("parts/bad.wrl", header + "\nGroup {");
  says("outer.wrl", "Inline { url \"parts/bad.wrl\" }", "parts/bad.wrl': line 3: the file ends within what line 3 begins");
  folder.write("parts/x.obj", "v 0 0 0\n");
  says("outer.wrl", "Inline { url \"parts/x.obj\" }", "parts/x.obj': not a VRML97 file");
  for (int k = 0; k < 20; ++k)
    folder.write("deep" + std::to_string(k) + ".wrl",
                 header + (k < 19 ? "Inline { url \"deep" + std::to_string(k + 1) + ".wrl\" }" : tetrahedron));
  CHECK(load_mesh(folder / "deep3.wrl", 1).mesh.volume() == Approx(1));
  CHECK_THROWS_WITH(load_mesh(folder / "deep0.wrl", 1), Contains("deep16.wrl': line 2: Inline more than 16 deep"));
  // What is not shown is not looked for.
  CHECK(load_mesh(folder.write("lod.wrl", header + "LOD { level [ Inline { url \"parts/two.wrl\" } Inline { url \"none.wrl\" } ] }"), 1)
            .mesh.volume() == Approx(2));
}

TEST_CASE("VRML: as a mesh file", "[vrml]") {
  const Folder folder;
  const Mesh mesh = box_mesh({0.3, 0.4, 0.5}, 3);
  for (const char* name : {"a.wrl", "b.VRML"}) {
    const LoadedMesh loaded = load_mesh(folder.write(name, header + shape_of(mesh)), 1e-3);
    CHECK(loaded.mesh.volume() == Approx(0.48e-9));
    CHECK(loaded.mesh.vertices.size() == 56);
    CHECK(topology_of(loaded.mesh, 0).watertight());
  }
  CHECK_THROWS_WITH(load_mesh(folder.write("none.wrl", header + "Shape { geometry Extrusion {} }"), 1),
                    Contains("none.wrl': no triangles; left out: 1 Extrusion"));
  CHECK_THROWS_WITH(load_mesh(folder.write("c.obj", header), 1), Contains("it begins like a .wrl file"));
  CHECK_THROWS_WITH(load_mesh(folder.write("c.wrl", header + "Transform { translation 1e999 0 0 children " + tetrahedron + "}"), 1),
                    Contains("finite numbers within"));
  CHECK_THROWS_WITH(load_mesh(folder.write("packed.wrl", "\x1f\x8b\x08"), 1), Contains("compressed with gzip"));
  // Cut anywhere it is read or refused, never worse.
  const std::string text = header + "DEF a " + shape_of(box_mesh({1, 1, 1})) + "Transform { children [ USE a Inline { url \"x y\" } ] }";
  int good = 0;
  for (std::size_t size = 0; size < text.size(); ++size) {
    std::string left_out;
    try {
      good += parse_vrml(std::string_view(text).substr(0, size), "x.wrl", {}, left_out).triangles.size() >= 12;
    } catch (const UsageError&) {
    }
  }
  CHECK(good <= 2);  // before and after the blank behind the first shape
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  CHECK(load_mesh(folder / "a.wrl", 1, context).status == Status::cancelled);
}

TEST_CASE("VRML: a file of a commercial tool", "[vrml]") {
  const char* named = std::getenv("TENDRIL_SHARED");
  const std::filesystem::path path = std::filesystem::path(named ? named : "../shared") / "data/meshes/ips_steering_wheel.wrl";
  if (!std::filesystem::exists(path)) {
    WARN("no shared meshes here: skipped");
    return;
  }
  const LoadedMesh loaded = load_mesh(path.string(), 1);
  CHECK(loaded.triangles_in_file == 27900);
  CHECK(loaded.warning.empty());
  CHECK(loaded.mesh.box().diagonal().norm() > 0.3);  // a wheel of 370 mm
  CHECK(loaded.mesh.box().diagonal().norm() < 0.8);
}

TEST_CASE("X3D through the module", "[import]") {
  const Folder folder;
  const LoadedMesh loaded = load_mesh(
      folder.write("t.x3d", R"(<?xml version="1.0" encoding="UTF-8"?>
<X3D profile="Interchange" version="3.3"><Scene><Transform scale="2 2 2"><Transform translation="10 0 0"><Shape>
<IndexedFaceSet coordIndex="0 2 1 -1 0 1 3 -1 0 3 2 -1 1 2 3 -1"><Coordinate point="0 0 0 1 0 0 0 2 0 0 0 3"/></IndexedFaceSet>
</Shape></Transform></Transform></Scene></X3D>)"), 1);
  CHECK(loaded.mesh.volume() == Approx(8));
  check_box(loaded.mesh, {20, 0, 0}, {22, 4, 6});
  CHECK_THROWS_WITH(load_mesh(folder.write("u.x3d", "<html></html>"), 1), Contains("truncated or not a .x3d file"));
}
