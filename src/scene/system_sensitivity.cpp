#include "scene/system_sensitivity.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "base/error.h"

namespace tendril {
namespace {

constexpr double difference = 1e-4;  // of a clip's way to the nearest stop
constexpr std::array<double, 4> places = {-2, -1, 1, 2};

/// How far a place may move along its rod before it meets an end, another hold or a load.
double way_to_next_stop(const RodProblem& rod, double at) {
  double way = std::min(at, rod.rod.length - at);
  const auto take = [&](double stop) {
    if (stop != at) way = std::min(way, std::abs(stop - at));
  };
  for (const Hold& hold : rod.holds) take(hold.at);
  for (const PointLoad& load : rod.loads) take(load.at);
  for (const RodPart& part : rod.rod.parts) take(part.upto);
  return way;
}

}  // namespace

SystemSensitivity::SystemSensitivity(const SceneEquilibrium& equilibrium, int k, const RunContext& context) {
  read(equilibrium, k);
  middle_ = settle(problem_, context);
  if (!middle_->sensitivity)
    why_not_ = std::string("the equilibrium could not be settled: ") + name_of(middle_->status);
  else if (!middle_->sensitivity->ok())
    why_not_ = "the equilibrium is singular: it does not depend smoothly on its parameters";
  if (why_not_.empty() && !clips_.empty()) shift_clips(context);
}

void SystemSensitivity::read(const SceneEquilibrium& equilibrium, int k) {
  const SolvedSystem& solved = equilibrium.systems[k];
  problem_ = solved.problem;
  options_ = equilibrium.rods[solved.rods.front()].options;
  options_.tolerance = std::min(options_.tolerance, 1e-10);
  for (int i = 0; i < static_cast<int>(solved.rods.size()); ++i) {
    RodProblem& problem = problem_.rods[i];
    const Equilibrium& rod = equilibrium.rods[solved.rods[i]].equilibrium;
    for (int h = 0; h < static_cast<int>(problem.holds.size()); ++h) {
      Hold& hold = problem.holds[h];
      if (!hold.slide) continue;
      if (hold.cut_at < 0) hold.cut_at = hold.at;
      if (h < static_cast<int>(rod.reactions.size())) hold.at = rod.reactions[h].s;
      hold.slide = false;
      clips_.push_back({{Parameter::Kind::hold_place, i, h}, 0, {}});
    }
    segments_.push_back(problem.rod.segments);
    touches_ = touches_ || problem.surroundings;
    std::vector<Frame>& own = frames_.emplace_back();
    for (std::size_t v = 0; v < rod.points.size(); ++v) own.push_back({rod.points[v], rod.rotations[v]});
    from_.rods.push_back(rod);
  }
  for (const int b : solved.branches) {
    branches_.push_back(equilibrium.branches[b].frame);
    from_.branches.push_back(equilibrium.branches[b].frame);
  }
  for (Clip& clip : clips_) {
    const RodProblem& rod = problem_.rods[clip.place.rod];
    clip.step = difference * way_to_next_stop(rod, rod.holds[clip.place.index].at);
  }
  const RodNetwork network(problem_, options_, segments_);
  for (int i = 0; i < network.rods(); ++i)
    if (static_cast<int>(frames_[i].size()) != network.rod(i).mesh().vertices())
      throw UsageError("equilibrium:gradient: '" + equilibrium.rods[solved.rods[i]].name + "' was solved on another mesh than it asks for");
}

std::unique_ptr<SystemSensitivity::Settled> SystemSensitivity::settle(const SystemProblem& problem, const RunContext& context) const {
  auto made = std::make_unique<Settled>(problem, options_, segments_);
  made->state = made->network.state_from(frames_, branches_);
  if (touches_) {
    made->contact = std::make_unique<ContactSolver>(made->network, options_);
    made->status = made->contact->run(made->state, &from_, context).newton.status;
    for (const ContactNetwork::Rod& rod : made->contact->contacts().rods())
      if (rod.terms->pressed_near_hold())
        throw UsageError("equilibrium:gradient: a rod is pushed near a hold, where the kept clearance grows; sensitivities are "
                         "for contact elsewhere");
  } else {
    NewtonOptions newton;
    newton.tolerance = options_.tolerance;
    newton.stable_only = false;
    newton.warm = true;
    made->status = Newton(made->network, nullptr).run(made->state, newton, context).status;
  }
  if (made->status == Status::solved)
    made->sensitivity = std::make_unique<Sensitivity>(made->network, made->state, made->contact ? &made->contact->contacts() : nullptr);
  return made;
}

void SystemSensitivity::shift_clips(const RunContext& context) {
  for (Clip& clip : clips_)
    for (const double place : places) {
      SystemProblem shifted = problem_;
      shifted.rods[clip.place.rod].holds[clip.place.index].at += place * clip.step;
      clip.shifted.push_back(settle(shifted, context));
      if (clip.shifted.back()->sensitivity && clip.shifted.back()->sensitivity->ok()) continue;
      why_not_ = "no equilibrium beside this one with a sliding clip shifted by " + std::to_string(1e3 * place * clip.step) + " mm";
      return;
    }
}

/// d/da of the energy's derivatives by the parameters.
std::vector<double> SystemSensitivity::stationary_change(const Clip& clip, std::span<const Parameter> parameters) const {
  Measure energy;
  energy.what = Measure::What::energy;
  constexpr std::array<double, 4> weights = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
  std::vector<double> sum(parameters.size(), 0.0);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (energy.rod = 0; energy.rod < middle_->network.rods(); ++energy.rod) {
      const std::vector<double> slopes = clip.shifted[i]->sensitivity->gradient(energy, parameters);
      for (std::size_t p = 0; p < slopes.size(); ++p) sum[p] += weights[i] / clip.step * slopes[p];
    }
  return sum;
}

SystemSensitivity::Answer SystemSensitivity::gradient(const Measure& measure, const std::vector<Parameter>& parameters) const {
  Answer answer{middle_->sensitivity->measure(measure).value, middle_->sensitivity->gradient(measure, parameters)};
  if (clips_.empty() || parameters.empty()) return answer;
  const int m = static_cast<int>(clips_.size());
  std::vector<Parameter> asked = parameters;  // and the clips' places
  for (const Clip& clip : clips_) asked.push_back(clip.place);
  Eigen::MatrixXd by_place(m, m), mixed(m, parameters.size());
  for (int k = 0; k < m; ++k) {
    const std::vector<double> row = stationary_change(clips_[k], asked);
    for (std::size_t p = 0; p < parameters.size(); ++p) mixed(k, p) = row[p];
    for (int l = 0; l < m; ++l) by_place(k, l) = row[parameters.size() + l];
  }
  const std::vector<double> by_clip =
      middle_->sensitivity->gradient(measure, std::span(asked).subspan(parameters.size()));
  const Eigen::MatrixXd slips = -by_place.partialPivLu().solve(mixed);
  for (std::size_t p = 0; p < parameters.size(); ++p)
    for (int k = 0; k < m; ++k) answer.derivatives[p] += by_clip[k] * slips(k, p);
  return answer;
}

}  // namespace tendril
