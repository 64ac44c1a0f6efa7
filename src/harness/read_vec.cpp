// VEC 1.2 and 2.x: the Vehicle Electric Container (VDA 4968, prostep ivip). Its topology, and the building blocks that place its
// nodes and draw its segments as NURBS; wires by read_vec_wires.h, fixings and connectors by read_vec_placements.h; protections are counted, not read.
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include <Eigen/LU>

#include "harness/harness_file.h"
#include "harness/read_vec_placements.h"
#include "harness/read_vec_wires.h"
#include "harness/vec_specifications.h"

namespace tendril {
namespace {

using Node = XmlFile::Node;

constexpr double farthest = 1e6;  // m
constexpr int highest_degree = 24;

/// Where a building block lies in the harness.
struct Positioning {
  Mat3 turn = Mat3::Identity();
  Vec3 by = Vec3::Zero();  // m
};

class VecReader {
 public:
  VecReader(std::string_view content, const std::string& path) : file_(content, path), units_(file_) { found_.path = path; }
  HarnessFile read();

 private:
  void check_root();
  void read_topology(Node specification);
  HarnessSegment topology_segment(Node node) const;
  int node_number(Node segment, const char* name) const;
  void read_positionings();
  Positioning positioning(Node node) const;
  void read_block(Node specification);
  void place_node(Node node, double unit, const Positioning& where);
  void draw_segment(Node node, double unit, const Positioning& where);
  std::optional<Vec3> direction(Node segment, const char* name, const Positioning& where) const;
  HarnessCurve curve(Node node, double unit, const Positioning& where) const;
  void read_knots(Node node, HarnessCurve& made) const;
  Vec3 point(Node from, std::string_view id, double unit) const;
  void keep_located();
  void count_drawings();

  void skip(const std::string& what) { found_.skipped.push_back(what); }

  XmlFile file_;
  VecUnits units_;
  HarnessFile found_;
  std::unordered_map<std::string_view, int> nodes_, segments_;  ///< of the topology, by id
  std::vector<bool> located_, drawn_;
  std::map<std::string_view, Positioning> positionings_;        ///< by the building block's id
};

void VecReader::check_root() {
  const Node root = file_.root();
  if (XmlFile::local_name(root) != "VecContent")
    file_.fail(root, "this is no VEC file: its root is <" + std::string(root.name()) + ">, expected <vec:VecContent>");
  const std::string version(XmlFile::text(root, "VecVersion"));
  if (!version.starts_with("1.2") && !version.starts_with("2."))
    file_.fail(root, "it is of VEC version '" + version + "'; 1.2 and 2.x are read");
  found_.format = "VEC " + version;
}

int VecReader::node_number(Node segment, const char* name) const {
  const std::string_view id = XmlFile::text(segment, name);
  const auto found = nodes_.find(file_.referenced(segment, id, "TopologyNode").attribute("id").value());
  // Elements of the right name can stand in wrong places.
  if (found == nodes_.end()) file_.fail(segment, "it refers to '" + std::string(id) + "', a TopologyNode that is not in the topology");
  return found->second;
}

/// A designed length is the centre line's, an adapted one what is made.
HarnessSegment VecReader::topology_segment(Node node) const {
  HarnessSegment made;
  made.id = node.attribute("id").value();
  made.name = XmlFile::text(node, "Identification");
  made.start = node_number(node, "StartNode");
  made.finish = node_number(node, "EndNode");
  made.form = XmlFile::text(node, "Form");
  for (Node length : node.children("LengthInformation")) {
    const double value = units_.value(length.child("Length"), vec_length);
    const bool adapted = XmlFile::text(length, "Classification") == "Adapted";
    (adapted ? made.physical_length : made.virtual_length) = value;
  }
  for (Node area : node.children("CrossSectionAreaInformation")) made.area = std::max(made.area, units_.value(area.child("Area"), vec_area));
  return made;
}

void VecReader::read_topology(Node specification) {
  for (Node node : specification.children("TopologyNode")) {
    if (!nodes_.emplace(node.attribute("id").value(), static_cast<int>(found_.nodes.size())).second) continue;
    HarnessNode made;
    made.id = node.attribute("id").value();
    made.name = XmlFile::text(node, "Identification");
    found_.nodes.push_back(std::move(made));
  }
  for (Node node : specification.children("TopologySegment")) {
    if (!segments_.emplace(node.attribute("id").value(), static_cast<int>(found_.segments.size())).second) continue;
    found_.segments.push_back(topology_segment(node));
  }
}

/// A CartesianPoint3D in m.
Vec3 VecReader::point(Node from, std::string_view id, double unit) const {
  const Node node = file_.referenced(from, id, "CartesianPoint");
  Vec3 found;
  const char* axes[] = {"X", "Y", "Z"};
  for (int k = 0; k < 3; ++k) found[k] = unit * file_.number(node, XmlFile::text(node, axes[k]));
  if (!(found.cwiseAbs().maxCoeff() <= farthest)) file_.fail(node, "<CartesianPoint>: it lies farther than 1000 km from the origin");
  return found;
}

Positioning VecReader::positioning(Node node) const {
  Positioning made;
  const Node transformation = node.child("Positioning");
  if (!transformation) return made;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const std::string name = "A" + std::to_string(i + 1) + std::to_string(k + 1);
      made.turn(i, k) = file_.number(transformation, XmlFile::text(transformation, name.c_str()));
    }
  if (!((made.turn * made.turn.transpose() - Mat3::Identity()).norm() < 1e-3 && made.turn.determinant() > 0))
    file_.fail(transformation, "<Positioning>: A11 to A33 are no rotation");
  // Its origin is a point of the building block or of the harness, in the unit of the block.
  const std::string_view origin = XmlFile::text(transformation, "Origin");
  if (!origin.empty()) {
    const Node block = file_.by_id(XmlFile::text(node, "Referenced3DBuildingBlock"));
    made.by = point(transformation, origin, units_.factor(block, XmlFile::text(block, "BaseUnit"), vec_length));
  }
  return made;
}

void VecReader::read_positionings() {
  each_specification(file_, "HarnessGeometrySpecification3D", [&](Node specification) {
    for (Node node : specification.children("BuildingBlockPositionings")) {
      const std::string_view block = XmlFile::text(node, "Referenced3DBuildingBlock");
      const Node target = file_.by_id(block);
      if (!target) file_.fail(node, "<BuildingBlockPositionings>: there is no building block '" + std::string(block) + "'");
      if (!positionings_.emplace(target.attribute("id").value(), positioning(node)).second)
        skip("line " + std::to_string(file_.line(node)) + ": building block '" + std::string(XmlFile::text(target, "Identification")) +
             "' is placed more than once: it stays where it was placed first");
    }
  });
}

void VecReader::place_node(Node node, double unit, const Positioning& where) {
  const auto number = nodes_.find(XmlFile::text(node, "ReferenceNode"));
  if (number == nodes_.end() || located_[static_cast<std::size_t>(number->second)]) return;
  found_.nodes[static_cast<std::size_t>(number->second)].at = where.turn * point(node, XmlFile::text(node, "CartesianPoint"), unit) + where.by;
  located_[static_cast<std::size_t>(number->second)] = true;
}

std::optional<Vec3> VecReader::direction(Node segment, const char* name, const Positioning& where) const {
  const Node vector = segment.child(name);
  if (!vector) return {};
  Vec3 found;
  const char* axes[] = {"X", "Y", "Z"};
  for (int k = 0; k < 3; ++k) found[k] = file_.number(vector, XmlFile::text(vector, axes[k]));
  const double length = found.stableNorm();
  if (!(length > 0)) return {};
  return where.turn * (found / length);
}

/// points + degree + 1 of them, or two less: then the outermost, which shape nothing, are left out.
void VecReader::read_knots(Node node, HarnessCurve& made) const {
  for (Node knot : node.children("Knots"))
    for (const std::string_view word : XmlFile::words(knot.text().get())) made.knots.push_back(file_.number(knot, word));
  const std::size_t needed = made.points.size() + static_cast<std::size_t>(made.degree) + 1;
  if (made.knots.empty()) return;
  if (made.knots.size() + 2 == needed) {
    made.knots.insert(made.knots.begin(), made.knots.front());
    made.knots.push_back(made.knots.back());
  }
  if (made.knots.size() != needed)
    file_.fail(node, "<Curve>: it has " + std::to_string(made.knots.size()) + " knots; " + std::to_string(needed) + " expected for " +
                         std::to_string(made.points.size()) + " control points and degree " + std::to_string(made.degree));
  if (!std::is_sorted(made.knots.begin(), made.knots.end()))
    file_.fail(node, "<Curve>: its knots fall; each at least as large as the one before expected");
  if (!(made.knots[made.points.size()] > made.knots[static_cast<std::size_t>(made.degree)]))
    file_.fail(node, "<Curve>: its knots leave no curve");
}

HarnessCurve VecReader::curve(Node node, double unit, const Positioning& where) const {
  HarnessCurve made;
  const double degree = file_.number(node, XmlFile::text(node, "Degree"));
  if (degree != std::floor(degree) || degree < 1 || degree > highest_degree)
    file_.fail(node, "<Curve>: its degree must be a whole number from 1 to " + std::to_string(highest_degree));
  made.degree = static_cast<int>(degree);
  bool rational = false;
  for (Node control : node.children("ControlPoint")) {
    made.points.push_back(where.turn * point(control, XmlFile::text(control, "CartesianPoint3D"), unit) + where.by);
    const std::string_view weight = XmlFile::text(control, "Weight");
    made.weights.push_back(weight.empty() ? 1 : file_.number(control, weight));
    if (!(made.weights.back() > 1e-6 && made.weights.back() < 1e6)) file_.fail(control, "<ControlPoint>: its weight must lie from 1e-6 to 1e6");
    rational = rational || made.weights.back() != made.weights.front();
  }
  if (!rational) made.weights.clear();
  if (static_cast<int>(made.points.size()) <= made.degree)
    file_.fail(node, "<Curve>: " + std::to_string(made.points.size()) + " control points are too few for degree " + std::to_string(made.degree));
  read_knots(node, made);
  return made;
}

void VecReader::draw_segment(Node node, double unit, const Positioning& where) {
  const auto number = segments_.find(XmlFile::text(node, "ReferenceSegment"));
  if (number == segments_.end() || drawn_[static_cast<std::size_t>(number->second)]) return;
  HarnessSegment& segment = found_.segments[static_cast<std::size_t>(number->second)];
  segment.start_direction = direction(node, "StartVector", where);
  segment.finish_direction = direction(node, "EndVector", where);
  for (Node child : node.children("Curve")) {
    if (vec_type(child) != "NURBSCurve") {
      skip("line " + std::to_string(file_.line(child)) + ": a curve of type '" + std::string(vec_type(child)) + "': the segment counts as straight");
      segment.curves.clear();
      break;
    }
    segment.curves.push_back(curve(child, unit, where));
  }
  drawn_[static_cast<std::size_t>(number->second)] = true;
}

void VecReader::read_block(Node specification) {
  const double unit = units_.factor(specification, XmlFile::text(specification, "BaseUnit"), vec_length);
  const auto placed = positionings_.find(specification.attribute("id").value());
  const Positioning where = placed == positionings_.end() ? Positioning() : placed->second;
  for (Node node : specification.children("GeometryNode")) place_node(node, unit, where);
  for (Node node : specification.children("GeometrySegment")) draw_segment(node, unit, where);
}

/// Nodes without a place, and segments between them, are left out.
void VecReader::keep_located() {
  std::vector<int> moved(found_.nodes.size(), -1);
  std::vector<HarnessNode> nodes;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (!located_[i]) {
      skip("node '" + found_.nodes[i].name + "' has no place in a 3D building block");
      continue;
    }
    moved[i] = static_cast<int>(nodes.size());
    nodes.push_back(std::move(found_.nodes[i]));
  }
  std::vector<HarnessSegment> segments;
  int straight = 0;
  for (std::size_t i = 0; i < found_.segments.size(); ++i) {
    HarnessSegment& segment = found_.segments[i];
    segment.start = moved[static_cast<std::size_t>(segment.start)];
    segment.finish = moved[static_cast<std::size_t>(segment.finish)];
    if (segment.start < 0 || segment.finish < 0) {
      skip("segment '" + segment.name + "' is left out: one of its nodes has no place");
      continue;
    }
    straight += segment.curves.empty();
    segments.push_back(std::move(segment));
  }
  if (straight > 0) skip(std::to_string(straight) + " segments have no centre curve: they count as straight");
  found_.nodes = std::move(nodes);
  found_.segments = std::move(segments);
}

void VecReader::count_drawings() {
  int drawn = 0;
  each_specification(file_, "BuildingBlockSpecification2D", [&](Node specification) {
    for (Node child : specification.children("GeometrySegment")) drawn += !child.empty();
  });
  if (drawn > 0) skip(std::to_string(drawn) + " segments of 2D drawings are not read");
}

HarnessFile VecReader::read() {
  check_root();
  const Node root = file_.root();
  for (Node document : root.children("DocumentVersion"))
    if (found_.name.empty()) found_.name = XmlFile::text(document, "DocumentNumber");
  each_specification(file_, "TopologySpecification", [&](Node specification) { read_topology(specification); });
  located_.assign(found_.nodes.size(), false);
  drawn_.assign(found_.segments.size(), false);
  read_positionings();
  each_specification(file_, "BuildingBlockSpecification3D", [&](Node specification) { read_block(specification); });
  keep_located();
  if (found_.nodes.empty() || found_.segments.empty())
    file_.fail(root, "the file has no 3D geometry: " + std::to_string(nodes_.size()) + " nodes and " + std::to_string(segments_.size()) +
                         " segments in its topology, " + std::to_string(found_.nodes.size()) + " and " +
                         std::to_string(found_.segments.size()) + " of them with a place");
  read_vec_wires(file_, units_, found_);
  read_vec_placements(file_, units_, found_);
  count_drawings();
  return std::move(found_);
}

}  // namespace

HarnessFile parse_vec(std::string_view content, const std::string& path) { return VecReader(content, path).read(); }

}  // namespace tendril
