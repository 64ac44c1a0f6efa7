// Build boards: lengths, planes and crossings of layouts whose answers are known; the parts against brute force.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "base/units.h"
#include "method/assembly/board_crossings.h"
#include "method/assembly/board_layout.h"
#include "method/assembly/board_press.h"
#include "method/assembly/flatten.h"

using namespace tendril;
using namespace tendril::assembly;

namespace {

Section cable() { return Section::round(0.012, 0, Material::from_poisson(5e6, 0.4, 1100)); }

/// A straight rod from a to b, held at both ends in the pose's axes.
void add_rod(Scene& scene, const std::string& name, const Vec3& a, const Vec3& b, const Frame& pose = {}) {
  const Frame from = Frame::looking(a, b - a), to{b, from.rotation};
  scene.add(PlacedRod(name, Rod::uniform((b - a).norm(), cable(), 20), pose * from, pose * to));
}

/// A branch point at `at` of `trunk`; the others start there as they were drawn.
void join(Scene& scene, const std::string& name, const std::string& trunk, double at, const std::vector<std::string>& others) {
  const PlacedRod& through = scene.rod(trunk);
  const Frame here = through.hold_at(0) ? through.hold_at(0)->frame * Frame{{0, 0, at}, Quat::Identity()}
                                        : through.hold_at(through.rod().length)->frame * Frame{{0, 0, at - through.rod().length}, Quat::Identity()};
  std::vector<BranchPlace> places{{&scene.rod(trunk), at, Frame{}}};
  for (const std::string& other : others)
    places.push_back({&scene.rod(other), 0, Frame{Vec3::Zero(), here.rotation.conjugate() * scene.rod(other).hold_at(0)->frame.rotation}});
  scene.join(name, places, std::nullopt);
}

Scene fork(double up, const Frame& pose = {}) {
  Scene scene(Vec3(0, 0, -9.81));
  add_rod(scene, "trunk", {0, 0, 0}, {0.4, 0, 0}, pose);
  add_rod(scene, "left", {0.4, 0, 0}, {0.7, 0.2, up}, pose);
  add_rod(scene, "right", {0.4, 0, 0}, {0.7, -0.2, up}, pose);
  join(scene, "fork", "trunk", 0.4, {"left", "right"});
  return scene;
}

/// A trunk with teeth of growing length across it.
Scene comb(int teeth) {
  Scene scene(Vec3(0, 0, -9.81));
  add_rod(scene, "trunk", {0, 0, 0}, {0.1 * (teeth + 1), 0, 0});
  for (int i = 1; i <= teeth; ++i) {
    const std::string tooth = "tooth " + std::to_string(i);
    add_rod(scene, tooth, {0.1 * i, 0, 0}, {0.1 * i, 0.2 + 0.02 * i, 0});
    join(scene, "joint " + std::to_string(i), "trunk", 0.1 * i, {tooth});
  }
  return scene;
}

double off_plane(const FlattenResult& r) {
  double off = 0;
  for (const BoardLine& line : r.lines)
    for (const Vec3& p : line.points) off = std::max(off, std::abs(p.z()));
  return off;
}

double worst_length(const FlattenResult& r) {
  double worst = 0;
  for (const BoardLine& line : r.lines) worst = std::max(worst, std::abs(line.length / line.design_length - 1));
  return worst;
}

Vec3 point(const FlattenResult& r, const std::string& name) {
  for (const BoardPoint& p : r.points)
    if (p.name == name) return p.at;
  FAIL("no point " << name);
  return {};
}

void check_flat(const FlattenResult& r) {
  INFO(r.message);
  CHECK(r.ok);
  CHECK(r.status == Status::solved);
  CHECK(r.crossings == 0);
  CHECK(off_plane(r) < 1e-6);
  CHECK(worst_length(r) < 1e-6);
}

}  // namespace

TEST_CASE("flatten: a hose that sags and bends is straight on the board", "[flatten]") {
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(PlacedRod("hose", Rod::uniform(0.5, cable(), 20), Frame::looking({0, 0, 0}, {1, 0, 0}), Frame::looking({0.3, 0.1, 0.1}, {0, 1, 0})));
  const FlattenResult r = flatten(scene);
  check_flat(r);
  CHECK(r.width == Approx(0.5).epsilon(1e-6));
  CHECK(r.height < 1e-6);
  CHECK(r.worst_strain < 1e-6);
  CHECK((point(r, "hose.start") - Vec3::Zero()).norm() < 1e-6);
  CHECK((point(r, "hose.finish") - Vec3(0.5, 0, 0)).norm() < 1e-6);
}

TEST_CASE("flatten: a fork in a plane keeps its angles, lengths and strains nothing", "[flatten]") {
  const FlattenResult r = flatten(fork(0));
  check_flat(r);
  CHECK(r.worst_strain < 1e-6);
  const Vec3 trunk = point(r, "fork") - point(r, "trunk.start"), left = point(r, "left.finish") - point(r, "fork"), right = point(r, "right.finish") - point(r, "fork");
  CHECK(left.norm() == Approx(std::hypot(0.3, 0.2)).epsilon(1e-6));
  CHECK(std::acos(trunk.normalized().dot(left.normalized())) == Approx(std::atan2(0.2, 0.3)).margin(1e-5));
  CHECK(std::acos(left.normalized().dot(right.normalized())) == Approx(2 * std::atan2(0.2, 0.3)).margin(1e-5));
  CHECK(r.width == Approx(0.7).epsilon(1e-5));
  CHECK(r.height == Approx(0.4).epsilon(1e-5));
}

TEST_CASE("flatten: a fork that is no plane is pressed flat, and says what that strains", "[flatten]") {
  const FlattenResult r = flatten(fork(0.1));
  CHECK(r.ok);
  CHECK(off_plane(r) < 1e-6);
  CHECK(r.crossings == 0);
  CHECK(r.worst_strain > 1e-3);
  CHECK(r.message.find("lying flat strains it by") != std::string::npos);
  CHECK(r.equilibrium->rods.size() == 3);
}

TEST_CASE("flatten: a comb of eight branches", "[flatten]") {
  const FlattenResult r = flatten(comb(8));
  check_flat(r);
  CHECK(r.lines.size() == 9);
  CHECK(r.points.size() == 18);
  for (int i = 1; i <= 8; ++i) {
    const std::string n = std::to_string(i);
    CHECK((point(r, "tooth " + n + ".finish") - point(r, "joint " + n)).norm() == Approx(0.2 + 0.02 * i).epsilon(1e-6));
    CHECK((point(r, "joint " + n) - point(r, "trunk.start")).norm() == Approx(0.1 * i).epsilon(1e-6));
  }
}

TEST_CASE("flatten: an H whose cross pieces stand across each other twists until it lies flat", "[flatten]") {
  Scene scene(Vec3(0, 0, -9.81));
  add_rod(scene, "bar", {0, 0, 0}, {0.4, 0, 0});
  add_rod(scene, "a", {0, 0, 0}, {0, 0.3, 0});
  add_rod(scene, "b", {0, 0, 0}, {0, -0.3, 0});
  add_rod(scene, "c", {0.4, 0, 0}, {0.4, 0.05, 0.3});
  add_rod(scene, "d", {0.4, 0, 0}, {0.4, -0.05, -0.3});
  join(scene, "left", "bar", 0, {"a", "b"});
  join(scene, "right", "bar", 0.4, {"c", "d"});
  const FlattenResult r = flatten(scene);
  check_flat(r);
  // The bar twists by the angle between the two: strain of the outermost fibre would be radius times that over the length.
  CHECK(r.worst_strain > 0.1 * 0.006 * 1.4 / 0.4);
  CHECK((point(r, "left") - point(r, "right")).norm() == Approx(0.4).epsilon(1e-6));
}

TEST_CASE("flatten: the layout does not know where the scene stands", "[flatten]") {
  std::mt19937 random(11);
  std::normal_distribution<> normal;
  const FlattenResult here = flatten(fork(0));
  for (int i = 0; i < 4; ++i) {
    const Frame pose{Vec3(normal(random), normal(random), normal(random)), Quat(normal(random), normal(random), normal(random), normal(random)).normalized()};
    const FlattenResult there = flatten(fork(0, pose));
    check_flat(there);
    for (const BoardPoint& p : here.points) CHECK((p.at - point(there, p.name)).norm() < 1e-5);
  }
}

TEST_CASE("flatten: a preformed bend that is no plane reports its strain", "[flatten]") {
  // Half a turn of a helix.
  const double radius = 0.1, rise = 0.03, speed = std::hypot(radius, rise);
  Rod rod = Rod::uniform(units::pi * speed, cable(), 40);
  rod.shape = [=](double s) {
    const double t = s / speed;
    return Frame::looking({radius * std::cos(t), radius * std::sin(t), rise * t}, {-radius * std::sin(t), radius * std::cos(t), rise}, {std::cos(t), std::sin(t), 0});
  };
  Scene scene;
  scene.add(PlacedRod("helix", rod, rod.shape(0), std::nullopt));
  const FlattenResult r = flatten(scene);
  INFO(r.message);
  CHECK(r.ok);
  CHECK(off_plane(r) < 1e-6);
  // It unwinds its torsion: the outermost fibre's shear is about radius rise / (radius^2 + rise^2) of the rod's radius.
  const double torsion = rise / (radius * radius + rise * rise);
  CHECK(r.worst_strain > 0.1 * 0.006 * torsion);
  CHECK(r.worst_strain < 2 * 0.006 * torsion);
  CHECK(r.message.find("strains it by") != std::string::npos);
}

TEST_CASE("flatten: branches that leave side by side are held apart", "[flatten]") {
  Scene scene(Vec3(0, 0, -9.81));
  add_rod(scene, "trunk", {0, 0, 0}, {0.4, 0, 0});
  add_rod(scene, "left", {0.4, 0, 0}, {0.8, 0, 0});
  add_rod(scene, "right", {0.4, 0, 0}, {0.8, 0, 0});
  join(scene, "fork", "trunk", 0.4, {"left", "right"});
  const FlattenResult r = flatten(scene);
  INFO(r.message);
  CHECK(r.ok);
  CHECK(r.crossings == 0);
  CHECK(r.message.find("held apart by pegs") != std::string::npos);
  CHECK((point(r, "left.finish") - point(r, "right.finish")).norm() > 0.1);
}

TEST_CASE("flatten: a loop is said to be one", "[flatten]") {
  Scene scene;
  add_rod(scene, "a", {0, 0, 0}, {0.4, 0, 0});
  add_rod(scene, "b", {0, 0, 0}, {0.4, 0, 0});
  join(scene, "begin", "a", 0, {"b"});
  scene.join("end", {{&scene.rod("a"), 0.4, Frame{}}, {&scene.rod("b"), 0.4, Frame{}}}, std::nullopt);
  scene.rod("a").hold({0.2, Frame::looking({0.2, 0, 0}, {1, 0, 0})});
  const FlattenResult r = flatten(scene);
  INFO(r.message);
  CHECK_FALSE(r.ok);
  CHECK(r.message.find("form a loop") != std::string::npos);
}

TEST_CASE("flatten: what makes no sense is refused", "[flatten]") {
  CHECK_THROWS_WITH(flatten(Scene()), Catch::Contains("flatten: the scene has no rods"));
  Scene scene = fork(0);
  CHECK_THROWS_WITH(flatten(scene, {{"lfet"}, 0}), Catch::Contains("flatten: unknown") && Catch::Contains("lfet") && Catch::Contains("left"));
  CHECK_THROWS_WITH(flatten(scene, {{}, -1}), Catch::Contains("'spacing'"));
  CHECK_THROWS_WITH(flatten(scene, {{}, NAN}), Catch::Contains("'spacing'"));
  add_rod(scene, "apart", {0, 1, 0}, {1, 1, 0});
  CHECK_THROWS_WITH(flatten(scene), Catch::Contains("flatten: rods 'trunk' and 'apart' do not hang together"));
}

TEST_CASE("flatten: the file holds every point", "[flatten]") {
  const FlattenResult r = flatten(fork(0));
  const std::string text = board_csv(r);
  std::size_t rows = 0, points = 1 + r.points.size();
  for (const BoardLine& line : r.lines) points += line.points.size();
  for (const char c : text) rows += c == '\n';
  CHECK(rows == points);
  CHECK(text.rfind("kind,name,x [mm],y [mm]\npoint,fork,", 0) == 0);
  CHECK(text.find("\nline,left,") != std::string::npos);
}

TEST_CASE("flatten: drawings of random trees cross nowhere", "[flatten]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<> number(0, 1);
  for (int round = 0; round < 30; ++round) {
    // Stars on stars, by their ends: one straight rod a piece.
    SystemProblem problem;
    SystemEquilibrium state;
    std::vector<Vec3> ends{Vec3::Zero()};
    problem.branches.push_back({});
    state.branches.push_back({});
    const int count = 3 + static_cast<int>(number(random) * 25);
    for (int k = 0; k < count; ++k) {
      const int at = static_cast<int>(number(random) * static_cast<double>(problem.branches.size()));
      const double length = 0.1 + number(random), angle = 6.28 * number(random);
      const Vec3 a = state.branches[at].at, b = a + length * Vec3(std::cos(angle), std::sin(angle), 0);
      RodProblem rod;
      rod.rod = Rod::uniform(length, cable(), 10);
      problem.rods.push_back(rod);
      problem.branches[at].sections.push_back({k, 0, {}});
      problem.branches.push_back({{{k, length, {}}}, {}, false, false});
      state.branches.push_back({b, Quat::Identity()});
      Equilibrium eq;
      for (int i = 0; i <= 10; ++i) {
        eq.s.push_back(length * i / 10);
        eq.points.push_back(a + (b - a) * i / 10);
        eq.rotations.push_back(Frame::looking(a, b - a).rotation);
      }
      state.rods.push_back(eq);
    }
    const BoardGraph graph = board_graph(problem);
    REQUIRE_FALSE(graph.has_loop());
    const std::vector<Vec3> layout = board_layout(graph, state);
    SystemEquilibrium drawn = state;
    for (const BoardPiece& piece : graph.pieces)
      for (int i = 0; i <= 10; ++i) drawn.rods[piece.rod].points[i] = layout[piece.from] + (layout[piece.to] - layout[piece.from]) * i / 10;
    INFO("round " << round << ", " << count << " rods");
    CHECK(board_crossings(graph, drawn, 1e-9).crossings == 0);
    for (const BoardPiece& piece : graph.pieces) CHECK((layout[piece.to] - layout[piece.from]).norm() == Approx(piece.length()).epsilon(1e-9));
  }
}

TEST_CASE("flatten: crossings are counted, touching ends are not", "[flatten]") {
  SystemProblem problem;
  SystemEquilibrium state;
  const auto add = [&](const Vec3& a, const Vec3& b) {
    RodProblem rod;
    rod.rod = Rod::uniform((b - a).norm(), cable(), 1);
    problem.rods.push_back(rod);
    Equilibrium eq;
    eq.s = {0, (b - a).norm()};
    eq.points = {a, b};
    state.rods.push_back(eq);
  };
  add({0, 0, 0}, {1, 0, 0});
  add({0.5, -1, 0}, {0.5, 1, 0});
  const BoardCrossings crossed = board_crossings(board_graph(problem), state, 0.01);
  CHECK(crossed.crossings == 1);
  CHECK((crossed.at - Vec3(0.5, 0, 0)).norm() < 1e-12);
  state.rods[1].points = {{0.5, 0, 0}, {0.5, 1, 0}};  // ends on the other: no inner point in common
  CHECK(board_crossings(board_graph(problem), state, 0.01).crossings == 0);
  state.rods[1].points = {{0.5, 1e-9, 0}, {0.5, 1, 0}};
  CHECK(board_crossings(board_graph(problem), state, 0.01).crossings == 0);
  state.rods[1].points = {{0.5, -1e-9, 0}, {0.5, 1, 0}};
  CHECK(board_crossings(board_graph(problem), state, 0.01).crossings == 1);
}
