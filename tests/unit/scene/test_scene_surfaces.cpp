// Scenes as surfaces: rods as tubes where they are, bodies in their places, motions, rods as text.
#include <catch2/catch.hpp>
#include <sstream>

#include "base/error.h"
#include "geometry/mesh_topology.h"
#include "scene/scene_motion.h"
#include "scene/scene_surfaces.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::testing;

namespace {

Scene hose_over_bodies() {
  Scene scene(earth);
  scene.add(sagging_hose());
  scene.add(solid("block", Box{{0.3, 0.2, 0.1}}, {0.4, 0.5, 0.2}));
  scene.add(sheet("sheet", {0, 0, -1}));
  PlacedObstacle floor = solid("floor", HalfSpace{}, {0, 0, -2});
  scene.add(floor);
  return scene;
}

const SurfacePart& named(const std::vector<SurfacePart>& parts, const std::string& name) {
  for (const SurfacePart& part : parts)
    if (part.name == name) return part;
  throw std::runtime_error("no part " + name);
}

std::vector<std::string> names(const std::vector<SurfacePart>& parts) {
  std::vector<std::string> all;
  for (const SurfacePart& part : parts) all.push_back(part.name);
  return all;
}

}  // namespace

TEST_CASE("a scene in equilibrium as surfaces", "[surfaces]") {
  const Scene scene = hose_over_bodies();
  const SceneEquilibrium eq = scene.solve();
  REQUIRE(eq.ok());
  const std::vector<SurfacePart> parts = surfaces_of(eq);
  CHECK(names(parts) == std::vector<std::string>{"hose", "block", "sheet", "floor"});
  const SurfacePart& hose = named(parts, "hose");
  CHECK(topology_of(welded(*hose.mesh, 1e-9).mesh, 0).watertight());
  CHECK(hose.smooth);
  CHECK(hose.opacity == 1);
  // Pappus: the section's area times the deformed length, less what facets cut off.
  const double volume = M_PI * 1e-4 * eq.rods[0].equilibrium.settled_length();
  CHECK(hose.mesh->volume() < volume);
  CHECK(hose.mesh->volume() > 0.96 * volume);
  CHECK(surfaces_of(eq, {.tolerance = 1e-6})[0].mesh->volume() == Approx(volume).epsilon(1e-3));
  // Every point of it is a radius from the centre line, and every vertex of that within the tube.
  for (const auto& sample : eq.rods[0].equilibrium.sampled(0.01)) {
    double nearest = 1;
    for (const Vec3& v : hose.mesh->vertices) nearest = std::min(nearest, (v - sample.frame.at).norm());
    CHECK(nearest < 0.02);
  }
  Eigen::AlignedBox3d box;
  for (const Vec3& p : eq.rods[0].equilibrium.points) box.extend(p);
  CHECK((hose.mesh->box().min() - box.min()).minCoeff() > -0.0101);
  CHECK((hose.mesh->box().max() - box.max()).maxCoeff() < 0.0101);

  const SurfacePart& block = named(parts, "block");
  CHECK(block.pose.at == Vec3(0.4, 0.5, 0.2));
  CHECK(block.mesh->volume() == Approx(0.006));
  CHECK(block.double_sided);
  CHECK(block.opacity == 0.5f);
  CHECK(named(parts, "sheet").mesh->triangles.size() == 2);
  CHECK(named(parts, "floor").mesh->triangles.size() == 2);

  CHECK(names(surfaces_of(eq, {.rods = false})) == std::vector<std::string>{"block", "sheet", "floor"});
  CHECK(names(surfaces_of(eq, {.obstacles = false})) == std::vector<std::string>{"hose"});
  CHECK(names(surfaces_of(scene)) == std::vector<std::string>{"block", "sheet", "floor"});
  CHECK_THROWS_WITH(surfaces_of(eq, {.tolerance = -1}), "surfaces: the tolerance is not a finite number of at least 0");
}

TEST_CASE("a rod without a shape is refused", "[surfaces]") {
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  Scene scene(earth);
  scene.add(sagging_hose());
  SceneEquilibrium eq = scene.solve({}, context);
  eq.rods[0].equilibrium.points.clear();
  eq.rods[0].equilibrium.message = "cancelled";
  CHECK_THROWS_WITH(surfaces_of(eq), "surfaces: rod 'hose' has no shape in this equilibrium (cancelled); solve the scene first");
  CHECK_THROWS_AS(rods_csv(eq), UsageError);
}

TEST_CASE("a motion as moving surfaces", "[surfaces]") {
  const Scene scene = hose_over_bodies();
  MovingHold finish{"hose", 1.2, [](double t) { return Frame::looking({0.8 - 0.2 * t, 0.1 * t, 1}, {1, 0, 0}); }};
  MotionOptions options;
  options.steps = 4;
  const SceneMotion motion = move_holds(scene, {finish}, options, {}, {});
  REQUIRE(motion.ok());
  const std::vector<std::shared_ptr<const SceneEquilibrium>> states(motion.equilibria.begin(), motion.equilibria.end());
  const std::vector<MovingPart> parts = moving_surfaces_of(states);
  REQUIRE(parts.size() == 4);
  const MovingPart& hose = parts[0];
  REQUIRE(hose.sections.size() == 5);
  CHECK(hose.section_of_vertex.size() == hose.part.mesh->vertices.size());
  for (std::size_t t = 0; t < 5; ++t) {
    CHECK((hose.sections[t].front().at - Vec3(0, 0, 1)).norm() < 1e-9);
    CHECK((hose.sections[t].back().at - finish.path(0.25 * static_cast<double>(t)).at).norm() < 1e-9);
    const Equilibrium& state = states[t]->rods[0].equilibrium;
    const std::size_t middle = hose.sections[t].size() / 2;
    const double s = 1.2 * static_cast<double>(middle) / static_cast<double>(hose.sections[t].size() - 1);
    CHECK((hose.sections[t][middle].at - state.frame_at(s).at).norm() < 1e-12);
  }
  for (std::size_t i = 1; i < 4; ++i) CHECK((parts[i].poses.empty() && parts[i].sections.empty()));  // they rest
  CarriedBody carried{"plug", "hose", 1.2, {}};
  carried.body.shape = Solid(Box{{0.02, 0.02, 0.02}});
  carried.body.pose.at = {0, 0, 0.01};
  const std::vector<MovingPart> plug = moving_bodies_of({carried}, states);
  for (std::size_t t = 0; t < 5; ++t) CHECK((plug[0].poses[t].at - finish.path(0.25 * static_cast<double>(t)).at - Vec3(0.01, 0, 0)).norm() < 1e-9);
  CHECK(!glb_of(parts, motion.times).empty());
  CHECK_THROWS_WITH(moving_surfaces_of({states[0]}), "surfaces: a motion of 1 states; at least 2 expected");
  Scene other(earth);
  other.add(sagging_hose("pipe"));
  CHECK_THROWS_WITH(moving_surfaces_of({states[0], std::make_shared<const SceneEquilibrium>(other.solve())}),
                    "surfaces: the states of the motion do not hold the same rods and bodies");
}

TEST_CASE("rods as comma-separated text", "[surfaces]") {
  Scene scene(earth);
  scene.add(sagging_hose("hose, \"left\"", 10));
  const SceneEquilibrium eq = scene.solve();
  const Equilibrium& state = eq.rods[0].equilibrium;
  std::istringstream text(rods_csv(eq));
  std::string line;
  std::getline(text, line);
  CHECK(line == "rod,s (m),x (m),y (m),z (m),tangent x,tangent y,tangent z,bend radius (m),tension (N)");
  const std::vector<double> radii = state.bend_radii();
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    REQUIRE(std::getline(text, line));
    const std::string name = "\"hose, \"\"left\"\"\",";
    REQUIRE(line.substr(0, name.size()) == name);
    std::istringstream fields(line.substr(name.size()));
    std::vector<double> numbers;
    for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::strtod(field.c_str(), nullptr));
    REQUIRE(numbers.size() == 9);
    CHECK(numbers[0] == state.s[i]);
    CHECK(Vec3(numbers[1], numbers[2], numbers[3]) == state.points[i]);
    CHECK(Vec3(numbers[4], numbers[5], numbers[6]).norm() == Approx(1));
    CHECK(numbers[7] == radii[i]);
  }
  CHECK_FALSE(std::getline(text, line));
  // A weight on a straight, hanging rod: its own below, and the load.
  Scene hanging(earth);
  PlacedRod rope("rope", Rod::uniform(1, soft_section(), 20), Frame::looking({0, 0, 0}, {0, 0, -1}), {});
  rope.load({.at = 1, .force = {0, 0, -5}});
  hanging.add(std::move(rope));
  const SceneEquilibrium straight = hanging.solve();
  std::istringstream lines(rods_csv(straight));
  std::getline(lines, line);
  for (int i = 0; i <= 20; ++i) {
    std::getline(lines, line);
    const double tension = std::strtod(line.substr(line.rfind(',') + 1).c_str(), nullptr);
    const double middle = (std::min(i, 19) + 0.5) / 20;
    CHECK(tension == Approx(5 + (1 - middle) * soft_section().mass * 9.81).epsilon(1e-6));
  }
}
