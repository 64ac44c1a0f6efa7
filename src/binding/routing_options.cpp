#include "binding/routing_options.h"

#include <algorithm>

#include "base/units.h"
#include "binding/scene_classes.h"

namespace tendril::lua {
namespace {

using OneOrMany = std::variant<double, std::vector<double>>;
using BoxOfCorners = std::array<Vec3, 2>;

Eigen::AlignedBox3d box_of(const BoxOfCorners& corners) {
  return {corners[0].cwiseMin(corners[1]), corners[0].cwiseMax(corners[1])};
}

}  // namespace

Schema surroundings_schema() {
  return {
      option<double>("clearance", "m", "Least gap to every obstacle; an obstacle's own larger one stands").at_least(0).preset(0),
      option<double>("free_ends", "m", "Length at both ends within which no gap is asked for: the object must reach what it is plugged to")
          .at_least(0).preset(0),
      option<BoxOfCorners>("keep_in", "m", "{corner, corner}: the whole object stays within this box"),
      option<std::vector<BoxOfCorners>>("keep_out", "m", "List of {corner, corner}: no part of it gets into these boxes"),
      option<double>("preference", "", "How much more a metre costs next to obstacles with prefer = \"avoid\", and away from those "
                                       "with prefer = \"near\"; 0: the shortest").at_least(0).preset(0),
      option<double>("preference_range", "m", "Gap from which on a preference counts no more").above(0).preset(0.1),
  };
}

void read_surroundings(const Options& o, routing::SpaceDemands& demands) {
  demands.clearance = o.get<double>("clearance");
  demands.preference = o.get<double>("preference");
  demands.preference_range = o.get<double>("preference_range");
  if (const auto box = o.maybe<BoxOfCorners>("keep_in")) demands.keep_in = box_of(*box);
  if (const auto boxes = o.maybe<std::vector<BoxOfCorners>>("keep_out"))
    for (const BoxOfCorners& corners : *boxes) demands.keep_out.push_back(box_of(corners));
}

CostWeights cost_weights(const Options& o, const std::map<std::string, double>& given) {
  CostWeights weights;
  for (const auto& [name, value] : given) {
    if (name == "length") weights.length = value;
    else if (name == "clearance") weights.clearance = value;
    else throw UsageError(o.who() + ": 'weights': unknown name '" + name + "', expected 'length' and 'clearance'");
  }
  return weights;
}

Schema routing_schema() {
  return Schema{
      option<Frame>("from", "", "Where the object begins, and its direction there").required(),
      option<Frame>("to", "", "Where it ends, and its direction there: on, not back").required(),
      option<double>("outer", "m", "Outer diameter; that of the section when one is given").above(0),
      option<Section>("section", "", "Cross-section: what the object is made of, for its rod and its equilibrium"),
      option<OneOrMany>("min_bend_radius", "m", "Of the centre line: one value for every bend, or a list of the bending tools' radii").required(),
      option<double>("min_straight", "m", "Least straight between two bends").at_least(0).preset(0),
      option<double>("end_straight", "m", "Least straight at both ends; default: min_straight").at_least(0),
  } + surroundings_schema();
}

routing::Ends routing_ends(const Options& o) {
  const Frame from = o.get<Frame>("from"), to = o.get<Frame>("to");
  return {from.at, from.d3(), to.at, to.d3()};
}

std::optional<Section> routed_section(const Options& o) {
  const Section* section = o.find<Section>("section");
  return section ? std::optional<Section>(*section) : std::nullopt;
}

routing::SpaceDemands space_demands(const Options& o) {
  routing::SpaceDemands demands;
  const std::optional<Section> section = routed_section(o);
  if (!section && !o.has("outer")) throw UsageError(o.who() + ": 'outer' is missing (or 'section', which has one)");
  if (section && o.has("outer") && std::abs(o.get<double>("outer") - section->outer) > 1e-9 * section->outer)
    throw UsageError(o.who() + ": 'outer' and the section's outer diameter differ; leave 'outer' out");
  demands.radius = 0.5 * (section ? section->outer : o.get<double>("outer"));
  read_surroundings(o, demands);
  return demands;
}

routing::PccDemands pcc_demands(const Options& o) {
  routing::PccDemands demands;
  const OneOrMany radius = o.get<OneOrMany>("min_bend_radius");
  if (const double* one = std::get_if<double>(&radius)) demands.radii = {*one};
  else demands.radii = std::get<std::vector<double>>(radius);
  if (demands.radii.empty()) throw UsageError(o.who() + ": 'min_bend_radius' is an empty list, expected at least one radius");
  std::sort(demands.radii.begin(), demands.radii.end());
  demands.radii.erase(std::unique(demands.radii.begin(), demands.radii.end()), demands.radii.end());
  demands.min_straight = o.get<double>("min_straight");
  demands.end_straight = o.maybe<double>("end_straight").value_or(demands.min_straight);
  demands.free_ends = o.get<double>("free_ends");
  return demands;
}

}  // namespace tendril::lua
