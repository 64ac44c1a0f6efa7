#include "harness/read_vec_placements.h"

#include <algorithm>
#include <unordered_map>

#include "harness/vec_specifications.h"

namespace tendril {
namespace {

using Node = XmlFile::Node;

/// Whether a component with such a role holds the harness, as clips, ties, channels and grommets do.
bool holds_harness(std::string_view role) {
  constexpr std::string_view roles[] = {"FixingRole", "CableTieRole", "CableDuctRole", "GrommetRole"};
  return std::find(std::begin(roles), std::end(roles), role) != std::end(roles);
}

class VecPlacements {
 public:
  VecPlacements(const XmlFile& file, const VecUnits& units, HarnessFile& found) : file_(file), units_(units), found_(found) {}
  void read();

 private:
  void read_placement(Node placement);
  void place(Node component, Node location);
  void place_at_node(Node component, Node location);
  void place_on_segment(Node component, Node location);

  const XmlFile& file_;
  const VecUnits& units_;
  HarnessFile& found_;
  std::unordered_map<std::string_view, int> nodes_, segments_;  ///< by id
  int along_ = 0, without_length_ = 0, others_ = 0;
};

/// Nodes and segments that have no place are gone, and named, already.
void VecPlacements::place_at_node(Node component, Node location) {
  const auto node = nodes_.find(file_.referenced(location, XmlFile::text(location, "ReferencedNode"), "TopologyNode").attribute("id").value());
  if (node == nodes_.end()) return;
  found_.nodes[static_cast<std::size_t>(node->second)].components.emplace_back(XmlFile::text(component, "Identification"));
}

void VecPlacements::place_on_segment(Node component, Node location) {
  const auto number =
      segments_.find(file_.referenced(location, XmlFile::text(location, "ReferencedSegment"), "TopologySegment").attribute("id").value());
  if (number == segments_.end()) return;
  HarnessFixing made;
  for (Node role : component.children("Role"))
    if (holds_harness(vec_type(role))) made.kind = vec_type(role);
  if (made.kind.empty()) {
    ++others_;
    return;
  }
  HarnessSegment& segment = found_.segments[static_cast<std::size_t>(number->second)];
  const double offset = units_.value(location.child("Offset"), vec_length);
  if (segment.virtual_length <= 0) {
    ++without_length_;
    return;
  }
  if (offset > segment.virtual_length * (1 + 1e-6)) file_.fail(location, "<Location>: its Offset goes beyond the end of the segment");
  made.id = component.attribute("id").value();
  made.name = XmlFile::text(component, "Identification");
  const double share = std::min(1.0, offset / segment.virtual_length);
  made.location = XmlFile::text(location, "Anchor") == "FromEndNode" ? 1 - share : share;
  segment.fixings.push_back(std::move(made));
}

void VecPlacements::place(Node component, Node location) {
  const std::string_view type = vec_type(location);
  if (type == "NodeLocation") return place_at_node(component, location);
  if (type == "SegmentLocation") return place_on_segment(component, location);
  ++others_;
}

void VecPlacements::read_placement(Node placement) {
  if (vec_type(placement) == "OnWayPlacement") {
    ++along_;
    return;
  }
  if (vec_type(placement) != "OnPointPlacement") {
    ++others_;
    return;
  }
  for (const std::string_view id : XmlFile::words(XmlFile::text(placement, "PlacedElement"))) {
    const Node component = file_.referenced(placement, id, "Role").parent();
    for (Node location : placement.children("Location")) place(component, location);
  }
}

void VecPlacements::read() {
  for (std::size_t i = 0; i < found_.nodes.size(); ++i) nodes_.emplace(found_.nodes[i].id, static_cast<int>(i));
  for (std::size_t i = 0; i < found_.segments.size(); ++i) segments_.emplace(found_.segments[i].id, static_cast<int>(i));
  each_specification(file_, "PlacementSpecification", [&](Node specification) {
    for (Node placement : specification.children("Placement")) read_placement(placement);
  });
  const auto skip = [&](int number, const std::string& what) {
    if (number > 0) found_.skipped.push_back(std::to_string(number) + " " + what);
  };
  skip(along_, "placements along segments, of protections, are not read");
  skip(without_length_, "fixings lie on segments whose length is not stated: they are left out");
  skip(others_, "placements are of other kinds and not read");
}

}  // namespace

void read_vec_placements(const XmlFile& file, const VecUnits& units, HarnessFile& found) { VecPlacements(file, units, found).read(); }

}  // namespace tendril
