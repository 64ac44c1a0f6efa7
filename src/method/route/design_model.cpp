#include "method/route/design_model.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "method/route/mesh_place.h"
#include "method/route/route_guess.h"
#include "scene/system_sensitivity.h"
#include "statics/solve.h"

namespace tendril::routing {
namespace {

using Eigen::VectorXd;
using What = Measure::What;

// What is demanded is kept by this much more, so that what the last digits of an optimum lack is no miss.
constexpr double gap_margin = 1e-5;      // m
constexpr double share_margin = 1e-5;    // of bend radii, tensions and strains
constexpr double seen_bend = 0.5, seen_room = 0.05;  // slacks and m beyond which nothing is looked at more closely
constexpr std::size_t most_rooms = 24;
constexpr int most_iterations = 150;     // from a design close by; a trial that needs more is not worth it

/// f(gap) of the cost, and its slope.
std::pair<double, double> nearness(double gap, double range) {
  const double x = std::max(0.0, 1 - gap / range);
  return {x * x, -2 * x / range};
}

}  // namespace

DesignModel::DesignModel(const SurroundingsByUse& around, const Vec3& gravity, const DesignSpace& space,
                         const RefinementOptions& options, const RunContext& context)
    : around_(&around), contact_(around.touchable.get()), gravity_(gravity), space_(&space), options_(&options), context_(&context) {
  const int n = space.size();
  lower_ = upper_ = scale_ = VectorXd(n);
  VectorXd at(n);
  for (int j = 0; j < n; ++j) {
    const DesignSpace::Variable& v = space.variables()[j];
    scale_[j] = v.scale;
    lower_[j] = v.lower / v.scale;
    upper_[j] = v.upper / v.scale;
    at[j] = v.start;
  }
  const Design design = space.design(at);
  room_scale_ = design.rod.largest_radius();
  for (const PlacedObstacle& obstacle : around.obstacles) room_scale_ = std::max(room_scale_, obstacle.clearance);
  if (options.min_length) {
    double chords = 0;
    for (const DesignSpace::Span& span : space.spans()) chords += span.chord;
    if (chords > 0) span_share_ = std::min(1.0, *options.min_length / chords);
  }
  for (int j = 0; j < n; ++j) {
    directions_.emplace_back();
    for (const auto& [parameter, weight] : space.direction(j, at)) {
      directions_.back().push_back({static_cast<int>(parameters_.size()), weight});
      parameters_.push_back(parameter);
    }
  }
}

VectorXd DesignModel::start() const {
  VectorXd x(space_->size());
  for (int j = 0; j < x.size(); ++j) x[j] = space_->variables()[j].start / scale_[j];
  return x.cwiseMax(lower_).cwiseMin(upper_);
}

std::shared_ptr<SceneEquilibrium> DesignModel::solved(const VectorXd& x, const ContactField* contact, const Equilibrium* from,
                                                      Purpose purpose) const {
  auto eq = std::make_shared<SceneEquilibrium>();
  SystemProblem system;
  system.rods.push_back(space_->problem(space_->design(unscaled(x)), gravity_));
  system.rods.front().surroundings = contact;
  SolveOptions options = options_->solve;
  options.clearance = ClearanceRule::judge;
  options.error = purpose == Purpose::last && options_->solve.error;
  options.follow = from != nullptr;
  if (purpose == Purpose::trial) options.max_iterations = std::min(options.max_iterations, most_iterations);
  SystemEquilibrium warm;
  if (from) warm.rods.push_back(*from);
  eq->rods.push_back({options_->name, system.rods.front(), options, {}});
  eq->obstacles = around_->obstacles;
  eq->surroundings = around_->all;
  SystemEquilibrium found = solve(system, options, *context_, from ? &warm : nullptr);
  eq->seconds = found.rods.front().seconds;
  eq->take(std::move(found), {0}, {});
  eq->systems.push_back({std::move(system), {0}, {}});
  return eq;
}

std::shared_ptr<SceneEquilibrium> DesignModel::verified(const VectorXd& x) const {
  return solved(x, around_->all.get(), &accepted_.rod(), Purpose::last);
}

bool DesignModel::begin(const VectorXd& x) {
  const Design design = space_->design(unscaled(x));
  const std::optional<Equilibrium> guess = guess_along_route(design);
  const Equilibrium* from = guess ? &*guess : nullptr;
  std::shared_ptr<SceneEquilibrium> first = solved(x, contact_, from, Purpose::first);
  // What runs from its connection through no surface is outside; else contact with everything finds a way in front of it.
  const bool outside = first->ok() && (!around_->all || !first_crossing(*around_->all, first->rods.front().equilibrium.points));
  if (!outside && !context_->stop()) first = solved(x, around_->all.get(), from, Purpose::first);
  if (!first->ok() && guess && !context_->stop()) first = solved(x, around_->all.get(), nullptr, Purpose::first);
  if (!first->ok()) {
    why_not_ = first->message();
    return false;
  }
  outside_ = first;
  accepted_ = State{x, first, {}, {}};
  return true;
}

ConstrainedProblem::Value DesignModel::evaluate(const VectorXd& x) {
  State state;
  state.x = x;
  if (space_->in_order(unscaled(x))) {
    state.equilibrium = solved(x, contact_, &accepted_.rod(), Purpose::trial);
    state.value.valid = state.equilibrium->ok();
  }
  if (state.value.valid) {
    const GapProfile profile(around_->demanded, outside_->rods.front().equilibrium, seen_room);
    state.rooms = profile.along(state.problem().rod, state.rod(), judged_stretches(state.problem(), *options_));
    state.value.cost = cost_at(state, nullptr, nullptr);
    state.value.violation = std::max(0.0, -least_slack(state));
  }
  const double seconds = std::chrono::duration<double>(RunContext::Clock::now() - began_).count();
  history_.push_back({seconds, state.value.valid ? state.value.cost : std::nan(""),
                      state.value.valid ? state.value.violation : INFINITY});
  candidate_ = std::move(state);
  return candidate_.value;
}

/// Cost per metre at a place; `gradient` by the place, 1/m.
double DesignModel::cost_of_place(const Vec3& p, const Vec3& outside, double radius, Vec3* gradient) const {
  const double limit = options_->range + radius;
  double sum = 0;
  if (gradient) gradient->setZero();
  const auto add = [&](const SignedGap& field, double weight, bool near) {
    const SignedGap::Value value = field.at(p, outside, limit);
    const auto [f, slope] = nearness(value.gap - radius, options_->range);
    sum += weight * (near ? 1 - f : f);
    if (gradient && value.obstacle >= 0) *gradient += (near ? -weight : weight) * slope * value.normal;
  };
  if (around_->nearest.field()) add(around_->nearest, options_->clearance_weight, false);
  for (const SignedGap& field : around_->avoided) add(field, options_->preference_weight, false);
  for (const SignedGap& field : around_->kept_near) add(field, options_->preference_weight, true);
  return sum;
}

/// The integral by the trapezoid rule over the vertices; its exact slope by the scaled variables where asked for.
double DesignModel::cost_at(const State& state, VectorXd* slope, const SystemSensitivity* sensitivity) const {
  const Rod& rod = state.problem().rod;
  const std::vector<double>& s = state.rod().s;
  const int n = space_->size(), last = static_cast<int>(s.size()) - 1;
  double cost = options_->length_weight * rod.length;
  if (slope) {
    *slope = VectorXd::Zero(n);
    for (int j = 0; j < n; ++j)
      if (space_->variables()[j].kind == DesignSpace::Variable::Kind::length) (*slope)[j] = options_->length_weight * scale_[j];
  }
  if (!around_->has_costs) return cost;
  std::vector<double> density(s.size());
  Measure moved;
  moved.what = What::functional;
  if (slope) moved.weights.assign(sensitivity->network().nodes(), Vec6::Zero());
  const Equilibrium& outside = outside_->rods.front().equilibrium;
  for (int i = 0; i <= last; ++i) {
    const double share = 0.5 * (s[std::min(i + 1, last)] - s[std::max(i - 1, 0)]);
    const Vec3 reference = outside.frame_at(s[i] / s.back() * outside.s.back()).at;
    Vec3 gradient;
    density[i] = cost_of_place(state.rod().points[i], reference, rod.section_at(s[i]).radius(), slope ? &gradient : nullptr);
    cost += share * density[i];
    if (slope) moved.weights[sensitivity->network().first_node(0) + i].head<3>() = share * gradient;
  }
  if (!slope) return cost;
  *slope += derivatives(moved, *sensitivity);
  for (int j = 0; j < n; ++j) {
    const std::vector<double> moves = space_->moves_along(j, state.problem(), s);
    for (int i = 0; i < last; ++i)
      (*slope)[j] += 0.5 * (density[i] + density[i + 1]) * (moves[i + 1] - moves[i]) * scale_[j];
  }
  return cost;
}

double DesignModel::span_slack(const RodProblem& problem, int index) const {
  const DesignSpace::Span& span = space_->spans()[index];
  const double chord = std::max(span_share_ * span.chord, 1e-3 * problem.rod.length);
  return (problem.holds[span.end].at - problem.holds[span.begin].at) / chord - 1;
}

double DesignModel::least_slack(const State& state) const {
  double least = INFINITY;
  const auto take = [&](double slack) { least = std::min(least, slack); };
  for (int k = 0; k < static_cast<int>(space_->spans().size()); ++k)
    if (space_->size() > 0) take(span_slack(state.problem(), k));
  if (options_->min_bend_radius > 0)
    take(1 - options_->min_bend_radius * (1 + share_margin) / state.rod().smallest_bend_radius());
  if (std::isfinite(options_->max_tension)) take(1 - state.rod().largest_tension() * (1 + share_margin) / options_->max_tension);
  if (std::isfinite(options_->max_strain)) take(1 - state.rod().largest_strain() * (1 + share_margin) / options_->max_strain);
  for (const Room& room : state.rooms) take((room.value - gap_margin) / room_scale_);
  return least;
}

/// The constraints that matter near a state.
std::vector<ConstrainedProblem::Tag> DesignModel::pressing(const State& state) const {
  std::vector<Tag> tags;
  for (int k = 0; k < static_cast<int>(space_->spans().size()); ++k) tags.push_back({span, double(k)});
  if (std::isfinite(options_->max_tension)) tags.push_back({tension, 0});
  if (std::isfinite(options_->max_strain)) tags.push_back({strain, 0});
  if (options_->min_bend_radius > 0) {
    const std::vector<double> radii = state.rod().bend_radii();
    const int last = static_cast<int>(radii.size()) - 1;
    const auto sharpest = [&](int i) {
      return (i == 0 || radii[i] <= radii[i - 1]) && (i == last || radii[i] <= radii[i + 1]);
    };
    for (int i = 0; i <= last; ++i)
      if (1 - options_->min_bend_radius / radii[i] < seen_bend &&
          (sharpest(i) || sharpest(std::max(i - 1, 0)) || sharpest(std::min(i + 1, last))))
        tags.push_back({bend, double(i)});
  }
  std::vector<Room> rooms;
  for (const Room& room : state.rooms)
    if (room.obstacle >= 0 && (room.lowest || room.value < room_scale_)) rooms.push_back(room);
  std::stable_sort(rooms.begin(), rooms.end(), [](const Room& a, const Room& b) {
    return a.lowest != b.lowest ? a.lowest : a.value < b.value;
  });
  for (std::size_t i = 0; i < std::min(rooms.size(), most_rooms); ++i)
    tags.push_back({room, mesh_place(state.rod().s, rooms[i].s)});
  return tags;
}

VectorXd DesignModel::derivatives(const Measure& measure, const SystemSensitivity& sensitivity) const {
  const std::vector<double> by_parameter = sensitivity.gradient(measure, parameters_).derivatives;
  VectorXd out = VectorXd::Zero(space_->size());
  for (int j = 0; j < out.size(); ++j)
    for (const auto& [parameter, weight] : directions_[j]) out[j] += weight * by_parameter[parameter] * scale_[j];
  return out;
}

Room DesignModel::room_at(const State& state, double place) const {
  const GapProfile profile(around_->demanded, outside_->rods.front().equilibrium, seen_room);
  return profile.at(state.problem().rod, state.rod(), arc_length_at(state.rod().s, place));
}

double DesignModel::slack_of(const Tag& tag, const State& state) const {
  switch (tag.kind) {
    case span: return span_slack(state.problem(), static_cast<int>(tag.place));
    case bend: {
      const std::vector<double> radii = state.rod().bend_radii();
      const std::size_t vertex = std::min(static_cast<std::size_t>(tag.place), radii.size() - 1);
      return 1 - options_->min_bend_radius * (1 + share_margin) / radii[vertex];
    }
    case room: return (room_at(state, tag.place).value - gap_margin) / room_scale_;
    case tension: return 1 - state.rod().largest_tension() * (1 + share_margin) / options_->max_tension;
    default: return 1 - state.rod().largest_strain() * (1 + share_margin) / options_->max_strain;
  }
}

/// By the scaled variables, at the accepted state.
VectorXd DesignModel::slope_of(const Tag& tag, const SystemSensitivity& sensitivity) const {
  const RodProblem& problem = accepted_.problem();
  VectorXd slope = VectorXd::Zero(space_->size());
  Measure measure;
  switch (tag.kind) {
    case span: {
      const DesignSpace::Span& stretch = space_->spans()[static_cast<int>(tag.place)];
      const std::vector<double> places = {problem.holds[stretch.begin].at, problem.holds[stretch.end].at};
      const double chord = (places[1] - places[0]) / (slack_of(tag, accepted_) + 1);
      for (int j = 0; j < slope.size(); ++j) {
        const std::vector<double> moves = space_->moves_along(j, problem, places);
        slope[j] = (moves[1] - moves[0]) / chord * scale_[j];
      }
      return slope;
    }
    case bend: {
      const std::vector<double> radii = accepted_.rod().bend_radii();
      const std::size_t vertex = std::min(static_cast<std::size_t>(tag.place), radii.size() - 1);
      if (!std::isfinite(radii[vertex])) return slope;
      measure.what = What::bend_radius;
      measure.at = accepted_.rod().s[vertex];
      const double demanded = options_->min_bend_radius * (1 + share_margin);
      return demanded / (radii[vertex] * radii[vertex]) * derivatives(measure, sensitivity);
    }
    case room: {
      const Room here = room_at(accepted_, tag.place);
      if (here.obstacle < 0 || here.normal.isZero(0)) return slope;
      measure.what = What::gap;
      measure.at = here.s;
      measure.along = here.normal;
      measure.origin = here.on;
      return derivatives(measure, sensitivity) / room_scale_;
    }
    case tension:
      measure.what = What::max_tension;
      return -(1 + share_margin) / options_->max_tension * derivatives(measure, sensitivity);
    default:
      measure.what = What::max_strain;
      return -(1 + share_margin) / options_->max_strain * derivatives(measure, sensitivity);
  }
}

VectorXd DesignModel::slacks(const std::vector<Tag>& tags) {
  VectorXd all(static_cast<Eigen::Index>(tags.size()));
  for (std::size_t i = 0; i < tags.size(); ++i) all[i] = slack_of(tags[i], candidate_);
  return all;
}

bool DesignModel::linearise(const std::vector<Tag>& always, Linear& out) {
  const VectorXd x = unscaled(accepted_.x);
  for (int j = 0; j < space_->size(); ++j) {
    const auto terms = space_->direction(j, x);
    for (std::size_t k = 0; k < terms.size(); ++k) directions_[j][k].second = terms[k].second;
  }
  std::unique_ptr<const SystemSensitivity> made;
  try {
    made = std::make_unique<const SystemSensitivity>(*accepted_.equilibrium, 0, *context_);
    why_not_ = made->why_not();
  } catch (const UsageError& e) {  // contact beside a hold: nothing that the user has asked for
    why_not_ = e.what();
  }
  if (!why_not_.empty()) return false;
  const SystemSensitivity& sensitivity = *made;
  cost_at(accepted_, &out.cost, &sensitivity);
  out.tags = always;
  for (const Tag& tag : pressing(accepted_)) {
    const bool known = std::any_of(always.begin(), always.end(), [&](const Tag& t) { return t.kind == tag.kind && t.place == tag.place; });
    if (!known) out.tags.push_back(tag);
  }
  const int m = static_cast<int>(out.tags.size());
  out.slacks = VectorXd(m);
  out.slopes = Eigen::MatrixXd(m, space_->size());
  for (int i = 0; i < m; ++i) {
    out.slacks[i] = slack_of(out.tags[i], accepted_);
    out.slopes.row(i) = slope_of(out.tags[i], sensitivity).transpose();
  }
  return out.slopes.allFinite() && out.cost.allFinite();
}

}  // namespace tendril::routing
