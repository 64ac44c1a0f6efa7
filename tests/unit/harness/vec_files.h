// A VEC file of a T of three segments for the tests, and changes to it.
#pragma once

#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "unit/base/random_numbers.h"

namespace tendril::test {

inline std::string point(const std::string& id, double x, double y, double z) {
  std::ostringstream out;
  out.precision(17);
  out << "<CartesianPoint id=\"" << id << "\"><X>" << x << "</X><Y>" << y << "</Y><Z>" << z << "</Z></CartesianPoint>\n";
  return out.str();
}
inline std::string control(const std::string& of, const char* weight = "1") {
  return "<ControlPoint id=\"C_" + of + "\"><Weight>" + weight + "</Weight><CartesianPoint3D>" + of + "</CartesianPoint3D></ControlPoint>\n";
}
inline std::string segment(const std::string& id, const std::string& start, const std::string& end, const std::string& length) {
  return "<TopologySegment id=\"" + id + "\"><Identification>SEG-" + id + "</Identification><Form>Circular</Form><EndNode>" + end +
         "</EndNode><StartNode>" + start + "</StartNode><CrossSectionAreaInformation id=\"A_" + id +
         "\"><Area id=\"AV_" + id + "\"><UnitComponent>U_mm2</UnitComponent><ValueComponent>50</ValueComponent></Area>"
         "<ValueDetermination>Calculated</ValueDetermination></CrossSectionAreaInformation><LengthInformation id=\"L_" + id +
         "\"><Length id=\"LV_" + id + "\"><UnitComponent>U_mm</UnitComponent><ValueComponent>" + length +
         "</ValueComponent></Length><Classification>Designed</Classification></LengthInformation></TopologySegment>\n";
}

/// Nodes at (0,0,0), (100,0,0), (200,100,0), (100,0,-150) mm: a straight line, a quarter circle of 100 mm, a segment without a curve.
inline std::string tee(const std::string& knots = "<Knots>0</Knots><Knots>0</Knots><Knots>0</Knots><Knots>1</Knots><Knots>1</Knots><Knots>1</Knots>",
                const std::string& positioning = "", const std::string& version = "2.1.0") {
  std::string text =
      "<?xml version=\"1.0\"?>\n<vec:VecContent xmlns:vec=\"http://www.prostep.org/ecad-if/2011/vec\" "
      "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" id=\"V\">\n<VecVersion>" + version + "</VecVersion>\n"
      "<DocumentVersion id=\"D\"><DocumentNumber>T-1</DocumentNumber>\n"
      "<Specification xsi:type=\"vec:TopologySpecification\" id=\"T\"><Identification>T</Identification>\n";
  for (const char* node : {"N1", "N2", "N3", "N4"})
    text += "<TopologyNode id=\"" + std::string(node) + "\"><Identification>ND-" + node + "</Identification></TopologyNode>\n";
  text += segment("S1", "N1", "N2", "100") + segment("S2", "N2", "N3", "157.079632679") + segment("S3", "N2", "N4", "150") + "</Specification>\n";
  text += "<Specification xsi:type=\"vec:BuildingBlockSpecification3D\" id=\"B\"><Identification>B</Identification><BaseUnit>U_mm</BaseUnit>\n" +
          point("P1", 0, 0, 0) + point("P2", 100, 0, 0) + point("P3", 200, 100, 0) + point("P4", 100, 0, -150) + point("Q", 200, 0, 0) + point("O", 0, 0, 1000);
  for (int k = 1; k <= 4; ++k) {
    const std::string n = std::to_string(k);
    text += "<GeometryNode id=\"G" + n + "\"><Identification>G" + n + "</Identification><ReferenceNode>N" + n + "</ReferenceNode><CartesianPoint>P" + n +
            "</CartesianPoint></GeometryNode>\n";
  }
  const auto drawn = [](const std::string& n, const std::string& start, const std::string& end, const std::string& from, const std::string& to,
                        const std::string& curve) {
    return "<GeometrySegment id=\"GS" + n + "\"><Identification>GS" + n + "</Identification><ReferenceSegment>S" + n + "</ReferenceSegment><StartVector id=\"SV" + n +
           "\">" + from + "</StartVector><EndVector id=\"EV" + n + "\">" + to + "</EndVector><EndNode>" + end + "</EndNode><StartNode>" + start + "</StartNode>" +
           curve + "</GeometrySegment>\n";
  };
  const std::string along_x = "<X>2</X><Y>0</Y><Z>0</Z>", along_y = "<X>0</X><Y>1</Y><Z>0</Z>", down = "<X>0</X><Y>0</Y><Z>-1</Z>";
  text += drawn("1", "G1", "G2", along_x, along_x,
                "<Curve xsi:type=\"vec:NURBSCurve\" id=\"K1\"><Degree>1</Degree><Knots>0</Knots><Knots>0</Knots><Knots>1</Knots><Knots>1</Knots>" +
                    control("P1") + control("P2") + "</Curve>");
  text += drawn("2", "G2", "G3", along_x, along_y,
                "<Curve xsi:type=\"vec:NURBSCurve\" id=\"K2\"><Degree>2</Degree>" + knots + control("P2") + control("Q", "0.70710678118654752") +
                    control("P3") + "</Curve>");
  text += drawn("3", "G2", "G4", down, down, "");
  return text + "</Specification>\n" + positioning +
         "</DocumentVersion>\n<Unit xsi:type=\"vec:SIUnit\" id=\"U_mm\"><SiUnitName>Metre</SiUnitName><SiPrefix>Milli</SiPrefix></Unit>\n"
         "<Unit xsi:type=\"vec:SIUnit\" id=\"U_mm2\"><Exponent>2</Exponent><SiUnitName>Metre</SiUnitName><SiPrefix>Milli</SiPrefix></Unit>\n</vec:VecContent>\n";
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != text.npos);
  return text.replace(at, what.size(), by);
}

/// A few places of it overwritten; `pieces` are what with.
inline std::string damaged(std::string text, Random& random, const std::vector<std::string>& pieces) {
  for (int k = 1 + random.below(3); k > 0; --k) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
    text.replace(at, static_cast<std::size_t>(random.below(4)), pieces[static_cast<std::size_t>(random.below(static_cast<int>(pieces.size())))]);
  }
  return text;
}

}  // namespace tendril::test
