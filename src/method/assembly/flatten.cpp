#include "method/assembly/flatten.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "method/assembly/board_crossings.h"
#include "method/assembly/board_layout.h"
#include "method/assembly/board_press.h"
#include "method/assembly/installed_system.h"

namespace tendril::assembly {

namespace {

// What still counts as lying in the plane, as a share of the longest rod.
constexpr double flat_enough = 1e-6;

/// The routed configuration on a mesh that stays, and its problem without holds, gravity and surroundings.
struct Unrouted {
  SystemProblem free;
  SystemEquilibrium routed;
  std::vector<std::string> rods, branches;  ///< names
  double radius = 0;                        ///< m, of the thickest rod
  std::vector<PlacedObstacle> obstacles;
};

Unrouted unrouted(const Scene& scene, const FlattenOptions& options, const RunContext& context) {
  const Scene::System system = system_of(scene, options.rods, "flatten");
  Unrouted out;
  const SceneEquilibrium routed = scene.solve({}, context);
  out.free = system.problem;
  if (const auto part = routed.part(routed, system.rods, system.branches)) out.routed = *part;
  for (std::size_t k = 0; k < system.rods.size(); ++k) {
    RodProblem& rod = out.free.rods[k];
    out.rods.push_back(scene.rods()[system.rods[k]]->name());
    out.radius = std::max(out.radius, rod.rod.largest_radius());
    rod.holds.clear();
    rod.fastenings.clear();
    rod.loads.clear();
    rod.gravity = Vec3::Zero();
    rod.surroundings = nullptr;
  }
  for (std::size_t b = 0; b < system.branches.size(); ++b) {
    out.branches.push_back(scene.branches()[system.branches[b]]->name);
    out.free.branches[b].position = out.free.branches[b].orientation = false;
  }
  return out;
}

std::string node_name(const Unrouted& system, const BoardNode& node) {
  if (node.branch >= 0) return system.branches[node.branch];
  return system.rods[node.rod] + (node.at <= 0 ? ".start" : ".finish");
}

double longest_rod(const SystemProblem& problem) {
  double longest = 0;
  for (const RodProblem& rod : problem.rods) longest = std::max(longest, rod.rod.length);
  return longest;
}

/// Moves the drawing so that its longer side lies along x and its corner in the origin.
void square_up(SystemEquilibrium& state) {
  Vec3 middle = Vec3::Zero();
  double count = 0;
  for (const Equilibrium& rod : state.rods)
    for (const Vec3& p : rod.points) middle += p, ++count;
  middle /= count;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Equilibrium& rod : state.rods)
    for (const Vec3& p : rod.points) spread += (p - middle).head<2>() * (p - middle).head<2>().transpose();
  double angle = 0.5 * std::atan2(2 * spread(0, 1), spread(0, 0) - spread(1, 1));
  // The first rod leads from left to right, or upwards.
  const Vec3 chord = state.rods.front().points.back() - state.rods.front().points.front();
  const double along = chord.x() * std::cos(angle) + chord.y() * std::sin(angle);
  if (along < 0) angle += units::pi;
  const Quat turn = exp_rotation(-angle * Vec3::UnitZ());
  Vec3 low = Vec3::Constant(INFINITY);
  for (const Equilibrium& rod : state.rods)
    for (const Vec3& p : rod.points) low = low.cwiseMin(turn * p);
  move_rigidly(state, {{-low.x(), -low.y(), 0}, turn});
}

void describe(const Unrouted& system, const BoardGraph& graph, SystemEquilibrium state, FlattenResult& r) {
  for (std::size_t k = 0; k < state.rods.size(); ++k) {
    const Equilibrium& rod = state.rods[k];
    r.lines.push_back({system.rods[k], rod.settled_length(), system.free.rods[k].rod.length, rod.points});
    r.worst_strain = std::max(r.worst_strain, rod.largest_strain());
    for (const Vec3& p : rod.points) {
      r.width = std::max(r.width, p.x());
      r.height = std::max(r.height, p.y());
    }
  }
  for (const BoardNode& node : graph.nodes) r.points.push_back({node_name(system, node), place_of(node, state)});
  auto equilibrium = std::make_shared<SceneEquilibrium>();
  std::vector<int> rods, branches;
  for (std::size_t k = 0; k < system.rods.size(); ++k) {
    equilibrium->rods.push_back({system.rods[k], system.free.rods[k], {}, {}});
    rods.push_back(static_cast<int>(k));
  }
  for (std::size_t b = 0; b < system.branches.size(); ++b) {
    equilibrium->branches.push_back({system.branches[b], {}, {}});
    branches.push_back(static_cast<int>(b));
  }
  equilibrium->take(std::move(state), rods, branches);
  equilibrium->systems.push_back({system.free, rods, branches});
  r.equilibrium = std::move(equilibrium);
}

std::string pair_of(const Unrouted& system, int a, int b) {
  return a == b ? "'" + system.rods[a] + "' with itself" : "'" + system.rods[a] + "' and '" + system.rods[b] + "'";
}

/// What is wrong with the drawing, or what is to be said about it.
void judge(const Unrouted& system, const BoardGraph& graph, const BoardCrossings& found, bool pegged, double off, double spacing, FlattenResult& r) {
  const std::string loop = graph.has_loop() ? "; the rods form a loop, which lies as it can: it is not drawn anew" : "";
  r.crossings = found.crossings;
  if (off > flat_enough) {
    r.status = Status::stalled;
    r.message = "it does not come to lie flat: the farthest place is " + number_text(off * longest_rod(system.free) / units::mm) + " mm off the board";
  } else if (found.crossings > 0) {
    r.status = Status::infeasible;
    r.message = std::to_string(found.crossings) + " crossings; the first: " + pair_of(system, found.rod_a, found.rod_b) + loop;
  } else if (found.near) {
    r.status = Status::infeasible;
    r.message = pair_of(system, found.near_a, found.near_b) + " come within " + number_text(found.distance / units::mm) + " mm, wanted are " +
                number_text(spacing / units::mm) + " mm" + loop;
  } else {
    r.ok = true;
    r.status = Status::solved;
    r.message = pegged ? "held apart by pegs at junctions and ends: by itself it crosses or lies too near to itself" : "lies on the board by itself";
    r.message += loop;
  }
  if (r.worst_strain > 1e-4) r.message += "; lying flat strains it by " + number_text(100 * r.worst_strain) + " %";
}

FlattenResult stopped_or(const RunContext& context, FlattenResult r, Status status, const std::string& message) {
  const auto stopped = context.stop();
  r.status = stopped ? *stopped : status;
  r.message = stopped ? std::string(*stopped == Status::timeout ? "out of time" : "cancelled") : message;
  return r;
}

}  // namespace

FlattenResult flatten(const Scene& scene, const FlattenOptions& options, const RunContext& context) {
  if (!(std::isfinite(options.spacing) && options.spacing >= 0)) throw UsageError("flatten: 'spacing' must be a finite number of at least 0");
  FlattenResult r;
  StepClock clock(r.steps);
  Unrouted system = unrouted(scene, options, context);
  if (!system.routed.ok())
    return stopped_or(context, std::move(r), Status::stalled, "the routed configuration has no equilibrium: " + (system.routed.rods.empty() ? std::string() : system.routed.rods.front().message));
  keep_vertices(system.free, system.routed);
  const BoardGraph graph = board_graph(system.free);
  clock.end("routed_configuration", {{"rods", long(system.rods.size())}, {"junctions", long(system.branches.size())}});

  const Relaxed relaxed = relaxed_on_board(system.free, system.routed, context);
  clock.end("constraint_relaxation", {{"solves", relaxed.solves}});
  r.seconds = clock.seconds();
  if (!relaxed.ok) return stopped_or(context, std::move(r), Status::stalled, "it does not relax: " + relaxed.message);

  const double spacing = options.spacing > 0 ? options.spacing : 4 * system.radius, size = longest_rod(system.free);
  Pressed pressed = pressed_flat(system.free, relaxed.state, {}, context);
  BoardCrossings found = board_crossings(graph, pressed.state, spacing);
  clock.end("plane", {{"solves", pressed.solves}, {"crossings", found.crossings}});
  bool pegged = false;
  if (pressed.ok && (found.crossings > 0 || found.near)) {
    const std::vector<Vec3> layout = board_layout(graph, relaxed.state);
    if (!layout.empty()) {
      const Pressed apart = pressed_flat(system.free, relaxed.state, pegs_of(system.free, graph, layout), context);
      const BoardCrossings still = board_crossings(graph, apart.state, spacing);
      clock.end("layout", {{"solves", apart.solves}, {"crossings", still.crossings}});
      if (apart.ok && (still.crossings < found.crossings || (still.crossings == found.crossings && !still.near))) {
        pressed = apart;
        found = still;
        pegged = true;
      }
    }
  }
  r.seconds = clock.seconds();
  if (context.stop() || !pressed.ok) return stopped_or(context, std::move(r), Status::stalled, "it does not come to lie flat: " + pressed.message);
  square_up(pressed.state);
  describe(system, graph, pressed.state, r);
  judge(system, graph, found, pegged, pressed.off / size, spacing, r);
  return r;
}

}  // namespace tendril::assembly
