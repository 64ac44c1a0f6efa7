// quantities: what a harness is measured by.
#include "binding/bind_quantities.h"

#include "binding/card.h"
#include "binding/examples.h"
#include "binding/quantity_classes.h"

namespace tendril::lua {
namespace {

using WireRods = std::map<std::string, std::vector<std::string>>;

Schema quantity_options() {
  return {
      option<WireRods>("wires", "", "By wire, the names of the rods that it runs through: {W1 = {\"trunk\", \"left\"}}"),
      option<double>("clearance", "", "How much more a metre costs next to obstacles, as weights.clearance in routing").at_least(0).preset(0),
      option<double>("preference", "", "How much more a metre costs next to obstacles with prefer = \"avoid\", and away from those with "
                                       "prefer = \"near\"").at_least(0).preset(0),
      option<double>("range", "m", "Gap from which on neither counts").above(0).preset(0.1),
      option<double>("free_ends", "m", "At the rods' ends, not judged for collision").at_least(0).preset(0),
  };
}

QuantityOptions options_of(const Options& o) {
  QuantityOptions options;
  options.clearance = o.get<double>("clearance");
  options.preference = o.get<double>("preference");
  options.range = o.get<double>("range");
  options.free_ends = o.get<double>("free_ends");
  options.wires = o.maybe<WireRods>("wires").value_or(WireRods());
  return options;
}

std::string describe_quantities(const Quantities& q) {
  Card card("quantities");
  card.row("length", q.total.length, "m", "unstressed " + quantity(q.total.unstressed_length, "m"));
  card.row("mass", q.total.mass, "kg").row("volume", quantity(1e3 * q.total.volume, "dm^3"));
  card.row("clips", std::to_string(q.total.clips)).row("held ends", std::to_string(q.total.held_ends));
  card.row("branch points", std::to_string(q.branches));
  card.row("in collision", q.total.length_in_collision, "m").row("cost", q.total.cost, "m");
  if (!q.wire_lengths.empty())
    card.row("cable", q.cable_length, "m", std::to_string(q.wire_lengths.size()) + " wires");
  std::vector<std::vector<std::string>> rows;
  for (const RodQuantities& r : q.rods)
    rows.push_back({r.rod, quantity(r.length, "m"), quantity(r.mass, "kg"), std::to_string(r.clips), quantity(r.length_in_collision, "m")});
  return card.text() + "\n" + table_text({"rod", "length", "mass", "clips", "in collision"}, rows);
}

template <class T, class Read>
void add_properties(Class<T>& bound, Read rod_of) {
  const auto number = [&](double RodQuantities::*member) { return [=](const T& q) { return rod_of(q).*member; }; };
  bound.property("length", "m", "Of the centre line at rest", number(&RodQuantities::length))
      .property("unstressed_length", "m", "Without load", number(&RodQuantities::unstressed_length))
      .property("volume", "m^3", "Of the space it takes; what is hollow counts as full", number(&RodQuantities::volume))
      .property("mass", "kg", "All of it", number(&RodQuantities::mass))
      .property("length_in_collision", "m", "Where it penetrates an obstacle by more than contact leaves", number(&RodQuantities::length_in_collision))
      .property("cost", "m", "Length, and what its run costs more by clearance and preference", number(&RodQuantities::cost))
      .property("clips", "", "Holds between the ends", [=](const T& q) { return rod_of(q).clips; })
      .property("held_ends", "", "Ends that are held; those at branch points do not count", [=](const T& q) { return rod_of(q).held_ends; });
}

}  // namespace

void add_quantities_to(lua_State* L, Class<SceneEquilibrium>& equilibrium) {
  Class<RodQuantities> rod(L, "What one rod is measured by");
  rod.property("name", "", "Its name in the scene", [](const RodQuantities& q) { return q.rod; });
  add_properties(rod, [](const RodQuantities& q) -> const RodQuantities& { return q; });
  rod.tostring([](const RodQuantities& q) {
    return "rod '" + q.rod + "', " + quantity(q.length, "m") + ", " + quantity(q.mass, "kg") + ", " + std::to_string(q.clips) + " clips";
  });
  Class<Quantities> all(L, "What a harness is measured by, in all and by rod");
  add_properties(all, [](const Quantities& q) -> const RodQuantities& { return q.total; });
  all.property("branches", "", "Number of branch points", [](const Quantities& q) { return q.branches; })
      .property("rods", "", "List by rod", [](const Quantities& q) { return q.rods; })
      .property("wire_lengths", "m", "By wire, at rest", [](const Quantities& q) { return q.wire_lengths; })
      .property("cable_length", "m", "Of all wires", [](const Quantities& q) { return q.cable_length; })
      .tostring(describe_quantities);
  equilibrium.method("quantities",
                     {.options = quantity_options(),
                      .does = "What the harness is measured by: lengths, volume, mass, clips, branch points, length in collision, cost; and "
                              "lengths by wire.",
                      .example = with_hose("local q = s:solve{}:quantities{wires = {W1 = {\"hose\"}, W2 = {\"hose\"}}}\n"
                                           "print(q.clips, q.branches, q.cable_length == 2 * q.length)  --> 0\t0\ttrue")},
                     [](const SceneEquilibrium& e, const Options& o) { return quantities_of(e, options_of(o)); });
}

}  // namespace tendril::lua
