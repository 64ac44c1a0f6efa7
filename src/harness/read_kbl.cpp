// KBL 2.3 to 2.5: the harness list of the German car makers (VDA 4964). References go by id; points are in millimetres.
#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "base/error.h"
#include "harness/harness_file.h"
#include "harness/kbl_units.h"
#include "harness/xml_file.h"

namespace tendril {
namespace {

using Node = XmlFile::Node;

constexpr double mm = 1e-3, farthest = 1e6;  // m
constexpr int highest_degree = 24;

class KblReader {
 public:
  KblReader(std::string_view content, const std::string& path) : file_(content, path), units_(file_) { found_.path = path; }
  HarnessFile read();

 private:
  void check_root();
  Vec3 point(Node from, std::string_view id) const;
  std::optional<Frame> placement(Node owner) const;
  void take_id(std::unordered_map<std::string_view, int>& taken, Node node, std::size_t number) const;
  void read_node(Node node);
  void read_segment(Node node);
  HarnessCurve curve(Node node) const;
  HarnessFixing fixing(Node assignment) const;
  HarnessProtection protection(Node area);
  double share(Node owner, const char* name, double otherwise) const;
  double mass(Node part);
  int number_of(const std::unordered_map<std::string_view, int>& read, Node from, std::string_view id, const char* tag) const;
  int node_number(Node segment, const char* name) const;
  void read_wire(Node occurrence);
  void read_cores(Node part, HarnessWire& wire) const;
  void read_routing(Node routing);
  std::string component_name(std::string_view id) const;

  XmlFile file_;
  KblUnits units_;
  HarnessFile found_;
  std::unordered_map<std::string_view, int> nodes_, segments_, wires_;  ///< by id; of cores: their cable
  std::set<Node> without_mass_;
  int not_routed_ = 0;
};

void KblReader::check_root() {
  const Node root = file_.root();
  if (XmlFile::local_name(root) != "KBL_container")
    file_.fail(root, "this is no KBL file: its root is <" + std::string(root.name()) + ">, expected <kbl:KBL_container>");
  const std::string version = root.attribute("version_id").value();
  found_.format = version.empty() ? "KBL" : "KBL " + version;
}

/// A Cartesian_point in m.
Vec3 KblReader::point(Node from, std::string_view id) const {
  const Node node = file_.referenced(from, id, "Cartesian_point");
  const Vec3 found = file_.vector(node, "Coordinates") * mm;
  if (found.cwiseAbs().maxCoeff() > farthest) file_.fail(node, "<Cartesian_point>: it lies farther than 1000 km from the origin");
  return found;
}

/// U and V are the axes d1 and d2.
std::optional<Frame> KblReader::placement(Node owner) const {
  const Node placement = owner.child("Placement");
  if (!placement) return {};
  const Vec3 at = point(placement, XmlFile::text(placement, "Cartesian_point"));
  const Vec3 u = file_.vector(placement, "U"), v = file_.vector(placement, "V"), w = u.cross(v);
  if (!(w.norm() > 1e-3 * u.norm() * v.norm())) return Frame{at, Quat::Identity()};
  Mat3 axes;
  axes.col(2) = w.normalized();
  axes.col(0) = u.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return Frame{at, Quat(axes)};
}

std::string KblReader::component_name(std::string_view id) const {
  const Node node = file_.by_id(id);
  const std::string name(XmlFile::text(node, "Id"));
  if (!name.empty()) return name;
  const std::string parent(XmlFile::text(node.parent(), "Id"));
  return parent.empty() ? std::string(id) : parent;
}

/// Rods and branch points are called as these: each by a name of its own.
void KblReader::take_id(std::unordered_map<std::string_view, int>& taken, Node node, std::size_t number) const {
  const std::string_view id = node.attribute("id").value();
  if (id.empty()) file_.fail(node, "<" + std::string(node.name()) + ">: it has no id");
  if (!taken.emplace(id, static_cast<int>(number)).second)
    file_.fail(node, "<" + std::string(node.name()) + " id=\"" + std::string(id) + "\">: another " + node.name() + " has this id");
}

void KblReader::read_node(Node node) {
  HarnessNode made;
  made.id = node.attribute("id").value();
  made.name = XmlFile::text(node, "Id");
  made.at = point(node, XmlFile::text(node, "Cartesian_point"));
  made.min_bend_radius = units_.value(node, "Bend_radius", Quantity::length);
  for (const std::string_view id : XmlFile::words(XmlFile::text(node, "Referenced_components")))
    made.components.push_back(component_name(id));
  take_id(nodes_, node, found_.nodes.size());
  found_.nodes.push_back(std::move(made));
}

HarnessCurve KblReader::curve(Node node) const {
  HarnessCurve made;
  const double degree = file_.number(node, XmlFile::text(node, "Degree"));
  for (const std::string_view id : XmlFile::words(XmlFile::text(node, "Control_points"))) made.points.push_back(point(node, id));
  if (degree != std::floor(degree) || degree < 1 || degree > highest_degree)
    file_.fail(node, "<Center_curve>: its degree must be a whole number from 1 to " + std::to_string(highest_degree));
  made.degree = static_cast<int>(degree);
  if (static_cast<int>(made.points.size()) <= made.degree)
    file_.fail(node, "<Center_curve>: " + std::to_string(made.points.size()) + " control points are too few for degree " +
                         std::to_string(made.degree));
  return made;
}

double KblReader::share(Node owner, const char* name, double otherwise) const {
  const std::string_view text = XmlFile::text(owner, name);
  if (text.empty()) return otherwise;
  const double value = file_.number(owner, text);
  if (value < -1e-6 || value > 1 + 1e-6)
    file_.fail(owner, "<" + std::string(owner.name()) + ">: " + name + " must lie from 0 to 1");
  return std::clamp(value, 0.0, 1.0);
}

HarnessFixing KblReader::fixing(Node assignment) const {
  const Node occurrence = file_.by_id(XmlFile::text(assignment, "Fixing"));
  if (!occurrence) file_.fail(assignment, "<Fixing_assignment>: there is no fixing '" + std::string(XmlFile::text(assignment, "Fixing")) + "'");
  HarnessFixing made;
  made.id = occurrence.attribute("id").value();
  made.name = XmlFile::text(occurrence, "Id");
  made.kind = XmlFile::text(file_.by_id(XmlFile::text(occurrence, "Part")), "Fixing_type");
  made.location = share(assignment, "Location", 0.5);
  made.place = placement(occurrence);
  return made;
}

/// kg per m; 0 where the part's mass is not stated, or that of a piece of unknown length.
double KblReader::mass(Node part) {
  if (units_.fits(part, "Mass_information", Quantity::mass_per_length))
    return units_.value(part, "Mass_information", Quantity::mass_per_length);
  if (without_mass_.insert(part).second)
    found_.skipped.push_back("line " + std::to_string(file_.line(part)) + ": the mass of '" + std::string(XmlFile::text(part, "Part_number")) +
                             "' is not given per length");
  return 0;
}

HarnessProtection KblReader::protection(Node area) {
  const Node occurrence = file_.by_id(XmlFile::text(area, "Associated_protection"));
  const Node part = file_.by_id(XmlFile::text(occurrence, "Part"));
  HarnessProtection made;
  made.id = occurrence.attribute("id").value();
  made.name = XmlFile::text(part, "Description");
  made.kind = XmlFile::text(part, "Protection_type");
  made.from = share(area, "Start_location", 0);
  made.to = std::max(made.from, share(area, "End_location", 1));
  made.mass = mass(part);
  return made;
}

/// Of what was read under this id; there are elements of the right name in wrong places too.
int KblReader::number_of(const std::unordered_map<std::string_view, int>& read, Node from, std::string_view id, const char* tag) const {
  const auto found = read.find(file_.referenced(from, id, tag).attribute("id").value());
  if (found == read.end())
    file_.fail(from, "<" + std::string(from.name()) + "> refers to '" + std::string(id) + "', a " + tag + " that is not where the file's own are");
  return found->second;
}

int KblReader::node_number(Node segment, const char* name) const {
  return number_of(nodes_, segment, XmlFile::text(segment, name), "Node");
}

void KblReader::read_segment(Node node) {
  HarnessSegment made;
  made.id = node.attribute("id").value();
  made.name = XmlFile::text(node, "Id");
  made.start = node_number(node, "Start_node");
  made.finish = node_number(node, "End_node");
  if (node.child("Start_vector")) made.start_direction = file_.vector(node, "Start_vector").stableNormalized();
  if (node.child("End_vector")) made.finish_direction = file_.vector(node, "End_vector").stableNormalized();
  made.virtual_length = units_.value(node, "Virtual_length", Quantity::length);
  made.physical_length = units_.value(node, "Physical_length", Quantity::length);
  made.form = XmlFile::text(node, "Form");
  made.area = units_.value(node.child("Cross_section_area_information"), "Area", Quantity::area);
  for (Node child : node.children("Center_curve")) made.curves.push_back(curve(child));
  for (Node child : node.children("Fixing_assignment")) made.fixings.push_back(fixing(child));
  for (Node child : node.children("Protection_area")) made.protections.push_back(protection(child));
  take_id(segments_, node, found_.segments.size());
  found_.segments.push_back(std::move(made));
}

/// A cable without numbers of its own has those of its cores: the area in sum, the bend radius of the stiffest.
void KblReader::read_cores(Node part, HarnessWire& wire) const {
  double area = 0, squares = 0;
  for (Node core : part.children("Core")) {
    const double outer = units_.value(core, "Outside_diameter", Quantity::length);
    area += units_.value(core, "Cross_section_area", Quantity::area);
    squares += outer * outer;
    wire.min_bend_radius = std::max(wire.min_bend_radius, units_.value(core, "Bend_radius", Quantity::length));
  }
  if (wire.conductor_area == 0) wire.conductor_area = area;
  // Round cores fill about 0.7 of the circle around them, the sheath not counted.
  if (wire.outer == 0) wire.outer = std::sqrt(squares / 0.7);
}

void KblReader::read_wire(Node occurrence) {
  const Node part = file_.referenced(occurrence, XmlFile::text(occurrence, "Part"), "General_wire");
  HarnessWire made;
  made.id = occurrence.attribute("id").value();
  made.name = XmlFile::text(occurrence, occurrence.child("Special_wire_id") ? "Special_wire_id" : "Wire_number");
  if (made.name.empty()) made.name = XmlFile::text(part, "Part_number");
  made.type = XmlFile::text(part, "Wire_type");
  made.outer = units_.value(part, "Outside_diameter", Quantity::length);
  made.conductor_area = units_.value(part, "Cross_section_area", Quantity::area);
  made.mass = mass(part);
  made.min_bend_radius = units_.value(part, "Bend_radius", Quantity::length);
  made.stated_length = units_.value(occurrence.child("Length_information"), "Length_value", Quantity::length);
  if (part.child("Core")) read_cores(part, made);
  const int number = static_cast<int>(found_.wires.size());
  wires_.emplace(occurrence.attribute("id").value(), number);
  for (Node core : occurrence.children("Core_occurrence")) wires_.emplace(core.attribute("id").value(), number);
  found_.wires.push_back(std::move(made));
}

void KblReader::read_routing(Node routing) {
  const std::vector<std::string_view> ids = XmlFile::words(XmlFile::text(routing, "Segments"));
  if (ids.empty()) {
    ++not_routed_;
    return;
  }
  const Node connection = file_.referenced(routing, XmlFile::text(routing, "Routed_wire"), "Connection");
  const auto wire = wires_.find(XmlFile::text(connection, "Wire"));
  if (wire == wires_.end()) file_.fail(connection, "<Connection>: there is no wire '" + std::string(XmlFile::text(connection, "Wire")) + "'");
  for (const std::string_view id : ids) {
    const int segment = number_of(segments_, routing, id, "Segment");
    std::vector<int>& through = found_.segments[segment].wires;
    if (!through.empty() && through.back() == wire->second) continue;
    if (std::find(through.begin(), through.end(), wire->second) != through.end()) continue;  // another core of the cable
    through.push_back(wire->second);
    found_.wires[wire->second].segments.push_back(segment);
  }
}

HarnessFile KblReader::read() {
  check_root();
  const Node root = file_.root(), harness = root.child("Harness");
  found_.name = XmlFile::text(harness, "Description");
  if (found_.name.empty()) found_.name = XmlFile::text(harness, "Part_number");
  for (Node node : root.children("Node")) read_node(node);
  for (Node node : root.children("Segment")) read_segment(node);
  for (Node node : harness.children("General_wire_occurrence")) read_wire(node);
  for (Node node : root.children("Routing")) read_routing(node);
  if (found_.nodes.empty() || found_.segments.empty())
    file_.fail(root, "the file has no geometry: " + std::to_string(found_.nodes.size()) + " nodes, " +
                         std::to_string(found_.segments.size()) + " segments");
  if (not_routed_ > 0) found_.skipped.push_back(std::to_string(not_routed_) + " connections name no segments: their wires count nowhere");
  return std::move(found_);
}

}  // namespace

HarnessFile parse_kbl(std::string_view content, const std::string& path) { return KblReader(content, path).read(); }

}  // namespace tendril
