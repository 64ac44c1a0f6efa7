#include "method/route/harness_model.h"

#include <algorithm>
#include <cmath>

#include "method/route/mesh_place.h"
#include "method/route/route_guess.h"
#include "scene/system_sensitivity.h"
#include "statics/solve.h"

namespace tendril::routing {

namespace {

using Eigen::VectorXd;
using What = Measure::What;

// What is demanded is kept by this much more, so that what the last digits of an optimum lack is no miss. But routes run at exactly
// their clearance, up to their certificate's tolerance: where a clip holds one there, no gap can be to spare.
constexpr double gap_allowance = 1e-5;    // m
constexpr double bend_margin = 1e-3, stretch_margin = 0.05;
constexpr double seen_bend = 0.5, seen_room = 0.05;  // slacks and m beyond which nothing is looked at more closely
constexpr double stretch_share = 0.02;    // a stretch of this much too much is a slack of -1
constexpr std::size_t most_rooms = 12;    // of a branch
constexpr int most_iterations = 200;      // from a design close by; a trial that needs more is not worth it

RefinementOptions uses_of(const HarnessOptions& options) {
  RefinementOptions refinement;
  refinement.clearance = options.space.clearance;
  return refinement;
}

std::shared_ptr<const Surroundings> demanding(const FreeSpace& space) {
  auto some = std::make_shared<Surroundings>();
  for (int k = 0; k < space.surroundings().size(); ++k)
    if (space.surroundings().clearance(k) > 0 || k >= space.first_zone()) some->add(space.surroundings().obstacle(k));
  return some->size() > 0 ? some : nullptr;
}

}  // namespace

HarnessSurroundings::HarnessSurroundings(const Scene& scene, const HarnessResult& harness)
    : by_use(scene, uses_of(harness.options)), demanded(demanding(*harness.space)) {
  for (const HarnessBranch& branch : harness.branches) {
    const Curve curve = branch.points.curve();
    const Rod rod = Rod::uniform(curve.length(), harness.options.section,
                                 std::clamp(static_cast<int>(std::ceil(curve.length() / harness.options.segment)), 4, Rod::max_segments));
    route.push_back(*guess_along_route(Design{rod, curve.at(0), curve.at(curve.length()), 0, {}, curve}));
  }
  room_scale = harness.options.section.radius();
  for (const PlacedObstacle& obstacle : by_use.obstacles) room_scale = std::max(room_scale, obstacle.clearance);
}

std::pair<double, double> judged_stretch(const HarnessBranch& branch, const HarnessOptions& options, double length) {
  return {branch.from.junction ? 0 : options.free_ends, length - (branch.to.junction ? 0 : options.free_ends)};
}

HarnessModel::HarnessModel(const HarnessSurroundings& around, const HarnessResult& harness, const HarnessVariables& variables,
                           const RunContext& context)
    : around_(&around), harness_(&harness), variables_(&variables), context_(&context), contact_(around.by_use.touchable.get()) {
  const int n = variables.size();
  lower_ = upper_ = scale_ = VectorXd(n);
  const VectorXd at = variables.start();
  for (int v = 0; v < n; ++v) {
    const HarnessVariables::Variable& variable = variables.variables()[v];
    scale_[v] = variable.scale;
    lower_[v] = variable.lower / variable.scale;
    upper_[v] = std::max(variable.upper, variable.lower) / variable.scale;
  }
  parameters_.resize(variables.problems(at).size());
  for (int v = 0; v < n; ++v) {
    std::vector<Parameter>& of_group = parameters_[variables.group_of(variables.variables()[v].branch)];
    directions_.emplace_back();
    for (const auto& [parameter, weight] : variables.direction(v, at)) {
      directions_.back().push_back({static_cast<int>(of_group.size()), weight});
      of_group.push_back(parameter);
    }
  }
}

std::shared_ptr<SceneEquilibrium> HarnessModel::solved(const VectorXd& x) const {
  auto eq = std::make_shared<SceneEquilibrium>();
  eq->obstacles = around_->by_use.obstacles;
  eq->surroundings = around_->by_use.all;
  SolveOptions options = harness_->options.solve;
  options.clearance = ClearanceRule::judge;
  options.error = false;
  options.follow = accepted_.equilibrium != nullptr;
  if (accepted_.equilibrium) options.max_iterations = std::min(options.max_iterations, most_iterations);
  for (const HarnessBranch& branch : harness_->branches) eq->rods.push_back({branch.name, {}, options, {}});
  for (std::size_t j = 0; j < harness_->junctions.size(); ++j) eq->branches.push_back({"junction " + std::to_string(j + 1), {}, {}});
  for (HarnessVariables::Group& group : variables_->problems(x.cwiseProduct(scale_))) {
    SystemEquilibrium warm;
    for (std::size_t k = 0; k < group.branches.size(); ++k) {
      group.problem.rods[k].surroundings = contact_;
      eq->rods[group.branches[k]].problem = group.problem.rods[k];
      warm.rods.push_back(accepted_.equilibrium ? accepted_.rod(group.branches[k]) : around_->route[group.branches[k]]);
    }
    for (std::size_t j = 0; j < group.junctions.size(); ++j)
      warm.branches.push_back(accepted_.equilibrium ? accepted_.equilibrium->branches[group.junctions[j]].frame : group.problem.branches[j].frame);
    eq->take(tendril::solve(group.problem, options, *context_, &warm), group.branches, group.junctions);
    eq->systems.push_back({std::move(group.problem), std::move(group.branches), std::move(group.junctions)});
  }
  return eq;
}

ConstrainedProblem::Value HarnessModel::evaluate(const VectorXd& x) {
  ++evaluations_;
  State state;
  state.x = x;
  state.equilibrium = solved(x);
  state.value.valid = state.equilibrium->ok();
  if (state.value.valid) {
    for (int b = 0; b < static_cast<int>(harness_->branches.size()); ++b) {
      const Rod& rod = state.equilibrium->rods[b].problem.rod;
      const GapProfile profile(around_->demanded, around_->route[b], seen_room);
      const auto judged = judged_stretch(harness_->branches[b], harness_->options, rod.length);
      state.rooms.push_back(judged.second > judged.first ? profile.along(rod, state.rod(b), {judged}) : std::vector<Room>());
    }
    state.value.cost = cost_at(state, nullptr, nullptr);
    state.value.violation = std::max(0.0, -least_slack(state));
  }
  candidate_ = std::move(state);
  return candidate_.value;
}

/// Branches' factors times the integral of what a metre costs there, by the trapezoid rule over the vertices; its exact slope by the
/// scaled variables where asked for.
double HarnessModel::cost_at(const State& state, VectorXd* slope, const std::vector<SystemSensitivity>* sensitivities) const {
  const FreeSpace& space = *harness_->space;
  const int n = variables_->size();
  double cost = 0;
  if (slope) *slope = VectorXd::Zero(n);
  std::vector<Measure> moved(slope ? sensitivities->size() : 0);
  for (std::size_t g = 0; g < moved.size(); ++g) {
    moved[g].what = What::functional;
    moved[g].weights.assign((*sensitivities)[g].network().nodes(), Vec6::Zero());
  }
  const VectorXd x = state.x.cwiseProduct(scale_);
  for (int b = 0; b < static_cast<int>(harness_->branches.size()); ++b) {
    const double factor = harness_->branches[b].factor;
    const std::vector<double>& s = state.rod(b).s;
    const int last = static_cast<int>(s.size()) - 1, group = variables_->group_of(b);
    std::vector<double> density(s.size(), 1.0);
    for (int i = 0; i <= last; ++i) {
      const double share = 0.5 * (s[std::min(i + 1, last)] - s[std::max(i - 1, 0)]);
      if (space.has_preferences()) {
        Vec3 gradient = Vec3::Zero();
        density[i] = space.cost(state.rod(b).points[i], slope ? &gradient : nullptr);
        if (slope) {
          const RodNetwork& network = (*sensitivities)[group].network();
          moved[group].weights[network.first_node(variables_->place_in_group(b)) + i].head<3>() = factor * share * gradient;
        }
      }
      cost += factor * share * density[i];
    }
    for (int v = 0; slope && v < n; ++v) {
      if (variables_->variables()[v].branch != b) continue;
      const std::vector<double> moves = variables_->moves_along(v, b, x, s);
      for (int i = 0; i < last; ++i)
        (*slope)[v] += factor * 0.5 * (density[i] + density[i + 1]) * (moves[i + 1] - moves[i]) * scale_[v];
    }
  }
  if (slope && space.has_preferences())
    for (std::size_t g = 0; g < moved.size(); ++g) *slope += derivatives(moved[g], static_cast<int>(g), *sensitivities);
  return cost;
}

VectorXd HarnessModel::derivatives(const Measure& measure, int group, const std::vector<SystemSensitivity>& sensitivities) const {
  const std::vector<double> by_parameter = sensitivities[group].gradient(measure, parameters_[group]).derivatives;
  VectorXd out = VectorXd::Zero(variables_->size());
  for (int v = 0; v < out.size(); ++v) {
    if (variables_->group_of(variables_->variables()[v].branch) != group) continue;
    for (const auto& [parameter, weight] : directions_[v]) out[v] += weight * by_parameter[parameter] * scale_[v];
  }
  return out;
}

double HarnessModel::bend_slack(double radius) const {
  return 1 - harness_->options.min_bend_radius * (1 + bend_margin) / radius;
}

double HarnessModel::wall_gap(const Equilibrium& rod, int vertex, int side) const {
  const Eigen::AlignedBox3d& box = *harness_->options.space.keep_in;
  const int axis = side / 2;
  const double way = side % 2 ? box.max()[axis] - rod.points[vertex][axis] : rod.points[vertex][axis] - box.min()[axis];
  return way - harness_->options.section.radius();
}

int HarnessModel::nearest_to_wall(const State& state, int branch, int side) const {
  const Equilibrium& rod = state.rod(branch);
  int nearest = 0;
  for (int i = 1; i < static_cast<int>(rod.points.size()); ++i)
    if (wall_gap(rod, i, side) < wall_gap(rod, nearest, side)) nearest = i;
  return nearest;
}

std::vector<HarnessModel::Place> HarnessModel::tight_places(const State& state, double below) const {
  std::vector<Place> places;
  for (int b = 0; b < static_cast<int>(harness_->branches.size()); ++b) {
    const Equilibrium& rod = state.rod(b);
    const auto add = [&](double s, double slack) {
      if (slack < below) places.push_back({b, s, slack});
    };
    const std::vector<double> radii = rod.bend_radii();
    for (std::size_t i = 0; i < radii.size(); ++i) add(rod.s[i], bend_slack(radii[i]));
    for (const Room& room : state.rooms[b]) add(room.s, (room.value + gap_allowance) / around_->room_scale);
    for (int side = 0; walled() && side < 6; ++side) {
      const int vertex = nearest_to_wall(state, b, side);
      add(rod.s[vertex], (wall_gap(rod, vertex, side) + gap_allowance) / around_->room_scale);
    }
    add(0.5 * rod.s.back(), slack_of(tag_of(stretch, b, 0), state));
  }
  return places;
}

double HarnessModel::least_slack(const State& state) const {
  double least = 1;
  for (const Place& place : tight_places(state, 1)) least = std::min(least, place.slack);
  return least;
}

void HarnessModel::add_pressing(const State& state, int branch, std::vector<Tag>& tags) const {
  const Equilibrium& rod = state.rod(branch);
  tags.push_back(tag_of(stretch, branch, 0));
  const std::vector<double> radii = rod.bend_radii();
  const int last = static_cast<int>(radii.size()) - 1;
  const auto sharpest = [&](int i) { return (i == 0 || radii[i] <= radii[i - 1]) && (i == last || radii[i] <= radii[i + 1]); };
  for (int i = 0; i <= last; ++i)
    if (bend_slack(radii[i]) < seen_bend && (sharpest(i) || sharpest(std::max(i - 1, 0)) || sharpest(std::min(i + 1, last))))
      tags.push_back(tag_of(bend, branch, i));
  std::vector<Room> rooms;
  for (const Room& room : state.rooms[branch])
    if (room.obstacle >= 0 && (room.lowest || room.value < around_->room_scale)) rooms.push_back(room);
  std::stable_sort(rooms.begin(), rooms.end(),
                   [](const Room& a, const Room& b) { return a.lowest != b.lowest ? a.lowest : a.value < b.value; });
  for (std::size_t i = 0; i < std::min(rooms.size(), most_rooms); ++i)
    tags.push_back(tag_of(Kind::room, branch, mesh_place(rod.s, rooms[i].s)));
  for (int side = 0; walled() && side < 6; ++side) {
    const int vertex = nearest_to_wall(state, branch, side);
    if (wall_gap(rod, vertex, side) < seen_room) tags.push_back(tag_of(wall, branch, 6 * vertex + side));
  }
}

std::vector<ConstrainedProblem::Tag> HarnessModel::pressing(const State& state) const {
  std::vector<Tag> tags;
  for (int b = 0; b < static_cast<int>(harness_->branches.size()); ++b) add_pressing(state, b, tags);
  return tags;
}

Room HarnessModel::room_at(const State& state, int branch, double place) const {
  const GapProfile profile(around_->demanded, around_->route[branch], seen_room);
  return profile.at(state.equilibrium->rods[branch].problem.rod, state.rod(branch), arc_length_at(state.rod(branch).s, place));
}

double HarnessModel::slack_of(const Tag& tag, const State& state) const {
  const int b = tag.kind / kinds;
  const Equilibrium& rod = state.rod(b);
  switch (tag.kind % kinds) {
    case bend: return bend_slack(rod.bend_radii()[std::min(static_cast<std::size_t>(tag.place), rod.s.size() - 1)]);
    case room: return (room_at(state, b, tag.place).value + gap_allowance) / around_->room_scale;
    case wall: return (wall_gap(rod, static_cast<int>(tag.place) / 6, static_cast<int>(tag.place) % 6) + gap_allowance) / around_->room_scale;
    default: return ((1 - stretch_margin) * harness_->options.max_stretch - (rod.settled_length() / rod.s.back() - 1)) / stretch_share;
  }
}

/// By the scaled variables, at the accepted state.
VectorXd HarnessModel::slope_of(const Tag& tag, const std::vector<SystemSensitivity>& sensitivities) const {
  const int b = tag.kind / kinds, group = variables_->group_of(b);
  const Equilibrium& rod = accepted_.rod(b);
  Measure measure;
  measure.rod = variables_->place_in_group(b);
  switch (tag.kind % kinds) {
    case bend: {
      const std::size_t vertex = std::min(static_cast<std::size_t>(tag.place), rod.s.size() - 1);
      const double radius = rod.bend_radii()[vertex];
      if (!std::isfinite(radius)) return VectorXd::Zero(variables_->size());
      measure.what = What::bend_radius;
      measure.at = rod.s[vertex];
      return harness_->options.min_bend_radius * (1 + bend_margin) / (radius * radius) * derivatives(measure, group, sensitivities);
    }
    case room: {
      const Room here = room_at(accepted_, b, tag.place);
      if (here.obstacle < 0 || here.normal.isZero(0)) return VectorXd::Zero(variables_->size());
      measure.what = What::gap;
      measure.at = here.s;
      measure.along = here.normal;
      measure.origin = here.on;
      return derivatives(measure, group, sensitivities) / around_->room_scale;
    }
    case wall: {
      const int vertex = static_cast<int>(tag.place) / 6, side = static_cast<int>(tag.place) % 6;
      measure.what = What::position;
      measure.at = rod.s[vertex];
      measure.along = (side % 2 ? -1.0 : 1.0) * Vec3::Unit(side / 2);
      return derivatives(measure, group, sensitivities) / around_->room_scale;
    }
    default: {
      measure.what = What::length;
      const double length = rod.s.back(), settled = rod.settled_length();
      VectorXd slope = derivatives(measure, group, sensitivities) / length;
      for (int v = 0; v < slope.size(); ++v) {
        const HarnessVariables::Variable& variable = variables_->variables()[v];
        if (variable.kind == HarnessVariables::Variable::Kind::stretch && variable.branch == b) slope[v] -= settled / (length * length) * scale_[v];
      }
      return -slope / stretch_share;
    }
  }
}

VectorXd HarnessModel::slacks(const std::vector<Tag>& tags) {
  VectorXd all(static_cast<Eigen::Index>(tags.size()));
  for (std::size_t i = 0; i < tags.size(); ++i) all[static_cast<Eigen::Index>(i)] = slack_of(tags[i], candidate_);
  return all;
}

bool HarnessModel::linearise(const std::vector<Tag>& always, Linear& out) {
  const VectorXd x = accepted_.x.cwiseProduct(scale_);
  for (int v = 0; v < variables_->size(); ++v) {
    const auto terms = variables_->direction(v, x);
    for (std::size_t k = 0; k < terms.size(); ++k) directions_[v][k].second = terms[k].second;
  }
  std::vector<SystemSensitivity> sensitivities;
  for (int g = 0; g < static_cast<int>(parameters_.size()); ++g) {
    sensitivities.emplace_back(*accepted_.equilibrium, g, *context_);
    if (!sensitivities.back().why_not().empty()) return false;
  }
  cost_at(accepted_, &out.cost, &sensitivities);
  out.tags = always;
  for (const Tag& tag : pressing(accepted_)) {
    const bool known = std::any_of(always.begin(), always.end(), [&](const Tag& t) { return t.kind == tag.kind && t.place == tag.place; });
    if (!known) out.tags.push_back(tag);
  }
  const int m = static_cast<int>(out.tags.size());
  out.slacks = VectorXd(m);
  out.slopes = Eigen::MatrixXd(m, variables_->size());
  for (int i = 0; i < m; ++i) {
    out.slacks[i] = slack_of(out.tags[i], accepted_);
    out.slopes.row(i) = slope_of(out.tags[i], sensitivities).transpose();
  }
  return out.slopes.allFinite() && out.cost.allFinite();
}

}  // namespace tendril::routing
