// Fixings and connectors of VEC files: where they lie, which are none, what is refused.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "harness/import_harness.h"
#include "unit/geometry/mesh_files.h"
#include "unit/harness/vec_files.h"

using namespace tendril;
using Catch::Contains;
using tendril::test::Folder;
using tendril::test::replaced;
using tendril::test::tee;

namespace {

std::string component(const std::string& id, const std::string& role) {
  return "<Component id=\"" + id + "\"><Identification>" + id + "</Identification><Role xsi:type=\"vec:" + role + "\" id=\"X_" + id +
         "\"/><Role xsi:type=\"vec:PlaceableElementRole\" id=\"PR_" + id + "\"/></Component>\n";
}
std::string placement(const std::string& element, const std::string& locations, const std::string& type = "OnPointPlacement") {
  return "<Placement xsi:type=\"vec:" + type + "\" id=\"PL_" + element + "\"><PlacedElement>PR_" + element + "</PlacedElement>" + locations +
         "</Placement>\n";
}
std::string on(const std::string& id, const std::string& segment, const std::string& offset, const std::string& anchor) {
  return "<Location xsi:type=\"vec:SegmentLocation\" id=\"" + id + "\"><Offset id=\"O_" + id +
         "\"><UnitComponent>U_mm</UnitComponent><ValueComponent>" + offset + "</ValueComponent></Offset><Anchor>" + anchor +
         "</Anchor><ReferencedSegment>" + segment + "</ReferencedSegment></Location>";
}
std::string at(const std::string& id, const std::string& node) {
  return "<Location xsi:type=\"vec:NodeLocation\" id=\"" + id + "\"><ReferencedNode>" + node + "</ReferencedNode></Location>";
}

/// The T with a clip 25 mm behind the start of S1, a channel 30 mm before the ends of S1 and S3, a connector at N1, tape, a label on S3.
std::string placed() {
  return replaced(tee(), "</DocumentVersion>",
                  "<Specification xsi:type=\"vec:CompositionSpecification\" id=\"CS\">" + component("CLIP", "FixingRole") + component("DUCT", "CableDuctRole") +
                      component("X1", "ConnectorHousingRole") + component("TAPE", "TapeRole") + component("LABEL", "SpecificRole") +
                      "</Specification><Specification xsi:type=\"vec:PlacementSpecification\" id=\"PS\">" +
                      placement("CLIP", on("L1", "S1", "25", "FromStartNode")) +
                      placement("DUCT", on("L2", "S1", "30", "FromEndNode") + on("L3", "S3", "30", "FromEndNode")) + placement("X1", at("L4", "N1")) +
                      placement("TAPE", "", "OnWayPlacement") + placement("LABEL", on("L5", "S3", "10", "FromStartNode")) +
                      "</Specification></DocumentVersion>");
}

void fails(const std::string& text, const std::string& why) {
  CHECK_THROWS_WITH(parse_vec(text, "t.vec"), Contains("scene.import: t.vec") && Contains(why));
}

}  // namespace

TEST_CASE("VEC placements: fixings on segments, connectors at nodes", "[vec]") {
  const HarnessFile file = parse_vec(placed(), "t.vec");
  REQUIRE(file.segments[0].fixings.size() == 2);
  CHECK(file.segments[0].fixings[0].name == "CLIP");
  CHECK(file.segments[0].fixings[0].kind == "FixingRole");
  CHECK(file.segments[0].fixings[0].location == Approx(0.25));
  CHECK(file.segments[0].fixings[1].location == Approx(0.7));
  REQUIRE(file.segments[2].fixings.size() == 1);
  CHECK(file.segments[2].fixings[0].location == Approx(0.8));  // of 150 mm
  CHECK(file.segments[1].fixings.empty());
  CHECK(file.nodes[0].components == std::vector<std::string>{"X1"});
  REQUIRE(file.skipped.size() == 3);
  CHECK(file.skipped[1] == "1 placements along segments, of protections, are not read");
  CHECK(file.skipped[2] == "1 placements are of other kinds and not read");
}

TEST_CASE("VEC placements: fixings are clips of the scene", "[vec]") {
  const Folder folder;
  Scene scene;
  const ImportedHarness harness = import_harness(read_harness(folder.write("t.vec", placed())), {}, scene);
  CHECK(harness.clips == 3);
  CHECK(scene.rod("S1").hold_at(0.025));
  CHECK(scene.rod("S1").hold_at(0.07));
  CHECK(scene.rod("S3").hold_at(0.12));
  CHECK(scene.solve().ok());
}

TEST_CASE("VEC placements: what makes no sense is refused or left out by name", "[vec]") {
  fails(replaced(placed(), "<ReferencedSegment>S1<", "<ReferencedSegment>S9<"), "refers to 'S9', which is not in the file");
  fails(replaced(placed(), "<ReferencedNode>N1<", "<ReferencedNode>S1<"), "which is a TopologySegment, expected a TopologyNode");
  fails(replaced(placed(), "<PlacedElement>PR_CLIP<", "<PlacedElement>CLIP<"), "which is a Component, expected a Role");
  fails(replaced(placed(), "<ValueComponent>25<", "<ValueComponent>101<"), "<Location>: its Offset goes beyond the end of the segment");
  fails(replaced(placed(), "<ValueComponent>25<", "<ValueComponent>-1<"), "<Offset>: got -0.001 (SI), expected 0 to 1e6");
  // Of a segment that states no length, or has no place.
  std::string text = replaced(placed(), "<Classification>Designed<", "<Classification>Adapted<");
  CHECK_THAT(parse_vec(text, "t.vec").skipped, Catch::VectorContains(std::string("2 fixings lie on segments whose length is not stated: they are left out")));
  text = replaced(placed(), "<ReferenceNode>N4</ReferenceNode>", "");
  CHECK(parse_vec(text, "t.vec").segments.size() == 2);
}
