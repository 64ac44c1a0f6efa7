#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

#include "base/error.h"
#include "method/stability/stability.h"
#include "scene/scene_gradient.h"
#include "unit/method/variation_cases.h"

using namespace tendril;
using namespace tendril::testing;
using variation::Options;
using variation::Outcomes;
using variation::OutcomeStatus;
using variation::Sampling;
using variation::Study;

namespace {

bool holds(const variation::Estimate& e, double truth) { return e.low <= truth && truth <= e.high; }

Options small_tolerances(int outcomes) {
  Options options;
  options.outcomes = outcomes;
  options.vary = {number("hose.length", 2e-4), ball("hose.to", 2e-4), number("hose.section.stiffness", 1e-3),
                  cone("hose.from", 1e-3)};
  options.vary[1].spread = variation::Spread::normal;
  options.measures = {measure("hose.min_bend_radius"), measure("hose.from.force.z"), measure("hose.energy.bend"),
                      function("sag", [](const SceneEquilibrium& e) { return e.rods[0].equilibrium.frame_at(0.5).at.z(); })};
  options.measures[3].unit = "m";
  return options;
}

}  // namespace

TEST_CASE("variation: small tolerances give the variance of the exact gradient, within the interval, for 40 seeds",
          "[variation]") {
  const Scene scene = one_hose();
  const Options options = small_tolerances(400);
  // The exact gradient, from the adjoint solution.
  SolveOptions tight;
  tight.tolerance = 1e-12;
  const SceneEquilibrium nominal = scene.solve(tight);
  SceneSensitivity sensitivity(nominal);
  const std::vector<SceneParameter> parameters =
      named_parameters(nominal, {"hose.length", "hose.to.at", "hose.section.stiffness", "hose.from.turn"});
  const SceneGradient g = sensitivity.gradient(named_measure(nominal, "hose.min_bend_radius"), parameters);
  REQUIRE(g.ok);
  const double third = 1.0 / 3;
  double variance = std::pow(g.entries[0].derivative * 2e-4 * third, 2);
  for (int c = 1; c < 4; ++c) variance += std::pow(g.entries[c].derivative * 2e-4 * third, 2);
  variance += std::pow(g.entries[4].derivative * 1e-3 * third, 2);
  // Tilts about the section's own d1 and d2; uniform over a small cap: each a quarter of the squared half angle.
  const Quat q = nominal.rods[0].problem.holds[0].frame.rotation;
  const Vec3 turn(g.entries[5].derivative, g.entries[6].derivative, g.entries[7].derivative);
  variance += (std::pow(turn.dot(q * Vec3::UnitX()), 2) + std::pow(turn.dot(q * Vec3::UnitY()), 2)) * 1e-6 / 4;
  int deviations = 0, means = 0;
  constexpr int seeds = 40;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Study study(scene, options, with_seed(seed));
    const Outcomes outcomes = study.run(0, options.outcomes);
    REQUIRE(outcomes.count(OutcomeStatus::solved) == options.outcomes);
    const variation::Sample sample = study.sample(outcomes, 0);
    deviations += holds(sample.deviation(), std::sqrt(variance));
    means += holds(sample.mean(), study.measures()[0].nominal);
    if (seed > 1) continue;
    const variation::Contributions contributions = study.contributions(outcomes, 0);
    CHECK(contributions.linear_deviation == Approx(std::sqrt(variance)).epsilon(1e-3));
    CHECK(contributions.explained > 0.999);
    double linear = 0;
    for (const variation::Contributor& c : contributions.all) {
      linear += c.linear;
      CHECK(c.regression == Approx(c.linear).margin(0.08));
    }
    CHECK(linear == Approx(1).epsilon(1e-9));
    CHECK(study.measures()[0].nominal == Approx(nominal.rods[0].equilibrium.smallest_bend_radius()).epsilon(1e-9));
  }
  CHECK(deviations >= 34);
  CHECK(means >= 34);
}

TEST_CASE("variation: total effects of an additive measure are its linear shares; interactions show", "[variation]") {
  const Scene scene = one_hose(10);
  Options options;
  options.outcomes = options.effects = 512;
  options.vary = {number("hose.to.at.x", 0.01), number("hose.to.at.y", 0.03), number("hose.to.at.z", 0.02)};
  const auto to = [](const SceneEquilibrium& e) { return Vec3(e.rods[0].problem.holds[1].frame.at - Vec3(0.8, 0.05, -0.12)); };
  options.measures = {function("sum", [=](const SceneEquilibrium& e) { return to(e).sum(); }),
                      function("product", [=](const SceneEquilibrium& e) { return to(e).x() * to(e).y(); })};
  const Study study(scene, options, with_seed(3));
  const Outcomes outcomes = study.run(0, options.outcomes);
  const auto of = [](const variation::Contributions& all, const std::string& name) {
    for (const variation::Contributor& c : all.all)
      if (c.name == name) return c;
    FAIL(name);
    return variation::Contributor{};
  };
  const variation::Contributions sum = study.contributions(outcomes, 0), product = study.contributions(outcomes, 1);
  CHECK(sum.all[0].name == "hose.to.at.y");
  for (const auto& [name, share] :
       {std::pair{"hose.to.at.x", 1.0 / 14}, std::pair{"hose.to.at.y", 9.0 / 14}, std::pair{"hose.to.at.z", 4.0 / 14}}) {
    const variation::Contributor c = of(sum, name);
    CAPTURE(name, c.first.value, c.total.value, c.total.low, c.total.high);
    CHECK(c.linear == Approx(share).epsilon(1e-6));
    CHECK(std::abs(c.total.value - share) < 2 * c.total.half_width());
    CHECK(std::abs(c.first.value - share) < 2 * c.first.half_width());
    CHECK(c.total.half_width() < 0.12);
  }
  // x y: nothing by themselves, all by their interaction.
  for (const char* name : {"hose.to.at.x", "hose.to.at.y"}) {
    CHECK(std::abs(of(product, name).first.value) < 2 * of(product, name).first.half_width());
    CHECK(std::abs(of(product, name).total.value - 1) < 2 * of(product, name).total.half_width());
  }
  CHECK(of(product, "hose.to.at.z").total.value == Approx(0).margin(1e-12));
}

TEST_CASE("variation: the same bits for any number of threads, and whichever parts are run", "[variation]") {
  const Scene scene = three_hoses();
  for (const Sampling sampling : {Sampling::random, Sampling::sobol, Sampling::latin}) {
    Options options;
    options.outcomes = 150;
    options.sampling = sampling;
    options.effects = 20;
    options.vary = {number("a.length", 0.03), cone("b.to", 0.2), ball("c.to", 0.02), number("b.length", 0.02)};
    options.groups = {{{"a.length", "b.length"}, Eigen::MatrixXd::Constant(1, 1, 0.6)}};
    options.measures = {
        measure("a.min_bend_radius"), measure("b.max_tension"),
        measure("tee.place.z"),       measure("c.to.moment.x"),
        measure("a.energy.bend"),     function("z", [](const SceneEquilibrium& e) { return e.branches[0].frame.at.z(); })};
    const Study study(scene, options, with_seed(5, 1));
    const Outcomes whole = study.run(0, 150, {}, with_seed(5, 1));
    CAPTURE(name_of(sampling), variation::summary(whole));
    CHECK(whole.count(OutcomeStatus::solved) == 150);
    for (int k = 0; k < 150; ++k) CHECK(whole.measures_of(k)[2] == Approx(whole.measures_of(k)[5]).margin(1e-9));
    for (const int threads : {2, 5}) {
      const Study other(scene, options, with_seed(5, threads));
      const Outcomes again = other.run(0, 150, {}, with_seed(5, threads));
      CHECK(identical(whole, again));
      for (int k = 0; k < 20; ++k)
        CHECK(std::memcmp(whole.effects_of(k).data(), again.effects_of(k).data(), whole.effects_of(k).size_bytes()) == 0);
    }
    const Outcomes parts[] = {study.run(97, 150), study.run(0, 13), study.run(13, 97), study.run(40, 40)};
    const Outcomes merged = Outcomes::merged(parts);
    CHECK(identical(whole, merged));
    CHECK(study.sample(whole, 0).mean().low == study.sample(merged, 0).mean().low);
    CHECK(study.contributions(whole, 0).all[0].total.value == study.contributions(merged, 0).all[0].total.value);
    CHECK_FALSE(identical(whole, Study(scene, options, with_seed(6)).run(0, 150)));
  }
}

TEST_CASE("variation: an outcome by itself is the one of the study, and built-in measures are those of its equilibrium",
          "[variation]") {
  const Scene scene = three_hoses();
  Options options;
  options.outcomes = 30;
  options.vary = {number("a.length", 0.03), cone("b.to", 0.2), number("c.section.EI", 0.1)};
  options.vary[2].relative = true;
  const char* names[] = {"a.min_bend_radius", "b.max_tension", "b.max_strain", "c.length",
                         "a.from.force.x",    "b.to.moment.y", "tee.place.x"};
  for (const char* name : names) options.measures.push_back(measure(name));
  for (const auto& [what, text] : {std::pair{Measure::What::position, "position"}, std::pair{Measure::What::tangent, "tangent"},
                                   std::pair{Measure::What::force, "force"}, std::pair{Measure::What::moment, "moment"},
                                   std::pair{Measure::What::tension, "tension"}, std::pair{Measure::What::twist, "twist"},
                                   std::pair{Measure::What::bend_radius, "bend"}}) {
    variation::MeasureRequest request = measure(text);
    request.built_in = SceneMeasure{text, 0, {}};
    request.built_in->measure.what = what;
    request.built_in->measure.rod = 1;
    request.built_in->measure.at = 0.21;
    options.measures.push_back(request);
  }
  const Study study(scene, options, with_seed(9));
  std::vector<int> passed;
  std::vector<std::vector<double>> frames;
  const Outcomes outcomes = study.run(0, 30, [&](const variation::OutcomeView& view) {
    passed.push_back(view.outcome);
    REQUIRE(view.frames.size() == 3);
    frames.emplace_back(view.frames[1].begin(), view.frames[1].end());
    CHECK(view.measures.size() == options.measures.size());
    CHECK(view.status == OutcomeStatus::solved);
  });
  REQUIRE(passed.size() == 30);
  for (const int k : {0, 7, 29}) {
    CHECK(passed[k] == k);
    const SceneEquilibrium eq = study.equilibrium(k);
    REQUIRE(eq.ok());
    const std::vector<double> variables = study.variables_of(k);
    for (std::size_t c = 0; c < variables.size(); ++c) CHECK(variables[c] == outcomes.variables_of(k)[c]);
    CHECK(eq.rod("a").problem.rod.length == Approx(variables[0]).epsilon(1e-14));
    CHECK(eq.rod("c").problem.rod.parts[0].section.EI1 == Approx(variables[3]).epsilon(1e-14));
    const Equilibrium& b = eq.rod("b").equilibrium;
    for (std::size_t i = 0; i < b.points.size(); ++i)
      CHECK((b.points[i] - Vec3(frames[k][7 * i], frames[k][7 * i + 1], frames[k][7 * i + 2])).norm() < 1e-8);
    SceneSensitivity sensitivity(eq);
    for (std::size_t m = 0; m < options.measures.size(); ++m) {
      CAPTURE(k, options.measures[m].name);
      const SceneMeasure own =
          options.measures[m].built_in ? *options.measures[m].built_in : named_measure(eq, options.measures[m].name);
      const SceneGradient g = sensitivity.gradient(own, named_parameters(eq, {"a.length"}));
      CHECK(outcomes.measures_of(k)[m] == Approx(g.value).epsilon(1e-6).margin(1e-7));
    }
  }
  // The tilt is within its cone, and what the clamp turned by.
  for (int k = 0; k < 30; ++k) CHECK(std::hypot(outcomes.variables_of(k)[1], outcomes.variables_of(k)[2]) <= 0.2);
  const Frame held = study.equilibrium(4).rod("b").problem.holds[0].frame, was = study.nominal().rod("b").problem.holds[0].frame;
  CHECK(std::acos(held.d3().dot(was.d3())) ==
        Approx(std::hypot(outcomes.variables_of(4)[1], outcomes.variables_of(4)[2])).epsilon(1e-6));
}

TEST_CASE("variation: correlated variables are, in what is drawn", "[variation]") {
  const Scene scene = three_hoses();
  Options options;
  options.outcomes = 4000;
  options.vary = {number("a.length", 0.01), number("b.length", 0.02), number("c.length", 0.01)};
  options.vary[2].spread = variation::Spread::uniform;
  Eigen::MatrixXd correlation(2, 2);
  correlation << 1, -0.7, -0.7, 1;
  options.groups = {{{"a.length", "b.length"}, correlation}};
  options.measures = {measure("a.length")};
  const Study study(scene, options, with_seed(2));
  Eigen::MatrixXd values(4000, 3);
  for (int k = 0; k < 4000; ++k) values.row(k) = Eigen::Map<const Eigen::RowVector3d>(study.variables_of(k).data());
  values.rowwise() -= values.colwise().mean().eval();
  const auto r = [&](int a, int b) { return values.col(a).dot(values.col(b)) / (values.col(a).norm() * values.col(b).norm()); };
  CHECK(r(0, 1) == Approx(-0.7).margin(0.03));
  CHECK(r(0, 2) == Approx(0).margin(0.06));
  CHECK(values.col(1).norm() / std::sqrt(4000.0) == Approx(0.02 / 3).epsilon(0.06));
  CHECK(values.col(2).cwiseAbs().maxCoeff() < 0.0101);
  REQUIRE(study.contributors().size() == 2);
  CHECK(study.contributors()[0] == "a.length + b.length");
}

TEST_CASE("variation: functions are called in the order of outcomes, on the thread that asked", "[variation]") {
  const Scene scene = one_hose(8);
  Options options;
  options.outcomes = 40;
  std::vector<double> asked;
  int calls = 0;
  options.vary = {number("hose.length", 0.01)};
  options.vary[0].tolerance.reset();
  options.vary[0].inverse = [&asked](double u) {
    asked.push_back(u);
    return 0.02 * u;
  };
  options.measures = {function("calls", [&calls](const SceneEquilibrium&) { return ++calls; })};
  const Study study(scene, options, with_seed(4, 3));
  asked.clear();
  calls = 0;
  const Outcomes outcomes = study.run(0, 40, {}, with_seed(4, 3));
  REQUIRE(asked.size() == 40);
  for (int k = 0; k < 40; ++k) {
    CHECK(outcomes.measures_of(k)[0] == k + 1);
    CHECK(outcomes.variables_of(k)[0] == Approx(1 + 0.02 * asked[k]));
  }
}

TEST_CASE("variation: tables give every outcome its number or frame", "[variation]") {
  const Scene scene = one_hose(10);
  Options options;
  options.outcomes = 9;
  variation::Variable length, to;
  length.name = "hose.length";
  to.name = "hose.to";
  const Frame nominal = scene.rod("hose").holds()[1].frame;
  for (int k = 0; k < 9; ++k) {
    length.numbers.push_back(1.0 + 0.01 * k);
    to.frames.push_back(nominal.moved({0.005 * k, 0.01 * k, 0}, {0, 0, 1}, 0.05 * k));
  }
  options.vary = {length, to};
  options.measures = {measure("hose.length")};
  const Study study(scene, options);
  const Outcomes outcomes = study.run(0, 9);
  CHECK(outcomes.count(OutcomeStatus::solved) == 9);
  for (int k = 0; k < 9; ++k) {
    const SceneEquilibrium eq = study.equilibrium(k);
    const RodProblem& problem = eq.rods[0].problem;
    CHECK(problem.rod.length == Approx(1.0 + 0.01 * k));
    CHECK((problem.holds[1].frame.at - to.frames[k].at).norm() < 1e-12);
    CHECK(problem.holds[1].frame.rotation.angularDistance(to.frames[k].rotation) < 1e-7);
    CHECK(outcomes.measures_of(k)[0] == Approx(eq.rods[0].equilibrium.settled_length()).epsilon(1e-9));
  }
}

TEST_CASE("variation: gravity, loads, clips and parts of systems", "[variation]") {
  Scene scene({0, 0, -9.81});
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  PlacedRod& a = scene.add(PlacedRod("a", Rod::uniform(1, hose_section(), 20), start, start.moved({0.9, 0, 0})));
  a.hold({0.4, Frame{{0.36, 0, -0.05}, Quat::Identity()}, true, false});
  a.load({0.7, {0, 0, -2}, Vec3::Zero()});
  scene.add(PlacedRod("b", Rod::uniform(1, hose_section(), 10), start.moved({0, 1, 0}), start.moved({0.9, 1, 0})));
  Options options;
  options.outcomes = 20;
  options.vary = {cone("gravity", 0.1), number("a.hold.1.place", 0.02), number("a.load.1.force.z", 0.5), ball("a.hold.1", 0.01)};
  options.measures = {measure("a.from.force.z"), measure("b.from.force.z"), measure("a.max_tension")};
  const Study study(scene, options, with_seed(8));
  const Outcomes outcomes = study.run(0, 20);
  CHECK(outcomes.count(OutcomeStatus::solved) == 20);
  for (const int k : {0, 11}) {
    const SceneEquilibrium eq = study.equilibrium(k);
    CHECK(eq.rod("a").problem.gravity.norm() == Approx(9.81).epsilon(1e-12));
    CHECK(std::acos(-eq.rod("b").problem.gravity.normalized().z()) ==
          Approx(std::hypot(outcomes.variables_of(k)[0], outcomes.variables_of(k)[1])).epsilon(1e-6));
    CHECK(eq.rod("a").problem.holds[2].at == Approx(outcomes.variables_of(k)[2]));
    CHECK(eq.rod("a").problem.loads[0].force.z() == Approx(outcomes.variables_of(k)[3]));
    CHECK(eq.rod("a").equilibrium.reactions[0].force.z() == Approx(outcomes.measures_of(k)[0]).epsilon(1e-5));
  }
  // Where nothing of a system varies it stays the nominal one.
  options.vary = {number("a.length", 0.01)};
  options.measures = {measure("b.from.force.z")};
  const Study still(scene, options);
  const Outcomes same = still.run(0, 20);
  for (int k = 0; k < 20; ++k) CHECK(same.measures_of(k)[0] == still.measures()[0].nominal);
}

TEST_CASE("variation: a preformed hose of another length is cut or goes on at its finish", "[variation]") {
  Scene scene;
  Rod design = Rod::uniform(0.6, hose_section(), 12);
  constexpr double radius = 0.2;
  design.shape = [](double s) {
    const double angle = std::min(s, 0.3) / radius;
    const Frame bend{{radius * (1 - std::cos(angle)), 0, radius * std::sin(angle)}, exp_rotation({0, angle, 0})};
    return s <= 0.3 ? bend : bend * Frame{{0, 0, s - 0.3}, Quat::Identity()};
  };
  design.shape_breaks = {0.3};
  scene.add(PlacedRod("hose", design, Frame{}, std::nullopt));
  Options options;
  options.outcomes = 12;
  options.vary = {number("hose.length", 0.06)};
  options.measures = {function("gap", [&](const SceneEquilibrium& e) {
    const Equilibrium& rod = e.rods[0].equilibrium;
    return (rod.points.back() - design.shape(rod.s.back()).at).norm();
  })};
  const Study study(scene, options);
  const Outcomes outcomes = study.run(0, 12);
  CHECK(outcomes.count(OutcomeStatus::solved) == 12);
  for (int k = 0; k < 12; ++k) CHECK(outcomes.measures_of(k)[0] < 1e-9);
}
