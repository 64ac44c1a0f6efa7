#include "harness/read_vec_wires.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "harness/vec_specifications.h"

namespace tendril {
namespace {

using Node = XmlFile::Node;

constexpr int deepest = 32;      // layers of a cable
constexpr double packing = 0.7;  // of round cores in the circle around them, the sheath not counted

/// A wire, or a layer of a cable with all that is in it.
struct WireElement {
  double outer = 0, conductor_area = 0, min_bend_radius = 0;
};

class VecWires {
 public:
  VecWires(const XmlFile& file, const VecUnits& units, HarnessFile& found) : file_(file), units_(units), found_(found) {}
  void read();

 private:
  void read_masses(Node specification);
  void read_component(Node component);
  void read_wire(Node component, Node role);
  WireElement element(Node node, int depth) const;
  double core_area(Node specification) const;
  double stated_length(Node reference) const;
  void read_routing(Node routing);
  void route(int wire, Node path, std::string_view id);

  const XmlFile& file_;
  const VecUnits& units_;
  HarnessFile& found_;
  std::unordered_map<std::string_view, double> masses_;    ///< kg per m, by the part's id
  std::unordered_map<std::string_view, WireElement> elements_;  ///< by the wire specification's id
  std::unordered_map<std::string_view, int> wires_;        ///< by the id of each of its cores
  std::unordered_map<std::string_view, int> segments_;     ///< by id
  std::unordered_set<std::string_view> routed_;            ///< cores
  int variants_ = 0, others_ = 0;
};

/// What a part weighs by length; masses of whole pieces say nothing of a wire.
void VecWires::read_masses(Node specification) {
  for (Node mass : specification.children("MassInformation")) {
    const Node value = mass.child("Value");
    if (!units_.fits(value, vec_mass_per_length)) continue;
    for (const std::string_view part : XmlFile::words(XmlFile::text(specification, "DescribedPart")))
      masses_.emplace(part, units_.value(value, vec_mass_per_length));
  }
}

double VecWires::core_area(Node specification) const {
  const std::string_view id = XmlFile::text(specification, "ConductorSpecification");
  if (id.empty()) return 0;
  const Node conductor = file_.referenced(specification, id, "Specification");
  return vec_type(conductor) == "ShieldSpecification" ? 0 : units_.value(conductor.child("CrossSectionArea"), vec_area);
}

/// A layer that states nothing of its own is as what lies in it: as wide as its cores packed, as stiff as the stiffest.
WireElement VecWires::element(Node node, int depth) const {
  if (depth > deepest) file_.fail(node, "<SubWireElement>: more than " + std::to_string(deepest) + " layers");
  WireElement inside;
  double squares = 0;
  int number = 0;
  for (Node child : node.children("SubWireElement")) {
    const WireElement one = element(child, depth + 1);
    squares += one.outer * one.outer;
    inside.outer = ++number == 1 ? one.outer : std::sqrt(squares / packing);
    inside.conductor_area += one.conductor_area;
    inside.min_bend_radius = std::max(inside.min_bend_radius, one.min_bend_radius);
  }
  const Node specification = file_.referenced(node, XmlFile::text(node, "WireElementSpecification"), "Specification");
  WireElement made;
  made.outer = units_.value(specification.child("OutsideDiameter"), vec_length);
  made.min_bend_radius = units_.value(specification.child("MinBendRadiusStatic"), vec_length);
  if (made.outer == 0) made.outer = inside.outer;
  if (made.min_bend_radius == 0) made.min_bend_radius = inside.min_bend_radius;
  // Layers may repeat the specification of what they hold: the innermost conductors count.
  made.conductor_area = inside.conductor_area > 0 ? inside.conductor_area : core_area(specification);
  return made;
}

/// Along the drawn centre lines where it is stated, else the first of the others.
double VecWires::stated_length(Node reference) const {
  double first = 0;
  for (Node length : reference.children("WireLength")) {
    const double value = units_.value(length.child("LengthValue"), vec_length);
    if (XmlFile::text(length, "LengthType") == "DMU") return value;
    if (first == 0) first = value;
  }
  return first;
}

void VecWires::read_wire(Node component, Node role) {
  HarnessWire made;
  made.id = component.attribute("id").value();
  made.name = XmlFile::text(component, "Identification");
  if (const std::string_view id = XmlFile::text(role, "WireSpecification"); !id.empty()) {
    if (const Node root = file_.referenced(role, id, "Specification").child("WireElement")) {
      const auto known = elements_.find(id);
      const WireElement whole = known != elements_.end() ? known->second : elements_.emplace(id, element(root, 1)).first->second;
      made.outer = whole.outer;
      made.conductor_area = whole.conductor_area;
      made.min_bend_radius = whole.min_bend_radius;
      made.type = XmlFile::text(file_.by_id(XmlFile::text(root, "WireElementSpecification")).child("Type"), "Type");
    }
  }
  if (const auto mass = masses_.find(XmlFile::text(component, "Part")); mass != masses_.end()) made.mass = mass->second;
  const int number = static_cast<int>(found_.wires.size());
  for (Node reference : role.children("WireElementReference")) {
    wires_.emplace(reference.attribute("id").value(), number);
    if (made.stated_length == 0) made.stated_length = stated_length(reference);
  }
  found_.wires.push_back(std::move(made));
}

void VecWires::read_component(Node component) {
  for (Node role : component.children("Role"))
    if (vec_type(role) == "WireRole") return read_wire(component, role);
}

/// Segments that have no place are gone, and named, already.
void VecWires::route(int wire, Node path, std::string_view id) {
  const auto segment = segments_.find(file_.referenced(path, id, "TopologySegment").attribute("id").value());
  if (segment == segments_.end()) return;
  std::vector<int>& through = found_.segments[static_cast<std::size_t>(segment->second)].wires;
  // Another core of the cable, or a wire that runs to and fro, counts once.
  if (!through.empty() && (through.back() == wire || std::find(through.begin(), through.end(), wire) != through.end())) return;
  through.push_back(wire);
  found_.wires[static_cast<std::size_t>(wire)].segments.push_back(segment->second);
}

void VecWires::read_routing(Node routing) {
  const std::string_view element = XmlFile::text(routing, "RoutedElement");
  const auto wire = wires_.find(element);
  if (wire == wires_.end()) {
    if (!file_.by_id(element)) file_.fail(routing, "<Routing>: there is no routed element '" + std::string(element) + "'");
    ++others_;
    return;
  }
  if (!routed_.insert(element).second) {
    ++variants_;
    return;
  }
  const Node path = routing.child("Path");
  for (Node segments : path.children("Segment"))
    for (const std::string_view id : XmlFile::words(segments.text().get())) route(wire->second, path, id);
}

void VecWires::read() {
  for (std::size_t i = 0; i < found_.segments.size(); ++i) segments_.emplace(found_.segments[i].id, static_cast<int>(i));
  each_specification(file_, "GeneralTechnicalPartSpecification", [&](Node specification) { read_masses(specification); });
  each_specification(file_, "CompositionSpecification", [&](Node specification) {
    for (Node component : specification.children("Component")) read_component(component);
  });
  each_specification(file_, "PartUsageSpecification", [&](Node specification) {
    for (Node usage : specification.children("PartUsage")) read_component(usage);
  });
  each_specification(file_, "RoutingSpecification", [&](Node specification) {
    for (Node routing : specification.children("Routing")) read_routing(routing);
  });
  if (variants_ > 0) found_.skipped.push_back(std::to_string(variants_) + " routings are variants: the first of each wire counts");
  if (others_ > 0) found_.skipped.push_back(std::to_string(others_) + " routings are of connections without a wire: they count nowhere");
}

}  // namespace

void read_vec_wires(const XmlFile& file, const VecUnits& units, HarnessFile& found) { VecWires(file, units, found).read(); }

}  // namespace tendril
