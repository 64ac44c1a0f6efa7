// Tolerance envelopes of 1000 outcomes, by voxel: three hoses in a T and a harness of 30 rods, solved in every call, and another
// harness of 30 rods moved by smooth random modes, at no cost. `cpu_ms`: processor time of all threads for the envelope, fastest call; `all_cpu_ms` and
// `all_wall_ms`: with solving and collecting; `first_ms`: wall time of the first such call with new memory. `error_mean_mm`,
// `error_max_mm`: distance of the vertices from the surface at 1 mm; `beyond_union`: per cent of the volume, by sampling,
// that no outcome's capsules fill: convex hulls, the directions' planes, margin and grid together.
#include <benchmark/benchmark.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <random>

#include "base/units.h"
#include "bench/tee_problem.h"
#include "geometry/distance_tree.h"
#include "geometry/inside_test.h"
#include "method/envelope/envelope.h"

namespace {

using namespace tendril;

double process_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

/// Rods that start as straight lines and are moved by a few smooth modes, each with its own random weight an outcome.
struct Family {
  std::vector<EnvelopeRod> rods;
  std::vector<std::vector<double>> points;  ///< by outcome * rods + rod
  int outcomes = 0;

  std::span<const double> operator()(int outcome, int rod) const { return points[outcome * rods.size() + rod]; }
};

struct Line {
  Vec3 from, to;
  double radius;
  int segments;
};

Family family(const std::vector<Line>& lines, int outcomes, double spread) {
  Family family;
  family.outcomes = outcomes;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(-1, 1);
  for (const Line& line : lines) family.rods.push_back({std::vector<double>(line.segments, line.radius), 1});
  for (int k = 0; k < outcomes; ++k)
    for (const Line& line : lines) {
      const double length = (line.to - line.from).norm();
      Vec3 modes[3];
      for (Vec3& mode : modes) mode = spread * Vec3(share(random), share(random), share(random));
      std::vector<double> points;
      for (int i = 0; i <= line.segments; ++i) {
        const double s = static_cast<double>(i) / line.segments;
        Vec3 p = line.from + s * (line.to - line.from) - Vec3(0, 0, 0.4 * length * s * (1 - s));
        for (int m = 0; m < 3; ++m) p += modes[m] * std::sin((m + 1) * units::pi * s) / ((m + 1) * (m + 1));
        points.insert(points.end(), {p.x(), p.y(), p.z()});
      }
      family.points.push_back(std::move(points));
    }
  return family;
}

/// 30 rods of 40 segments over 2 m.
Family harness() {
  std::vector<Line> lines;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 30; ++k) {
    const Vec3 from(0.07 * k, 0.3 * share(random), 0.2 * share(random));
    lines.push_back({from, from + Vec3(0.1 * share(random), 0.35 + 0.2 * share(random), 0.2 * share(random)), 0.006 + 0.004 * share(random), 40});
  }
  return family(lines, 1000, 0.03);
}

RunContext threads(int count) {
  RunContext context;
  context.threads = count;
  return context;
}

/// Where the vertices lie against a finer mesh.
void measure_error(benchmark::State& state, const Mesh& mesh, const Mesh& finer) {
  const DistanceTree tree(finer);
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / 20000);
  double sum = 0, largest = 0;
  int count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += step, ++count) {
    const double distance = tree.closest(mesh.vertices[v]).distance;
    sum += distance;
    largest = std::max(largest, distance);
  }
  state.counters["error_mean_mm"] = 1e3 * sum / count;
  state.counters["error_max_mm"] = 1e3 * largest;
}

bool within_some_outcome(const EnvelopeOutcomes& outcomes, const std::vector<EnvelopeOutcomes::Chord>& chords,
                         const std::vector<Eigen::AlignedBox3f>& boxes, const Vec3& point) {
  const Eigen::Vector3f p = (point - outcomes.origin()).cast<float>();
  for (std::size_t c = 0; c < chords.size(); ++c) {
    const auto radius = static_cast<float>(chords[c].radius);
    if (boxes[c].exteriorDistance(p) > radius) continue;
    const envelope::PointArrays from = outcomes.places(chords[c].node), to = outcomes.places(chords[c].node + 1);
    for (int k = 0; k < outcomes.size(); ++k) {
      const Eigen::Vector3f a(from.x[k], from.y[k], from.z[k]), along = Eigen::Vector3f(to.x[k], to.y[k], to.z[k]) - a;
      const float share = std::clamp(along.dot(p - a) / along.squaredNorm(), 0.0f, 1.0f);
      if ((p - a - share * along).squaredNorm() <= radius * radius) return true;
    }
  }
  return false;
}

double beyond_union(const Mesh& mesh, const EnvelopeOutcomes& outcomes) {
  const std::vector<EnvelopeOutcomes::Chord> chords = outcomes.chords();
  std::vector<Eigen::AlignedBox3f> boxes(chords.size());
  for (std::size_t c = 0; c < chords.size(); ++c)
    for (const int node : {chords[c].node, chords[c].node + 1}) {
      const envelope::PointArrays places = outcomes.places(node);
      for (int k = 0; k < outcomes.size(); ++k) boxes[c].extend(Eigen::Vector3f(places.x[k], places.y[k], places.z[k]));
    }
  const InsideTest test(mesh);
  const Eigen::AlignedBox3d box = mesh.box();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  int inside = 0, filled = 0;
  while (inside < 20000) {
    const Vec3 p = box.min() + box.sizes().cwiseProduct(Vec3(share(random), share(random), share(random)));
    if (!test.inside(p)) continue;
    ++inside;
    filled += within_some_outcome(outcomes, chords, boxes, p);
  }
  return 100.0 * (inside - filled) / inside;
}

/// Outcomes as they come: collects them, in the way of the family.
using Collect = std::function<void(EnvelopeOutcomes&, const RunContext&)>;

double first_call_ms(const std::vector<EnvelopeRod>& rods, const Collect& collect, double voxel, int workers) {
  double first = INFINITY;
  for (int round = 0; round < 3; ++round) {
    const auto begun = RunContext::Clock::now();
    EnvelopeBuilder builder;
    EnvelopeOutcomes outcomes(rods);
    collect(outcomes, threads(workers));
    EnvelopeOptions options;
    options.voxel = voxel;
    benchmark::DoNotOptimize(builder.build(outcomes, options, threads(workers)));
    first = std::min(first, 1e3 * std::chrono::duration<double>(RunContext::Clock::now() - begun).count());
  }
  return first;
}

void run(benchmark::State& state, const std::vector<EnvelopeRod>& rods, const Collect& collect, double voxel, int workers) {
  state.counters["first_ms"] = first_call_ms(rods, collect, voxel, workers);
  EnvelopeBuilder builder;
  EnvelopeOutcomes outcomes(rods);
  EnvelopeOptions options;
  options.voxel = voxel;
  Envelope envelope;
  double fastest = INFINITY, building = INFINITY, wall = INFINITY, build_wall = INFINITY;
  std::vector<double> steps;
  collect(outcomes, threads(workers));
  builder.build(outcomes, options, threads(workers), envelope);  // large ones get but one round: that is not to be the cold one
  for (auto _ : state) {
    const double before = process_seconds();
    const auto begun = RunContext::Clock::now();
    outcomes.clear();
    collect(outcomes, threads(workers));
    const double collected = process_seconds();
    RunContext context = threads(workers);
    std::vector<double> begun_steps;
    context.progress = [&](double, const char*) { begun_steps.push_back(process_seconds()); };
    builder.build(outcomes, options, context, envelope);
    begun_steps.push_back(process_seconds());
    building = std::min(building, process_seconds() - collected);
    build_wall = std::min(build_wall, envelope.seconds);
    fastest = std::min(fastest, process_seconds() - before);
    wall = std::min(wall, std::chrono::duration<double>(RunContext::Clock::now() - begun).count());
    steps.resize(envelope.steps.size(), INFINITY);
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = std::min(steps[i], begun_steps[i + 1] - begun_steps[i]);
  }
  state.counters["all_cpu_ms"] = 1e3 * fastest;
  state.counters["all_wall_ms"] = 1e3 * wall;
  state.counters["cpu_ms"] = 1e3 * building;
  state.counters["build_wall_ms"] = 1e3 * build_wall;
  for (std::size_t i = 0; i < steps.size(); ++i) state.counters[envelope.steps[i].name + "_ms"] = 1e3 * steps[i];
  state.counters["triangles"] = static_cast<double>(envelope.mesh.triangles.size());
  state.counters["volume_dm3"] = 1e3 * envelope.volume;
  state.counters["planes"] = envelope.planes / static_cast<double>(envelope.hulls);
  state.counters["blocks"] = envelope.blocks;
  state.counters["scratch_MB"] = 1e-6 * (static_cast<double>(envelope.scratch_bytes) + static_cast<double>(outcomes.bytes()));
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);  // a peak of the whole program: run one benchmark alone to read it
  const double resident = usage.ru_maxrss / 1024.0;
  if (workers == 1) {
    EnvelopeOptions finest;
    finest.voxel = 1e-3;
    measure_error(state, envelope.mesh, builder.build(outcomes, finest).mesh);
    state.counters["beyond_union"] = beyond_union(envelope.mesh, outcomes);
  }
  state.counters["resident_MB"] = resident;
}

/// Solved anew in every call: 8 segments a hose, cut into 5 pieces for the envelope; 120 pieces of 12.5 mm in all.
void envelope_tee(benchmark::State& state) {
  const SystemProblem nominal = bench::tee(8);
  const Batch batch(nominal);
  const Batch::Fill fill = bench::tee_outcomes(nominal);
  const std::vector<EnvelopeRod> rods(3, {std::vector<double>(8, 0.013), 5});
  BatchResults results;
  const Collect collect = [&](EnvelopeOutcomes& outcomes, const RunContext& context) {
    batch.solve(1000, fill, results, context);
    outcomes.add(results, nullptr, context);
  };
  run(state, rods, collect, 1e-3 * static_cast<double>(state.range(0)), static_cast<int>(state.range(1)));
}
BENCHMARK(envelope_tee)->ArgNames({"voxel_mm", "threads"})->ArgsProduct({{8, 4, 2, 1}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

void envelope_harness(benchmark::State& state) {
  const Family harness_family = harness();
  const Collect collect = [&](EnvelopeOutcomes& outcomes, const RunContext& context) {
    outcomes.add_points(harness_family.outcomes, harness_family, context);
  };
  run(state, harness_family.rods, collect, 1e-3 * static_cast<double>(state.range(0)), static_cast<int>(state.range(1)));
}
BENCHMARK(envelope_harness)->ArgNames({"voxel_mm", "threads"})->ArgsProduct({{4, 2}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

/// Solved anew in every call: 30 hoses in ten T pieces, lengths within 10 mm, connections within a cone of 5 degrees; 1200
/// pieces of 12.5 mm in all.
void envelope_harness_solved(benchmark::State& state) {
  const SystemProblem nominal = bench::tees(10, 8);
  const Batch batch(nominal);
  const Batch::Fill fill = bench::tee_outcomes(nominal, 0.01, 5);
  const std::vector<EnvelopeRod> rods(30, {std::vector<double>(8, 0.013), 5});
  BatchResults results;
  int added = 0;
  const Collect collect = [&](EnvelopeOutcomes& outcomes, const RunContext& context) {
    batch.solve(1000, fill, results, context);
    outcomes.add(results, &added, context);
  };
  run(state, rods, collect, 1e-3 * static_cast<double>(state.range(0)), static_cast<int>(state.range(1)));
  state.counters["solved"] = added;
}
BENCHMARK(envelope_harness_solved)->ArgNames({"voxel_mm", "threads"})->ArgsProduct({{2}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
