// The search for passages: those of scenes where they can be counted, shortest paths against brute force, and what is said where
// nothing passes.
#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>

#include "base/units.h"
#include "method/preform/end_lead.h"
#include "method/preform/global_search.h"
#include "method/preform/path_search.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using namespace tendril::preform;
using tendril::test::box_mesh;
using tendril::test::Random;

namespace {

void add(Scene& scene, const std::string& name, decltype(Obstacle::shape) shape, const Frame& pose, double clearance = 0,
         Preference prefer = Preference::neutral) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = std::move(shape);
  obstacle.body.pose = pose;
  obstacle.clearance = clearance;
  obstacle.prefer = prefer;
  scene.add(std::move(obstacle));
}

/// A box between two corners, placed by a motion.
void add_box(Scene& scene, const std::string& name, const Vec3& low, const Vec3& high, const Frame& motion = {}) {
  add(scene, name, Solid(Box{high - low}), motion * Frame{0.5 * (low + high), Quat::Identity()});
}

/// A wall at x = 0 (40 mm thick, 1 m square) with windows of 120 mm at y = +-0.25.
void add_wall_with_windows(Scene& scene, const Frame& motion = {}) {
  add_box(scene, "below", {-0.02, -0.5, -0.5}, {0.02, 0.5, -0.06}, motion);
  add_box(scene, "above", {-0.02, -0.5, 0.06}, {0.02, 0.5, 0.5}, motion);
  add_box(scene, "left", {-0.02, -0.5, -0.06}, {0.02, -0.31, 0.06}, motion);
  add_box(scene, "middle", {-0.02, -0.19, -0.06}, {0.02, 0.19, 0.06}, motion);
  add_box(scene, "right", {-0.02, 0.31, -0.06}, {0.02, 0.5, 0.06}, motion);
}

Options options_between(const Vec3& start, const Vec3& start_along, const Vec3& finish, const Vec3& finish_along) {
  Options options;
  options.ends = {start, start_along, finish, finish_along};
  options.space.radius = 0.012;
  options.space.clearance = 0.008;
  options.curve.radii = {0.05};
  options.curve.end_straight = 0.02;
  return options;
}

GlobalPaths search(const Scene& scene, const Options& options, double margin = 0.2, const RunContext& context = {}) {
  const FreeSpace space(scene, options.space, {options.ends.start, options.ends.finish}, margin);
  return global_search(space, options, context);
}

double length_of(const std::vector<Vec3>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

/// Where a path first crosses the plane x = `at`.
Vec3 crossing(const std::vector<Vec3>& path, double at) {
  for (std::size_t i = 1; i < path.size(); ++i)
    if ((path[i - 1].x() - at) * (path[i].x() - at) <= 0 && path[i].x() != path[i - 1].x())
      return path[i - 1] + (at - path[i - 1].x()) / (path[i].x() - path[i - 1].x()) * (path[i] - path[i - 1]);
  FAIL("the path does not cross");
  return {};
}

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  INFO(text);
  REQUIRE(at != std::string::npos);
  return std::stod(text.substr(at + words.size()));
}

}  // namespace

TEST_CASE("in empty space the first path is as straight as a grid allows, its ends along the connections", "[global_search]") {
  const Options options = options_between({0, 0, 0}, {1, 0, 0}, {0.8, 0.3, 0.1}, {1, 0, 0});
  const GlobalPaths found = search(Scene(), options);
  REQUIRE(found.paths.size() > 1);
  CHECK(found.obstruction.empty());
  CHECK(found.free_nodes == found.nodes);
  const double straight = (options.ends.finish - options.ends.start).norm();
  CHECK(length_of(found.paths[0]) >= straight);
  CHECK(length_of(found.paths[0]) <= 1.128 * straight + 2 * options.grid);
  for (std::size_t i = 0; i < found.paths.size(); ++i) {
    const std::vector<Vec3>& path = found.paths[i];
    CHECK(path.front() == options.ends.start);
    CHECK(path.back() == options.ends.finish);
    CHECK(path[1].isApprox(Vec3(0.07, 0, 0)));
    CHECK((path[path.size() - 2] - Vec3(0.73, 0.3, 0.1)).norm() < 1e-12);
    if (i > 0) CHECK(length_of(path) >= length_of(found.paths[i - 1]) - 1e-6);
  }
}

TEST_CASE("both windows of a wall are found, and the ways around it", "[global_search]") {
  Scene scene;
  add_wall_with_windows(scene);
  Options options = options_between({-0.3, 0, 0}, {1, 0, 0}, {0.3, 0, 0}, {1, 0, 0});
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5));
  const GlobalPaths inside = search(scene, options);
  int left = 0, right = 0;
  for (const auto& path : inside.paths) {
    const Vec3 at = crossing(path, 0);
    CHECK(std::abs(at.z()) <= 0.0401);
    CHECK(std::abs(std::abs(at.y()) - 0.25) <= 0.0401);
    (at.y() < 0 ? left : right)++;
  }
  CHECK(left >= 1);
  CHECK(right >= 1);
  CHECK(left + right <= 6);
  // Without the box the hose may also go around the wall's four sides.
  options.space.keep_in.reset();
  std::set<int> ways;
  for (const auto& path : search(scene, options).paths) {
    const Vec3 at = crossing(path, 0);
    if (std::abs(at.y()) > 0.5) ways.insert(at.y() > 0 ? 1 : 2);
    else if (std::abs(at.z()) > 0.5) ways.insert(at.z() > 0 ? 3 : 4);
    else ways.insert(at.y() > 0 ? 5 : 6);
  }
  CHECK(ways.size() == 6);
}

TEST_CASE("longer detours than allowed are left, the others are what they would be", "[global_search]") {
  Scene scene;
  add_wall_with_windows(scene);
  Options options = options_between({-0.3, 0, 0}, {1, 0, 0}, {0.3, 0.1, 0}, {1, 0, 0});
  options.max_detour = INFINITY;
  const std::vector<std::vector<Vec3>> all = search(scene, options).paths;
  // A path's cost is its length without the two straights at the ends, of 70 mm.
  const auto detour = [&](const std::vector<Vec3>& path) { return (length_of(path) - 0.14) / (length_of(all[0]) - 0.14); };
  REQUIRE(detour(all.back()) > 1.8);
  std::size_t before = 0;
  for (const double most : {1.0, 1.2, 1.5, 1.8}) {
    CAPTURE(most);
    options.max_detour = most;
    const std::vector<std::vector<Vec3>> some = search(scene, options).paths;
    REQUIRE(some.size() < all.size());
    CHECK(some.size() >= std::max<std::size_t>(before, 1));
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i < some.size()) CHECK(some[i] == all[i]);
      CHECK((i < some.size()) == (detour(all[i]) <= most * (1 + 1e-6)));
    }
    before = some.size();
  }
  CHECK(before > 1);
}

TEST_CASE("every gap of a row of posts is found", "[global_search]") {
  for (const int posts : {1, 3, 6}) {
    CAPTURE(posts);
    const double pitch = 0.16, half = 0.5 * (posts + 1) * pitch;
    Scene scene;
    for (int i = 0; i < posts; ++i)
      add(scene, "post " + std::to_string(i + 1), Solid(Cylinder{0.03, 1}), {{0, -half + (i + 1) * pitch, 0}, Quat::Identity()});
    Options options = options_between({-0.4, 0, 0}, {1, 0, 0}, {0.4, 0, 0}, {1, 0, 0});
    options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.6, -half, -0.05), Vec3(0.6, half, 0.05));
    std::set<int> gaps;
    const GlobalPaths found = search(scene, options);
    for (const auto& path : found.paths) gaps.insert(static_cast<int>(std::floor((crossing(path, 0).y() + half) / pitch)));
    CHECK(static_cast<int>(gaps.size()) == posts + 1);
  }
}

TEST_CASE("every place of every path keeps clear, whatever the step", "[global_search]") {
  for (const double step : {0.015, 0.02, 0.045}) {
    CAPTURE(step);
    Random random(7);
    Scene scene;
    for (int i = 0; i < 25; ++i)
      add(scene, "box " + std::to_string(i), std::make_shared<const TriangleSurface>(box_mesh({0.05, 0.03, 0.04})),
          {{random.in(-0.25, 0.25), random.in(-0.3, 0.3), random.in(-0.3, 0.3)}, random.rotation()});
    Options options = options_between({-0.5, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {1, 0, 0});
    options.grid = step;
    const FreeSpace space(scene, options.space, {options.ends.start, options.ends.finish}, 0.2);
    const GlobalPaths found = global_search(space, options);
    REQUIRE(found.paths.size() >= 3);
    for (const auto& path : found.paths)
      for (std::size_t i = 0; i < path.size(); ++i) {
        REQUIRE(space.is_free(path[i]));
        if (i > 0) REQUIRE_FALSE(space.surroundings().ray(path[i - 1], path[i]));
        // Beyond 1.15 times radius plus clearance the edges themselves are judged.
        if (i > 0 && step > 0.023) REQUIRE(space.is_free(path[i - 1], path[i]));
      }
  }
}

TEST_CASE("thin walls are not crossed on a coarse grid", "[global_search]") {
  Scene scene;
  Mesh sheet;
  sheet.vertices = {{0, -2, -2}, {0, 2, -2}, {0, 2, 2}, {0, -2, 2}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  add(scene, "sheet", std::make_shared<const TriangleSurface>(sheet), {{-0.101, 0, 0}, Quat::Identity()});
  Options options = options_between({-0.3, 0, 0}, {1, 0, 0}, {0.3, 0, 0}, {1, 0, 0});
  options.space.radius = 0.002;
  options.space.clearance = 0;
  options.grid = 0.05;
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.5, -1, -1), Vec3(0.5, 1, 1));
  const GlobalPaths found = search(scene, options);
  CHECK(found.paths.empty());
  CHECK(found.obstruction == "start is enclosed by 'sheet': no way for a radius above 12.5 mm leads out of the space around it");
}

TEST_CASE("the search moves with the scene", "[global_search]") {
  const double step = 0.02;
  const auto found_after = [&](const Frame& motion) {
    Scene scene;
    add_wall_with_windows(scene, motion);
    Options options = options_between(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitX());
    options.grid = step;
    options.ends = {motion.rotation * Vec3(-0.3, 0.06, 0) + motion.at, motion.rotation * Vec3(1, 0, 0),
                    motion.rotation * Vec3(0.3, 0.06, 0) + motion.at, motion.rotation * Vec3(1, 0, 0)};
    const GlobalPaths found = search(scene, options, 0.2);
    std::vector<std::vector<Vec3>> back;
    for (const auto& path : found.paths) {
      back.emplace_back();
      for (const Vec3& p : path) back.back().push_back(motion.rotation.conjugate() * (p - motion.at));
    }
    return back;
  };
  const auto reference = found_after({});
  REQUIRE(reference.size() >= 2);
  const Quat quarter_z(Eigen::AngleAxisd(units::pi / 2, Vec3::UnitZ())), quarter_x(Eigen::AngleAxisd(units::pi / 2, Vec3::UnitX()));
  // Shifts leave the order of nodes as it is: the very same paths.
  const auto shifted = found_after({{3 * step, -5 * step, 2 * step}, Quat::Identity()});
  REQUIRE(shifted.size() == reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    CHECK(length_of(shifted[i]) == Approx(length_of(reference[i])).epsilon(1e-6));
  }
  // Turns do not: among paths of equal length another may be taken, but the shortest are as long, through the same windows.
  for (const Quat& turn : {quarter_z, quarter_x, Quat(quarter_z * quarter_x), Quat(quarter_z * quarter_z)}) {
    const auto turned = found_after({{0.1, 0.2, -0.3}, turn});
    REQUIRE(turned.size() >= 2);
    CHECK(length_of(turned[0]) == Approx(length_of(reference[0])).epsilon(1e-6));
    CHECK((crossing(turned[0], 0) - Vec3(0, 0.25, 0)).cwiseAbs().maxCoeff() <= 0.04);
    bool other = false;
    for (const auto& path : turned) other = other || (crossing(path, 0) - Vec3(0, -0.25, 0)).cwiseAbs().maxCoeff() <= 0.04;
    CHECK(other);
  }
}

TEST_CASE("shortest paths and distances are those of brute force, also after exclusions and with preferences", "[global_search]") {
  int compared = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Scene scene;
    for (int i = 0; i < 5; ++i)
      add(scene, "ball " + std::to_string(i), Solid(Sphere{0.05}), {0.15 * random.point(1), Quat::Identity()}, 0,
          i % 2 ? Preference::avoid : Preference::near);
    routing::SpaceDemands demands;
    demands.radius = 0.01;
    demands.clearance = seed % 2 ? 0.03 : 0;
    demands.preference = seed % 3 ? 1 : 0;
    demands.keep_in = Eigen::AlignedBox3d(Vec3::Constant(-0.19), Vec3::Constant(0.21));
    const Vec3 start(-0.17, -0.17, -0.17), finish(0.18, 0.18, 0.18);
    const FreeSpace space(scene, demands, {start, finish}, 0.1);
    const routing::Roadmap roadmap(space, 0.04);
    const int count = static_cast<int>(roadmap.nodes());
    std::vector<char> excluded(count, 0);
    // Bellman-Ford over all pairs of neighbours, judged by the space itself.
    const auto brute = [&] {
      std::vector<double> cost(count, INFINITY);
      const auto cost_of = [&](const Vec3& a, const Vec3& b) { return 0.5 * (space.cost(a) + space.cost(b)) * (b - a).norm(); };
      const auto joins = [&](int n, const Vec3& end) {
        const Vec3 p = roadmap.place(n);
        return space.is_free(p) && (p - end).norm() <= PathSearch::joined_steps * roadmap.step() && space.is_free(end, p);
      };
      const bool judge_edges = roadmap.step() > 1.15 * (demands.radius + demands.clearance);
      for (int n = 0; n < count; ++n)
        if (joins(n, start) && !excluded[n]) cost[n] = cost_of(start, roadmap.place(n));
      for (bool changed = true; changed;) {
        changed = false;
        for (int a = 0; a < count; ++a) {
          if (!std::isfinite(cost[a])) continue;
          for (int b = 0; b < count; ++b) {
            const Vec3 way = roadmap.place(b) - roadmap.place(a);
            if (a == b || excluded[b] || way.cwiseAbs().maxCoeff() > 1.001 * roadmap.step() || !space.is_free(roadmap.place(b))) continue;
            const double through = cost[a] + cost_of(roadmap.place(a), roadmap.place(b));
            if (through >= cost[b] - 1e-12 || (judge_edges && !space.is_free(roadmap.place(a), roadmap.place(b)))) continue;
            cost[b] = through;
            changed = true;
          }
        }
      }
      double best = INFINITY;
      for (int n = 0; n < count; ++n)
        if (joins(n, finish)) best = std::min(best, cost[n] + cost_of(finish, roadmap.place(n)));
      return best;
    };
    PathSearch paths(space, roadmap, start, finish);
    for (int turn = 0; turn < 3; ++turn) {
      const double expected = brute();
      const PathSearch::Path path = paths.shortest();
      if (!std::isfinite(expected)) {
        CHECK(path.places.empty());
        break;
      }
      CHECK(path.cost == Approx(expected).epsilon(1e-5));
      ++compared;
      const double reach = 0.05;
      paths.exclude_around(path, reach, [&](const Vec3& p) { return (p - start).norm() < 0.1 || (p - finish).norm() < 0.1; });
      for (const int node : path.nodes)
        for (int n = 0; n < count; ++n) {
          const Vec3 p = roadmap.place(n);
          if ((p - roadmap.place(node)).norm() <= reach && (p - start).norm() >= 0.1 && (p - finish).norm() >= 0.1) excluded[n] = 1;
        }
    }
  }
  CHECK(compared >= 8);
}

TEST_CASE("what is too narrow is named, with its place and what it lets through", "[global_search]") {
  Random random(3);
  for (const double width : {0.0286, 0.037, 0.012}) {
    for (const double offset : {0.0, 0.0071, 0.0093}) {
      CAPTURE(width, offset);
      Scene scene;
      add_box(scene, "left cheek", {-0.03, -0.6, -0.6}, {0.03, offset - 0.5 * width, 0.6});
      add_box(scene, "right cheek", {-0.03, offset + 0.5 * width, -0.6}, {0.03, 0.6, 0.6});
      Options options = options_between({-0.3, 0.1, 0}, {1, 0, 0}, {0.3, -0.1, 0}, {1, 0, 0});
      options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5));
      const GlobalPaths found = search(scene, options);
      CHECK(found.paths.empty());
      INFO(found.obstruction);
      CHECK(found.obstruction.rfind("no passage for a radius + clearance of 20 mm: the widest one found, at (", 0) == 0);
      CHECK(number_after(found.obstruction, ", lets ") == Approx(0.5e3 * width).margin(0.15));
      CHECK((found.obstruction.find("between 'left cheek' and 'right cheek'") != std::string::npos ||
             found.obstruction.find("between 'right cheek' and 'left cheek'") != std::string::npos));
      CHECK(std::abs(number_after(found.obstruction, "found, at (")) < 0.031);
    }
  }
}

TEST_CASE("the wider of two windows is found to be the widest", "[global_search]") {
  Scene scene;
  const double small = 0.010, large = 0.016;  // half widths
  add_box(scene, "below", {-0.005, -0.6, -0.6}, {0.005, 0.6, -large});
  add_box(scene, "above", {-0.005, -0.6, large}, {0.005, 0.6, 0.6});
  add_box(scene, "left", {-0.005, -0.6, -large}, {0.005, -0.2 - small, large});
  add_box(scene, "middle", {-0.005, -0.2 + small, -large}, {0.005, 0.213 - large, large});
  add_box(scene, "right", {-0.005, 0.213 + large, -large}, {0.005, 0.6, large});
  Options options = options_between({-0.3, -0.2, 0}, {1, 0, 0}, {0.3, -0.2, 0}, {1, 0, 0});
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5));
  const GlobalPaths found = search(scene, options);
  INFO(found.obstruction);
  CHECK(found.paths.empty());
  CHECK(number_after(found.obstruction, ", lets ") == Approx(16).margin(0.2));
  CHECK(found.obstruction.find("0.213, ") != std::string::npos);
}

TEST_CASE("a passage that only the grid misses is told", "[global_search]") {
  Scene scene;
  add_box(scene, "left cheek", {-0.03, -0.6, -0.6}, {0.03, 0.0102, 0.6});
  add_box(scene, "right cheek", {-0.03, 0.0512, -0.6}, {0.03, 0.6, 0.6});
  Options options = options_between({-0.3, 0.1, 0}, {1, 0, 0}, {0.3, -0.1, 0}, {1, 0, 0});
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5));
  const GlobalPaths found = search(scene, options);
  CHECK(found.paths.empty());
  INFO(found.obstruction);
  CHECK(found.obstruction.rfind("no passage on a grid of 20 mm: it misses the one at (", 0) == 0);
  CHECK(found.obstruction.find("wide enough for a radius + clearance of 20 mm; take a smaller 'grid'") != std::string::npos);
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.4, -0.15, -0.06), Vec3(0.4, 0.15, 0.06));
  CHECK(search(scene, options).paths.empty());
  options.grid = 0.0022;
  CHECK(search(scene, options).paths.size() >= 1);
}

TEST_CASE("an end that nothing leads out of is told", "[global_search]") {
  Scene scene;
  add(scene, "cage", std::make_shared<const TriangleSurface>(box_mesh({0.2, 0.2, 0.2})), {{0.5, 0, 0}, Quat::Identity()});
  const Options in = options_between({-0.3, 0, 0}, {1, 0, 0}, {0.6, 0, 0}, {1, 0, 0});
  CHECK(search(scene, in).obstruction == "finish is enclosed by 'cage': no way for a radius above 10 mm leads out of the space around it");
  const Options out = options_between({0.4, 0, 0}, {1, 0, 0}, {-0.3, 0, 0}, {1, 0, 0});
  CHECK(search(scene, out).obstruction == "start is enclosed by 'cage': no way for a radius above 10 mm leads out of the space around it");
}

TEST_CASE("an end that is too near to something is told, with the free end that would do", "[global_search]") {
  Scene scene;
  // The start is plugged to a block; 15 mm of the way out of it run between two jaws.
  add_box(scene, "block", {-0.1, -0.05, -0.05}, {0, 0.05, 0.05});
  add_box(scene, "jaw", {0, 0.0151, -0.05}, {0.015, 0.05, 0.05});
  Options options = options_between({0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {1, 0, 0});
  const GlobalPaths found = search(scene, options);
  CHECK(found.paths.empty());
  CHECK(found.obstruction == "start: the hose is 20 mm too near to 'block' (12 mm into it, 8 mm required); move it, ask for less "
                             "clearance, or let 'free_ends' be at least 28.2 mm");
  options.curve.free_ends = 0.0275;
  CHECK(search(scene, options).obstruction == "start: 27.5 mm along its straight the hose is 0.4 mm too near to 'jaw' (7.6 mm away, 8 mm "
                                              "required); move it, ask for less clearance, or let 'free_ends' be at least 28.2 mm");
  options.curve.free_ends = 0.0282;
  CHECK(search(scene, options).obstruction.empty());
  CHECK(search(scene, options).paths.size() >= 1);
  // The finish points the wrong way: through the block.
  options.ends = {{0.5, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  CHECK(search(scene, options).obstruction == "finish: its straight passes through 'block' after 0 mm; move it, or turn it the other way");
  options.ends = {{0.03, 0, 0}, {-1, 0, 0}, {0.5, 0, 0}, {1, 0, 0}};
  options.curve.free_ends = 0.05;
  CHECK(search(scene, options).obstruction == "start: its straight passes through 'block' after 30 mm; move it, or turn it the other way");
  options.curve.free_ends = 0.005;
  CHECK(search(scene, options).obstruction.rfind("start: 20 mm along its straight the hose is 10 mm too near to 'block' (2 mm into it", 0) == 0);
}

TEST_CASE("ends outside zones and walls are asked for by their names", "[global_search]") {
  Options options = options_between({0.009, 0.3, 0}, {1, 0, 0}, {0.5, 0.3, 0}, {1, 0, 0});
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(0, 0, -1), Vec3(1, 1, 1));
  CHECK(search(Scene(), options).obstruction == "start: the hose is 3 mm outside keep_in; move it, or let 'free_ends' be at least 3 mm");
  options.ends.start.x() = 0.05;
  options.space.keep_out = {{Vec3(0.4, 0.2, -0.1), Vec3(0.48, 0.4, 0.1)}};
  CHECK(search(Scene(), options).obstruction == "finish: 20 mm along its straight the hose is 12 mm inside keep_out 1; move it, or let "
                                                "'free_ends' be at least 112 mm");
}

TEST_CASE("an end whose direction may turn finds the way out beside its axis", "[global_search]") {
  Scene scene;
  add_box(scene, "post", {0.06, -0.03, -0.005}, {0.09, 0.03, 0.005});
  routing::PccDemands demands;
  demands.radii = {0.05};
  demands.end_straight = 0.06;
  routing::SpaceDemands space_demands;
  space_demands.radius = 0.01;
  const FreeSpace space(scene, space_demands, {Vec3(0, 0, 0)}, 0.3);
  CHECK_FALSE(end_lead(space, demands, {0, 0, 0}, {1, 0, 0}, 0, "start").obstruction.empty());
  const EndLead lead = end_lead(space, demands, {0, 0, 0}, {1, 0, 0}, 0.5, "start");
  CHECK(lead.obstruction.empty());
  CHECK(lead.length >= 0.06);
  CHECK(lead.tip.norm() == Approx(lead.length));
  CHECK(std::acos(lead.tip.normalized().x()) <= 0.5);
  CHECK(space.is_free(Vec3(0, 0, 0), lead.tip));
}

TEST_CASE("the same paths for any number of threads, fewer when stopped or limited", "[global_search]") {
  Scene scene;
  add_wall_with_windows(scene);
  Options options = options_between({-0.3, 0, 0}, {1, 0, 0}, {0.3, 0, 0}, {1, 0, 0});
  RunContext one, three;
  one.threads = 1;
  three.threads = 3;
  const GlobalPaths a = search(scene, options, 0.2, one), b = search(scene, options, 0.2, three);
  CHECK(a.paths == b.paths);
  CHECK(a.free_nodes == b.free_nodes);
  options.max_paths = 2;
  const GlobalPaths two = search(scene, options);
  REQUIRE(two.paths.size() == 2);
  CHECK(two.paths[1] == a.paths[1]);
  const std::atomic<bool> cancelled = true;
  one.cancel = &cancelled;
  const GlobalPaths none = search(scene, options, 0.2, one);
  CHECK(none.paths.empty());
  CHECK(none.obstruction.empty());
  options.grid = 1e-4;
  CHECK_THROWS_WITH(search(scene, options), Catch::Contains("million nodes") && Catch::Contains("keep_in"));
}
