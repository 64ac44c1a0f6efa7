#include "scene/scene_gradient.h"

#include <cmath>

#include "statics/contact_solver.h"
#include "statics/solve.h"

namespace tendril {

/// One system, settled to rounding, with its factorised matrix.
struct SceneSensitivity::System {
  RodNetwork network;
  std::unique_ptr<ContactSolver> contact;
  RodState state;
  Status status = Status::solved;
  std::unique_ptr<Sensitivity> sensitivity;  ///< null: not solved

  System(const SystemProblem& problem, const SolveOptions& options, const std::vector<int>& segments)
      : network(problem, options, segments) {}
};

SceneSensitivity::SceneSensitivity(const SceneEquilibrium& equilibrium)
    : equilibrium_(equilibrium), systems_(equilibrium.systems.size()) {}
SceneSensitivity::~SceneSensitivity() = default;

std::string SceneGradient::unit_of(const std::string& measure, const std::string& parameter) {
  if (measure == parameter) return "1";
  if (parameter.empty()) return measure;
  const bool product = parameter.find_first_of(" /") != std::string::npos;
  return (measure.empty() ? "1" : measure) + "/" + (product ? "(" + parameter + ")" : parameter);
}

SceneSensitivity::System& SceneSensitivity::system(int k, const RunContext& context) {
  std::unique_ptr<System>& made = systems_[k];
  if (made) return *made;
  const SolvedSystem& solved = equilibrium_.systems[k];
  std::vector<int> segments;
  std::vector<std::vector<Frame>> frames;
  bool touches = false, pressed = false;
  for (std::size_t i = 0; i < solved.rods.size(); ++i) {
    const RodProblem& problem = solved.problem.rods[i];
    const Equilibrium& rod = equilibrium_.rods[solved.rods[i]].equilibrium;
    for (const Hold& hold : problem.holds)
      if (hold.slide)
        throw UsageError("equilibrium:gradient: rod '" + equilibrium_.rods[solved.rods[i]].name +
                         "' slides through a clip; sensitivities are for rods held at given places");
    segments.push_back(problem.rod.segments);
    touches = touches || problem.surroundings;
    pressed = pressed || !rod.contacts.empty();
    std::vector<Frame>& own = frames.emplace_back();
    for (std::size_t v = 0; v < rod.points.size(); ++v) own.push_back({rod.points[v], rod.rotations[v]});
  }
  if (pressed && solved.rods.size() > 1)
    throw UsageError("equilibrium:gradient: '" + equilibrium_.rods[solved.rods.front()].name +
                     "' and the rods it is joined to touch obstacles; sensitivities in contact are for rods by themselves");
  std::vector<Frame> branches;
  for (const int b : solved.branches) branches.push_back(equilibrium_.branches[b].frame);
  auto system = std::make_unique<System>(solved.problem, equilibrium_.rods[solved.rods.front()].options, segments);
  for (int i = 0; i < system->network.rods(); ++i)
    if (static_cast<int>(frames[i].size()) != system->network.rod(i).mesh().vertices())
      throw UsageError("equilibrium:gradient: '" + equilibrium_.rods[solved.rods[i]].name + "' was solved on another mesh than it asks for");
  system->state = system->network.state_from(frames, branches);
  SolveOptions options = equilibrium_.rods[solved.rods.front()].options;
  options.tolerance = std::min(options.tolerance, 1e-10);
  if (touches && solved.rods.size() == 1) {
    SystemEquilibrium from;
    from.rods = {equilibrium_.rods[solved.rods.front()].equilibrium};
    system->contact = std::make_unique<ContactSolver>(system->network, options);
    system->status = system->contact->run(system->state, &from, context).newton.status;
  } else {
    NewtonOptions newton;
    newton.tolerance = options.tolerance;
    newton.stable_only = false;
    newton.warm = true;
    system->status = Newton(system->network, nullptr).run(system->state, newton, context).status;
  }
  if (system->status == Status::solved)
    system->sensitivity = std::make_unique<Sensitivity>(system->network, system->state,
                                                        system->contact ? &system->contact->terms() : nullptr);
  made = std::move(system);
  return *made;
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
  System& system = this->system(measure.system, context);
  if (!system.sensitivity || !system.sensitivity->ok()) {
    out.message = system.sensitivity ? "the equilibrium is singular: it does not depend smoothly on its parameters"
                                     : std::string("the equilibrium could not be settled: ") + name_of(system.status);
    return out;
  }
  const std::vector<double> derivatives = system.sensitivity->gradient(measure.measure, own);
  out.value = system.sensitivity->measure(measure.measure).value;
  std::size_t next = 0;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const bool here = parameters[k].system < 0 || parameters[k].system == measure.system;
    out.entries[k].derivative = here ? derivatives[next++] : 0;
  }
  out.ok = true;
  return out;
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
