#include "binding/scene_cards.h"

#include <algorithm>
#include <cmath>

#include "binding/card.h"

namespace tendril::lua {
namespace {

std::string place(const Vec3& v) {
  return "{" + plain_number(v.x()) + ", " + plain_number(v.y()) + ", " + plain_number(v.z()) + "} m";
}

std::string pair(double first, double second, const char* unit) {
  return first == second ? quantity(first, unit) : "{" + quantity(first, unit) + ", " + quantity(second, unit) + "}";
}

std::string count(std::size_t number, const char* one, const char* many) {
  return std::to_string(number) + " " + (number == 1 ? one : many);
}

/// The smallest gap, and those to other obstacles that require one.
void add_clearances(Card& card, const SceneEquilibrium& eq, const SolvedRod& rod, const std::string& prefix) {
  constexpr std::size_t most = 6;  // obstacles with rows of their own
  const std::vector<SceneEquilibrium::JudgedGap> gaps = eq.judged_gaps(rod);
  if (gaps.empty()) card.row(prefix + "min clearance", "none near");
  for (std::size_t i = 0; i < std::min(most, gaps.size()); ++i) {
    const auto& [gap, required, too_close] = gaps[i];
    const std::string& name = eq.obstacles[gap.obstacle].name;
    std::string note = (i == 0 ? "to '" + name + "' " : "") + "at s = " + quantity(gap.s, "m");
    if (required > 0) note += (too_close ? ", LESS than the required " : ", required ") + quantity(required, "m");
    card.row(prefix + (i == 0 ? "min clearance" : "clearance to '" + name + "'"), gap.value, "m", note);
  }
}

void add_rod_rows(Card& card, const SceneEquilibrium& eq, const SolvedRod& rod, const std::string& prefix) {
  const Equilibrium& e = rod.equilibrium;
  card.row(prefix + "length", e.settled_length(), "m", "unstressed " + quantity(rod.problem.rod.length, "m"));
  card.row(prefix + "min bend radius", e.smallest_bend_radius(), "m");
  card.row(prefix + "max tension", e.largest_tension(), "N");
  card.row(prefix + "max strain", quantity(100 * e.largest_strain(), "%"));
  if (!eq.obstacles.empty()) add_clearances(card, eq, rod, prefix);
}

std::string status_of(const SceneEquilibrium& eq) {
  if (!eq.ok()) return name_of(eq.status());
  return eq.stable() ? "solved, stable" : "solved, not stable";
}

}  // namespace

std::string describe_section(const Section& s) {
  Card card("section");
  card.row("outer", s.outer, "m").row("inner", s.inner, "m").row("EA", s.EA, "N");
  card.row("GA", pair(s.GA1, s.GA2, "N")).row("EI", pair(s.EI1, s.EI2, "N m^2")).row("GJ", s.GJ, "N m^2");
  return card.row("mass", s.mass, "kg/m").text();
}

std::string describe_rod(const Rod& r) {
  Card card("rod");
  card.row("length", r.length, "m").row("segments", std::to_string(r.segments)).row("mass", r.mass(), "kg");
  card.row("shape", r.shape ? "preformed" : "straight");
  for (const RodPart& part : r.parts) {
    const Section& s = part.section;
    card.row(r.parts.size() == 1 ? "section" : "section to " + quantity(part.upto, "m"),
             quantity(s.outer, "m") + (s.inner > 0 ? " x " + quantity(s.inner, "m") : ""),
             "EI " + pair(s.EI1, s.EI2, "N m^2") + ", EA " + quantity(s.EA, "N"));
  }
  return card.text();
}

std::string describe_placed(const PlacedRod& rod) {
  Card card("placed rod '" + rod.name() + "'");
  card.row("length", rod.rod().length, "m");
  for (const Hold& hold : rod.holds()) {
    const char* what = hold.slide                          ? "slides through"
                       : hold.position && hold.orientation ? "clamped"
                       : hold.position                     ? "pinned"
                                                           : "orientation held";
    std::string note = "at " + place(hold.frame.at);
    if (hold.turns != 0) note += ", " + plain_number(hold.turns) + " extra turns";
    if (const Attachment* attached = rod.attachment_at(hold.at)) note += ", on robot '" + attached->robot + "'";
    card.row(rod.describe(hold.at), what, note);
  }
  for (const PointLoad& load : rod.loads()) card.row("load at " + rod.describe(load.at), load.force.norm(), "N");
  return card.text();
}

std::string describe_scene(const Scene& scene) {
  Card card("scene");
  card.row("gravity", scene.gravity().isZero(0) ? "none" : quantity(scene.gravity().norm(), "m/s^2"));
  for (const auto& rod : scene.rods())
    card.row("rod '" + rod->name() + "'", quantity(rod->rod().length, "m"),
             count(rod->holds().size(), "hold", "holds") + ", " + count(rod->loads().size(), "load", "loads"));
  for (const auto& branch : scene.branches())
    card.row("branch point '" + branch->name + "'", count(branch->places.size(), "section", "sections"),
             branch->position || branch->orientation ? "held" : "free");
  for (const PlacedRobot& robot : scene.robots())
    card.row("robot '" + robot.name + "'", robot.robot->name(), count(robot.bodies->size(), "solid link", "solid links"));
  for (const PlacedObstacle& obstacle : scene.obstacles()) {
    const std::size_t triangles = obstacle.triangles();
    card.row("obstacle '" + obstacle.name + "'", triangles ? count(triangles, "triangle", "triangles") : "solid",
             obstacle.clearance > 0 ? "clearance " + quantity(obstacle.clearance, "m") : "");
  }
  return card.text();
}

std::string describe_equilibrium(const SceneEquilibrium& eq, bool unicode) {
  Card card("equilibrium");
  card.row("status", status_of(eq), eq.ok() ? "" : eq.message());
  card.row("time", eq.seconds, "s", count(eq.iterations(), "iteration", "iterations"));
  if (eq.seconds_for_trees > 1e-3) card.row("time for distance trees", eq.seconds_for_trees, "s", "once");
  card.row("residual", eq.residual(), "N");
  if (const std::vector<double> steps = eq.steps(); steps.size() > 1)
    card.row("convergence", sparkline(steps, unicode), "steps of Newton's method, " + plain_number(steps.front()) + " to " + plain_number(steps.back()));
  if (const auto error = eq.error())
    card.row("estimated error", error->valid ? quantity(error->value, "m") : "not valid", error->valid ? "" : error->why);
  const Energy energy = eq.energy();
  const std::pair<const char*, double> terms[] = {
      {"bend", energy.bend}, {"twist", energy.twist}, {"stretch", energy.stretch}, {"shear", energy.shear},
      {"gravity", energy.gravity}, {"contact", energy.contact}, {"load", energy.load}, {"spring", energy.spring}};
  for (const auto& [name, value] : terms)
    if (value != 0) card.row(std::string("energy: ") + name, value, "J");
  card.row("energy: total", energy.total(), "J");
  constexpr std::size_t most = 8;  // rods with rows of their own
  for (std::size_t i = 0; i < std::min(most, eq.rods.size()); ++i)
    add_rod_rows(card, eq, eq.rods[i], eq.rods.size() == 1 ? "" : eq.rods[i].name + ": ");
  if (eq.rods.size() > most) card.row("...", count(eq.rods.size() - most, "more rod", "more rods"));
  if (eq.deepest_penetration() > 0) card.row("deepest penetration", eq.deepest_penetration(), "m");
  return card.text();
}

std::string describe_solved_rod(const SolvedRodHandle& handle) {
  const SolvedRod& rod = handle.rod();
  Card card("rod '" + rod.name + "' in equilibrium");
  card.row("status", name_of(rod.equilibrium.status), rod.equilibrium.ok() ? "" : rod.equilibrium.message);
  add_rod_rows(card, *handle.equilibrium, rod, "");
  return card.text();
}

std::string describe_energy(const Energy& e) {
  Card card("energy");
  card.row("bend", e.bend, "J").row("twist", e.twist, "J").row("stretch", e.stretch, "J").row("shear", e.shear, "J");
  card.row("gravity", e.gravity, "J").row("contact", e.contact, "J").row("load", e.load, "J");
  return card.row("total", e.total(), "J").text();
}

std::string describe_clearance(const ClearanceValue& c) {
  if (c.obstacle.empty()) return "no obstacle near";
  std::string text = quantity(c.clearance.value, "m") + " to '" + c.obstacle + "' at s = " + quantity(c.clearance.s, "m") +
                     ", " + place(c.clearance.at);
  if (c.required > 0) text += " (required " + quantity(c.required, "m") + ")";
  return text;
}

std::string describe_error(const ErrorValue& e) {
  return quantity(e.estimate.value, "m") + (e.estimate.valid ? "" : " (not valid: " + e.estimate.why + ")");
}

std::string describe_contact(const ContactHandle& c) {
  return "contact of '" + c.rod + "' with '" + c.obstacle + "' at s = " + quantity(c.force.s, "m") + ": " +
         quantity(c.force.force.norm(), "N") + ", gap " + quantity(c.force.gap, "m");
}

}  // namespace tendril::lua
