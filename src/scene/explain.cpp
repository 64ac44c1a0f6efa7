#include "scene/explain.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/number_text.h"
#include "scene/reach.h"

namespace tendril {
namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

bool same_stiffness_both_ways(const Section& section) {
  return section.EI1 == section.EI2 && section.GA1 == section.GA2;
}

void explain_holds(const PlacedRod& rod, std::vector<ExplainedItem>& out) {
  std::string text;
  double turns = 0;
  for (const Hold& hold : rod.holds()) {
    const char* what = hold.slide                          ? "slides through a clip"
                       : hold.position && hold.orientation ? "clamped"
                       : hold.position                     ? "pinned"
                                                           : "turned (orientation only)";
    text += (text.empty() ? "" : ", ") + std::string(what) + " at " + rod.describe(hold.at);
    if (const Attachment* attached = rod.attachment_at(hold.at)) text += " on robot '" + attached->robot + "'";
    if (hold.turns != 0) turns = hold.turns;
  }
  for (const auto& [end, name] : {std::pair{0.0, "start"}, std::pair{rod.rod().length, "finish"}})
    if (!rod.hold_at(end)) text += (text.empty() ? "" : ", ") + std::string(name) + " free";
  if (rod.holds().empty()) text += ": the rod can move freely and cannot be solved";
  out.push_back({rod.name(), "holds", !rod.holds().empty(), text});
  out.push_back({rod.name(), "extra turns", turns != 0,
                 turns != 0 ? number_text(turns) + " full turns about the tangent" : "no hold asks for any"});
}

void explain_design(const Rod& rod, const std::string& name, std::vector<ExplainedItem>& out) {
  out.push_back({name, "elastic energy", true, "bending, twist, stretch and shear"});
  out.push_back({name, "preformed shape", static_cast<bool>(rod.shape),
                 rod.shape ? "reference curvature and torsion from a curve" : "straight without load"});
  out.push_back({name, "varying section", rod.parts.size() > 1,
                 rod.parts.size() > 1 ? counted(rod.parts.size(), "part", "parts") : "one section all along"});
  bool isotropic = true;
  for (const RodPart& part : rod.parts) isotropic = isotropic && same_stiffness_both_ways(part.section);
  out.push_back({name, "unequal stiffness", !isotropic,
                 isotropic ? "the same about d1 and d2" : "bending or shear differ between d1 and d2"});
}

void explain_clearance(const Scene& scene, const PlacedRod& rod, const SolveOptions& options, std::vector<ExplainedItem>& out) {
  double largest = 0;
  for (const PlacedObstacle& obstacle : scene.bodies()) largest = std::max(largest, obstacle.clearance);
  const bool push = options.clearance == ClearanceRule::push;
  out.push_back({rod.name(), "kept clearance", push && largest > 0,
                 largest == 0 ? "no obstacle requires any"
                 : push       ? "contact acts up to " + number_text(1e3 * largest) + " mm off the obstacles, less near holds"
                              : "required clearances are judged, not kept (clearance = \"push\")"});
}

void explain_terms(const Scene& scene, const PlacedRod& rod, std::vector<ExplainedItem>& out) {
  const Vec3& g = scene.gravity();
  const double mass = rod.rod().mass();
  const bool heavy = !g.isZero(0) && mass > 0;
  out.push_back({rod.name(), "gravity", heavy,
                 heavy ? "weight " + number_text(mass * g.norm()) + " N"
                       : g.isZero(0) ? "the scene has no gravity" : "the rod has no mass"});
  out.push_back({rod.name(), "loads", !rod.loads().empty(),
                 rod.loads().empty() ? "none given" : counted(rod.loads().size(), "dead load", "dead loads")});
  std::string far;
  std::size_t near = 0;
  for (const PlacedObstacle& obstacle : scene.bodies())
    if (can_reach(rod, obstacle))
      ++near;
    else
      far += (far.empty() ? "" : ", ") + obstacle.name;
  std::string why = "the scene has no obstacles";
  if (near > 0) why = "with " + counted(near, "obstacle", "obstacles") + ", at the rod's surface, without friction";
  if (near == 0 && !far.empty()) why = "no obstacle is in reach";
  out.push_back({rod.name(), "contact", near > 0, why + (far.empty() ? "" : "; out of reach: " + far)});
}

void explain_method(const PlacedRod& rod, const SolveOptions& options, std::vector<ExplainedItem>& out) {
  const bool se3 = options.element == Element::se3;
  const int n = rod.rod().segments;
  const int unknowns = se3 ? 6 * (n + 1) : 3 * (n + 1) + 3 * n;
  out.push_back({rod.name(), "unknowns", true,
                 std::to_string(unknowns) + " in " + counted(n, "segment", "segments") +
                     ", those of the holds included (" + (se3 ? "position and rotation at every vertex)"
                                                             : "positions at vertices, rotations on segments)")});
  std::string element = se3 ? "se3: frames at vertices, fourth order" : "staggered: second order";
  if (!se3 && options.clamp == ClampRule::thesis) element = "staggered with the thesis's clamp: first order";
  out.push_back({rod.name(), "element", true, element});
  out.push_back({rod.name(), "solver", true, "mixed-stress Newton, block LDL^T along the rod, tolerance " + number_text(options.tolerance)});
  out.push_back({rod.name(), "error estimate", options.error,
                 options.error ? "from a second mesh" : "not asked for (error = true)"});
}

void explain_trees(const Scene& scene, std::vector<ExplainedItem>& out) {
  std::size_t meshes = 0, built = 0, triangles = 0;
  for (const PlacedObstacle& obstacle : scene.bodies()) {
    meshes += obstacle.triangles() > 0;
    built += obstacle.has_tree();
    if (obstacle.has_tree()) triangles += obstacle.triangles();
  }
  std::string why = std::to_string(built) + " of " + std::to_string(meshes) + " built, over " +
                    counted(triangles, "triangle", "triangles");
  if (built == 0) why = "not built yet; the first solve builds those that a rod can reach";
  if (meshes == 0) why = scene.bodies().empty() ? "no obstacles, so none is built" : "only solids, which need none";
  out.push_back({"scene", "distance trees", built > 0, why});
}

void explain_pairs(const Scene& scene, std::vector<ExplainedItem>& out) {
  const std::size_t all = scene.rods().size() * scene.bodies().size();
  std::size_t near = 0;
  for (const auto& rod : scene.rods())
    for (const PlacedObstacle& obstacle : scene.bodies()) near += can_reach(*rod, obstacle);
  out.push_back({"scene", "collision pairs", near > 0,
                 all == 0 ? "no pair of a rod and an obstacle"
                          : std::to_string(near) + " of " + counted(all, "pair", "pairs") + " of a rod and an obstacle; " +
                                std::to_string(all - near) + " out of reach"});
}

void explain_branch(const Scene& scene, const PlacedBranch& branch, std::vector<ExplainedItem>& out) {
  std::string text;
  for (const JoinedPlace& place : branch.places)
    text += (text.empty() ? "" : ", ") + ("'" + place.rod + "' at " + scene.rod(place.rod).describe(place.at));
  const char* held = branch.position && branch.orientation ? "clamped"
                     : branch.position                     ? "pinned"
                     : branch.orientation                  ? "turned (orientation only)"
                                                           : "free: six unknowns";
  out.push_back({branch.name, "branch point", true, "joins " + text + "; " + held});
}

void explain_robot(const Scene& scene, const PlacedRobot& robot, std::vector<ExplainedItem>& out) {
  std::string carried;
  for (const auto& rod : scene.rods())
    for (const Attachment& a : rod->attachments())
      if (a.robot == robot.name)
        carried += (carried.empty() ? "" : ", ") + ("'" + rod->name() + "' at " + rod->describe(a.at) + " on ") + robot.robot->links()[a.link].name;
  out.push_back({robot.name, "robot", true,
                 robot.robot->name() + ", " + counted(robot.robot->size(), "joint", "joints") + "; " +
                     (carried.empty() ? "carries no rod" : "carries " + carried)});
  std::string near;
  std::size_t far = 0;
  const std::vector<PlacedObstacle>& bodies = scene.bodies();
  for (const LinkBody& body : *robot.bodies) {
    const auto placed = std::find_if(bodies.begin(), bodies.end(), [&](const PlacedObstacle& o) { return o.name == body.solid.name; });
    const bool reached = std::any_of(scene.rods().begin(), scene.rods().end(), [&](const auto& rod) { return can_reach(*rod, *placed); });
    if (reached) near += (near.empty() ? "" : ", ") + robot.robot->links()[body.link].name;
    else ++far;
  }
  out.push_back({robot.name, "solid links", !near.empty(),
                 near.empty() ? "no rod can reach any of " + counted(far, "link", "links")
                              : near + (far > 0 ? "; " + std::to_string(far) + " out of reach" : "")});
}

}  // namespace

Explanation explain(const Scene& scene, const SolveOptions& options) {
  Explanation result;
  std::vector<ExplainedItem>& out = result.items;
  const Vec3& g = scene.gravity();
  out.push_back({"scene", "gravity", !g.isZero(0),
                 g.isZero(0) ? "zero" : "{" + number_text(g.x()) + ", " + number_text(g.y()) + ", " + number_text(g.z()) + "} m/s^2"});
  explain_trees(scene, out);
  explain_pairs(scene, out);
  out.push_back({"scene", "contact between rods", false, "rods do not feel each other or themselves"});
  out.push_back({"scene", "picture", false, "the renderer is loaded when a view is saved"});
  for (const auto& rod : scene.rods()) {
    explain_holds(*rod, out);
    explain_design(rod->rod(), rod->name(), out);
    explain_terms(scene, *rod, out);
    explain_clearance(scene, *rod, options, out);
    explain_method(*rod, options, out);
  }
  for (const PlacedRobot& robot : scene.robots()) explain_robot(scene, robot, out);
  for (const auto& branch : scene.branches()) explain_branch(scene, *branch, out);
  return result;
}

bool Explanation::uses(std::string_view name) const {
  bool known = false;
  std::vector<std::string> names;
  for (const ExplainedItem& item : items) {
    known = known || item.name == name;
    if (item.name == name && item.used) return true;
    if (std::find(names.begin(), names.end(), item.name) == names.end()) names.push_back(item.name);
  }
  if (!known) throw UsageError("explanation: unknown item " + unknown_name(name, "items", names));
  return false;
}

std::string Explanation::text() const {
  std::string text, subject;
  for (const ExplainedItem& item : items) {
    if (item.subject != subject) {
      text += (text.empty() ? "" : "\n") + item.subject + "\n";
      subject = item.subject;
    }
    std::string name = item.name;
    name.resize(std::max<std::size_t>(name.size(), 20), ' ');
    text += std::string(item.used ? "  + " : "  - ") + name + "  " + item.why + "\n";
  }
  return text;
}

}  // namespace tendril
