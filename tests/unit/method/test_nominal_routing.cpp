// Nominal routing: the lattice's search and the smoothing, against what is known without it.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/units.h"
#include "method/preform/preform.h"
#include "method/route/nominal_routing.h"

using namespace tendril;
using namespace tendril::routing;

namespace {

PlacedObstacle solid(const char* name, Solid shape, const Frame& pose = {}) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = shape;
  obstacle.body.pose = pose;
  return obstacle;
}

/// What one search needs, with a bend radius of 50 mm and a grid of 20 mm.
struct Case {
  Scene scene;
  SpaceDemands demands;
  Ends ends;
  double grid = 20e-3;
  NominalOptions options;

  Case() {
    demands.radius = 10e-3;
    demands.clearance = 5e-3;
    options.curve.radii = {50e-3};
  }
  FreeSpace space() const { return FreeSpace(scene, demands, {ends.start, ends.finish}, 0.15); }
  LatticePath search() const {
    const FreeSpace space = this->space();
    return lattice_search(space, Roadmap(space, grid), StateLattice(grid, options.curve.radii.front(), 0.5 * grid), ends, options.search);
  }
  NominalRoute route(const RunContext& context = {}) const {
    const FreeSpace space = this->space();
    NominalOptions asked = options;
    asked.ends = ends;
    return nominal_routing(space, Roadmap(space, grid, context), StateLattice(grid, options.curve.radii.front(), 0.5 * grid), asked, context);
  }
  double smallest(const PccPoints& curve) const { return smallest_gap(space(), curve, 0, 1).value + demands.clearance; }
};

Ends straight_ahead() { return {{-0.3, 0.003, 0.001}, {1, 0, 0}, {0.3, 0.003, 0.001}, {1, 0, 0}}; }

/// A wall across the way with a square window.
void add_wall_with_window(Scene& scene, const Vec3& window, double size) {
  const double far = 1;
  const auto part = [&](const char* name, const Vec3& low, const Vec3& high) {
    scene.add(solid(name, Box{high - low}, {0.5 * (low + high), Quat::Identity()}));
  };
  const double half = 0.5 * size;
  part("wall left", {-0.01, -far, -far}, {0.01, window.y() - half, far});
  part("wall right", {-0.01, window.y() + half, -far}, {0.01, far, far});
  part("wall below", {-0.01, window.y() - half, -far}, {0.01, window.y() + half, window.z() - half});
  part("wall above", {-0.01, window.y() - half, window.z() + half}, {0.01, window.y() + half, far});
}

}  // namespace

TEST_CASE("lattice search: chains keep the bend radius and reach both ends in their directions", "[route]") {
  const Ends all[] = {
      straight_ahead(),
      {{0, 0, 0}, {1, 0, 0}, {0.31, 0.27, 0.13}, {0, 1, 0}},
      {{0, 0, 0}, {1, 0, 0}, {0.02, 0.2, 0}, {-1, 0, 0}},       // a turn by 180 degrees
      {{0, 0, 0}, {0, 0, 1}, {0.4, 0.1, 0.2}, {0, 0.6, -0.8}},
  };
  for (const Ends& ends : all) {
    Case c;
    c.ends = ends;
    const LatticePath path = c.search();
    REQUIRE(path.outcome == LatticePath::Outcome::found);
    PccDemands demands;
    demands.radii = path.chain.radii.empty() ? std::vector<double>{0.05} : path.chain.radii;
    CHECK(violations(c.space(), demands, ends, path.chain).empty());
    for (const double radius : path.chain.radii) CHECK(radius >= 0.05 * (1 - 1e-9));
    CHECK(path.chain.length() == Approx(path.cost).epsilon(1e-5));
    preform::Options open;
    open.ends = ends;
    open.space = c.demands;
    open.curve = c.options.curve;
    const preform::Result best = preform::run(c.scene, open);
    REQUIRE(best.ok);
    CHECK(path.chain.length() >= best.hoses.front().length - 1e-6);
    CHECK(path.chain.length() <= 1.35 * best.hoses.front().length);
  }
}

TEST_CASE("lattice search: end straights are straight", "[route]") {
  Case c;
  c.ends = {{0, 0, 0}, {1, 0, 0}, {0.31, 0.27, 0.13}, {0, 1, 0}};
  c.options.search.end_straight = 0.04;
  const LatticePath path = c.search();
  REQUIRE(path.outcome == LatticePath::Outcome::found);
  const std::vector<PccPiece> pieces = pieces_of(path.chain);
  CHECK(!pieces.front().is_arc);
  CHECK(!pieces.back().is_arc);
  CHECK(pieces.front().length >= 0.04 - 1e-9);
  CHECK(pieces.back().length >= 0.04 - 1e-9);
}

TEST_CASE("nominal routing: without obstacles the optimum of open space, within the grid's step", "[route]") {
  const Ends all[] = {straight_ahead(),
                      {{0, 0, 0}, {1, 0, 0}, {0.31, 0.27, 0.13}, {0, 1, 0}},
                      {{0, 0, 0}, {1, 0, 0}, {0.3, 0.1, 0}, {1, 0, 0}}};
  for (const Ends& ends : all) {
    Case c;
    c.ends = ends;
    const NominalRoute route = c.route();
    REQUIRE(route.status == NominalRoute::Status::found);
    preform::Options open;
    open.ends = ends;
    open.space = c.demands;
    open.curve = c.options.curve;
    const preform::Result best = preform::run(c.scene, open);
    CHECK(route.length >= best.hoses.front().length * (1 - 1e-3));
    CHECK(route.length <= best.hoses.front().length + c.grid);
    CHECK(route.length <= route.lattice_length + 1e-6);
  }
}

TEST_CASE("nominal routing: through the window, wherever it is", "[route]") {
  for (const Vec3& window : {Vec3(0, 0.15, 0), Vec3(0, -0.1, 0.12), Vec3(0, 0, -0.2)}) {
    Case c;
    c.ends = straight_ahead();
    add_wall_with_window(c.scene, window, 0.08);
    const NominalRoute route = c.route();
    REQUIRE(route.status == NominalRoute::Status::found);
    CHECK(violations(c.space(), c.options.curve, c.ends, route.points).empty());
    double nearest = 1;
    for (const Vec3& p : route.points.curve().sampled(1e-3))
      if (std::abs(p.x()) < 0.01) nearest = std::min(nearest, (p - Vec3(p.x(), window.y(), window.z())).norm());
    CHECK(nearest <= 0.04);
  }
}

TEST_CASE("nominal routing: why there is none", "[route]") {
  Case c;
  c.ends = straight_ahead();
  add_wall_with_window(c.scene, {0, 0.1, 0}, 0.024);  // lets 12 mm through, 15 are needed
  c.demands.keep_in = Eigen::AlignedBox3d(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5));  // and no way around
  const NominalRoute narrow = c.route();
  CHECK(narrow.status == NominalRoute::Status::infeasible);
  CHECK_THAT(narrow.obstruction, Catch::Matchers::Contains("wall"));

  // Places are connected, but in a tube of 60 mm nothing with a bend radius of 50 mm turns back.
  Case turn;
  turn.ends = {{0, 0, 0}, {1, 0, 0}, {0.2, 0.01, 0}, {-1, 0, 0}};
  turn.demands.keep_in = Eigen::AlignedBox3d(Vec3(-0.3, -0.03, -0.03), Vec3(0.5, 0.03, 0.03));
  const NominalRoute stuck = turn.route();
  CHECK(stuck.status == NominalRoute::Status::infeasible);
  CHECK(!stuck.obstruction.empty());
}

TEST_CASE("nominal routing: more weight on clearance never gives less of it", "[route]") {
  double last_gap = 0, last_length = 0;
  for (const double weight : {0.0, 0.5, 2.0, 8.0}) {
    Case c;
    c.ends = straight_ahead();
    c.scene.add(solid("post", Cylinder{0.03, 4}, {{0, -0.02, 0}, Quat::Identity()}));
    c.demands.clearance_weight = weight;
    const NominalRoute route = c.route();
    REQUIRE(route.status == NominalRoute::Status::found);
    const double gap = c.smallest(route.points);
    CAPTURE(weight, gap, route.length);
    CHECK(gap >= last_gap - 1e-4);
    CHECK(route.length >= last_length - 1e-4);
    last_gap = gap;
    last_length = route.length;
  }
  CHECK(last_gap > 0.02);
}

TEST_CASE("nominal routing: turned by 90 degrees with everything, the same length; the same bits for any threads", "[route]") {
  const auto build = [](const Quat& turn) {
    Case c;
    const Ends ends{{-0.3, 0, 0.02}, {1, 0, 0}, {0.3, 0.06, 0}, {0, 1, 0}};
    c.ends = {turn * ends.start, turn * ends.start_along, turn * ends.finish, turn * ends.finish_along};
    c.scene.add(solid("box", Box{{0.1, 0.16, 0.3}}, {Vec3::Zero(), turn}));
    return c;
  };
  const Case straight = build(Quat::Identity());
  const NominalRoute route = straight.route();
  REQUIRE(route.status == NominalRoute::Status::found);
  const NominalRoute turned = build(Quat(Eigen::AngleAxisd(0.5 * units::pi, Vec3::UnitX()))).route();
  REQUIRE(turned.status == NominalRoute::Status::found);
  CHECK(turned.length == Approx(route.length).epsilon(5e-3));

  RunContext one, two;
  one.threads = 1;
  two.threads = 2;
  CHECK(straight.route(one).length == straight.route(two).length);
}

TEST_CASE("nominal routing: stops when told to", "[route]") {
  Case c;
  c.ends = straight_ahead();
  RunContext context;
  context.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
  CHECK(c.route(context).status == NominalRoute::Status::stopped);
}
