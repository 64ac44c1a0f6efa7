// What files of the car industry say of a wiring harness, whatever their format: nodes, segments with their centre curves, wires,
// fixings and protections. As it stands in the file, in SI units; what is sound of it is judged later (centre_line.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/frame.h"

namespace tendril {

/// One B-spline, rational where it has weights. Files of the car industry often leave the knots out: then only its neighbours
/// tell whether it begins and ends at its first and last control points.
struct HarnessCurve {
  int degree = 0;
  std::vector<Vec3> points;     ///< control points, m
  std::vector<double> weights;  ///< empty: all 1
  std::vector<double> knots;    ///< points + degree + 1 of them; empty: the file does not say
};

struct HarnessNode {
  std::string id, name;
  Vec3 at = Vec3::Zero();       ///< m
  double min_bend_radius = 0;   ///< m; 0: not stated
  std::vector<std::string> components;  ///< names of the connectors, terminals or boxes there
};

/// A clip, cable tie, grommet or channel on a segment.
struct HarnessFixing {
  std::string id, name;
  std::string kind;             ///< as the file has it: "CABLE_DUCT"
  double location = 0;          ///< share of the segment's length from its start, 0 ... 1
  std::optional<Frame> place;   ///< the fixing's own frame, where the file has one
};

/// Tape, tube or conduit around a part of a segment.
struct HarnessProtection {
  std::string id, name;
  std::string kind;             ///< as the file has it: "TAPE"
  double from = 0, to = 1;      ///< shares of the segment's length
  double mass = 0;              ///< kg per m; 0: not stated
};

struct HarnessSegment {
  std::string id, name;
  int start = -1, finish = -1;  ///< nodes
  std::vector<HarnessCurve> curves;                       ///< one after the other from start to finish
  std::optional<Vec3> start_direction, finish_direction;  ///< unit vectors along the segment
  double virtual_length = 0;    ///< m, of the drawn centre line; 0: not stated
  double physical_length = 0;   ///< m, of what is cut; 0: not stated
  double area = 0;              ///< m^2, of the cross-section; 0: not stated
  std::string form;             ///< "circular"
  std::vector<HarnessFixing> fixings;
  std::vector<HarnessProtection> protections;
  std::vector<int> wires;       ///< through it, each cable once
};

/// A single wire, or a cable of several cores.
struct HarnessWire {
  std::string id, name;         ///< its number in the harness, else its part's
  std::string type;             ///< as the file has it
  double outer = 0;             ///< m; 0: not stated
  double conductor_area = 0;    ///< m^2, of all its cores; 0: not stated
  double mass = 0;              ///< kg per m; 0: not stated
  double min_bend_radius = 0;   ///< m; 0: not stated
  double stated_length = 0;     ///< m; 0: not stated
  std::vector<int> segments;    ///< that it runs through
};

struct HarnessFile {
  std::string path;
  std::string format;           ///< "KBL 2.4 SR-1"
  std::string name;             ///< part number or description
  std::vector<HarnessNode> nodes;
  std::vector<HarnessSegment> segments;
  std::vector<HarnessWire> wires;
  std::shared_ptr<const std::string> content;  ///< of the file, to write it back with what has changed
  std::vector<std::string> skipped;  ///< what was in the file and not taken, one sentence each
};

/// Readers of the formats. `content`: the whole file; `path` stands in messages and in the result. Throw UsageError
/// "scene.import: path: ..." for what is not such a file or refers to what is not there.
HarnessFile parse_kbl(std::string_view content, const std::string& path);
/// VEC 1.2 and 2.x: topology, places, centre curves, wires, fixings and connectors; protections are not read, and counted in `skipped`.
HarnessFile parse_vec(std::string_view content, const std::string& path);

}  // namespace tendril
