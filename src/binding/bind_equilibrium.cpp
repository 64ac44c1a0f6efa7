// equilibrium: what a solve found, and everything measured on it.
#include <cmath>
#include <limits>

#include "binding/bind_export.h"
#include "binding/bind_quantities.h"
#include "binding/bind_gradient.h"
#include "binding/examples.h"
#include "binding/card.h"
#include "binding/clearance_value.h"
#include "binding/scene_cards.h"
#include "binding/shell_services.h"
#include "binding/lua_class.h"
#include "binding/open.h"
#include "binding/number_like.h"
#include "binding/scene_classes.h"

namespace tendril::lua {
namespace {

using Eq = std::shared_ptr<SceneEquilibrium>;
using Where = std::variant<std::string, double>;

std::size_t index_of(const SceneEquilibrium& eq, const std::string& name) {
  return static_cast<std::size_t>(&eq.rod(name) - eq.rods.data());
}

double place_on(const SolvedRod& rod, const Where& where) {
  const std::string* end = std::get_if<std::string>(&where);
  if (!end) return std::get<double>(where);
  if (*end == "start") return 0;
  if (*end == "finish") return rod.problem.rod.length;
  throw UsageError("equilibrium: unknown place '" + *end + "', expected \"start\", \"finish\" or an arc length in m");
}

std::vector<ContactHandle> contacts_of(const SceneEquilibrium& eq, const SolvedRod& rod) {
  std::vector<ContactHandle> all;
  for (const ContactForce& force : rod.equilibrium.contacts) {
    const bool known = force.obstacle >= 0 && force.obstacle < static_cast<int>(eq.obstacles.size());
    all.push_back({force, rod.name, known ? eq.obstacles[force.obstacle].name : std::string()});
  }
  return all;
}

std::vector<Frame> frames_of(const Equilibrium& eq) {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < eq.points.size(); ++i) frames.push_back({eq.points[i], eq.rotations[i]});
  return frames;
}

std::vector<double> tensions_of(const Equilibrium& eq) {
  std::vector<double> tension;
  for (std::size_t i = 0; i < eq.forces.size(); ++i)
    tension.push_back(eq.forces[i].dot((eq.points[i + 1] - eq.points[i]).normalized()));
  return tension;
}

std::vector<double> twists_of(const Equilibrium& eq) {
  std::vector<double> twist;
  for (const Vec3& omega : eq.curvatures) twist.push_back(omega.z());
  return twist;
}

void bind_values(lua_State* L) {
  Class<ClearanceValue> clearance(L, "The smallest gap; computes as a number in m, negative where surfaces penetrate");
  clearance.property("value", "m", "The gap as a plain number", [](const ClearanceValue& c) { return c.clearance.value; })
      .property("s", "m", "Arc length of the place on the rod", [](const ClearanceValue& c) { return c.clearance.s; })
      .property("at", "m", "The place on the rod's centre line", [](const ClearanceValue& c) { return c.clearance.at; })
      .property("point", "m", "The closest point of the obstacle", [](const ClearanceValue& c) { return c.clearance.on; })
      .property("on", "", "Name of the obstacle, nil without one", [](const ClearanceValue& c) {
        return c.obstacle.empty() ? std::nullopt : std::optional<std::string>(c.obstacle);
      })
      .property("required", "m", "The clearance required of that obstacle", [](const ClearanceValue& c) { return c.required; })
      .property("ok", "", "At least the required clearance; where none is required, no penetration beyond that of contact",
                [](const ClearanceValue& c) { return !c.too_close; })
      .tostring(describe_clearance);
  compute_as_number(clearance);

  Class<ErrorValue> error(L, "Estimated discretisation error of the centre line; computes as a number in m");
  error.property("value", "m", "The estimate as a plain number", [](const ErrorValue& e) { return e.estimate.value; })
      .property("valid", "", "False: too coarse to be trusted; see why", [](const ErrorValue& e) { return e.estimate.valid; })
      .property("why", "", "Why it is not valid", [](const ErrorValue& e) { return e.estimate.why; })
      .property("order", "", "Observed order of convergence", [](const ErrorValue& e) { return e.estimate.order; })
      .tostring(describe_error);
  compute_as_number(error);

  Class<Energy>(L, "Energy by term, all rods")
      .property("bend", "J", "Bending", [](const Energy& e) { return e.bend; })
      .property("twist", "J", "Twist", [](const Energy& e) { return e.twist; })
      .property("stretch", "J", "Stretch", [](const Energy& e) { return e.stretch; })
      .property("shear", "J", "Shear", [](const Energy& e) { return e.shear; })
      .property("gravity", "J", "Weight times height above the world origin", [](const Energy& e) { return e.gravity; })
      .property("contact", "J", "Elastic energy of contact", [](const Energy& e) { return e.contact; })
      .property("load", "J", "Potential of the dead loads", [](const Energy& e) { return e.load; })
      .property("total", "J", "Sum of all", [](const Energy& e) { return e.total(); })
      .tostring(describe_energy);

  Class<ContactHandle>(L, "A force that the surroundings exert on a rod")
      .property("rod", "", "Name of the rod", [](const ContactHandle& c) { return c.rod; })
      .property("on", "", "Name of the obstacle", [](const ContactHandle& c) { return c.obstacle; })
      .property("s", "m", "Arc length", [](const ContactHandle& c) { return c.force.s; })
      .property("at", "m", "Place on the centre line", [](const ContactHandle& c) { return c.force.point; })
      .property("force", "N", "On the rod, world axes", [](const ContactHandle& c) { return c.force.force; })
      .property("gap", "m", "Between the surfaces; negative: penetration", [](const ContactHandle& c) { return c.force.gap; })
      .property("length", "m", "Of the rod that it stands for", [](const ContactHandle& c) { return c.force.length; })
      .tostring(describe_contact);
}

void bind_supports(lua_State* L) {
  Class<Reaction>(L, "What a hold or a branch point does to a rod")
      .property("s", "m", "Arc length; of a slide clip: where the rod has settled in it", [](const Reaction& r) { return r.s; })
      .property("force", "N", "On the rod, world axes", [](const Reaction& r) { return r.force; })
      .property("moment", "N m", "On the rod, about its centre line there, world axes", [](const Reaction& r) { return r.moment; })
      .tostring([](const Reaction& r) {
        return "support at s = " + quantity(r.s, "m") + ": " + quantity(r.force.norm(), "N") + ", " + quantity(r.moment.norm(), "N m");
      });
  Class<SolvedBranch>(L, "One branch point in equilibrium")
      .property("name", "", "Its name in the scene", [](const SolvedBranch& b) { return b.name; })
      .property("frame", "", "Where it is", [](const SolvedBranch& b) { return b.frame; })
      .property("force", "N", "Of what holds it, world axes; zero where it is free", [](const SolvedBranch& b) { return b.support.force; })
      .property("moment", "N m", "Of what holds it, about its place, world axes", [](const SolvedBranch& b) { return b.support.moment; })
      .tostring([](const SolvedBranch& b) { return "branch point '" + b.name + "' in equilibrium"; });
}

void bind_solved_rod(lua_State* L) {
  Class<SolvedRodHandle>(L, "One rod in equilibrium")
      .property("name", "", "Its name in the scene", [](const SolvedRodHandle& r) { return r.rod().name; })
      .property("design", "", "What it is", [](const SolvedRodHandle& r) { return r.rod().problem.rod; })
      .property("ok", "", "Solved", [](const SolvedRodHandle& r) { return r.rod().equilibrium.ok(); })
      .property("status", "", "How the solve ended", [](const SolvedRodHandle& r) { return name_of(r.rod().equilibrium.status); })
      .property("arc_lengths", "m", "Of the vertices, unstressed", [](const SolvedRodHandle& r) { return r.rod().equilibrium.s; })
      .property("points", "m", "Vertices of the centre line", [](const SolvedRodHandle& r) { return r.rod().equilibrium.points; })
      .property("frames", "", "Sections at the vertices", [](const SolvedRodHandle& r) { return frames_of(r.rod().equilibrium); })
      .property("bend_radius", "m", "At the vertices", [](const SolvedRodHandle& r) { return r.rod().equilibrium.bend_radii(); })
      .property("min_bend_radius", "m", "The smallest; math.huge when straight",
                [](const SolvedRodHandle& r) { return r.rod().equilibrium.smallest_bend_radius(); })
      .property("tension", "N", "Of each segment; negative: compression", [](const SolvedRodHandle& r) { return tensions_of(r.rod().equilibrium); })
      .property("twist", "rad/m", "Of each segment", [](const SolvedRodHandle& r) { return twists_of(r.rod().equilibrium); })
      .property("max_tension", "N", "The largest; negative: compression everywhere",
                [](const SolvedRodHandle& r) { return r.rod().equilibrium.largest_tension(); })
      .property("max_strain", "", "The largest", [](const SolvedRodHandle& r) { return r.rod().equilibrium.largest_strain(); })
      .property("length", "m", "Of the deformed centre line", [](const SolvedRodHandle& r) { return r.rod().equilibrium.settled_length(); })
      .property("clearance", "m", "Smallest gap to any obstacle",
                [](const SolvedRodHandle& r) { return clearance_value(*r.equilibrium, r.rod(), r.equilibrium->clearance(r.rod())); })
      .property("supports", "", "What its holds, in the order they were given, and branch points do to it",
                [](const SolvedRodHandle& r) { return r.rod().equilibrium.reactions; })
      .property("contact_length", "m", "Of the rod that the surroundings press on", [](const SolvedRodHandle& r) { return r.rod().equilibrium.contact_length(); })
      .property("contacts", "", "Forces of the surroundings on it", [](const SolvedRodHandle& r) { return contacts_of(*r.equilibrium, r.rod()); })
      .method("at", {.takes = {"s"}, .does = "The section's frame at an arc length in m.",
                         .example = with_equilibrium("print(eq:rod(\"hose\"):at(0.5).at)")},
              [](const SolvedRodHandle& r, double s) {
                const double length = r.rod().problem.rod.length;
                if (s < 0 || s > length)
                  throw UsageError("solved_rod:at: s is " + std::to_string(s) + " m, expected 0 to " + std::to_string(length));
                return r.rod().equilibrium.frame_at(s);
              })
      .tostring(describe_solved_rod);
}

}  // namespace

void bind_equilibrium(lua_State* L) {
  bind_values(L);
  bind_supports(L);
  bind_solved_rod(L);
  Class<SceneEquilibrium> equilibrium(L, "A scene in static equilibrium, as it was when it was solved");
  add_save_to(equilibrium);
  add_quantities_to(L, equilibrium);
  equilibrium.property("ok", "", "Every rod is solved", [](const SceneEquilibrium& e) { return e.ok(); })
      .property("status", "", "\"solved\", \"stalled\", \"cancelled\", \"timeout\"", [](const SceneEquilibrium& e) { return name_of(e.status()); })
      .property("message", "", "What there is to say about it", [](const SceneEquilibrium& e) { return e.message(); })
      .property("seconds", "s", "Time to solve, without building trees", [](const SceneEquilibrium& e) { return e.seconds; })
      .property("seconds_for_trees", "s", "Time to build the obstacles' trees, 0 when they stood already",
                [](const SceneEquilibrium& e) { return e.seconds_for_trees; })
      .property("iterations", "", "Newton steps, all rods", [](const SceneEquilibrium& e) { return e.iterations(); })
      .property("convergence", "", "Sizes of the steps of Newton's method (rad, or shares of the length), one an iteration, of the system that took the most",
                [](const SceneEquilibrium& e) { return e.steps(); })
      .property("residual", "N", "Largest unbalanced force, or moment over length", [](const SceneEquilibrium& e) { return e.residual(); })
      .property("stable", "", "No negative eigenvalue", [](const SceneEquilibrium& e) { return e.stable(); })
      .property("modes", "", "Other stable equilibria for the same holds, by growing energy; nil unless solved with modes = true",
                [](const SceneEquilibrium& e) { return e.modes ? std::optional(e.modes->others) : std::nullopt; })
      .property("eigenvalues", "", "Softest first: stiffness against the softest disturbances, a pure number (EI/L^2 times a turn's "
                                   "share of the length); negative: unstable; nil unless solved with modes = true",
                [](const SceneEquilibrium& e) { return e.modes ? std::optional(e.modes->eigenvalues) : std::nullopt; })
      .property("softest_mode", "", "By rod: how far the vertices move (m) along the softest disturbance; nil unless solved with "
                                    "modes = true",
                [](const SceneEquilibrium& e) { return e.modes ? std::optional(e.modes->softest) : std::nullopt; })
      .property("deepest_penetration", "m", "0 without contact", [](const SceneEquilibrium& e) { return e.deepest_penetration(); })
      .property("error", "m", "Estimated discretisation error; nil unless solved with error = true",
                [](const SceneEquilibrium& e) -> std::optional<ErrorValue> {
                  const auto error = e.error();
                  if (!error) return std::nullopt;
                  return ErrorValue{*error};
                })
      .property("energy", "J", "By term", [](const SceneEquilibrium& e) { return e.energy(); })
      .property("rods", "", "Names of the rods", [](const SceneEquilibrium& e) {
        std::vector<std::string> names;
        for (const SolvedRod& rod : e.rods) names.push_back(rod.name);
        return names;
      })
      .property("contacts", "", "Forces of the surroundings on the rods", [](const SceneEquilibrium& e) {
        std::vector<ContactHandle> all;
        for (const SolvedRod& rod : e.rods)
          for (ContactHandle& contact : contacts_of(e, rod)) all.push_back(std::move(contact));
        return all;
      })
      .method("rod", {.takes = {"name"}, .does = "One rod in equilibrium.",
                         .example = with_equilibrium("print(eq:rod(\"hose\").min_bend_radius / units.mm)")},
              [](Eq e, const std::string& name) { return SolvedRodHandle{e, index_of(*e, name)}; })
      .method("branch", {.takes = {"name"}, .does = "One branch point in equilibrium.",
                         .example = with_hose("s:branch(\"end\", {{\"hose\", \"finish\"}})\n"
                                              "print(s:solve{}:branch(\"end\").frame.at)")},
              [](const SceneEquilibrium& e, const std::string& name) { return e.branch(name); })
      .method("force", {.takes = {"name", "where"}, .does = "Force (N, world axes) of the support or branch point on the rod at a hold or joint.",
                         .example = with_equilibrium("print(eq:force(\"hose\", \"start\"))")},
              [](const SceneEquilibrium& e, const std::string& name, const Where& where) {
                const SolvedRod& rod = e.rod(name);
                return e.reaction(rod, place_on(rod, where)).force;
              })
      .method("moment", {.takes = {"name", "where"},
                         .does = "Moment (N m, world axes, about the centre line) of the support or branch point on the rod at a hold or joint.",
                         .example = with_equilibrium("print(eq:moment(\"hose\", \"finish\"))")},
              [](const SceneEquilibrium& e, const std::string& name, const Where& where) {
                const SolvedRod& rod = e.rod(name);
                return e.reaction(rod, place_on(rod, where)).moment;
              })
      .method("clearance", {.options = clearance_options(),
                            .does = "The smallest gap between a rod's surface and an obstacle; computes as a number in m.",
                         .example = with_hose("s:obstacle(\"floor\", scene.plane{}, {pose = frame{at = {0, 0, -1}, along = {0, 0, 1}}})\n"
                                                 "print(s:solve{}:clearance{to = \"floor\"} / units.mm)")},
              [](const SceneEquilibrium& e, const Options& o) { return clearance_between(e, o); })
      .property("parameters", "", "Names of all that eq:gradient can differentiate by", [](const SceneEquilibrium& e) {
        std::vector<std::string> names;
        for (const SceneParameter& p : parameters_of(e)) names.push_back(p.name);
        return names;
      })
      .property("measures", "", "Names of the measures that eq:gradient knows", [](const SceneEquilibrium& e) {
        std::vector<std::string> names;
        for (const SceneMeasure& m : measures_of(e)) names.push_back(m.name);
        return names;
      })
      .method("gradient", {.takes = {"measure", "parameters"},
                           .does = "Exact first derivatives of a measure by parameters, in SI units. The measure: a name (eq.measures), a "
                                   "table {rod =, what =, at =, along =}, or a function of an equilibrium (then by differences). The "
                                   "parameters: names (eq.parameters), or what several begin with: \"hose.to\", \"gravity\".",
                           .example = with_equilibrium("local g = eq:gradient(\"hose.min_bend_radius\", {\"hose.length\", \"hose.to.at\", \"gravity.z\"})\n"
                                                       "print(g, g[\"hose.length\"])")},
              [](lua_State* L, Eq e, const MeasureArgument& measure, const std::vector<std::string>& parameters) {
                return gradient_of(L, e, measure, parameters);
              })
      .operation("__tostring", [](lua_State* state, const SceneEquilibrium& e) -> std::string {
        return describe_equilibrium(e, shell_services(state).unicode);
      });
}

}  // namespace tendril::lua
