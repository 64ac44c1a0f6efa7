#include "scene/scene_gradient.h"

#include <cmath>

#include "statics/solve.h"

namespace tendril {

SceneSensitivity::SceneSensitivity(const SceneEquilibrium& equilibrium)
    : equilibrium_(equilibrium), systems_(equilibrium.systems.size()) {}

std::string SceneGradient::unit_of(const std::string& measure, const std::string& parameter) {
  if (measure == parameter) return "1";
  if (parameter.empty()) return measure;
  const bool product = parameter.find_first_of(" /") != std::string::npos;
  return (measure.empty() ? "1" : measure) + "/" + (product ? "(" + parameter + ")" : parameter);
}

SystemSensitivity& SceneSensitivity::system(int k, const RunContext& context) {
  if (!systems_[k]) systems_[k] = std::make_unique<SystemSensitivity>(equilibrium_, k, context);
  return *systems_[k];
}

SceneGradient SceneSensitivity::gradient(const SceneMeasure& measure, const std::vector<SceneParameter>& parameters,
                                         const RunContext& context) {
  SceneGradient out;
  out.measure = measure.name;
  out.unit = tendril::unit_of(measure.measure.what);
  std::vector<Parameter> own;
  for (const SceneParameter& p : parameters) {
    out.entries.push_back({p.name, tendril::unit_of(p.parameter.kind), std::nan("")});
    if (p.system < 0 || p.system == measure.system) own.push_back(p.parameter);
  }
  if (!equilibrium_.ok()) {
    out.message = "the equilibrium is not solved: " + equilibrium_.message();
    return out;
  }
  const SystemSensitivity& system = this->system(measure.system, context);
  if (!system.why_not().empty()) {
    out.message = system.why_not();
    return out;
  }
  const auto [value, derivatives] = system.gradient(measure.measure, own);
  out.value = value;
  std::size_t next = 0;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const bool here = parameters[k].system < 0 || parameters[k].system == measure.system;
    out.entries[k].derivative = here ? derivatives[next++] : 0;
  }
  out.ok = true;
  return out;
}

std::vector<std::vector<Vec3>> SceneSensitivity::motion(const SceneParameter& parameter, const RunContext& context) {
  std::vector<std::vector<Vec3>> moves;
  for (const SolvedRod& rod : equilibrium_.rods) moves.emplace_back(rod.equilibrium.points.size(), Vec3::Zero());
  for (int k = 0; k < static_cast<int>(equilibrium_.systems.size()); ++k) {
    if (parameter.system >= 0 && parameter.system != k) continue;
    const std::vector<int>& rods = equilibrium_.systems[k].rods;
    const SystemSensitivity& own = system(k, context);
    std::vector<Vec6> motion;
    if (own.why_not().empty()) motion = own.motion(parameter.parameter);
    for (int i = 0; i < static_cast<int>(rods.size()); ++i) {
      std::vector<Vec3>& rod = moves[rods[i]];
      for (std::size_t v = 0; v < rod.size(); ++v)
        rod[v] = motion.empty() ? Vec3(Vec3::Constant(std::nan(""))) : Vec3(motion[own.network().first_node(i) + v].head<3>());
    }
  }
  return moves;
}

SceneEquilibrium SceneSensitivity::solved_after(const SceneParameter& parameter, double by, const RunContext& context) const {
  SceneEquilibrium out = equilibrium_;
  out.rods = equilibrium_.rods;
  for (int k = 0; k < static_cast<int>(out.systems.size()); ++k) {
    if (parameter.system >= 0 && parameter.system != k) continue;
    SolvedSystem& system = out.systems[k];
    system.problem = changed(system.problem, parameter.parameter, by);
    for (std::size_t i = 0; i < system.rods.size(); ++i) out.rods[system.rods[i]].problem = system.problem.rods[i];
    SolveOptions options = out.rods[system.rods.front()].options;
    options.error = false;
    options.tolerance = std::min(options.tolerance, 1e-11);
    const std::optional<SystemEquilibrium> from = equilibrium_.part(equilibrium_, system.rods, system.branches);
    out.take(solve(system.problem, options, context, from ? &*from : nullptr), system.rods, system.branches);
  }
  return out;
}

SceneGradient SceneSensitivity::gradient(const std::function<double(const SceneEquilibrium&)>& measure,
                                         const std::vector<SceneParameter>& parameters, const RunContext& context) const {
  SceneGradient out;
  out.measure = "function";
  out.ok = equilibrium_.ok();
  if (!out.ok) out.message = "the equilibrium is not solved: " + equilibrium_.message();
  out.value = measure(equilibrium_);
  for (const SceneParameter& p : parameters) {
    SceneGradient::Entry& entry = out.entries.emplace_back();
    entry = {p.name, tendril::unit_of(p.parameter.kind), std::nan("")};
    if (!out.ok) continue;
    const double step = small_step(equilibrium_.systems[std::max(p.system, 0)].problem, p.parameter);
    const SceneEquilibrium more = solved_after(p, step, context), less = solved_after(p, -step, context);
    if (more.ok() && less.ok()) {
      entry.derivative = (measure(more) - measure(less)) / (2 * step);
      continue;
    }
    out.ok = false;
    out.message = "no equilibrium beside this one in the direction of " + p.name + ": " +
                  (more.ok() ? less.message() : more.message());
  }
  return out;
}

}  // namespace tendril
