// Branched harnesses: junctions and branches of a route, its certificate, and how it comes to rest.
#include <atomic>
#include <catch2/catch.hpp>

#include "base/units.h"
#include "method/route/harness_routing.h"
#include "unit/method/routing_cases.h"

using namespace tendril;
using namespace tendril::routing;
using namespace tendril::testing;

namespace {

Section cable() { return Section::round(0.012, 0, Material::from_poisson(2e7, 0.4, 1500)); }

HarnessOptions options_with(const std::vector<std::pair<Vec3, Vec3>>& connections) {
  HarnessOptions options;
  for (const auto& [at, along] : connections) options.connections.push_back(Frame::looking(at, along));
  options.section = cable();
  options.min_bend_radius = 0.03;
  options.end_straight = 0.01;
  return options;
}

/// Three connections in a plane, 120 degrees apart, that look at each other.
HarnessOptions star_of_three() {
  std::vector<std::pair<Vec3, Vec3>> connections;
  for (const double angle : {0.0, 120.0, 240.0}) {
    const Vec3 out(std::cos(angle * units::deg), std::sin(angle * units::deg), 0);
    connections.push_back({0.3 * out, -out});
  }
  HarnessOptions options = options_with(connections);
  options.bundling = 1;
  return options;
}

/// A room with boxes in it, and five connections along its walls.
Scene room() {
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(solid_of("engine", Box{Vec3(0.3, 0.3, 0.3)}, Vec3(0.4, 0.3, 0.15)));
  scene.add(solid_of("battery", Box{Vec3(0.2, 0.15, 0.2)}, Vec3(0.8, 0.5, 0.1)));
  scene.add(solid_of("tank", Cylinder{0.08, 0.4}, Vec3(0.85, 0.15, 0.2)));
  return scene;
}
HarnessOptions in_room() {
  HarnessOptions options = options_with({{Vec3(0, 0, 0.1), Vec3::UnitX()},
                                         {Vec3(1.1, 0.1, 0.25), -Vec3::UnitX()},
                                         {Vec3(1.1, 0.6, 0.3), -Vec3::UnitX()},
                                         {Vec3(0.3, 0.7, 0.2), -Vec3::UnitY()},
                                         {Vec3(0.6, 0.3, 0.5), -Vec3::UnitZ()}});
  options.space.clearance = 0.008;
  return options;
}

Vec3 leaving(const HarnessBranch& branch, int junction) {
  const std::vector<Vec3>& p = branch.points.points;
  if (branch.from.junction && branch.from.number == junction) return (p[1] - p[0]).normalized();
  return (p[p.size() - 2] - p.back()).normalized();
}

/// Branches begin and end where they should; trunks go straight on; lengths add up; and the clearance holds at fine samples.
void check_route(const Scene& scene, const HarnessResult& r) {
  const auto place = [&](const HarnessEnd& end) { return end.junction ? r.junctions[end.number].frame.at : r.options.connections[end.number].at; };
  double harness = 0, cable = 0;
  for (const HarnessBranch& branch : r.branches) {
    CHECK((branch.points.points.front() - place(branch.from)).norm() < 1e-12);
    CHECK((branch.points.points.back() - place(branch.to)).norm() < 1e-12);
    const Curve curve = branch.points.curve();
    CHECK(curve.length() == Approx(branch.length).epsilon(1e-9));
    CHECK(curve.min_bend_radius() >= r.options.min_bend_radius * (1 - 1e-9));
    if (!branch.from.junction) CHECK(curve.at(0).d3().dot(r.options.connections[branch.from.number].d3()) > 1 - 1e-9);
    if (!branch.to.junction) CHECK(curve.at(curve.length()).d3().dot(r.options.connections[branch.to.number].d3()) < -1 + 1e-9);
    harness += branch.length;
    cable += branch.length * static_cast<double>(branch.wires.size());
    if (!scene.surroundings()) continue;
    double least = 1;
    for (double s = r.options.free_ends; s < branch.length - r.options.free_ends; s += 1e-3)
      least = std::min(least, scene.surroundings()->closest(curve.at(s).at, 1).distance - r.options.section.radius());
    CHECK(least >= r.options.space.clearance - 1e-5);
    if (branch.clearance.obstacle >= 0) CHECK(branch.clearance.value == Approx(least).margin(1e-3));
  }
  CHECK(r.harness_length == Approx(harness).epsilon(1e-12));
  CHECK(r.cable_length == Approx(cable).epsilon(1e-12));
  for (std::size_t j = 0; j < r.junctions.size(); ++j) {
    const std::vector<int>& meeting = r.junctions[j].branches;
    REQUIRE(meeting.size() >= 3);
    CHECK(leaving(r.branches[meeting[0]], static_cast<int>(j)).dot(leaving(r.branches[meeting[1]], static_cast<int>(j))) < -1 + 1e-9);
  }
}

}  // namespace

TEST_CASE("three branches meet at the Steiner point", "[harness]") {
  HarnessOptions options = star_of_three();
  options.equilibrium = false;
  // The trunk's bend costs a little: the best is near the three straights of 0.3 m.
  const HarnessResult r = route_harness(Scene(), options);
  INFO(r.message);
  REQUIRE(r.ok);
  check_route(Scene(), r);
  REQUIRE(r.junctions.size() == 1);
  CHECK(r.junctions[0].frame.at.norm() < 0.02);
  CHECK(r.harness_length >= 0.9 - 1e-9);
  CHECK(r.harness_length < 0.9 * 1.01);
  HarnessOptions fixed = options;
  fixed.improve = false;
  const HarnessResult on_grid = route_harness(Scene(), fixed);
  REQUIRE(on_grid.ok);
  CHECK(r.cost <= on_grid.cost);
}

TEST_CASE("two connections are joined by one branch, three in a row by a straight trunk", "[harness]") {
  HarnessOptions two = options_with({{Vec3(0, 0, 0), Vec3::UnitX()}, {Vec3(0.5, 0, 0), -Vec3::UnitX()}});
  two.equilibrium = false;
  const HarnessResult straight = route_harness(Scene(), two);
  REQUIRE(straight.ok);
  CHECK(straight.junctions.empty());
  REQUIRE(straight.branches.size() == 1);
  CHECK(straight.harness_length == Approx(0.5).epsilon(1e-6));
  CHECK(straight.branches[0].min_bend_radius == std::numeric_limits<double>::infinity());

  HarnessOptions three = options_with({{Vec3(0, 0, 0), Vec3::UnitX()}, {Vec3(0.6, 0, 0), -Vec3::UnitX()}, {Vec3(0.3, 0.2, 0), -Vec3::UnitY()}});
  three.equilibrium = false;
  three.bundling = 1;
  const HarnessResult tee = route_harness(Scene(), three);
  REQUIRE(tee.ok);
  check_route(Scene(), tee);
  // Between the straight trunk with its branch (0.8) and the free Steiner tree (about 0.72).
  CHECK(tee.harness_length <= 0.8 * (1 + 1e-6));
  CHECK(tee.harness_length >= 0.3 * std::sqrt(3.0) + 0.2 - 1e-9);
}

TEST_CASE("a harness through a room keeps what is demanded and comes to rest", "[harness]") {
  const Scene scene = room();
  const HarnessOptions options = in_room();
  const HarnessResult r = route_harness(scene, options);
  INFO(r.message);
  REQUIRE(r.ok);
  check_route(scene, r);
  REQUIRE(r.equilibrium);
  CHECK(r.equilibrium->ok());
  CHECK(r.equilibrium->rods.size() == r.branches.size());
  CHECK(r.branches.size() == r.junctions.size() + options.connections.size() - 1);
  // Held ends stay, junctions join.
  for (std::size_t b = 0; b < r.branches.size(); ++b) {
    const Equilibrium& eq = r.equilibrium->rods[b].equilibrium;
    const HarnessBranch& branch = r.branches[b];
    for (const auto& [end, at] : {std::pair{branch.from, eq.points.front()}, std::pair{branch.to, eq.points.back()}})
      CHECK((at - (end.junction ? r.junctions[end.number].settled.at : options.connections[end.number].at)).norm() < 1e-9);
    CHECK(branch.settled_length == Approx(branch.length).epsilon(1e-2));
  }
  SECTION("for any number of threads the same") {
    RunContext one;
    one.threads = 1;
    const HarnessResult again = route_harness(scene, options, one);
    REQUIRE(again.ok);
    CHECK(again.cost == r.cost);
    for (std::size_t b = 0; b < r.branches.size(); ++b) CHECK(again.branches[b].points.points == r.branches[b].points.points);
  }
  SECTION("bundling shortens the harness") {
    HarnessOptions loose = options, tight = options;
    loose.equilibrium = tight.equilibrium = false;
    loose.bundling = 0;
    tight.bundling = 1;
    const HarnessResult l = route_harness(scene, loose), t = route_harness(scene, tight);
    INFO(l.message << "; " << t.message);
    REQUIRE((l.ok && t.ok));
    CHECK(t.harness_length < l.harness_length);
    CHECK(t.cable_length > l.cable_length);
  }
}

TEST_CASE("a harness that is impossible says why", "[harness]") {
  Scene scene;
  scene.add(solid_of("wall", Box{Vec3(0.02, 4, 4)}, Vec3(0.25, 0, 0)));
  HarnessOptions options = options_with({{Vec3(0, 0, 0), Vec3::UnitX()}, {Vec3(0.5, 0, 0), -Vec3::UnitX()}, {Vec3(0, 0.3, 0), Vec3::UnitX()}});
  options.space.keep_in = Eigen::AlignedBox3d(Vec3(-0.1, -0.2, -0.1), Vec3(0.6, 0.4, 0.1));
  const HarnessResult apart = route_harness(scene, options);
  CHECK(apart.status == Status::infeasible);
  CHECK_FALSE(apart.ok);
  CHECK(apart.message.find("connections 1 and 2: ") == 0);
  CHECK(apart.message.find("wall") != std::string::npos);

  options.connections[0].at = Vec3(0.235, 0, 0);
  const HarnessResult inside = route_harness(scene, options);
  CHECK(inside.status == Status::infeasible);
  CHECK(inside.message.find("connection 1: ") == 0);
  CHECK(inside.message.find("'wall'") != std::string::npos);
}

TEST_CASE("a harness that is cancelled says so", "[harness]") {
  const std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  const HarnessResult r = route_harness(room(), in_room(), context);
  CHECK(r.status == Status::cancelled);
  CHECK(r.message == "cancelled; no route yet");
}

TEST_CASE("a harness's options are checked", "[harness]") {
  const auto message = [](auto change) -> std::string {
    HarnessOptions options = star_of_three();
    change(options);
    try {
      route_harness(Scene(), options);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no error";
  };
  CHECK(message([](auto& o) { o.connections.resize(1); }) == "harness: 1 connections, 2 to 9 expected");
  CHECK(message([](auto& o) { o.connections[1].at.x() = std::nan(""); }) == "harness: connection 2 is not a finite place with a rotation");
  CHECK(message([](auto& o) { o.connections[2] = o.connections[0]; }) == "harness: connections 1 and 3 are in one place");
  CHECK(message([](auto& o) { o.names = {"a"}; }) == "harness: 1 names for 3 connections");
  CHECK(message([](auto& o) { o.min_bend_radius = 0.006; }) ==
        "harness: the bend radius is 6 mm, more than the section's own radius of 6 mm expected; bend radii are those of the centre line");
  CHECK(message([](auto& o) { o.end_straight = -1; }) == "harness: 'end_straight' is -1 m, a length of at least 0 expected");
  CHECK(message([](auto& o) { o.max_bends = 1; }) == "harness: 'max_bends' is 1, 2 to 30 expected");
  CHECK(message([](auto& o) { o.grid = 0; }) == "harness: 'grid' is 0 m, a length above 0 expected");
  CHECK(message([](auto& o) { o.segment = 0; }) == "harness: 'segment' is 0 m, a length above 0 expected");
  CHECK(message([](auto& o) { o.max_clips = -1; }) == "harness: 'clips' is -1, 0 to 1000 expected");
  CHECK(message([](auto& o) { o.restarts = 21; }) == "harness: 'restarts' is 21, 0 to 20 expected");
  CHECK(message([](auto& o) { o.max_stretch = 0; }) == "harness: 'max_stretch' is 0, a share above 0 expected");
  CHECK(message([](auto& o) { o.solve.element = Element::staggered; }) ==
        "harness: the rods must be of se3 elements where they are refined: staggered ones have no sensitivities");
  CHECK(message([](auto& o) { o.clip_reach = -1; }) == "harness: 'clip_reach' is -1 m, a length of at least 0 expected");
  CHECK(message([](auto& o) { o.wires = {{0, 1}}; }) == "harness: no wire ends at connection 3");
}

TEST_CASE("a junction comes to the Fermat point where bends are small", "[harness]") {
  // Connections look at the point from which they are seen 120 degrees apart; the trunk's bend of 60 degrees costs a few mm.
  const double a = 0.35, b = 0.25, c = 0.2;
  HarnessOptions options;
  const Vec3 fermat(0.1, 0.05, 0.02);
  int k = 0;
  for (const double length : {a, b, c}) {
    const double angle = 120 * units::deg * k++ + 0.3;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    options.connections.push_back(Frame::looking(fermat + length * out, -out));
  }
  options.section = Section::round(0.004, 0, Material::from_poisson(2e7, 0.4, 1500));
  options.min_bend_radius = 0.003;
  options.bundling = 1;
  options.equilibrium = false;
  const HarnessResult r = route_harness(Scene(), options);
  INFO(r.message);
  REQUIRE(r.ok);
  REQUIRE(r.junctions.size() == 1);
  CHECK((r.junctions[0].frame.at - fermat).norm() < 0.004);
  CHECK(r.harness_length >= a + b + c - 1e-9);
  CHECK(r.harness_length <= (a + b + c) * 1.002);
  CHECK(r.cost == Approx(r.harness_length).epsilon(1e-9));
  REQUIRE(r.wire_lengths.size() == 2);
  CHECK(r.wire_lengths[0] == Approx(a + b).epsilon(3e-3));
  CHECK(r.wire_lengths[1] == Approx(a + c).epsilon(3e-3));
  CHECK(r.wire_lengths[0] + r.wire_lengths[1] == Approx(r.cable_length).epsilon(1e-12));

  SECTION("moved and turned, and with connections in another order") {
    Random random(3);
    for (int run = 0; run < 4; ++run) {
      INFO("run " << run);
      HarnessOptions moved = options;
      const Frame by{random.point(0.3), random.rotation()};
      for (Frame& frame : moved.connections) frame = by * frame;
      if (run % 2) std::swap(moved.connections[0], moved.connections[2]);
      const HarnessResult other = route_harness(Scene(), moved);
      REQUIRE(other.ok);
      CHECK(other.cost == Approx(r.cost).epsilon(1e-3));
      CHECK((other.junctions[0].frame.at - (by * Frame{fermat, Quat::Identity()}).at).norm() < 0.004);
    }
  }
}

TEST_CASE("more weight on clearance never brings a harness nearer", "[harness]") {
  Scene scene;
  scene.add(solid_of("post", Cylinder{0.04, 0.6}, Vec3(0.3, 0.02, 0)));
  HarnessOptions options;
  options.connections = {Frame::looking(Vec3(0, 0, 0), Vec3::UnitX()), Frame::looking(Vec3(0.6, 0.1, 0), -Vec3::UnitX()),
                         Frame::looking(Vec3(0.6, -0.1, 0), -Vec3::UnitX())};
  options.section = cable();
  options.min_bend_radius = 0.03;
  options.end_straight = 0.01;
  options.equilibrium = false;
  double gap = 0, length = 0;
  for (const double weight : {0.0, 1.0, 4.0, 16.0}) {
    INFO("weight " << weight);
    options.space.clearance_weight = weight;
    const HarnessResult r = route_harness(scene, options);
    REQUIRE(r.ok);
    double nearest = 1;
    for (const HarnessBranch& branch : r.branches)
      if (branch.clearance.obstacle >= 0) nearest = std::min(nearest, branch.clearance.value);
    CHECK(nearest >= gap - 1e-4);
    CHECK(r.cable_length >= length * (1 - 1e-3));
    // What a metre costs more, summed by hand.
    double more = 0, cost = 0;
    for (const HarnessBranch& branch : r.branches) {
      const Curve curve = branch.points.curve();
      constexpr int places = 4000;
      double here = 0;
      for (int i = 0; i < places; ++i) {
        const Vec3 at = curve.at((i + 0.5) / places * curve.length()).at;
        const double outside = std::hypot(at.x() - 0.3, at.y() - 0.02) - 0.04 - 0.006;
        const double share = std::max(0.0, 1 - outside / options.space.preference_range);
        here += weight * share * share * curve.length() / places;
      }
      more += here;
      cost += branch.factor * (branch.length + here);
    }
    CHECK(r.preference == Approx(more).epsilon(1e-3).margin(1e-9));
    CHECK(r.cost == Approx(cost).epsilon(1e-3));
    gap = nearest;
    length = r.cable_length;
  }
  CHECK(gap > 0.02);
}
