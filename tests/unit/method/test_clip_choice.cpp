#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "method/route/clip_choice.h"
#include "method/route/clip_places.h"
#include "method/route/clipped_design.h"
#include "method/route/route_guess.h"
#include "method/route/stretch_trial.h"
#include "unit/method/refinement_cases.h"

using namespace tendril;
using namespace tendril::routing;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double margin_of(const std::vector<int>& places, int n, const SpanMargin& margin) {
  double least = infinity;
  int from = 0;
  for (const int place : places) {
    least = std::min(least, margin(from, place));
    from = place;
  }
  return std::min(least, margin(from, n + 1));
}

/// All subsets of 1 ... n.
std::vector<std::vector<int>> subsets(int n) {
  std::vector<std::vector<int>> all;
  for (int bits = 0; bits < 1 << n; ++bits) {
    all.emplace_back();
    for (int k = 0; k < n; ++k)
      if (bits >> k & 1) all.back().push_back(k + 1);
  }
  return all;
}

/// A way of two bends along the wall y = 0.
Design along_wall(double radius) {
  Design design;
  design.route = Curve::pcc({{0, 0.05, 0.3}, {0.4, 0.05, 0.3}, {0.5, 0.05, 0.5}, {1.0, 0.05, 0.5}}, radius);
  design.rod = Rod::uniform(design.route->length(), soft_hose(), 80);
  design.from = design.route->at(0);
  design.to = design.route->at(design.route->length());
  return design;
}

/// Over a table, round a pillar.
Design on_table() {
  Design design;
  design.route = Curve::pcc({{0, 0, 0.03}, {0.5, 0, 0.03}, {0.6, 0.3, 0.03}, {0.9, 0.3, 0.03}, {1, 0, 0.03}, {1.5, 0, 0.03}}, 0.1);
  design.rod = Rod::uniform(design.route->length(), soft_hose(), 80);
  design.from = design.route->at(0);
  design.to = design.route->at(design.route->length());
  return design;
}

Scene table() {
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(solid("table", HalfSpace{}, Vec3::Zero(), 0.01));
  scene.add(solid("pillar", Box{{0.25, 0.5, 0.6}}, {0.75, 0, 0.3}, 0.01));
  return scene;
}

Scene wall() {
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(solid("wall", Box{{4, 0.1, 4}}, {0, -0.05, 0}));
  return scene;
}

}  // namespace

TEST_CASE("clip choice: the fewest, and among those the safest, of all subsets", "[refinement]") {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const int n = std::uniform_int_distribution<>(0, 8)(random), most = std::uniform_int_distribution<>(0, n + 1)(random);
    std::vector<std::vector<double>> margins(n + 2, std::vector<double>(n + 2));
    // Longer ones are worse, but not always.
    for (int i = 0; i < n + 2; ++i)
      for (int j = i + 1; j < n + 2; ++j)
        margins[i][j] = std::uniform_real_distribution<>(-1, 1)(random) + 0.5 - 0.2 * (j - i);
    std::set<std::pair<int, int>> asked;
    const SpanMargin margin = [&](int i, int j) { return margins[i][j]; };
    const ClipChoice choice = fewest_clips(
        n, most,
        [&](int i, int j) {
          CHECK(asked.insert({i, j}).second);
          return margin(i, j);
        },
        n + 2);
    int needed = -1;
    double best = -infinity, best_of_needed = -infinity;
    for (const std::vector<int>& places : subsets(n)) {
      const double here = margin_of(places, n, margin);
      const int count = static_cast<int>(places.size());
      if (here >= 0 && (needed < 0 || count < needed)) needed = count, best_of_needed = -infinity;
      if (here >= 0 && count == needed) best_of_needed = std::max(best_of_needed, here);
      if (count <= most) best = std::max(best, here);
    }
    CHECK(choice.needed == needed);
    CHECK(static_cast<int>(choice.places.size()) <= most);
    CHECK(choice.margin == margin_of(choice.places, n, margin));
    if (needed >= 0 && needed <= most) {
      CHECK(static_cast<int>(choice.places.size()) == needed);
      CHECK(choice.margin == best_of_needed);
    } else {
      CHECK(choice.margin == best);
    }
  }
}

TEST_CASE("clip choice: long stretches that are lost are not asked for", "[refinement]") {
  const int n = 40, reach = 5;
  int asked = 0;
  const ClipChoice choice = fewest_clips(n, n, [&](int i, int j) { return ++asked, j - i <= reach ? 1.0 / (j - i) : -1.0; });
  CHECK(choice.needed == (n + 1 + reach - 1) / reach - 1);
  CHECK(static_cast<int>(choice.places.size()) == choice.needed);
  CHECK(asked <= (n + 1) * (reach + 4) + 1);
}

TEST_CASE("clip choice: places that depend on each other are left out while all is kept", "[refinement]") {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::vector<double> worth(8);
    for (double& w : worth) w = std::uniform_real_distribution<>(0, 1)(random);
    const double demanded = std::uniform_real_distribution<>(0, 4)(random);
    const auto margin = [&](const std::vector<int>& places) {
      double sum = -demanded;
      for (const int place : places) sum += worth[place];
      return sum;
    };
    const std::vector<int> all = {0, 1, 2, 3, 4, 5, 6, 7}, left = pruned_clips(all, margin);
    if (margin(all) < 0) {
      CHECK(left == all);
      continue;
    }
    CHECK(margin(left) >= 0);
    // With independent worths the greedy choice is the best: the largest worths that are enough.
    std::vector<double> sorted = worth;
    std::sort(sorted.rbegin(), sorted.rend());
    std::size_t enough = 0;
    for (double sum = -demanded; sum < 0; ++enough) sum += sorted[enough];
    CHECK(left.size() == enough);
  }
}

TEST_CASE("clip places: within reach, clear, apart from the ends, in the way's frame", "[refinement]") {
  const Scene scene = wall();
  RefinementOptions options;
  options.clearance = 0.01;
  const SurroundingsByUse around(scene, options);
  // A way that leaves the wall: its surface is farther than 50 mm from x = 0.5 on.
  const auto way = [](double s) { return Frame::looking({s, 0.03 + 0.06 * s, 0.3}, {1, 0.06, 0}); };
  const double length = 1, radius = 0.01;
  const std::vector<Hold> places = clip_places(way, length, radius, 0.03, 0.05, {around.all.get(), &around.obstacles, 0.05});
  REQUIRE(places.size() > 10);
  CHECK(places.front().at == Approx(0.05).margin(1e-12));
  CHECK(places.back().at <= 0.5 + 1e-9);
  CHECK(places.back().at >= 0.5 - 0.03);
  for (std::size_t k = 0; k < places.size(); ++k) {
    CHECK(places[k].position);
    CHECK(places[k].orientation);
    CHECK((places[k].frame.at - way(places[k].at).at).norm() == 0);
    if (k > 0) CHECK(places[k].at - places[k - 1].at <= 0.03 + 1e-12);
  }
  // Nearer to the wall than the clearance allows: nowhere. Obstacles that take no clips: nowhere.
  const auto near = [](double s) { return Frame::looking({s, 0.019, 0.3}, {1, 0, 0}); };
  CHECK(clip_places(near, length, radius, 0.03, 0.05, {around.all.get(), &around.obstacles, 0.05}).empty());
  std::vector<PlacedObstacle> smooth = around.obstacles;
  smooth.front().clip = false;
  CHECK(clip_places(way, length, radius, 0.03, 0.05, {around.all.get(), &smooth, 0.05}).empty());
  CHECK(clip_places(way, 0.08, radius, 0.03, 0.05, {around.all.get(), &around.obstacles, 0.05}).empty());
}

TEST_CASE("stretch trials: between full holds a stretch keeps what it keeps in the whole rod", "[refinement]") {
  const Scene scene = wall();
  RefinementOptions options;
  options.min_bend_radius = 0.06;
  options.clearance = 0.01;
  const Design design = along_wall(0.1);
  const SurroundingsByUse around(scene, options);
  const Way way = *way_of(design);
  const double length = design.rod.length;
  const std::vector<double> at = {0, 0.3 * length, 0.55 * length, 0.8 * length, length};
  const RunContext context;
  const StretchTrial trial(around, scene.gravity(), design.rod, way, options, context);
  Design whole = design;
  double least = infinity;
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    if (k > 0) whole.clips.push_back({at[k], way(at[k])});
    least = std::min(least, trial.margin({at[k], way(at[k])}, {at[k + 1], way(at[k + 1])}));
  }
  RefinementOptions fixed = options;
  fixed.adjust = {};
  fixed.adjust.length = false;
  const RefinementResult result = refine(scene, whole, fixed);
  REQUIRE(result.equilibrium);
  const double bend = 1 - options.min_bend_radius / result.min_bend_radius, room = (result.clearance.value - 0.01) / 0.01;
  // Meshes differ a little.
  CHECK(least == Approx(std::min(bend, room)).margin(0.03));
}

TEST_CASE("clipped designs: as few clips as hold a soft hose on its way, and why not fewer", "[refinement]") {
  RefinementOptions options;
  options.min_bend_radius = 0.08;
  options.most_clips = 8;
  const Scene scene = table();
  const Design design = on_table();
  RefinementOptions none = options;
  none.most_clips = 0;
  REQUIRE_FALSE(refine(scene, design, none).ok);
  const RefinementResult result = refine(scene, design, options);
  INFO(result.message);
  CHECK(result.ok);
  REQUIRE_FALSE(result.added_clips.empty());
  CHECK(result.min_bend_radius >= 0.08);
  const int needed = static_cast<int>(result.added_clips.size());
  options.most_clips = 1;
  const RefinementResult fewer = refine(scene, design, options);
  CHECK_FALSE(fewer.ok);
  CHECK_THAT(fewer.message, Catch::Contains(std::to_string(needed) + " clips would do, at most 1 may be added"));
  // The design's own clips stay where they are.
  Design held = design;
  const Way way = *way_of(design);
  const double own = 0.52 * design.rod.length;
  held.clips.push_back({own, way(own)});
  options.most_clips = 8;
  const RefinementResult with = refine_clipped(scene, held, options);
  CHECK(with.ok);
  CHECK(std::any_of(with.design.clips.begin(), with.design.clips.end(), [&](const Hold& clip) { return clip.at == own; }));
}
