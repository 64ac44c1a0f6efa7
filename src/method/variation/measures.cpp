#include "method/variation/measures.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril::variation {
namespace {

using What = Measure::What;

/// Energies need loads and weights at vertices: a whole equilibrium has them.
bool is_energy(What what) {
  switch (what) {
    case What::bend: case What::twist_energy: case What::stretch: case What::shear: case What::gravity: case What::load:
    case What::energy: return true;
    default: return false;
  }
}

/// Measures at a place, and those of forces and curvatures.
bool needs_stress(What what) {
  switch (what) {
    case What::force: case What::moment: case What::tension: case What::twist: case What::bend_radius: case What::min_bend_radius:
    case What::max_tension: case What::max_strain: return true;
    default: return false;
  }
}

bool at_place(What what) {
  switch (what) {
    case What::position: case What::tangent: case What::force: case What::moment: case What::tension: case What::twist:
    case What::bend_radius: case What::gap: return true;
    default: return false;
  }
}

int segment_at(const Equilibrium& rod, double at) {
  const auto above = std::upper_bound(rod.s.begin(), rod.s.end(), at);
  return std::clamp(static_cast<int>(above - rod.s.begin()) - 1, 0, static_cast<int>(rod.s.size()) - 2);
}

double tension_of(const Equilibrium& rod, int segment) {
  return rod.forces[segment].dot(rod.rotations[segment].slerp(0.5, rod.rotations[segment + 1]) * Vec3::UnitZ());
}

double bend_radius_at(const Equilibrium& rod, double at) {
  const int i = segment_at(rod, at);
  return rod.bend_radii()[at - rod.s[i] > 0.5 * (rod.s[i + 1] - rod.s[i]) ? i + 1 : i];
}

double energy_of(What what, const Energy& e) {
  switch (what) {
    case What::bend: return e.bend;
    case What::twist_energy: return e.twist;
    case What::stretch: return e.stretch;
    case What::shear: return e.shear;
    case What::gravity: return e.gravity;
    case What::load: return e.load;
    default: return e.bend + e.twist + e.stretch + e.shear + e.gravity + e.load;
  }
}

double value_on_rod(const Measure& m, double at, const Rod& design, const Equilibrium& rod) {
  switch (m.what) {
    case What::position: return rod.frame_at(at).at.dot(m.along);
    case What::tangent: return rod.frame_at(at).d3().dot(m.along);
    case What::force: return rod.forces[segment_at(rod, at)].dot(m.along);
    case What::moment: return rod.moments[segment_at(rod, at)].dot(m.along);
    case What::tension: return tension_of(rod, segment_at(rod, at));
    case What::twist: return rod.curvatures[segment_at(rod, at)].z();
    case What::bend_radius: return bend_radius_at(rod, at);
    case What::min_bend_radius: return rod.smallest_bend_radius();
    case What::max_tension: return rod.largest_tension();
    case What::max_strain: return rod.largest_strain();
    case What::length: return rod.settled_length();
    case What::gap: return m.along.dot(rod.frame_at(at).at - m.origin) - design.section_at(at).radius();
    default: return energy_of(m.what, rod.energy);
  }
}

double value_on_branch(const Measure& m, const SystemOutcome& outcome) {
  if (m.what == What::branch_position) {
    const Vec3 at =
        outcome.equilibrium ? outcome.equilibrium->branches[m.index].at : outcome.results->branch(outcome.row, m.index).at;
    return at.dot(m.along);
  }
  BatchResults::Support support;
  if (outcome.equilibrium)
    support = {outcome.equilibrium->branch_supports[m.index].force, outcome.equilibrium->branch_supports[m.index].moment};
  else support = outcome.results->branch_support(outcome.row, m.index);
  return (m.what == What::branch_force ? support.force : support.moment).dot(m.along);
}

}  // namespace

std::string rod_of_contact_length(const std::string& measure) {
  const std::string end = ".contact_length";
  const bool has = measure.size() > end.size() && measure.compare(measure.size() - end.size(), end.size(), end) == 0;
  return has ? measure.substr(0, measure.size() - end.size()) : "";
}

Measures::Measures(const SceneEquilibrium& nominal, const Options& options) : nominal_(nominal) {
  for (const MeasureRequest& request : options.measures) {
    for (const Column& other : columns_)
      if (other.name == request.name) throw UsageError("method.variation: two measures are called '" + request.name + "'");
    add(nominal, request);
  }
  if (!options.measures.empty() || !options.measured) return;
  for (const std::string& name : usual_measures(nominal)) {
    MeasureRequest request;
    request.name = name;
    add(nominal, request);
  }
}

void Measures::add_clearance(const SceneEquilibrium& nominal, const std::string& name, const std::string& rod,
                             const std::string& to) {
  if (!nominal.surroundings) throw UsageError("method.variation: measure '" + name + "': the scene has no obstacles");
  Entry entry;
  entry.kind = Entry::Kind::clearance;
  entry.obstacle = to.empty() ? -1 : nominal.obstacle(to);
  const auto [system, index] = place_of_rod(nominal, rod);
  entry.measure.system = system;
  entry.measure.measure.rod = index;
  entries_.push_back(std::move(entry));
  columns_.push_back({name, "m", 0, -1});
}

void Measures::add_contact_length(const SceneEquilibrium& nominal, const std::string& name, const std::string& rod) {
  Entry entry;
  entry.kind = Entry::Kind::contact_length;
  const auto [system, index] = place_of_rod(nominal, rod);
  entry.measure.system = system;
  entry.measure.measure.rod = index;
  entries_.push_back(std::move(entry));
  columns_.push_back({name, "m", 0, -1});
}

void Measures::add(const SceneEquilibrium& nominal, const MeasureRequest& request) {
  const std::string who = "method.variation: measure '" + request.name + "'";
  if (request.name.empty()) throw UsageError("method.variation: a measure has no name");
  const int ways = static_cast<int>(request.built_in.has_value()) + !request.rod.empty() + static_cast<bool>(request.function);
  if (ways > 1) throw UsageError(who + " is given in more than one way; expected a function, a built-in measure or a clearance");
  if (request.function) {
    Entry entry;
    entry.kind = Entry::Kind::function;
    entry.function = &request.function;
    entries_.push_back(entry);
    columns_.push_back({request.name, request.unit, 0, -1});
    return;
  }
  if (request.contact_length) return add_contact_length(nominal, request.name, request.rod);
  if (!request.rod.empty()) return add_clearance(nominal, request.name, request.rod, request.to);
  Entry entry;
  if (request.built_in) {
    entry.measure = *request.built_in;
  } else {
    if (const std::string rod = rod_of_contact_length(request.name); !rod.empty()) return add_contact_length(nominal, request.name, rod);
    const std::vector<SceneMeasure> all = measures_of(nominal);
    const auto found = std::find_if(all.begin(), all.end(), [&](const SceneMeasure& m) { return m.name == request.name; });
    if (found != all.end() && found->measure.what == What::gap)
      return add_clearance(nominal, request.name, request.name.substr(0, request.name.rfind('.')), "");
    try {
      entry.measure = found != all.end() ? *found : named_measure(nominal, request.name);
    } catch (const UsageError& error) {
      const std::string text = error.what();
      throw UsageError("method.variation: " + text.substr(std::min(text.size(), text.find("unknown"))));
    }
  }
  const Measure& m = entry.measure.measure;
  if (m.what == What::rotation || m.what == What::functional)
    throw UsageError(who + " has derivatives but no value of its own; measure a tangent or a position");
  if (entry.measure.system < 0 || entry.measure.system >= static_cast<int>(nominal.systems.size()))
    throw UsageError(who + " belongs to system " + std::to_string(entry.measure.system) + ", expected one of " +
                     std::to_string(nominal.systems.size()));
  const SystemProblem& problem = nominal.systems[entry.measure.system].problem;
  const bool of_branch = m.what == What::branch_force || m.what == What::branch_moment || m.what == What::branch_position;
  const bool reaction = m.what == What::reaction_force || m.what == What::reaction_moment;
  const auto in = [&](int index, std::size_t size, const char* what) {
    if (index < 0 || index >= static_cast<int>(size))
      throw UsageError(who + ": got " + what + " " + std::to_string(index) + ", expected one of " + std::to_string(size));
  };
  if (of_branch) in(m.index, problem.branches.size(), "branch point");
  else in(m.rod, problem.rods.size(), "rod");
  if (reaction) in(m.index, problem.rods[m.rod].holds.size(), "hold");
  if (at_place(m.what)) {
    const double length = problem.rods[m.rod].rod.length;
    if (!(m.at >= 0 && m.at <= length * (1 + 1e-9)))
      throw UsageError(who + " is at " + number_text(m.at) + " m, expected 0 to " + number_text(length) + " m");
    entry.at_finish = m.at >= length * (1 - 1e-9);
  }
  entries_.push_back(entry);
  columns_.push_back({request.name, unit_of(m.what), 0, -1});
}

bool Measures::has_functions() const {
  return std::any_of(entries_.begin(), entries_.end(), [](const Entry& e) { return e.kind == Entry::Kind::function; });
}

bool Measures::reads(int system) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& e) { return e.kind != Entry::Kind::function && e.measure.system == system; });
}

bool Measures::needs_equilibrium(int system) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return e.kind == Entry::Kind::function ||
           (e.kind == Entry::Kind::built_in && e.measure.system == system && is_energy(e.measure.measure.what));
  });
}

double Measures::clearance(const Entry& entry, const SystemOutcome& outcome) const {
  const int index = entry.measure.measure.rod;
  return nominal_.clearance(outcome.problem->rods[index], outcome.rod(index, false), entry.obstacle).value;
}

void Measures::read(int system, const SystemOutcome& outcome, std::span<double> values) const {
  for (int k = 0; k < count(); ++k) {
    const Entry& entry = entries_[k];
    if (entry.kind == Entry::Kind::function || entry.measure.system != system) continue;
    const Measure& m = entry.measure.measure;
    if (entry.kind == Entry::Kind::clearance) {
      values[k] = clearance(entry, outcome);
      continue;
    }
    if (entry.kind == Entry::Kind::contact_length) {
      // Outcomes of a batch touch nothing.
      values[k] = outcome.equilibrium ? outcome.equilibrium->rods[m.rod].contact_length() : 0;
      continue;
    }
    switch (m.what) {
      case What::branch_position:
      case What::branch_force:
      case What::branch_moment:
        values[k] = value_on_branch(m, outcome);
        break;
      case What::reaction_force: values[k] = outcome.rod(m.rod, false).reactions[m.index].force.dot(m.along); break;
      case What::reaction_moment: values[k] = outcome.rod(m.rod, false).reactions[m.index].moment.dot(m.along); break;
      default: {
        const Rod& design = outcome.problem->rods[m.rod].rod;
        values[k] = value_on_rod(m, entry.at_finish ? design.length : m.at, design, outcome.rod(m.rod, needs_stress(m.what)));
      }
    }
  }
}

void Measures::call(const SceneEquilibrium& outcome, std::span<double> values) const {
  for (int k = 0; k < count(); ++k)
    if (entries_[k].kind == Entry::Kind::function) values[k] = (*entries_[k].function)(outcome);
}

}  // namespace tendril::variation
