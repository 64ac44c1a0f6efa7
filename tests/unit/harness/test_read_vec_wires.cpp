// Wires of VEC files: sizes by layers, routes, what is left out, and bundles made of them.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
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

std::string value(const std::string& name, const std::string& id, const std::string& number, const std::string& unit) {
  return "<" + name + " id=\"" + id + "\"><UnitComponent>" + unit + "</UnitComponent><ValueComponent>" + number + "</ValueComponent></" + name + ">";
}
std::string specification(const std::string& type, const std::string& id, const std::string& content) {
  return "<Specification xsi:type=\"vec:" + type + "\" id=\"" + id + "\"><Identification>" + id + "</Identification>" + content + "</Specification>\n";
}
std::string component(const std::string& id, const std::string& part, const std::string& wire_specification, const std::string& references) {
  return "<Component id=\"" + id + "\"><Identification>" + id + "</Identification>" +
         "<Role xsi:type=\"vec:SpecificRole\" id=\"SR_" + id + "\"/><Role xsi:type=\"vec:WireRole\" id=\"WR_" + id + "\"><WireSpecification>" +
         wire_specification + "</WireSpecification>" + references + "</Role><Part>" + part + "</Part></Component>\n";
}
std::string reference(const std::string& id, const std::string& lengths = "") {
  return "<WireElementReference id=\"" + id + "\"><Identification>" + id + "</Identification>" + lengths + "</WireElementReference>";
}
std::string length(const std::string& type, const std::string& id, const std::string& number) {
  return "<WireLength id=\"L" + id + "\"><LengthType>" + type + "</LengthType>" + value("LengthValue", "LV" + id, number, "U_mm") + "</WireLength>";
}
std::string routing(const std::string& id, const std::string& element, const std::string& segments) {
  return "<Routing id=\"" + id + "\"><RoutedElement>" + element + "</RoutedElement><Path id=\"P_" + id + "\"><Segment>" + segments +
         "</Segment></Path></Routing>\n";
}

/// The T with a single wire W1 (1.3 mm, 0.35 mm^2, 4.6 g/m) along S1 and S2, and a shielded pair W2 of such cores along S1 and S3.
std::string wired() {
  const auto inner = [](const std::string& id, const std::string& of, const std::string& inside) {
    return "<SubWireElement id=\"" + id + "\"><Identification>" + id + "</Identification><WireElementSpecification>" + of +
           "</WireElementSpecification>" + inside + "</SubWireElement>";
  };
  const std::string text =
      specification("CoreSpecification", "CORE", value("CrossSectionArea", "V1", "0.35", "U_mm2")) +
      specification("ShieldSpecification", "SHIELD", value("CrossSectionArea", "V2", "1.5", "U_mm2")) +
      specification("WireElementSpecification", "WES1",
                    "<Type id=\"WT\"><Type>FLRY-A</Type></Type>" + value("MinBendRadiusStatic", "V3", "4", "U_mm") +
                        value("OutsideDiameter", "V4", "1.3", "U_mm") + "<ConductorSpecification>CORE</ConductorSpecification>") +
      specification("WireElementSpecification", "WES2", "<ConductorSpecification>SHIELD</ConductorSpecification>") +
      specification("WireElementSpecification", "WES3", "") +
      specification("WireSpecification", "WS1",
                    "<WireElement id=\"WE1\"><Identification>1</Identification><WireElementSpecification>WES1</WireElementSpecification></WireElement>") +
      specification("WireSpecification", "WS2",
                    "<WireElement id=\"WE2\"><Identification>R</Identification><WireElementSpecification>WES3</WireElementSpecification>" +
                        inner("WE3", "WES2", inner("WE4", "WES1", "") + inner("WE5", "WES1", "")) + "</WireElement>") +
      specification("GeneralTechnicalPartSpecification", "GT",
                    "<DescribedPart>PV1</DescribedPart><MassInformation id=\"M1\">" + value("Value", "V5", "4.6", "U_g_m") + "</MassInformation>") +
      specification("GeneralTechnicalPartSpecification", "GT2",
                    "<DescribedPart>PV2</DescribedPart><MassInformation id=\"M2\">" + value("Value", "V6", "30", "U_g") + "</MassInformation>") +
      specification("CompositionSpecification", "CS",
                    component("W1", "PV1", "WS1", reference("R1", length("Production", "1", "300") + length("DMU", "2", "257"))) +
                        component("W2", "PV2", "WS2", reference("R2") + reference("R3", length("Production", "3", "250")) + reference("R4"))) +
      specification("RoutingSpecification", "RS",
                    routing("RT1", "R1", "S1 S2") + routing("RT2", "R3", "S1 S3 S3") + routing("RT3", "R4", "S3 S1") + routing("RT4", "R1", "S3"));
  return replaced(replaced(tee(), "</DocumentVersion>", text + "</DocumentVersion>"), "</vec:VecContent>",
                  "<PartVersion id=\"PV1\"/><PartVersion id=\"PV2\"/>"
                  "<Unit xsi:type=\"vec:SIUnit\" id=\"U_g\"><SiUnitName>Gram</SiUnitName></Unit>"
                  "<Unit xsi:type=\"vec:SIUnit\" id=\"U_per_m\"><Exponent>-1</Exponent><SiUnitName>Metre</SiUnitName></Unit>"
                  "<Unit xsi:type=\"vec:CompositeUnit\" id=\"U_g_m\"><Factors>U_g U_per_m</Factors></Unit></vec:VecContent>");
}

void fails(const std::string& text, const std::string& why) {
  CHECK_THROWS_WITH(parse_vec(text, "t.vec"), Contains("scene.import: t.vec") && Contains(why));
}

}  // namespace

TEST_CASE("VEC wires: sizes, masses, lengths and routes", "[vec]") {
  const HarnessFile file = parse_vec(wired(), "t.vec");
  REQUIRE(file.wires.size() == 2);
  const HarnessWire &single = file.wires[0], &pair = file.wires[1];
  CHECK(single.name == "W1");
  CHECK(single.type == "FLRY-A");
  CHECK(single.outer == Approx(1.3e-3));
  CHECK(single.conductor_area == Approx(0.35e-6));
  CHECK(single.min_bend_radius == Approx(4e-3));
  CHECK(single.mass == Approx(4.6e-3));
  CHECK(single.stated_length == Approx(0.257));  // DMU before Production
  CHECK(single.segments == std::vector<int>{0, 1});
  // Of the pair: two cores packed, the shield is no core; its mass is of a piece.
  CHECK(pair.outer == Approx(1.3e-3 * std::sqrt(2 / 0.7)));
  CHECK(pair.conductor_area == Approx(0.7e-6));
  CHECK(pair.min_bend_radius == Approx(4e-3));
  CHECK(pair.mass == 0);
  CHECK(pair.stated_length == Approx(0.25));
  CHECK(pair.segments == std::vector<int>{0, 2});
  CHECK(file.segments[0].wires == std::vector<int>{0, 1});
  CHECK(file.segments[1].wires == std::vector<int>{0});
  CHECK(file.segments[2].wires == std::vector<int>{1});
  CHECK(file.skipped.back() == "1 routings are variants: the first of each wire counts");
}

TEST_CASE("VEC wires: a segment that is left out keeps the numbers of the others", "[vec]") {
  // Without N3 the segment S2, between S1 and S3, is gone.
  const HarnessFile file = parse_vec(replaced(wired(), "<ReferenceNode>N3</ReferenceNode>", ""), "t.vec");
  REQUIRE(file.segments.size() == 2);
  CHECK(file.segments[1].id == "S3");
  CHECK(file.wires[0].segments == std::vector<int>{0});
  CHECK(file.wires[1].segments == std::vector<int>{0, 1});
  CHECK(file.segments[1].wires == std::vector<int>{1});
}

TEST_CASE("VEC wires: bundles have their sizes", "[vec]") {
  const Folder folder;
  Scene scene, bare;
  const ImportedHarness harness = import_harness(read_harness(folder.write("t.vec", wired())), {}, scene);
  import_harness(read_harness(folder.write("bare.vec", tee())), {}, bare);
  REQUIRE(scene.rods().size() == 3);
  // One wire of 1.3 mm against the 50 mm^2 that the file states of the segment.
  const auto radius = [](const Scene& of, std::size_t i) { return of.rods()[i]->rod().largest_radius(); };
  CHECK(radius(scene, 1) == Approx(0.65e-3));
  CHECK(radius(bare, 1) > 3e-3);
  CHECK(radius(scene, 0) > radius(scene, 1));
  CHECK(scene.solve().ok());
}

TEST_CASE("VEC wires: what refers to nothing, or has another unit, is refused by name", "[vec]") {
  fails(replaced(wired(), "<Segment>S1 S2<", "<Segment>S1 S9<"), "refers to 'S9', which is not in the file");
  fails(replaced(wired(), "<Segment>S1 S2<", "<Segment>S1 N2<"), "which is a TopologyNode, expected a TopologySegment");
  fails(replaced(wired(), "<RoutedElement>R1<", "<RoutedElement>R9<"), "<Routing>: there is no routed element 'R9'");
  fails(replaced(wired(), "<WireSpecification>WS1<", "<WireSpecification>WS9<"), "refers to 'WS9', which is not in the file");
  fails(replaced(wired(), "<ConductorSpecification>CORE<", "<ConductorSpecification>W1<"), "which is a Component, expected a Specification");
  fails(replaced(wired(), "<ValueComponent>1.3<", "<ValueComponent>thick<"), "got 'thick', expected a finite number");
  fails(replaced(wired(), "<UnitComponent>U_mm</UnitComponent><ValueComponent>1.3<", "<UnitComponent>U_g</UnitComponent><ValueComponent>1.3<"),
        "<Unit>: expected metres, by SiUnitName and SiPrefix, where line");
  fails(replaced(wired(), "<UnitComponent>U_mm2</UnitComponent><ValueComponent>0.35<", "<UnitComponent>U_mm</UnitComponent><ValueComponent>0.35<"),
        "<Unit>: expected metres with the exponent 2, by SiUnitName and SiPrefix, where line");
  fails(replaced(wired(), "<ValueComponent>1.3<", "<ValueComponent>-1.3<"), "<OutsideDiameter>: got -0.0013 (SI), expected 0 to 1e6");
  std::string deep, close;
  for (int k = 0; k < 40; ++k) {
    deep += "<SubWireElement id=\"D" + std::to_string(k) + "\">";
    close += "</SubWireElement>";
  }
  fails(replaced(wired(), "<SubWireElement id=\"WE3\">", deep + close + "<SubWireElement id=\"WE3\">"), "<SubWireElement>: more than 32 layers");
  // A unit that is a factor of itself measures nothing.
  const HarnessFile file = parse_vec(replaced(wired(), "<Factors>U_g U_per_m<", "<Factors>U_g U_g_m<"), "t.vec");
  CHECK(file.wires[0].mass == 0);
}

TEST_CASE("VEC wires: connections that no wire realises count nowhere", "[vec]") {
  const HarnessFile file = parse_vec(replaced(wired(), "<RoutedElement>R3<", "<RoutedElement>S1<"), "t.vec");
  CHECK(file.skipped.back() == "1 routings are of connections without a wire: they count nowhere");
  CHECK(file.wires[1].segments == std::vector<int>{2, 0});  // by its other core
}

TEST_CASE("VEC wires: damaged files are read or refused, never worse", "[vec]") {
  const std::string sound = wired();
  const unsigned seed = 31;
  CAPTURE(seed);
  Random random(seed);
  int read = 0, refused = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const std::string text = damaged(sound, random, {"0", "-1", "1e300", "9", "S2", "WE3", "", "<", "</", "nan", " ", "U_g"});
    CAPTURE(trial);
    try {
      const HarnessFile file = parse_vec(text, "t.vec");
      for (const HarnessWire& wire : file.wires) {
        CHECK(std::isfinite(wire.outer + wire.conductor_area + wire.mass + wire.min_bend_radius + wire.stated_length));
        for (const int segment : wire.segments) CHECK((segment >= 0 && segment < static_cast<int>(file.segments.size())));
      }
      ++read;
    } catch (const UsageError&) {
      ++refused;
    }
  }
  CHECK(read > 50);
  CHECK(refused > 300);
}
