// Robot paths for a dress pack: builtin:six_axis with a hose of 1.6 m (EI 2 and GJ 1.4 N m^2, EA 20 kN, 15 N/m) from its upper arm to
// its hand, 16 elements. `problematic`: wrung through 160 + 50 degrees and pulled taut on the way; `taut`: pulled taut; `easy`: neither.
// Counters: largest force of a hold before and after, N; objective; iterations. `cpu` of optimise() holds the simulations of the path
// before and after as well; `search_ms` is the optimisation alone, the fastest of the run.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "geometry/surroundings.h"
#include "method/dress_pack/pack_bodies.h"
#include "method/dress_pack/reduced.h"
#include "robot/load_robot.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::dress_pack;
using tendril::test::degrees;

namespace {

PackProblem six_axis_hose(int segments) {
  PackProblem pack;
  pack.robot = load_robot("builtin:six_axis");
  pack.rods = {test::hose(1.6, segments)};
  pack.attachments = {{0, 0, pack.robot->link("link_2"), Frame::looking({0.05, 0.2, 0.75}, {1, 0, 1}, {0, 0, 1})},
                      {0, 1, pack.robot->link("link_6"), Frame::looking({0.05, 0, 0.15}, {1, 0, 0}, {0, 0, 1})}};
  return pack;
}

enum Case { problematic, taut, easy };

JointPath path_of(int which, int via = 8) {
  const JointVector start = degrees({0, 0, 0, 0, 0, 0});
  if (which == problematic) return JointPath({start, degrees({30, 10, -80, 80, 45, 25}), degrees({60, 0, -10, 160, 0, 50})}).resampled(via);
  if (which == taut) return JointPath({start, degrees({30, 10, -75, 20, 40, 0}), degrees({60, 0, 0, 0, 0, 0})}).resampled(via);
  return JointPath({start, degrees({30, 5, -20, 20, 10, 10}), degrees({60, 0, 0, 40, 0, 0})}).resampled(via);
}

ReducedOptions options_of(int steps = 40) {
  ReducedOptions options;
  options.steps = steps;
  options.demands.force = {50, 50};
  options.demands.twist = {2, 0.5};
  options.demands.curvature = {8, 2};
  return options;
}

void optimised(benchmark::State& run, int which) {
  const PackProblem pack = six_axis_hose(16);
  const JointPath path = path_of(which);
  ReducedResult found;
  double search = 1e9;
  for (auto _ : run) {
    found = optimise(pack, path, options_of());
    search = std::min(search, found.search_seconds);
  }
  if (!found.ok()) run.SkipWithError(found.message.c_str());
  run.counters["search_ms"] = 1e3 * search;
  run.counters["iterations"] = found.iterations;
  run.counters["f_before"] = found.objective_before;
  run.counters["f"] = found.objective;
  run.counters["N_before"] = found.before.largest_end_force();
  run.counters["N_after"] = found.after.largest_end_force();
}

void path_problematic(benchmark::State& run) { optimised(run, problematic); }
void path_taut(benchmark::State& run) { optimised(run, taut); }
void path_easy(benchmark::State& run) { optimised(run, easy); }
BENCHMARK(path_problematic)->Unit(benchmark::kMillisecond);
BENCHMARK(path_taut)->Unit(benchmark::kMillisecond);
BENCHMARK(path_easy)->Unit(benchmark::kMillisecond);

/// A box of 12 n^2 triangles.
void add_box(const Vec3& middle, const Vec3& size, int n, Mesh& mesh) {
  const auto face = [&](const Vec3& corner, const Vec3& a, const Vec3& b) {
    const int first = static_cast<int>(mesh.vertices.size());
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) mesh.vertices.push_back(corner + a * (double(i) / n) + b * (double(j) / n));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int v = first + i * (n + 1) + j;
        mesh.triangles.push_back({v, v + n + 1, v + n + 2});
        mesh.triangles.push_back({v, v + n + 2, v + 1});
      }
  };
  const Vec3 half = size / 2, x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  face(middle - half, y, x), face(middle - half, x, z), face(middle - half, z, y);
  face(middle + half, -x, -y), face(middle + half, -z, -x), face(middle + half, -y, -z);
}

void add_link(const char* name, PackProblem& pack) {
  const int link = pack.robot->link(name);
  for (const LinkShape& shape : pack.robot->links()[link].collision) {
    PackBody body{{{}, shape.pose, 0, name}, link};
    if (const auto* mesh = std::get_if<0>(&shape.shape)) body.body.shape = (*mesh)->surface();
    else body.body.shape = std::get<1>(shape.shape);
    pack.bodies.push_back(std::move(body));
  }
}

/// The pack with its hand's links in a cell of 124,800 triangles: a table, a wall, and two posts whose tops are 10 mm under the hose on
/// the best path without them. The links do not come near.
PackProblem in_cell(int which) {
  PackProblem pack = six_axis_hose(16);
  const ReducedResult free = optimise(pack, path_of(which), options_of());
  Mesh cell;
  for (const int k : {13, 22}) {
    const RodState& state = free.after.steps[k].state;
    const auto low = std::min_element(state.r.begin(), state.r.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    const double top = low->z() - 0.025;
    add_box({low->x(), low->y(), top / 2}, {0.06, 0.06, top}, 40, cell);
  }
  add_box({1.2, -1.2, 0.4}, {0.8, 0.8, 0.8}, 60, cell);
  add_box({0.5, 2.2, 1.0}, {2, 0.1, 2.0}, 60, cell);
  pack.bodies = {{{std::make_shared<const TriangleSurface>(std::move(cell)), {}, 0, "cell"}}};
  for (const char* name : {"link_5", "link_6"}) add_link(name, pack);
  return pack;
}

/// The same cell with a plate in it, 10 mm under the lowest corner of the boxes about the hand half way on the best path without bodies:
/// 129,600 triangles, and the links come near.
PackProblem over_plate(int which) {
  PackProblem pack = in_cell(which);
  PackProblem bare = pack;
  bare.bodies.clear();
  const ReducedResult free = optimise(bare, path_of(which), options_of());
  const PackBodies bodies(pack);
  std::vector<BodyPose> at;
  bodies.poses(free.after.steps[20].q, at);
  Vec3 lowest(0, 0, 1e9);
  for (int b = 1; b < bodies.size(); ++b)
    for (int c = 0; c < 8; ++c) {
      const Vec3 corner = at[b].to_world(bodies.own_box(b).corner(static_cast<Eigen::AlignedBox3d::CornerType>(c)));
      if (corner.z() < lowest.z()) lowest = corner;
    }
  Mesh cell = std::get<0>(pack.bodies[0].body.shape)->mesh();
  add_box(lowest - Vec3(0, 0, 0.04), {0.3, 0.3, 0.06}, 20, cell);
  pack.bodies[0].body.shape = std::make_shared<const TriangleSurface>(std::move(cell));
  return pack;
}

/// Hose so much (negative: it is not looked at), links 30 mm clear of the cell. The mark is the search; verification is a simulation of 200 steps among the bodies.
void clear_of(benchmark::State& run, const PackProblem& pack, int which, double hose_clearance, int steps) {
  ReducedOptions options = options_of(steps);
  options.demands.clearance = hose_clearance;
  options.demands.robot_clearance = 0.03;
  ReducedResult found;
  double search = 1e9;
  for (auto _ : run) {
    found = optimise(pack, path_of(which), options);
    search = std::min(search, found.search_seconds);
  }
  if (!found.ok()) run.SkipWithError(found.message.c_str());
  run.counters["search_ms"] = 1e3 * search;
  run.counters["iterations"] = found.iterations;
  run.counters["f"] = found.objective;
  run.counters["clear_mm"] = 1e3 * found.clearance;
  run.counters["links_mm"] = 1e3 * found.robot_clearance;
}
void clear_of_cell(benchmark::State& run) { clear_of(run, in_cell(static_cast<int>(run.range(0))), static_cast<int>(run.range(0)), 0.03, 40); }
void links_near_cell(benchmark::State& run) { clear_of(run, over_plate(problematic), problematic, -1, 40); }
BENCHMARK(clear_of_cell)->ArgName("path")->Arg(problematic)->Arg(easy)->Unit(benchmark::kMillisecond);
BENCHMARK(links_near_cell)->Unit(benchmark::kMillisecond);

/// Gradient and second derivative at 40 time steps, and the gradient alone.
void derivatives(benchmark::State& run) {
  const PackProblem pack = six_axis_hose(16);
  const ReducedOptions options = options_of();
  ReducedProblem problem(pack, path_of(easy), options.steps, options.demands, options.weights);
  if (!problem.start({}).ok()) return run.SkipWithError("not followed");
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  for (auto _ : run) {
    const bool ok = run.range(0) ? problem.derivatives(gradient, hessian, {}) : problem.gradient(gradient);
    if (!ok) run.SkipWithError("not stable");
  }
}
BENCHMARK(derivatives)->ArgName("second")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void simulated(benchmark::State& run) {
  PackProblem pack = six_axis_hose(static_cast<int>(run.range(0)));
  if (run.range(1)) pack.bodies = {{{Box{{0.6, 0.6, 1.2}}, {{1.2, 0.35, 0.9}, Quat::Identity()}, 0, "fixture"}}};
  const JointPath path = path_of(static_cast<int>(run.range(2)));
  PackMotion motion;
  for (auto _ : run) motion = simulate(pack, path, {200});
  if (!motion.ok()) run.SkipWithError(motion.message.c_str());
  run.counters["us_a_step"] = benchmark::Counter(200e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  run.counters["N"] = motion.largest_end_force();
  if (run.range(1)) run.counters["clearance_mm"] = 1e3 * motion.smallest_clearance();
  run.counters["snaps"] = static_cast<double>(motion.snaps.size());
  run.counters["solves"] = motion.iterations;
}
BENCHMARK(simulated)->ArgNames({"segments", "contact", "path"})->Args({16, 0, easy})->Args({32, 0, easy})->Args({16, 0, problematic})->Args({16, 1, easy})->Unit(benchmark::kMillisecond);

enum Pressed { forearm, links };

/// Something that the hose rests on all along the easy path: a round forearm, or the meshes of the arm's last links.
PackProblem pressed_hose(int on) {
  PackProblem pack = six_axis_hose(16);
  if (on == forearm) {
    const Quat along = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
    pack.bodies = {{{Cylinder{0.12, 1.0}, {{0.5, 0, 0.1}, along}, 0, "forearm"}, pack.robot->link("link_3")}};
  } else {
    for (const char* name : {"link_3", "link_4", "link_5"}) add_link(name, pack);
  }
  return pack;
}

/// Steps that touch, solutions with contact, and factorisations for each.
void pressed(benchmark::State& run) {
  const PackProblem pack = pressed_hose(static_cast<int>(run.range(0)));
  PackMotion motion;
  for (auto _ : run) motion = simulate(pack, path_of(easy), {200});
  if (!motion.ok()) run.SkipWithError(motion.message.c_str());
  run.counters["touching"] = static_cast<double>(std::count_if(motion.steps.begin(), motion.steps.end(), [](const PackStep& step) { return !step.rods[0].contacts.empty(); }));
  run.counters["solutions"] = motion.contact_solutions;
  run.counters["passes"] = static_cast<double>(motion.iterations) / motion.contact_solutions;
  run.counters["snaps"] = static_cast<double>(motion.snaps.size());
  run.counters["clearance_mm"] = 1e3 * motion.smallest_clearance();
}
BENCHMARK(pressed)->ArgName("on")->Arg(forearm)->Arg(links)->Unit(benchmark::kMillisecond);

/// Error against run time: the objective of one path and the largest force of a hold, against the time steps and elements that judge it.
void judged(benchmark::State& run) {
  const PackProblem pack = six_axis_hose(static_cast<int>(run.range(0)));
  const ReducedOptions options = options_of(static_cast<int>(run.range(1)));
  double objective = 0;
  for (auto _ : run) {
    ReducedProblem problem(pack, path_of(taut), options.steps, options.demands, options.weights);
    if (!problem.start({}).ok()) run.SkipWithError("not followed");
    objective = problem.objective();
  }
  run.counters["f"] = objective;
  run.counters["N"] = simulate(pack, path_of(taut), {options.steps}).largest_end_force();
}
BENCHMARK(judged)->ArgNames({"segments", "steps"})->Args({16, 20})->Args({16, 40})->Args({16, 80})->Args({16, 200})->Args({16, 800})
    ->Args({32, 40})->Args({32, 200})->Args({64, 40})->Args({64, 200})->Args({128, 800})->Unit(benchmark::kMillisecond);

}  // namespace
