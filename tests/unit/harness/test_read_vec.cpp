// VEC files: a T of three segments written here, as drawn, turned, in parts, and broken.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "harness/centre_line.h"
#include "harness/import_harness.h"
#include "unit/geometry/mesh_files.h"
#include "unit/harness/vec_files.h"

using namespace tendril;
using Catch::Contains;
using tendril::test::damaged;
using tendril::test::Folder;
using tendril::test::Random;
using tendril::test::replaced;
using tendril::test::tee;

namespace {

std::string positioned(const std::string& rows) {
  return "<Specification xsi:type=\"vec:HarnessGeometrySpecification3D\" id=\"H\"><BuildingBlockPositionings id=\"BP\"><Positioning id=\"TR\">" + rows +
         "<Origin>O</Origin></Positioning><Referenced3DBuildingBlock>B</Referenced3DBuildingBlock></BuildingBlockPositionings></Specification>\n";
}
/// A quarter turn about z.
const std::string quarter = "<A11>0</A11><A12>-1</A12><A13>0</A13><A21>1</A21><A22>0</A22><A23>0</A23><A31>0</A31><A32>0</A32><A33>1</A33>";

void fails(const std::string& text, const std::string& why) {
  CHECK_THROWS_WITH(parse_vec(text, "t.vec"), Contains("scene.import: t.vec") && Contains(why));
}

}  // namespace

TEST_CASE("VEC: topology, places, lengths and centre curves", "[vec]") {
  for (const char* version : {"1.2.1", "2.0.2", "2.2.0"}) {
    const HarnessFile file = parse_vec(replaced(tee(), "2.1.0", version), "t.vec");
    CHECK(file.format == std::string("VEC ") + version);
    CHECK(file.name == "T-1");
    REQUIRE(file.nodes.size() == 4);
    REQUIRE(file.segments.size() == 3);
    CHECK((file.nodes[2].at - Vec3(0.2, 0.1, 0)).norm() < 1e-15);
    CHECK(file.nodes[2].name == "ND-N3");
    const HarnessSegment& bend = file.segments[1];
    CHECK(bend.name == "SEG-S2");
    CHECK((bend.start == 1 && bend.finish == 2));
    CHECK(bend.area == Approx(50e-6));
    CHECK(bend.virtual_length == Approx(0.157079632679));
    CHECK(bend.form == "Circular");
    CHECK(*file.segments[0].start_direction == Vec3(1, 0, 0));
    CHECK(*bend.finish_direction == Vec3(0, 1, 0));
    const CentreLine line(file, bend);
    CHECK(line.sound());
    CHECK(line.length() == Approx(0.05 * M_PI).epsilon(1e-9));
    CHECK(line.min_bend_radius() == Approx(0.1).epsilon(1e-6));
    for (double s : {0.01, 0.08, 0.15}) CHECK((line.at(s) - Vec3(0.1, 0.1, 0)).norm() == Approx(0.1));  // on the circle
    CHECK(file.segments[0].curves[0].weights.empty());
    CHECK(CentreLine(file, file.segments[0]).length() == Approx(0.1));
    CHECK(CentreLine(file, file.segments[2]).length() == Approx(0.15));
    CHECK(file.skipped == std::vector<std::string>{"1 segments have no centre curve: they count as straight"});
  }
}

TEST_CASE("VEC: a building block that is turned and moved", "[vec]") {
  const HarnessFile plain = parse_vec(tee(), "t.vec");
  const HarnessFile file = parse_vec(tee("", positioned(quarter)), "t.vec");
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& p = plain.nodes[i].at;
    CHECK((file.nodes[i].at - Vec3(-p.y(), p.x(), p.z() + 1)).norm() < 1e-14);
  }
  CHECK(*file.segments[0].start_direction == Vec3(0, 1, 0));
  const HarnessFile turned = parse_vec(replaced(tee(), "</DocumentVersion>", positioned(quarter) + "</DocumentVersion>"), "t.vec");
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(CentreLine(turned, turned.segments[i]).sound());
    CHECK(CentreLine(turned, turned.segments[i]).length() == Approx(CentreLine(plain, plain.segments[i]).length()));
  }
  fails(tee("", positioned(replaced(quarter, "<A33>1<", "<A33>2<"))), "<Positioning>: A11 to A33 are no rotation");
  fails(tee("", positioned(replaced(quarter, "<A33>1<", "<A33>-1<"))), "<Positioning>: A11 to A33 are no rotation");
  const HarnessFile twice = parse_vec(tee("", positioned(quarter) + positioned(quarter)), "t.vec");
  CHECK_THAT(twice.skipped.front(), Contains("building block 'B' is placed more than once: it stays where it was placed first"));
}

TEST_CASE("VEC: knots of either count, or none", "[vec]") {
  const auto length = [](const std::string& knots) {
    const HarnessFile file = parse_vec(tee(knots), "t.vec");
    return CentreLine(file, file.segments[1]).length();
  };
  CHECK(length("<Knots>0</Knots><Knots>0</Knots><Knots>1</Knots><Knots>1</Knots>") == Approx(0.05 * M_PI));  // without the outermost
  CHECK(length("<Knots>0 0 0 5 5 5</Knots>") == Approx(0.05 * M_PI));
  CHECK(length("") == Approx(0.05 * M_PI));  // clamped, as that meets the nodes
  fails(tee("<Knots>0</Knots>"), "<Curve>: it has 1 knots; 6 expected for 3 control points and degree 2");
  fails(tee("<Knots>0 0 1 0 1 1</Knots>"), "<Curve>: its knots fall");
  fails(tee("<Knots>1 1 1 1 1 1</Knots>"), "<Curve>: its knots leave no curve");
}

TEST_CASE("VEC: what is not read is counted, what has no place is left out", "[vec]") {
  std::string text = tee();
  text = replaced(text, "</DocumentVersion>",
                  "<Specification xsi:type=\"vec:BuildingBlockSpecification2D\" id=\"PS\"><GeometrySegment id=\"PL\"/></Specification></DocumentVersion>");
  HarnessFile file = parse_vec(text, "t.vec");
  REQUIRE(file.skipped.size() == 2);
  CHECK(file.skipped[1] == "1 segments of 2D drawings are not read");
  file = parse_vec(replaced(tee(), "<ReferenceNode>N4</ReferenceNode>", ""), "t.vec");
  CHECK(file.nodes.size() == 3);
  CHECK(file.segments.size() == 2);
  CHECK(file.skipped == std::vector<std::string>{"node 'ND-N4' has no place in a 3D building block", "segment 'SEG-S3' is left out: one of its nodes has no place"});
  file = parse_vec(replaced(tee(), "<Curve xsi:type=\"vec:NURBSCurve\" id=\"K2\">", "<Curve xsi:type=\"vec:Helix\" id=\"K2\">"), "t.vec");
  CHECK(file.segments[1].curves.empty());
  CHECK_THAT(file.skipped[0], Contains("a curve of type 'Helix': the segment counts as straight"));
}

TEST_CASE("VEC: broken files say what is wrong with them, and where", "[vec]") {
  fails("", "the file is empty");
  fails("<vec:VecContent>", "this is no well-formed XML");
  fails("<kbl/>", "this is no VEC file: its root is <kbl>, expected <vec:VecContent>");
  fails(tee("", "", "1.1.3"), "t.vec:2: it is of VEC version '1.1.3'; 1.2 and 2.x are read");
  fails(replaced(tee(), "<EndNode>N2</EndNode>", "<EndNode>N9</EndNode>"), "refers to 'N9', which is not in the file");
  fails(replaced(tee(), "<EndNode>N2</EndNode>", "<EndNode>P2</EndNode>"), "which is a CartesianPoint, expected a TopologyNode");
  fails(replaced(tee(), "<BaseUnit>U_mm</BaseUnit>", ""), "names no Unit");
  fails(replaced(tee(), "<BaseUnit>U_mm</BaseUnit>", "<BaseUnit>U_mm2</BaseUnit>"), "<Unit>: expected metres, by SiUnitName and SiPrefix, where line");
  fails(replaced(tee(), "<SiUnitName>Metre</SiUnitName>", "<SiUnitName>Kelvin</SiUnitName>"), "<Unit>: expected metres");
  fails(replaced(tee(), "<X>200</X>", "<X>far</X>"), "got 'far', expected a finite number");
  fails(replaced(tee(), "<X>200</X>", "<X>1e12</X>"), "<CartesianPoint>: it lies farther than 1000 km from the origin");
  fails(replaced(tee(), "<Degree>2</Degree>", "<Degree>2.5</Degree>"), "<Curve>: its degree must be a whole number from 1 to 24");
  fails(replaced(tee(), "<Degree>2</Degree>", "<Degree>3</Degree>"), "<Curve>: 3 control points are too few for degree 3");
  fails(replaced(tee(), "<Weight>0.70710678118654752</Weight>", "<Weight>0</Weight>"), "<ControlPoint>: its weight must lie from 1e-6 to 1e6");
  fails(replaced(tee(), "BuildingBlockSpecification3D", "BuildingBlockSpecification2D"),
        "the file has no 3D geometry: 4 nodes and 3 segments in its topology, 0 and 0 of them with a place");
  // Cut anywhere it is refused.
  const std::string text = tee();
  for (std::size_t size = 0; size + 1 < text.size(); size += 41) CHECK_THROWS_AS(parse_vec(text.substr(0, size), "t.vec"), UsageError);
}

TEST_CASE("VEC: damaged files are read or refused, never worse", "[vec]") {
  const std::string sound = tee("<Knots>0 0 0 1 1 1</Knots>", positioned(quarter));
  const unsigned seed = 29;
  CAPTURE(seed);
  Random random(seed);
  int read = 0, refused = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const std::string text = damaged(sound, random, {"0", "-1", "1e300", "9", "N2", "P1", "", "<", "</", "nan", " ", "U_mm2"});
    CAPTURE(trial);
    try {
      const HarnessFile file = parse_vec(text, "t.vec");
      for (const HarnessNode& node : file.nodes) CHECK(node.at.allFinite());
      for (const HarnessSegment& segment : file.segments) CHECK_FALSE(std::isnan(CentreLine(file, segment).length()));
      ++read;
    } catch (const UsageError&) {
      ++refused;
    }
  }
  CHECK(read > 50);
  CHECK(refused > 300);
}

TEST_CASE("VEC: as a scene; .hmd is refused with a hint", "[vec]") {
  const Folder folder;
  Scene scene;
  const ImportedHarness harness = import_harness(read_harness(folder.write("t.vec", tee())), {}, scene);
  CHECK(scene.rods().size() == 3);
  CHECK(harness.branches == 1);
  for (const ImportedSegment& segment : harness.segments) {
    CHECK_FALSE(segment.rod.empty());
    CHECK(segment.length == Approx(segment.stated_length).epsilon(1e-9));
  }
  CHECK(scene.solve().ok());
  CHECK_THROWS_WITH(read_harness(folder.write("t.hmd", "x")),
                    Contains("t.hmd': what .hmd files hold is not published; export the harness as .kbl or .vec"));
}
