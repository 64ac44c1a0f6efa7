// Variation simulation of three coolant hoses that meet in a T: lengths within 50 mm, connections within a cone of 15 degrees,
// 1000 outcomes with three measures. `fastest_ms`: setting up and solving all of it, the shortest of the runs; `outcomes_ms`: of
// that the outcomes alone. variation_harness_1000: 30 rods of 40 segments, 45 numbers vary, 90 measures.
// error_against_time: the interval of a mean at 95 % (half its width) by way of drawing and number of outcomes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/units.h"
#include "method/variation/whole_study.h"

namespace {

using namespace tendril;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Hoses of 26 mm over 18 mm, half a metre each, from three connections to the T, whose third arm is square to the others.
Scene tee() {
  Scene scene({0, 0, -9.81});
  const Section section = Section::round(0.026, 0.018, Material::from_poisson(5e6, 0.5, 1150));
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  const Rod design = Rod::uniform(0.5, section, 8);
  PlacedRod& a = scene.add(PlacedRod("a", design, start, std::nullopt));
  PlacedRod& b = scene.add(PlacedRod("b", design, std::nullopt, start.moved({0.86, 0.10, 0.10})));
  PlacedRod& c = scene.add(PlacedRod("c", design, std::nullopt, Frame::looking({0.42, 0.50, -0.15}, {0, 1, 0}, {0, 0, 1})));
  scene.join("tee", {{&a, 0.5, Frame{{0, 0, -0.015}, Quat::Identity()}},
                     {&b, 0, Frame{{0, 0, 0.015}, Quat::Identity()}},
                     {&c, 0, Frame{{0, 0.015, 0}, exp_rotation({-0.5 * units::pi, 0, 0})}}}, std::nullopt);
  return scene;
}

variation::Options tolerances(int outcomes, variation::Sampling sampling) {
  variation::Options options;
  for (const auto& [hose, end] : {std::pair{"a", ".from"}, std::pair{"b", ".to"}, std::pair{"c", ".to"}}) {
    variation::Variable length, connection;
    length.name = hose + std::string(".length");
    length.tolerance = 0.05;
    length.spread = variation::Spread::uniform;
    connection.name = hose + std::string(end);
    connection.cone = 15 * units::deg;
    options.vary.push_back(length);
    options.vary.push_back(connection);
  }
  for (const char* name : {"a.min_bend_radius", "b.max_tension", "c.length"}) {
    variation::MeasureRequest measure;
    measure.name = name;
    options.measures.push_back(measure);
  }
  options.outcomes = outcomes;
  options.sampling = sampling;
  return options;
}

void tee_1000(benchmark::State& state) {
  const Scene scene = tee();
  const variation::Options options = tolerances(1000, variation::Sampling::random);
  RunContext context;
  context.threads = static_cast<int>(state.range(0));
  double whole = INFINITY, outcomes = INFINITY;
  for (auto _ : state) {
    const double begin = seconds();
    const variation::Study study(scene, options, context);
    const double middle = seconds();
    const variation::Outcomes found = study.run(0, options.outcomes, {}, context);
    const double end = seconds();
    whole = std::min(whole, end - begin);
    outcomes = std::min(outcomes, end - middle);
    if (found.count(variation::OutcomeStatus::solved) != options.outcomes) state.SkipWithError(variation::summary(found).c_str());
  }
  state.counters["fastest_ms"] = 1e3 * whole;
  state.counters["outcomes_ms"] = 1e3 * outcomes;
}
BENCHMARK(tee_1000)->Name("variation_tee_1000")->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A trunk of 15 pieces with a twig at every joint and two at the last: 30 rods of 40 segments, held at all free ends.
Scene harness() {
  Scene scene({0, 0, -9.81});
  const Section section = Section::round(0.012, 0, Material::from_poisson(2e7, 0.4, 1300));
  constexpr int joints = 14;
  constexpr double step = 0.1, slack = 1.02;  // of the twigs
  std::vector<PlacedRod*> trunk, twigs;
  const auto along = [](const Vec3& at, const Vec3& d3) { return Frame::looking(at, d3, {0, 0, 1}); };
  for (int k = 0; k <= joints; ++k) {
    const std::optional<Frame> from = k == 0 ? std::optional(along({0, 0, 0}, {1, 0, 0})) : std::nullopt;
    const std::optional<Frame> to = k == joints ? std::optional(along({step * (joints + 1), 0, 0}, {1, 0, 0})) : std::nullopt;
    trunk.push_back(&scene.add(PlacedRod("trunk" + std::to_string(k), Rod::uniform(step, section, 40), from, to)));
  }
  for (int k = 0; k <= joints; ++k) {
    const double x = step * std::min(k + 1, joints), side = k % 2 ? -1 : 1;
    twigs.push_back(&scene.add(PlacedRod("twig" + std::to_string(k), Rod::uniform(slack * 0.15, section, 40), std::nullopt,
                                         along({x + 0.05, side * 0.12, 0}, {0, side, 0}))));
  }
  for (int k = 0; k < joints; ++k) {
    std::vector<BranchPlace> places = {{trunk[k], step, std::nullopt}, {trunk[k + 1], 0, std::nullopt}};
    for (int twig = k; twig <= (k + 1 < joints ? k : k + 1); ++twig) places.push_back({twigs[twig], 0, std::nullopt});
    scene.join("joint" + std::to_string(k), places, std::nullopt);
  }
  return scene;
}

void harness_1000(benchmark::State& state) {
  const Scene scene = harness();
  variation::Options options;
  for (int k = 0; k < 15; ++k) {
    variation::Variable length, end;
    length.name = "twig" + std::to_string(k) + ".length";
    length.tolerance = 0.003;
    end.name = "twig" + std::to_string(k) + ".to";
    end.cone = 5 * units::deg;
    options.vary.push_back(length);
    options.vary.push_back(end);
  }
  RunContext context;
  context.threads = static_cast<int>(state.range(0));
  double outcomes = INFINITY, whole = INFINITY;
  for (auto _ : state) {
    const double begin = seconds();
    const variation::Study study(scene, options, context);
    const double middle = seconds();
    const variation::Outcomes found = study.run(0, options.outcomes, {}, context);
    outcomes = std::min(outcomes, seconds() - middle);
    whole = std::min(whole, seconds() - begin);
    if (found.count(variation::OutcomeStatus::solved) != options.outcomes) state.SkipWithError(variation::summary(found).c_str());
  }
  state.counters["fastest_ms"] = 1e3 * whole;
  state.counters["outcomes_ms"] = 1e3 * outcomes;
}
BENCHMARK(harness_1000)
    ->Name("variation_harness_1000")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void error_against_time(benchmark::State& state) {
  const Scene scene = tee();
  const auto sampling = static_cast<variation::Sampling>(state.range(0));
  const int count = static_cast<int>(state.range(1));
  const variation::Options options = tolerances(count, sampling);
  state.SetLabel(variation::name_of(sampling));
  double half = 0;
  for (auto _ : state) {
    const variation::Study study(scene, options);
    half = study.sample(study.run(0, count), 2).mean().half_width();
  }
  state.counters["mean_within_um"] = 1e6 * half;
}
BENCHMARK(error_against_time)->Name("variation_error_against_time")->ArgNames({"sampling", "outcomes"})
    ->ArgsProduct({{0, 1, 2}, {256, 1024, 4096}})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
