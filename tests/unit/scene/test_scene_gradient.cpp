#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/scene.h"
#include "scene/scene_gradient.h"

using namespace tendril;

namespace {

/// Two rods that meet at a branch point, and a third by itself.
Scene scene_with_branch(double reach = 0.9) {
  Scene scene({0, 0, -9.81});
  const Section section = Section::round(0.016, 0.004, Material::from_poisson(5e6, 0.4, 1100));
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  PlacedRod& a = scene.add(PlacedRod("a", Rod::uniform(0.5, section, 12), start, std::nullopt));
  PlacedRod& b = scene.add(PlacedRod("b", Rod::uniform(0.5, section, 12), std::nullopt, start.moved({reach, 0, 0})));
  scene.join("tee", {{&a, 0.5, std::nullopt}, {&b, 0, std::nullopt}}, std::nullopt);
  scene.add(PlacedRod("alone", Rod::uniform(1, section, 20), start.moved({0, 1, 0}), start.moved({0.8, 1, 0})));
  return scene;
}

SolveOptions exact() {
  SolveOptions options;
  options.tolerance = 1e-12;
  return options;
}

double entry(const SceneGradient& g, const std::string& name) {
  for (const SceneGradient::Entry& e : g.entries)
    if (e.parameter == name) return e.derivative;
  FAIL("no entry " << name);
  return 0;
}

}  // namespace

TEST_CASE("scene gradient: names of parameters and measures") {
  const SceneEquilibrium eq = scene_with_branch().solve(exact());
  REQUIRE(eq.ok());
  std::vector<std::string> names;
  for (const SceneParameter& p : parameters_of(eq)) names.push_back(p.name);
  for (const char* name : {"gravity.x", "a.length", "a.section.EI", "a.from.at.x", "a.from.turn.z", "b.to.at.y", "tee.1.at.x",
                           "tee.2.turn.z", "alone.to.at.z"})
    CHECK(std::count(names.begin(), names.end(), name) == 1);
  for (const char* name : {"a.to.at.x", "tee.at.x", "tee.1.place", "a.load.1.force.x"})
    CHECK(std::count(names.begin(), names.end(), name) == 0);
  CHECK(named_parameters(eq, {"b.to"}).size() == 6);
  CHECK(named_parameters(eq, {"tee"}).size() == 12);
  CHECK(named_measure(eq, "tee.place.z").measure.what == Measure::What::branch_position);
  CHECK_THROWS_WITH(named_measure(eq, "tee.force.z"), Catch::Contains("unknown measure 'tee.force.z'"));
  CHECK_THROWS_WITH(named_parameters(eq, {"tee.3.at.x"}), Catch::Contains("did you mean 'tee.1.at.x'?"));
  CHECK(SceneGradient::unit_of("m", "m") == "1");
  CHECK(SceneGradient::unit_of("N", "N m^2") == "N/(N m^2)");
  CHECK(SceneGradient::unit_of("", "m") == "1/m");
  CHECK(SceneGradient::unit_of("J", "") == "J");
}

TEST_CASE("scene gradient: rods at a branch point against differences, and a rod that hangs by itself") {
  const SceneEquilibrium eq = scene_with_branch().solve(exact());
  REQUIRE(eq.ok());
  SceneSensitivity sensitivity(eq);
  const std::vector<SceneParameter> by =
      named_parameters(eq, {"gravity.z", "a.length", "b.section.EI", "b.to.at.x", "tee.1.turn.y", "alone.length"});
  for (const std::string name : {"a.min_bend_radius", "b.max_tension", "tee.place.z", "a.from.force.x", "b.energy.bend"}) {
    const SceneMeasure measure = named_measure(eq, name);
    const SceneGradient g = sensitivity.gradient(measure, by);
    REQUIRE(g.ok);
    const SceneGradient numeric = sensitivity.gradient(
        [&](const SceneEquilibrium& other) {
          SceneSensitivity there(other);
          return there.gradient(named_measure(other, name), {}).value;
        },
        by);
    REQUIRE(numeric.ok);
    CHECK(g.value == Approx(numeric.value));
    for (const SceneParameter& p : by) {
      INFO(name << " by " << p.name);
      const double expected = entry(numeric, p.name);
      CHECK(std::abs(entry(g, p.name) - expected) <= 1e-4 * std::abs(expected) + 1e-7);
    }
    CHECK(entry(g, "alone.length") == 0);
  }
  // The scene itself, solved with the hold moved.
  const double step = 1e-4;
  const auto height = [&](double by_x) { return scene_with_branch(0.9 + by_x).solve(exact()).branches[0].frame.at.z(); };
  CHECK(entry(sensitivity.gradient(named_measure(eq, "tee.place.z"), by), "b.to.at.x") ==
        Approx((height(step) - height(-step)) / (2 * step)).epsilon(1e-5));
}

TEST_CASE("scene gradient: what is not solved or has no obstacle near") {
  Scene scene = scene_with_branch();
  SceneEquilibrium eq = scene.solve(exact());
  CHECK_THROWS_WITH(clearance_measure(eq, "a"), Catch::Contains("there is no obstacle near 'a'"));
  CHECK_THROWS_WITH(place_of_rod(eq, "alon"), Catch::Contains("did you mean 'alone'?"));
  SceneEquilibrium unsolved = eq;
  unsolved.rods[0].equilibrium.status = Status::stalled;
  unsolved.rods[0].equilibrium.message = "stuck";
  const SceneGradient g = SceneSensitivity(unsolved).gradient(named_measure(eq, "a.length"), named_parameters(eq, {"a.length"}));
  CHECK_FALSE(g.ok);
  CHECK(g.message == "the equilibrium is not solved: a: stuck");
  CHECK(std::isnan(g.entries.front().derivative));
}

TEST_CASE("scene gradient: clips that slide follow the parameters") {
  const bool two = GENERATE(false, true);  // the second one lets the rod turn
  const auto solved = [two](double stiffness) {
    Scene scene({0, 0, -9.81});
    Section section = Section::round(0.016, 0.004, Material::from_poisson(5e6, 0.4, 1100));
    section.EI1 *= stiffness;
    section.EI2 *= stiffness;
    const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
    PlacedRod& hose = scene.add(PlacedRod("hose", Rod::uniform(1.1, section, 24), start, start.moved({0.9, 0.1, 0.05})));
    Hold clip{0.4, start.moved({0.35, 0.05, 0.04})};
    clip.slide = true;
    hose.hold(clip);
    if (two) {
      Hold other{0.8, start.moved({0.68, 0.06, -0.02})};
      other.slide = true;
      other.orientation = false;
      hose.hold(other);
    }
    return scene.solve(exact());
  };
  const SceneEquilibrium eq = solved(1);
  REQUIRE(eq.ok());
  const double EI = eq.rods[0].problem.rod.parts[0].section.EI1, step = 1e-3;
  const SceneEquilibrium stiffer = solved(1 + step), softer = solved(1 - step);
  REQUIRE(stiffer.ok());
  REQUIRE(softer.ok());
  SceneSensitivity sensitivity(eq);
  const std::vector<SceneParameter> by =
      named_parameters(eq, {"gravity.z", "hose.length", "hose.section.EI", "hose.to.at.x", "hose.hold.1.at.z", "hose.hold.1.turn.y"});
  for (const std::string name : {"hose.min_bend_radius", "hose.energy.bend", "hose.from.force.x", "hose.hold.1.force.z", "hose.to.moment.y"}) {
    const auto value = [&](const SceneEquilibrium& at) { return SceneSensitivity(at).gradient(named_measure(at, name), {}).value; };
    const SceneGradient g = sensitivity.gradient(named_measure(eq, name), by);
    REQUIRE(g.ok);
    const SceneGradient numeric = sensitivity.gradient(value, by);
    REQUIRE(numeric.ok);
    for (const SceneParameter& p : by) {
      INFO(name << " by " << p.name);
      // Clips settle to a billionth of the length: by the stiffness, a small number, that asks for a step well above it.
      const double expected =
          p.name == "hose.section.EI" ? (value(stiffer) - value(softer)) / (2 * step * EI) : entry(numeric, p.name);
      CHECK(std::abs(entry(g, p.name) - expected) <= 1e-4 * std::abs(expected) + 1e-6);
    }
  }
  CHECK_THROWS_WITH(named_parameters(eq, {"hose.hold.1.place"}), Catch::Contains("unknown parameter"));
}
