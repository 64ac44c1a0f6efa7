#include "method/route/harness_routing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "base/units.h"
#include "method/free_space/bottleneck.h"
#include "method/preform/end_lead.h"
#include "method/route/harness_refinement.h"
#include "method/route/harness_scene.h"
#include "method/route/harness_smoothing.h"
#include "method/route/harness_variables.h"

namespace tendril::routing {

namespace {

// rad: directions that branches may take at junctions before those are settled, about those of their paths.
constexpr double free_cone = 1.2;
constexpr int most_rounds = 6;
// The smallest gap of a route is looked for up to here, m.
constexpr double farthest_clearance = 0.5;

void require(bool holds, const std::string& what) {
  if (!holds) throw UsageError("harness: " + what);
}

std::string mm(double value) { return number_text(std::round(value / units::mm * 10) / 10) + " mm"; }

void check(const HarnessOptions& options) {
  const int count = static_cast<int>(options.connections.size());
  require(count >= 2, std::to_string(count) + " connections, 2 to 9 expected");
  for (int c = 0; c < count; ++c) {
    const Frame& frame = options.connections[c];
    require(all_finite(frame.at) && frame.rotation.coeffs().allFinite() && std::abs(frame.rotation.norm() - 1) < 1e-6,
            "connection " + std::to_string(c + 1) + " is not a finite place with a rotation");
    for (int d = 0; d < c; ++d)
      require((options.connections[d].at - frame.at).norm() > 1e-6,
              "connections " + std::to_string(d + 1) + " and " + std::to_string(c + 1) + " are in one place");
  }
  require(options.names.empty() || static_cast<int>(options.names.size()) == count,
          std::to_string(options.names.size()) + " names for " + std::to_string(count) + " connections");
  options.section.check();
  require(std::isfinite(options.min_bend_radius) && options.min_bend_radius > options.section.radius(),
          "the bend radius is " + mm(options.min_bend_radius) + ", more than the section's own radius of " + mm(options.section.radius()) +
              " expected; bend radii are those of the centre line");
  const std::pair<const char*, double> lengths[] = {{"min_straight", options.min_straight}, {"end_straight", options.end_straight},
                                                    {"free_ends", options.free_ends}, {"min_branch", options.min_branch},
                                                    {"clip_reach", options.clip_reach}};
  for (const auto& [name, value] : lengths)
    require(std::isfinite(value) && value >= 0, std::string("'") + name + "' is " + number_text(value) + " m, a length of at least 0 expected");
  require(options.max_bends >= 2 && options.max_bends <= 30, "'max_bends' is " + std::to_string(options.max_bends) + ", 2 to 30 expected");
  require(std::isfinite(options.grid) && options.grid > 0, "'grid' is " + number_text(options.grid) + " m, a length above 0 expected");
  require(!options.refine || !options.equilibrium || options.solve.element == Element::se3,
          "the rods must be of se3 elements where they are refined: staggered ones have no sensitivities");
  require(options.max_clips >= 0 && options.max_clips <= 1000, "'clips' is " + std::to_string(options.max_clips) + ", 0 to 1000 expected");
  require(options.restarts >= 0 && options.restarts <= 20, "'restarts' is " + std::to_string(options.restarts) + ", 0 to 20 expected");
  require(std::isfinite(options.max_stretch) && options.max_stretch > 0, "'max_stretch' is " + number_text(options.max_stretch) + ", a share above 0 expected");
  require(std::isfinite(options.segment) && options.segment > 0, "'segment' is " + number_text(options.segment) + " m, a length above 0 expected");
}

std::string name_of_connection(const HarnessOptions& options, int number) {
  return options.names.empty() ? std::to_string(number + 1) : options.names[number];
}

std::string name_of_end(const HarnessOptions& options, const HarnessEnd& end) {
  return end.junction ? "junction " + std::to_string(end.number + 1) : name_of_connection(options, end.number);
}

/// Free places of the grid around a tip that can be reached straight from there.
std::vector<Roadmap::Goal> goals_around(const FreeSpace& space, const Roadmap& roadmap, const Vec3& tip, double way) {
  std::vector<Roadmap::Goal> goals;
  const std::array<int, 3> middle = roadmap.nearest(tip);
  for (int reach = 1; reach <= 2 && goals.empty(); ++reach)
    for (int z = -reach; z <= reach; ++z)
      for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
          const std::array<int, 3> cell{middle[0] + x, middle[1] + y, middle[2] + z};
          if (!roadmap.holds(cell)) continue;
          const int node = roadmap.node(cell);
          if (!roadmap.is_free(node) || !space.is_free(tip, roadmap.place(node))) continue;
          goals.push_back({node, way + (roadmap.place(node) - tip).norm()});
        }
  return goals;
}

/// One call's parts.
class HarnessRouting {
 public:
  HarnessRouting(const Scene& scene, HarnessResult& result, const RunContext& context)
      : scene_(scene), r_(result), options_(result.options), context_(context), steps_(result.steps) {}

  void run() {
    r_.status = Status::solved;
    open();
    for (const auto step : {&HarnessRouting::find_tree, &HarnessRouting::smooth_branches, &HarnessRouting::improve_junctions,
                            &HarnessRouting::certify})
      if (!ended()) (this->*step)();
    ended();
    r_.seconds = steps_.seconds();
  }

 private:
  bool ended() {
    if (const auto status = context_.stop(); status && r_.status == Status::solved) r_.status = *status;
    return r_.status != Status::solved;
  }
  void refuse(std::string why) {
    r_.status = Status::infeasible;
    r_.message = std::move(why);
  }

  void open() {
    std::vector<Vec3> ends;
    for (const Frame& frame : options_.connections) ends.push_back(frame.at);
    const double margin = 4 * options_.min_bend_radius + options_.space.radius + options_.space.clearance;
    r_.space = std::make_shared<const FreeSpace>(scene_, options_.space, ends, margin, context_);
    steps_.end("distance_field", {{"obstacles", r_.space->surroundings().size()}});
  }

  void find_tree() {
    const FreeSpace& space = *r_.space;
    ShapeBranch from_connection;
    const PccDemands demands = demands_of(options_, from_connection);
    for (std::size_t c = 0; c < options_.connections.size(); ++c) {
      const Frame& frame = options_.connections[c];
      const preform::EndLead lead = preform::end_lead(space, demands, frame.at, frame.d3(), 0, "connection " + name_of_connection(options_, static_cast<int>(c)));
      if (!lead.obstruction.empty()) return refuse(lead.obstruction);
      tips_.push_back(lead.tip);
    }
    const Roadmap roadmap(space, options_.grid, context_);
    std::vector<std::vector<Roadmap::Goal>> goals;
    for (std::size_t c = 0; c < tips_.size(); ++c)
      goals.push_back(goals_around(space, roadmap, tips_[c], (tips_[c] - options_.connections[c].at).norm()));
    TreeOptions tree_options;
    tree_options.wires = options_.wires;
    tree_options.bundling = options_.bundling;
    const HarnessTree tree = best_tree(roadmap, goals, tree_options, context_);
    steps_.end("tree", {{"free nodes", roadmap.free_nodes()}, {"labels", tree.labels}, {"junctions", long(tree.junctions.size())}});
    if (tree.status == Status::infeasible) return refuse(why_apart(tree));
    if (tree.status != Status::solved) {
      r_.status = tree.status;
      return;
    }
    const double least = options_.min_branch > 0 ? options_.min_branch : options_.min_bend_radius + 2 * options_.end_straight;
    shape_ = shape_of(roadmap, tree, options_, tips_, least);
  }

  std::string why_apart(const HarnessTree& tree) const {
    const auto& [a, b] = tree.apart;
    const std::string grid = "the grid of " + mm(options_.grid);
    if (a == b) return "connection " + name_of_connection(options_, a) + ": no free place of " + grid + " near it; take a smaller 'grid'";
    const Bottleneck narrow = bottleneck_between(*r_.space, tips_[a], tips_[b], options_.grid, context_);
    return "connections " + name_of_connection(options_, a) + " and " + name_of_connection(options_, b) + ": " +
           text_of(narrow, *r_.space, options_.grid);
  }

  void smooth_branches() {
    // Directions at junctions are free at first: the trunk follows from what the branches make of that.
    missed_ = smooth(*r_.space, options_, shape_, shape_.junctions.empty() ? 0 : free_cone, context_);
    shape_.choose_trunks();
    steps_.end("smoothing", {{"branches", long(shape_.branches.size())}, {"infeasible", infeasible()}});
  }
  void improve_junctions() {
    if (shape_.junctions.empty()) return;
    const HarnessShape on_grid = shape_;
    missed_.assign(shape_.branches.size(), {Violation{}});  // without directions in common at junctions it is no route yet
    if (options_.improve) move_together(on_grid);
    if (!options_.improve || infeasible()) {
      HarnessShape still = on_grid;
      offer(still, smooth(*r_.space, options_, still, 0, context_));
      if (options_.improve && !context_.stop()) move_together(still);
    }
    steps_.end("improvement", {{"junctions", long(shape_.junctions.size())}, {"infeasible", infeasible()}});
  }
  /// Each time from what came out before: a descent stops at kinks of the distance, from which another one gets away.
  void move_together(HarnessShape shape) {
    for (int round = 0; round < most_rounds && !context_.stop(); ++round) {
      const ShapeViolations missed = improve(*r_.space, options_, shape, context_);
      if (!offer(shape, missed) && misses(missed) == 0) return;
    }
  }
  /// Takes a shape that is better than what there is.
  bool offer(const HarnessShape& shape, const ShapeViolations& missed) {
    const double before = misses(missed_), after = misses(missed);
    const double least = 1e-3 * shape.cost();
    if (after > before || (after == before && weighted_cost(*r_.space, shape) > weighted_cost(*r_.space, shape_) - least)) return false;
    shape_ = shape;
    missed_ = missed;
    return true;
  }
  long infeasible() const {
    return std::count_if(missed_.begin(), missed_.end(), [](const auto& of_branch) { return !of_branch.empty(); });
  }

  void certify() {
    for (std::size_t b = 0; b < shape_.branches.size(); ++b) take_branch(static_cast<int>(b));
    for (const ShapeJunction& j : shape_.junctions) r_.junctions.push_back({Frame::looking(j.at, j.leaving[0]), j.branches, {}});
    r_.design = design_as_routed(r_);
    measure_wires();
    steps_.end("certificate", {{"violations", long(r_.misses.size())}});
    if (r_.misses.empty()) return;
    refuse("no harness was found that keeps all that is demanded; the nearest one has " + r_.misses.front());
  }

  void measure_wires() {
    const int wires = static_cast<int>(options_.wires.empty() ? options_.connections.size() - 1 : options_.wires.size());
    r_.wire_lengths.assign(wires, 0.0);
    for (const HarnessBranch& branch : r_.branches)
      for (const int wire : branch.wires) r_.wire_lengths[wire] += branch.length;
  }
  void take_branch(int number) {
    const ShapeBranch& shape = shape_.branches[number];
    HarnessBranch branch;
    branch.name = "branch " + std::to_string(number + 1);
    branch.from = shape.from;
    branch.to = shape.to;
    branch.wires = shape.wires;
    branch.factor = shape.factor;
    branch.points = shape.points;
    branch.length = shape.points.length();
    branch.violations = missed_[number];
    branch.min_bend_radius = shape.points.bends() ? *std::min_element(shape.points.radii.begin(), shape.points.radii.end())
                                                  : std::numeric_limits<double>::infinity();
    const PccDemands demands = demands_of(options_, shape);
    const FreeSpace& space = *r_.space;
    branch.clearance = smallest_gap(space, shape.points, demands.start_free(), demands.finish_free(), farthest_clearance, 1e-5);
    const int obstacle = branch.clearance.obstacle;
    if (obstacle >= 0) {
      branch.clearance_to = space.name(obstacle);
      if (obstacle < space.surroundings().size()) branch.clearance.value += space.surroundings().clearance(obstacle);
    }
    if (!branch.violations.empty())
      r_.misses.push_back(branch.name + " (" + name_of_end(options_, branch.from) + " to " + name_of_end(options_, branch.to) +
                          "): " + text_of(branch.violations.front(), space));
    const double preference = preference_along(space, shape.points);
    r_.preference += preference;
    r_.cost += shape.factor * (branch.length + preference);
    r_.harness_length += branch.length;
    r_.cable_length += branch.length * static_cast<double>(branch.wires.size());
    r_.branches.push_back(std::move(branch));
  }

  const Scene& scene_;
  HarnessResult& r_;
  const HarnessOptions& options_;
  const RunContext& context_;
  StepClock steps_;
  std::vector<Vec3> tips_;
  HarnessShape shape_;
  ShapeViolations missed_;
};

HarnessResult routed(const Scene& scene, const HarnessOptions& options, const RunContext& context) {
  HarnessResult result;
  result.options = options;
  HarnessRouting(scene, result, context).run();
  return result;
}

/// A routed harness at rest, refined where that is asked for. False: another route would not help.
bool come_to_rest(const Scene& scene, HarnessResult& r, bool clips_first, const RunContext& context) {
  StepClock steps(r.steps);
  bool may_help = false;
  if (r.options.refine) may_help = refine(scene, r, clips_first, context);
  else settle(scene, r, context);
  if (r.options.refine && context.stop()) r.refinement += std::string(r.refinement.empty() ? "" : "; ") + "refinement was cut short";
  const SceneEquilibrium& eq = *r.equilibrium;
  if (r.options.refine) steps.end("refinement", {{"equilibria", r.equilibria}, {"clips", long(r.design.clips.size())}});
  else steps.end("equilibrium", {{"rods", long(eq.rods.size())}, {"iterations", eq.iterations()}});
  r.seconds += steps.seconds();
  if (eq.ok()) return may_help;
  r.status = eq.status();
  if (eq.status() == Status::stalled || eq.status() == Status::infeasible)
    r.message = "the route keeps all that is demanded, but no equilibrium was found: " + eq.message();
  return false;
}

/// What is demanded of the next route, with in reserve what gravity took from this one and a little for the next. Of a bend radius not
/// all of it: clips have part in what is missed, and too large a reserve leaves no way.
HarnessOptions with_reserve(HarnessOptions options, const HarnessResult& r) {
  for (const HarnessBranch& branch : r.branches) {
    const double radius = r.options.min_bend_radius, gap = r.options.space.clearance;
    if (branch.settled_bend_radius < radius)
      options.min_bend_radius = std::max(options.min_bend_radius, radius * std::min(1.5, 1.02 + 0.7 * (radius / std::max(branch.settled_bend_radius, 1e-9) - 1)));
    if (branch.settled_clearance.obstacle >= 0 && branch.settled_clearance.value < gap)
      options.space.clearance = std::max(options.space.clearance, gap + std::min(0.02, 1.5 * (gap - branch.settled_clearance.value) + 1e-3));
  }
  return options;
}

/// Where the harness at rest misses something, other routes.
void restart(const Scene& scene, HarnessResult& best, const RunContext& context) {
  const HarnessOptions demanded = best.options;
  HarnessOptions stricter = demanded;
  HarnessResult last = best;
  for (int i = 1; i <= demanded.restarts && last.missed_share > 0 && !context.stop(); ++i) {
    const HarnessOptions before = stricter;
    stricter = with_reserve(stricter, last);
    if (stricter.min_bend_radius == before.min_bend_radius && stricter.space.clearance == before.space.clearance) return;
    HarnessResult other = routed(scene, stricter, context);
    best.seconds += other.seconds;
    if (other.status != Status::solved) return;
    const double begun = other.seconds;
    other.options = demanded;
    other.space = best.space;
    come_to_rest(scene, other, !best.design.clips.empty(), context);
    best.seconds += other.seconds - begun;
    last = other;
    other.restarts = i;
    if (!(missed_at_rest(other) < missed_at_rest(best))) continue;
    other.seconds = best.seconds;
    other.equilibria += best.equilibria;
    best = std::move(other);
  }
}

std::string counted(std::size_t n, const char* one, const char* more) { return std::to_string(n) + " " + (n == 1 ? one : more); }

void conclude(HarnessResult& r, const RunContext& context) {
  if (const auto stopped = context.stop(); stopped && r.status == Status::solved && !(r.equilibrium && r.equilibrium->ok())) r.status = *stopped;
  r.ok = r.status == Status::solved;
  if (r.status == Status::timeout || r.status == Status::cancelled)
    r.message = std::string(r.status == Status::timeout ? "out of time" : "cancelled") +
                (r.branches.empty() ? "; no route yet" : "; the route is there, its equilibrium is not");
  if (!r.ok) return;
  r.message = counted(r.branches.size(), "branch", "branches") + ", " + counted(r.junctions.size(), "junction", "junctions") + ", " +
              number_text(std::round(r.harness_length / units::mm)) + " mm of harness, " +
              number_text(std::round(r.cable_length / units::mm)) + " mm of wires";
  if (r.options.max_clips > 0 && r.equilibrium)
    r.message += ", " + std::to_string(r.design.clips.size()) + " of " + counted(r.options.max_clips, "clip", "clips");
  if (r.length_in_collision > 0) r.message += "; at rest " + mm(r.length_in_collision) + " of it penetrate obstacles";
  if (!r.settled_misses.empty()) r.message += "; at rest not all is kept: " + r.settled_misses.front();
  if (!r.refinement.empty() && r.missed_share > 0) r.message += " (" + r.refinement + ")";
}

}  // namespace


HarnessResult route_harness(const Scene& scene, const HarnessOptions& options, const RunContext& context) {
  check(options);
  HarnessOptions own = options;
  own.space.radius = options.section.radius();
  HarnessResult result = routed(scene, own, context);
  if (result.status == Status::solved && own.equilibrium) {
    if (come_to_rest(scene, result, false, context)) restart(scene, result, context);
  }
  conclude(result, context);
  return result;
}

}  // namespace tendril::routing
