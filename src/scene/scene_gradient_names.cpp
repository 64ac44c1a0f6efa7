// What the parameters and measures of a scene are called.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"
#include "scene/scene_gradient.h"

namespace tendril {
namespace {

using Kind = Parameter::Kind;
using What = Measure::What;

constexpr const char* components[] = {".x", ".y", ".z"};

bool inside(double at, const Rod& rod) { return at > 1e-9 * rod.length && at < rod.length * (1 - 1e-9); }

/// "from", "to", "hold.1", "hold.2": the rod's holds in their order.
std::vector<std::string> names_of_holds(const RodProblem& problem) {
  std::vector<std::string> names;
  int number = 0;
  for (const Hold& hold : problem.holds)
    names.push_back(inside(hold.at, problem.rod) ? "hold." + std::to_string(++number)
                    : hold.at < 0.5 * problem.rod.length ? "from" : "to");
  return names;
}

class ParameterList {
 public:
  std::vector<SceneParameter> all;

  void add(int system, const std::string& name, const Parameter& parameter) { all.push_back({name, system, parameter}); }
  void add_vector(int system, const std::string& name, Parameter parameter) {
    for (parameter.component = 0; parameter.component < 3; ++parameter.component)
      add(system, name + components[parameter.component], parameter);
  }

  void add_sections(int system, const std::string& name, int rod, int parts) {
    static const std::pair<const char*, Kind> kinds[] = {
        {"EA", Kind::EA}, {"GA", Kind::GA}, {"GA1", Kind::GA1}, {"GA2", Kind::GA2}, {"EI", Kind::EI}, {"EI1", Kind::EI1},
        {"EI2", Kind::EI2}, {"GJ", Kind::GJ}, {"stiffness", Kind::stiffness}, {"mass", Kind::mass}, {"density", Kind::density},
        {"outer", Kind::outer}, {"inner", Kind::inner}, {"young", Kind::young}};
    for (int part = -1; part < (parts > 1 ? parts : 0); ++part)
      for (const auto& [text, kind] : kinds)
        add(system, name + ".section." + (part < 0 ? "" : std::to_string(part + 1) + ".") + text, {kind, rod, 0, 0, 0, part});
  }

  void add_rod(int system, const std::string& name, const RodProblem& problem, int rod) {
    add(system, name + ".length", {Kind::length, rod});
    add_sections(system, name, rod, static_cast<int>(problem.rod.parts.size()));
    const std::vector<std::string> holds = names_of_holds(problem);
    for (int k = 0; k < static_cast<int>(holds.size()); ++k) {
      const Hold& hold = problem.holds[k];
      const std::string place = name + "." + holds[k];
      if (hold.position) add_vector(system, place + ".at", {Kind::hold_position, rod, k});
      if (hold.orientation) add_vector(system, place + ".turn", {Kind::hold_orientation, rod, k});
      if (inside(hold.at, problem.rod) && !hold.slide) add(system, place + ".place", {Kind::hold_place, rod, k});
    }
    for (int k = 0; k < static_cast<int>(problem.loads.size()); ++k) {
      const std::string load = name + ".load." + std::to_string(k + 1);
      add_vector(system, load + ".force", {Kind::load_force, rod, k});
      add_vector(system, load + ".moment", {Kind::load_moment, rod, k});
      if (inside(problem.loads[k].at, problem.rod)) add(system, load + ".place", {Kind::load_place, rod, k});
    }
  }

  void add_branch(int system, const std::string& name, const SystemProblem& problem, int index) {
    const BranchPoint& branch = problem.branches[index];
    if (branch.position) add_vector(system, name + ".at", {Kind::branch_position, 0, index});
    if (branch.orientation) add_vector(system, name + ".turn", {Kind::branch_orientation, 0, index});
    for (int k = 0; k < static_cast<int>(branch.sections.size()); ++k) {
      const std::string section = name + "." + std::to_string(k + 1);
      add_vector(system, section + ".at", {Kind::joint_position, 0, index, k});
      add_vector(system, section + ".turn", {Kind::joint_orientation, 0, index, k});
      const JoinedSection& joined = branch.sections[k];
      if (inside(joined.at, problem.rods[joined.rod].rod)) add(system, section + ".place", {Kind::joint_place, 0, index, k});
    }
  }
};

class MeasureList {
 public:
  std::vector<SceneMeasure> all;

  void add(int system, const std::string& name, What what, int rod, int index = 0, const Vec3& along = Vec3::UnitZ()) {
    Measure measure;
    measure.what = what;
    measure.rod = rod;
    measure.index = index;
    measure.along = along;
    all.push_back({name, system, measure});
  }
  void add_vector(int system, const std::string& name, What what, int rod, int index) {
    for (int c = 0; c < 3; ++c) add(system, name + components[c], what, rod, index, Vec3::Unit(c));
  }

  void add_rod(int system, const std::string& name, const RodProblem& problem, int rod) {
    static const std::pair<const char*, What> whats[] = {
        {"min_bend_radius", What::min_bend_radius}, {"max_tension", What::max_tension}, {"max_strain", What::max_strain},
        {"length", What::length}, {"energy.bend", What::bend}, {"energy.twist", What::twist_energy},
        {"energy.stretch", What::stretch}, {"energy.shear", What::shear}, {"energy.gravity", What::gravity},
        {"energy.load", What::load}, {"energy.total", What::energy}};
    for (const auto& [text, what] : whats) add(system, name + "." + text, what, rod);
    if (problem.surroundings) add(system, name + ".clearance", What::gap, rod);
    const std::vector<std::string> holds = names_of_holds(problem);
    for (int k = 0; k < static_cast<int>(holds.size()); ++k) {
      const std::string place = name + "." + holds[k];
      if (problem.holds[k].position) add_vector(system, place + ".force", What::reaction_force, rod, k);
      if (problem.holds[k].orientation) add_vector(system, place + ".moment", What::reaction_moment, rod, k);
    }
  }

  void add_branch(int system, const std::string& name, const BranchPoint& branch, int index) {
    add_vector(system, name + ".place", What::branch_position, 0, index);
    if (branch.position) add_vector(system, name + ".force", What::branch_force, 0, index);
    if (branch.orientation) add_vector(system, name + ".moment", What::branch_moment, 0, index);
  }
};

/// Calls on_rod(system, name, index there) and on_branch for all of an equilibrium.
template <class OnRod, class OnBranch>
void for_all(const SceneEquilibrium& eq, OnRod on_rod, OnBranch on_branch) {
  for (int k = 0; k < static_cast<int>(eq.systems.size()); ++k) {
    const SolvedSystem& system = eq.systems[k];
    for (int i = 0; i < static_cast<int>(system.rods.size()); ++i) on_rod(k, eq.rods[system.rods[i]].name, i);
    for (int i = 0; i < static_cast<int>(system.branches.size()); ++i) on_branch(k, eq.branches[system.branches[i]].name, i);
  }
}

template <class T>
std::vector<std::string> names_in(const std::vector<T>& all) {
  std::vector<std::string> names;
  for (const T& entry : all) names.push_back(entry.name);
  return names;
}

/// The tail of a message about an unknown name, without listing hundreds of others.
std::string unknown(const std::string& wanted, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(wanted, names);
  std::string text = "'" + wanted + "'";
  if (!nearest.empty()) return text + "; did you mean '" + nearest + "'?";
  // What the name could go on with, after as much of it as is right.
  std::string known = wanted;
  const auto begins = [&](const std::string& name) { return known.empty() || name.rfind(known + ".", 0) == 0; };
  do {
    const auto dot = known.rfind('.');
    known = dot == std::string::npos ? "" : known.substr(0, dot);
  } while (!known.empty() && std::none_of(names.begin(), names.end(), begins));
  std::vector<std::string> next;
  for (const std::string& name : names) {
    if (!begins(name)) continue;
    const std::size_t from = known.empty() ? 0 : known.size() + 1;
    const std::string part = name.substr(from, name.find('.', from) - from);
    if (std::find(next.begin(), next.end(), part) == next.end()) next.push_back(part);
  }
  text += known.empty() ? " (they begin with:" : " ('" + known + "' goes on with:";
  for (std::size_t i = 0; i < next.size(); ++i) text += (i ? ", " : " ") + next[i];
  return text + ")";
}

/// Diameters and modulus mean nothing for a section with measured stiffnesses: asked for by name, the answer says so; a group
/// leaves them out.
bool belongs_to_group(const SceneEquilibrium& eq, const SceneParameter& p) {
  const Kind kind = p.parameter.kind;
  if (kind != Kind::outer && kind != Kind::inner && kind != Kind::young) return true;
  const std::vector<RodPart>& parts = eq.systems[p.system].problem.rods[p.parameter.rod].rod.parts;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (p.parameter.part >= 0 && p.parameter.part != static_cast<int>(k)) continue;
    if (!is_round(parts[k].section)) return false;
  }
  return true;
}

}  // namespace

std::vector<SceneParameter> parameters_of(const SceneEquilibrium& eq) {
  ParameterList list;
  list.add_vector(-1, "gravity", {Kind::gravity});
  for_all(
      eq, [&](int k, const std::string& name, int i) { list.add_rod(k, name, eq.systems[k].problem.rods[i], i); },
      [&](int k, const std::string& name, int i) { list.add_branch(k, name, eq.systems[k].problem, i); });
  return std::move(list.all);
}

std::vector<SceneMeasure> measures_of(const SceneEquilibrium& eq) {
  MeasureList list;
  for_all(
      eq, [&](int k, const std::string& name, int i) { list.add_rod(k, name, eq.systems[k].problem.rods[i], i); },
      [&](int k, const std::string& name, int i) { list.add_branch(k, name, eq.systems[k].problem.branches[i], i); });
  return std::move(list.all);
}

std::vector<std::string> usual_measures(const SceneEquilibrium& eq) {
  std::vector<std::string> names;
  for (const SolvedRod& rod : eq.rods) {
    for (const char* what : {".min_bend_radius", ".max_tension", ".length"}) names.push_back(rod.name + what);
    if (eq.surroundings && eq.clearance(rod).obstacle >= 0) names.push_back(rod.name + ".clearance");
  }
  return names;
}

std::vector<SceneParameter> named_parameters(const SceneEquilibrium& eq, const std::vector<std::string>& names) {
  const std::vector<SceneParameter> all = parameters_of(eq);
  std::vector<SceneParameter> out;
  for (const std::string& name : names) {
    const std::size_t before = out.size();
    for (const SceneParameter& p : all)
      if (p.name == name || (p.name.rfind(name + ".", 0) == 0 && belongs_to_group(eq, p))) out.push_back(p);
    if (out.size() == before) throw UsageError("equilibrium:gradient: unknown parameter " + unknown(name, names_in(all)));
  }
  return out;
}

SceneMeasure named_measure(const SceneEquilibrium& eq, const std::string& name) {
  const std::vector<SceneMeasure> all = measures_of(eq);
  for (const SceneMeasure& m : all) {
    if (m.name != name) continue;
    return m.measure.what == What::gap ? clearance_measure(eq, name.substr(0, name.rfind('.'))) : m;
  }
  throw UsageError("equilibrium:gradient: unknown measure " + unknown(name, names_in(all)));
}

std::pair<int, int> place_of_rod(const SceneEquilibrium& eq, const std::string& name) {
  const int rod = static_cast<int>(&eq.rod(name) - eq.rods.data());
  for (int k = 0; k < static_cast<int>(eq.systems.size()); ++k)
    for (int i = 0; i < static_cast<int>(eq.systems[k].rods.size()); ++i)
      if (eq.systems[k].rods[i] == rod) return {k, i};
  throw UsageError("equilibrium:gradient: rod '" + name + "' belongs to no solved system");
}

SceneMeasure clearance_measure(const SceneEquilibrium& eq, const std::string& rod, int to) {
  const auto [system, index] = place_of_rod(eq, rod);
  const Clearance gap = eq.clearance(eq.rod(rod), to);
  if (gap.obstacle < 0) throw UsageError("equilibrium:gradient: there is no obstacle near '" + rod + "', so its clearance has no derivatives");
  SceneMeasure out{rod + ".clearance", system, {}};
  out.measure.what = What::gap;
  out.measure.rod = index;
  out.measure.at = gap.s;
  out.measure.origin = gap.on;
  // Away from the surface, which the centre line may have passed.
  const double distance = gap.value + eq.rod(rod).problem.rod.section_at(gap.s).radius();
  out.measure.along = (distance < 0 ? -1 : 1) * (gap.at - gap.on).normalized();
  return out;
}

}  // namespace tendril
