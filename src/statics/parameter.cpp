#include "statics/parameter.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"

namespace tendril {
namespace {

using Kind = Parameter::Kind;

[[noreturn]] void refuse(const std::string& what) { throw UsageError("sensitivity: " + what); }

int checked(int index, std::size_t size, const char* what) {
  if (index < 0 || index >= static_cast<int>(size))
    refuse("got " + std::string(what) + " " + std::to_string(index) + ", expected one of " + std::to_string(size));
  return index;
}

Vec3 axis(const Parameter& p) { return Vec3::Unit(checked(p.component, 3, "component")); }

Vec6 both(const Vec3& a, const Vec3& b) { return (Vec6() << a, b).finished(); }

/// Flexibilities' change per unit of a common relative change of the stiffnesses in `which`.
Vec6 stiffer(const Section& s, std::initializer_list<int> which) {
  const double stiffness[6] = {s.GA1, s.GA2, s.EA, s.EI1, s.EI2, s.GJ};
  Vec6 change = Vec6::Zero();
  for (const int k : which) change[k] = -1 / stiffness[k];
  return change;
}

/// ... per unit of the stiffnesses themselves.
Vec6 stiffer_by_unit(const Section& s, std::initializer_list<int> which) {
  const double stiffness[6] = {s.GA1, s.GA2, s.EA, s.EI1, s.EI2, s.GJ};
  Vec6 change = Vec6::Zero();
  for (const int k : which) change[k] = -1 / (stiffness[k] * stiffness[k]);
  return change;
}

/// A diameter: areas go with the square, second moments with the fourth power.
SegmentChange wider(const Section& s, double diameter, double sign) {
  const double o2 = s.outer * s.outer, i2 = s.inner * s.inner;
  const double area = sign * 2 * diameter / (o2 - i2), moment = sign * 4 * diameter * diameter * diameter / (o2 * o2 - i2 * i2);
  SegmentChange change;
  change.flexibility = area * stiffer(s, {0, 1, 2}) + moment * stiffer(s, {3, 4, 5});
  change.mass = area * s.mass;
  return change;
}

SegmentChange change_of(const Section& s, Kind kind) {
  SegmentChange change;
  switch (kind) {
    case Kind::GA1: change.flexibility = stiffer_by_unit(s, {0}); break;
    case Kind::GA2: change.flexibility = stiffer_by_unit(s, {1}); break;
    case Kind::GA: change.flexibility = stiffer_by_unit(s, {0, 1}); break;
    case Kind::EA: change.flexibility = stiffer_by_unit(s, {2}); break;
    case Kind::EI1: change.flexibility = stiffer_by_unit(s, {3}); break;
    case Kind::EI2: change.flexibility = stiffer_by_unit(s, {4}); break;
    case Kind::EI: change.flexibility = stiffer_by_unit(s, {3, 4}); break;
    case Kind::GJ: change.flexibility = stiffer_by_unit(s, {5}); break;
    case Kind::stiffness: change.flexibility = stiffer(s, {0, 1, 2, 3, 4, 5}); break;
    case Kind::young: change.flexibility = stiffer(s, {0, 1, 2, 3, 4, 5}) / young_of(s, "young"); break;
    case Kind::mass: change.mass = 1; break;
    case Kind::density: change.mass = s.mass; break;
    case Kind::outer:
      young_of(s, "outer");
      change = wider(s, s.outer, 1);
      change.radius = 0.5;
      break;
    case Kind::inner:
      young_of(s, "inner");
      change = wider(s, s.inner, -1);
      break;
    default: break;
  }
  return change;
}

void add_parts(const Parameter& p, const RodSystem& system, ParameterEffect& out) {
  const std::vector<RodPart>& parts = system.problem().rod.parts;
  if (p.part >= 0) checked(p.part, parts.size(), "part");
  for (int k = 0; k < static_cast<int>(parts.size()); ++k)
    if (p.part < 0 || p.part == k) out.parts.push_back({k, change_of(parts[k].section, p.kind)});
}

void add_length(const RodSystem& system, ParameterEffect& out) {
  const RodMesh& mesh = system.mesh();
  const int last = mesh.vertices() - 1;
  const double length = system.length();
  auto fixed = [&](int vertex) {
    auto is = [&](const std::vector<int>& all) { return std::find(all.begin(), all.end(), vertex) != all.end(); };
    return is(mesh.hold_vertex) || is(mesh.load_vertex) || is(mesh.joint_vertex);
  };
  for (const int vertex : break_vertices(system)) {
    const bool between_parts = std::any_of(system.problem().rod.parts.begin(), system.problem().rod.parts.end(), [&](const RodPart& part) {
      return std::abs(part.upto - mesh.s[vertex]) <= 1e-9 * length;
    });
    if (vertex == last)
      out.places.push_back({vertex, 1});
    else if (between_parts && !fixed(vertex))
      out.places.push_back({vertex, mesh.s[vertex] / length});
  }
}

void add_place(int vertex, const RodSystem& system, const char* what, ParameterEffect& out) {
  if (vertex == 0 || vertex == system.mesh().vertices() - 1)
    refuse(std::string("the place of a ") + what + " at an end of its rod does not move; ask for one inside the rod, or for the length");
  out.places.push_back({vertex, 1});
  out.shape_stays = true;
}

/// The prescribed motion of the target with this number.
void add_motion(const Parameter& p, const RodNetwork& network, int target, ParameterEffect& out) {
  const RodSystem::Target& held = network.targets()[target];
  const bool turns = p.kind == Kind::hold_orientation || p.kind == Kind::branch_orientation;
  const Vec3 a = axis(p);
  if (turns && (held.mask & held_rotation))
    out.motions.push_back({held.node, both(Vec3::Zero(), held.frame.rotation.conjugate() * a)});
  if (!turns && (held.mask & held_position)) out.motions.push_back({held.node, both(a, Vec3::Zero())});
}

int target_of_hold(const Parameter& p, const RodNetwork& network) {
  int target = 0;
  for (int k = 0; k < p.rod; ++k) target += static_cast<int>(network.rod(k).targets().size());
  return target + checked(p.index, network.rod(p.rod).problem().holds.size(), "hold");
}

void add_branch(const Parameter& p, const RodNetwork& network, ParameterEffect& out) {
  const auto& branches = network.problem().branches;
  const int node = network.branch_node(checked(p.index, branches.size(), "branch point"));
  for (std::size_t k = 0; k < network.targets().size(); ++k)
    if (network.targets()[k].node == node) add_motion(p, network, static_cast<int>(k), out);
}

void add_joint(const Parameter& p, const RodNetwork& network, ParameterEffect& out) {
  const auto& branches = network.problem().branches;
  const auto& sections = branches[checked(p.index, branches.size(), "branch point")].sections;
  const JoinedSection& section = sections[checked(p.section, sections.size(), "section")];
  int before = 0;  // joined places of the same rod
  for (int b = 0; b <= p.index; ++b)
    for (int k = 0; k < (b < p.index ? static_cast<int>(branches[b].sections.size()) : p.section); ++k)
      before += branches[b].sections[k].rod == section.rod;
  const RodSystem& system = network.rod(section.rod);
  const int vertex = system.mesh().joint_vertex[before];
  if (p.kind == Kind::joint_place) {
    out.rod = section.rod;
    add_place(vertex, system, "joined section", out);
    return;
  }
  const Vec3 a = axis(p), none = Vec3::Zero();
  out.joints.push_back({network.first_node(section.rod) + system.section_at(vertex).position, network.branch_node(p.index),
                        section.relative, p.kind == Kind::joint_position ? both(a, none) : both(none, a)});
}

}  // namespace

bool is_round(const Section& s) {
  const double o2 = s.outer * s.outer, i2 = s.inner * s.inner;
  const double bend = s.EA * (o2 + i2) / 16;
  return std::abs(s.EI1 - bend) <= 1e-6 * bend && std::abs(s.EI2 - bend) <= 1e-6 * bend;
}

double young_of(const Section& s, const char* wanted) {
  if (!is_round(s))
    refuse(std::string(wanted) + " belongs to a round section of one material; this one's stiffnesses are given by "
           "themselves, ask for EA, EI, GJ or the common factor");
  return s.EA / (units::pi / 4 * (s.outer * s.outer - s.inner * s.inner));
}

const char* unit_of(Kind kind) {
  switch (kind) {
    case Kind::EA: case Kind::GA1: case Kind::GA2: case Kind::GA: case Kind::load_force: return "N";
    case Kind::EI1: case Kind::EI2: case Kind::EI: case Kind::GJ: return "N m^2";
    case Kind::load_moment: return "N m";
    case Kind::stiffness: case Kind::density: return "";
    case Kind::mass: return "kg/m";
    case Kind::young: return "Pa";
    case Kind::gravity: return "m/s^2";
    case Kind::hold_orientation: case Kind::branch_orientation: case Kind::joint_orientation: return "rad";
    default: return "m";
  }
}

ParameterEffect effect_of(const Parameter& p, const RodNetwork& network) {
  ParameterEffect out;
  const bool of_network = p.kind == Kind::gravity || p.kind == Kind::branch_position || p.kind == Kind::branch_orientation ||
                          p.kind == Kind::joint_position || p.kind == Kind::joint_orientation || p.kind == Kind::joint_place;
  if (of_network) {
    if (p.kind == Kind::gravity) out.gravity = axis(p);
    else if (p.kind == Kind::branch_position || p.kind == Kind::branch_orientation) add_branch(p, network, out);
    else add_joint(p, network, out);
    return out;
  }
  const RodSystem& system = network.rod(checked(p.rod, network.rods(), "rod"));
  const RodProblem& problem = system.problem();
  const int first = network.first_node(p.rod);
  auto load_node = [&] { return first + system.mesh().load_vertex[checked(p.index, problem.loads.size(), "load")]; };
  out.rod = p.rod;
  switch (p.kind) {
    case Kind::length: add_length(system, out); break;
    case Kind::hold_position: case Kind::hold_orientation: add_motion(p, network, target_of_hold(p, network), out); break;
    case Kind::hold_place:
      add_place(system.mesh().hold_vertex[checked(p.index, problem.holds.size(), "hold")], system, "hold", out);
      break;
    case Kind::load_force: out.loads.push_back({load_node(), both(axis(p), Vec3::Zero())}); break;
    case Kind::load_moment: out.loads.push_back({load_node(), both(Vec3::Zero(), axis(p))}); break;
    case Kind::load_place: add_place(load_node() - first, system, "load", out); break;
    default: add_parts(p, system, out);
  }
  return out;
}

std::vector<int> break_vertices(const RodSystem& system) {
  const RodMesh& mesh = system.mesh();
  const Rod& rod = system.problem().rod;
  std::vector<int> vertices = {0, mesh.vertices() - 1};
  for (const auto* more : {&mesh.hold_vertex, &mesh.load_vertex, &mesh.joint_vertex})
    vertices.insert(vertices.end(), more->begin(), more->end());
  auto add_place_at = [&](double place) {
    const auto at = std::lower_bound(mesh.s.begin(), mesh.s.end(), place - 1e-9 * rod.length);
    if (at != mesh.s.end() && std::abs(*at - place) <= 1e-9 * rod.length)
      vertices.push_back(static_cast<int>(at - mesh.s.begin()));
  };
  for (const RodPart& part : rod.parts) add_place_at(part.upto);
  for (const double place : rod.shape_breaks) add_place_at(place);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<int> segment_parts(const RodSystem& system) {
  const std::vector<RodPart>& parts = system.problem().rod.parts;
  std::vector<int> of;
  of.reserve(system.mesh().segments.size());
  std::size_t part = 0;
  for (const MeshSegment& segment : system.mesh().segments) {
    while (part + 1 < parts.size() && segment.start + 0.5 * segment.length > parts[part].upto) ++part;
    of.push_back(static_cast<int>(part));
  }
  return of;
}

}  // namespace tendril
