// Outcomes that fail, jump or touch, and studies that cannot be.
#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>

#include "base/error.h"
#include "statics/solve.h"
#include "unit/method/variation_cases.h"

using namespace tendril;
using namespace tendril::testing;
using variation::Options;
using variation::Outcomes;
using variation::OutcomeStatus;
using variation::Study;

namespace {

/// d1 = +z, d3 = +x turned by `angle` in the plane of x and z, upwards.
Frame tilted(double x, double angle) {
  return Frame::looking({x, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {-std::sin(angle), 0, std::cos(angle)});
}

/// A strip pushed together between two clamps that tilt upwards: it bulges up. Stiff out of its plane.
Scene arch(double angle) {
  Scene scene;
  Section section;
  section.EI1 = 0.1;
  section.EI2 = 0.002;
  section.GJ = 0.05;
  section.EA = 2000;
  section.GA1 = section.GA2 = 800;
  section.mass = 0.05;
  section.outer = 0.01;
  scene.add(PlacedRod("arch", Rod::uniform(0.5, section, 40), tilted(0, angle), tilted(0.46, -angle)));
  return scene;
}

variation::MeasureRequest height() {
  variation::MeasureRequest request;
  request.name = "height";
  request.built_in = SceneMeasure{"height", 0, {}};
  request.built_in->measure.what = Measure::What::position;
  request.built_in->measure.at = 0.25;
  return request;
}

/// A floor whose top is at this height.
PlacedObstacle floor_at(double z) {
  PlacedObstacle obstacle;
  obstacle.name = "floor";
  obstacle.body.shape = Box{{3, 3, 0.5}};
  obstacle.body.pose.at = {0.4, 0, z - 0.25};
  return obstacle;
}

double lowest_of(const SceneEquilibrium& eq) {
  double z = 0;
  for (const Equilibrium::Sample& sample : eq.rods[0].equilibrium.sampled(0.002)) z = std::min(z, sample.frame.at.z());
  return z;
}

}  // namespace

TEST_CASE("variation: outcomes on the other side of a snap are counted as jumped, and no others are", "[variation]") {
  const double most = 60 * units::deg;
  const Scene scene = arch(most);
  Options options;
  // Both clamps turn down: past a certain angle the arch has snapped.
  variation::Variable from, to;
  from.name = "arch.from";
  to.name = "arch.to";
  constexpr int steps = 21;
  options.outcomes = steps;
  for (int k = 0; k < steps; ++k) {
    const double angle = most * (1 - 2.0 * k / (steps - 1));
    from.frames.push_back(tilted(0, angle));
    to.frames.push_back(tilted(0.46, -angle));
  }
  options.vary = {from, to};
  options.measures = {height()};
  const Study study(scene, options);
  REQUIRE(study.measures()[0].nominal > 0.05);
  const Outcomes outcomes = study.run(0, steps);
  const std::vector<int> jumped = outcomes.all(OutcomeStatus::jumped);
  CAPTURE(variation::summary(outcomes));
  REQUIRE(!jumped.empty());
  CHECK(outcomes.count(OutcomeStatus::solved) + static_cast<int>(jumped.size()) == steps);
  // The branch ends once: all before it are up, all behind are down.
  const int first = jumped.front();
  for (int k = 0; k < steps; ++k) {
    CAPTURE(k, outcomes.measures_of(k)[0], outcomes.message(k));
    CHECK((outcomes.status(k) == OutcomeStatus::jumped) == (k >= first));
    CHECK((outcomes.measures_of(k)[0] > 0) == (k < first));
  }
  CHECK(outcomes.message(first).find("snaps at") == 0);
  CHECK(outcomes.message(first).find("'arch'") != std::string::npos);
  CHECK(variation::summary(outcomes).find("jumped (" + std::to_string(first + 1)) != std::string::npos);
  CHECK(study.sample(outcomes, 0).size() == steps);
}

TEST_CASE("variation: an outcome that makes no sense is counted, listed and has no measures", "[variation]") {
  const Scene scene = one_hose(8);
  Options options;
  variation::Variable length;
  length.name = "hose.length";
  length.numbers = {1.0, -0.5, 1.1, 0.0, 1.05};
  options.vary = {length};
  options.outcomes = 5;
  options.measures = {measure("hose.length"), function("one", [](const SceneEquilibrium&) { return 1.0; })};
  const variation::Result result = variation::run(scene, options);
  CHECK_FALSE(result.ok);
  CHECK(result.status == Status::solved);
  CHECK(result.outcomes.all(OutcomeStatus::failed) == std::vector<int>{1, 3});
  CHECK(result.message == "5 outcomes, 2 failed (2, 4)");
  CHECK(!result.outcomes.message(1).empty());
  CHECK(std::isnan(result.outcomes.measures_of(1)[0]));
  CHECK(std::isnan(result.outcomes.measures_of(1)[1]));
  const variation::Sample sample = result.study->sample(result.outcomes, 0);
  CHECK(sample.size() == 3);
  CHECK(sample.missing() == 2);
  const SceneEquilibrium failed = result.study->equilibrium(1);
  CHECK_FALSE(failed.ok());
  CHECK(failed.message().find(result.outcomes.message(1)) != std::string::npos);
}

TEST_CASE("variation: near an obstacle outcomes touch or keep clear as cold solutions do", "[variation]") {
  for (const double gap : {0.004, 0.03}) {
    Scene scene = one_hose(20);
    scene.add(floor_at(lowest_of(scene.solve()) - 0.01 - gap));
    Options options;
    options.outcomes = 24;
    options.vary = {number("hose.length", 0.03), ball("hose.to", 0.01)};
    options.measures = {measure("hose.clearance"), measure("hose.max_tension"),
                        function("contacts", [](const SceneEquilibrium& e) {
                          return static_cast<double>(e.rods[0].equilibrium.contacts.size());
                        })};
    const Study study(scene, options, with_seed(3));
    const Outcomes outcomes = study.run(0, 24);
    CAPTURE(gap, variation::summary(outcomes));
    CHECK(outcomes.count(OutcomeStatus::solved) == 24);
    int touching = 0;
    for (int k = 0; k < 24; ++k) {
      const SceneEquilibrium eq = study.equilibrium(k);
      REQUIRE(eq.ok());
      // Solved anew, with the obstacle, from the nominal equilibrium.
      SystemProblem problem = eq.systems[0].problem;
      REQUIRE(problem.rods[0].surroundings != nullptr);
      const Equilibrium anew = solve(problem.rods[0], {}, {}, &study.nominal().rods[0].equilibrium);
      REQUIRE(anew.ok());
      double apart = 0;
      for (std::size_t i = 0; i < anew.points.size(); ++i)
        apart = std::max(apart, (anew.points[i] - eq.rods[0].equilibrium.points[i]).norm());
      CAPTURE(k, outcomes.measures_of(k)[0]);
      CHECK(apart < 1e-6);
      CHECK(outcomes.measures_of(k)[0] == Approx(eq.clearance(eq.rods[0]).value).margin(1e-8));
      CHECK(outcomes.measures_of(k)[0] > -1e-5);
      CHECK(outcomes.measures_of(k)[2] == static_cast<double>(anew.contacts.size()));
      touching += anew.contacts.empty() ? 0 : 1;
    }
    if (gap < 0.01) CHECK(touching > 2);
    CHECK(touching < 24);
    const Study threads(scene, options, with_seed(3, 3));
    CHECK(identical(outcomes, threads.run(0, 24, {}, with_seed(3, 3))));
  }
}

TEST_CASE("variation: a nominal design that rests on an obstacle is varied with contact", "[variation]") {
  Scene scene = one_hose(20);
  scene.add(floor_at(lowest_of(scene.solve()) + 0.01));
  Options options;
  options.outcomes = 8;
  options.vary = {number("hose.length", 0.005)};
  options.measures = {measure("hose.clearance"), measure("hose.min_bend_radius")};
  const Study study(scene, options);
  REQUIRE(!study.nominal().rods[0].equilibrium.contacts.empty());
  const Outcomes outcomes = study.run(0, 8);
  CHECK(outcomes.count(OutcomeStatus::solved) == 8);
  for (int k = 0; k < 8; ++k) {
    CHECK(std::abs(outcomes.measures_of(k)[0]) < 1e-5);
    CHECK(outcomes.measures_of(k)[1] == Approx(study.equilibrium(k).rods[0].equilibrium.smallest_bend_radius()));
  }
  const variation::Contributions contributions = study.contributions(outcomes, 1);
  CHECK(contributions.all[0].linear == Approx(1));
}

TEST_CASE("variation: interrupted it keeps whole outcomes and says so", "[variation]") {
  const Scene scene = one_hose(8);
  Options options;
  options.outcomes = 5000;
  options.vary = {number("hose.length", 0.01)};
  options.measures = {measure("hose.length")};
  const Study study(scene, options);
  std::atomic<bool> cancel = false;
  RunContext context;
  context.cancel = &cancel;
  int passed = 0;
  const Outcomes outcomes = study.run(0, 5000, [&](const variation::OutcomeView& view) {
    CHECK(view.outcome == passed++);
    cancel = passed >= 100;
  }, context);
  CHECK(outcomes.count(OutcomeStatus::solved) == passed);
  CHECK(outcomes.count(OutcomeStatus::unsolved) == 5000 - passed);
  CHECK(passed < 5000);
  CHECK(study.sample(outcomes, 0).size() == passed);
  CHECK(study.sample(outcomes, 0).missing() == 0);
  context.cancel = nullptr;
  context.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
  CHECK(study.run(0, 100, {}, context).count(OutcomeStatus::unsolved) == 100);
}

TEST_CASE("variation: what cannot be varied or measured is refused", "[variation]") {
  const Scene scene = three_hoses();
  const auto refused = [&](const Options& options) -> std::string {
    try {
      const Study study(scene, options);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  const auto with = [&](variation::Variable variable) {
    Options options;
    options.vary = {std::move(variable)};
    return refused(options);
  };
  const auto named = [](const char* name) {
    variation::Variable variable;
    variable.name = name;
    return variable;
  };
  using Catch::Contains;
  CHECK_THAT(refused({}), Contains("nothing varies; give vary"));
  CHECK_THAT(with(named("a.length")), Contains("'a.length' has nothing that varies; give tolerance"));
  CHECK_THAT(with(number("a.lenght", 0.1)), Contains("method.variation: unknown variable 'a.lenght'; did you mean 'a.length'?"));
  CHECK_THAT(with(cone("a.lenght", 0.1)), Contains("unknown variable 'a.lenght'; did you mean 'a.length'?"));
  CHECK_THAT(with(cone("a.length", 0.1)), Contains("'a.length' is no frame; give a tolerance"));
  CHECK_THAT(with(number("a.from", 0.1)), Contains("'a.from' is more than one kind of number ('a.from.at.x', 'a.from.turn.x')"));
  CHECK_THAT(with(cone("tee", 0.1)),
             Contains("'tee' is a branch point that nothing holds; its sections are tee.1, tee.2, tee.3"));
  CHECK(with(cone("tee.2", 0.1)).empty());
  CHECK_THAT(with(number("a.length", -0.1)), Contains("has tolerance = -0.1, expected a number from 0 up"));
  CHECK_THAT(with(number("a.length", NAN)), Contains("has tolerance = nan"));
  CHECK_THAT(with(number("a.length", 0.5)), Contains("'a.length' varies by 0.5 about 0.5, which leaves nothing of it"));
  CHECK_THAT(with(cone("a.from", 4)), Contains("has cone = 4, expected a number from 0 to 3.14159"));
  CHECK_THAT(with(ball("a.from", INFINITY)), Contains("has ball = inf"));
  variation::Variable v = ball("a.from", 0.1);
  v.box = Vec3(1, 1, 1);
  CHECK_THAT(with(v), Contains("has a ball and a box; give one of them"));
  v = ball("a.from", 0.1);
  v.tolerance = 0.1;
  CHECK_THAT(with(v), Contains("varies in more than one way"));
  v = ball("a.from", 0.1);
  v.spread = variation::Spread::triangular;
  CHECK_THAT(with(v), Contains("varies within a ball or cone, whose spread is 'uniform' or 'normal'"));
  v = ball("a.from", 0.1);
  v.relative = true;
  CHECK_THAT(with(v), Contains("only a number varies by a share"));
  v = number("a.length", 0.1);
  v.spread = variation::Spread::function;
  CHECK_THAT(with(v), Contains("has no inverse distribution to draw from"));
  v.spread = variation::Spread::uniform;
  v.inverse = [](double u) { return u; };
  CHECK_THAT(with(v), Contains("has a spread and an inverse distribution"));
  v = number("a.length", 0.1);
  v.spread = variation::Spread::uniform;
  v.sigma = 0.1;
  CHECK_THAT(with(v), Contains("has a sigma, which only the normal spread has"));
  v = number("a.from.at.y", 0.1);
  v.relative = true;
  CHECK_THAT(with(v), Contains("has the nominal value 0, of which there is no share"));
  v = named("a.length");
  v.numbers = {1, 2};
  CHECK_THAT(with(v), Contains("has a table of 2 entries, expected one for each of 1000 outcomes"));
  v.numbers.assign(1000, NAN);
  CHECK_THAT(with(v), Contains("has a table with a number that is not finite"));
  v = ball("gravity", 0.1);
  CHECK_THAT(with(v), Contains("'gravity' is a direction"));
  v = named("a.length");
  v.inverse = [](double) { return INFINITY; };
  CHECK_THAT(with(v), Contains("the inverse distribution gave inf"));

  Options options;
  options.vary = {number("a.length", 0.01), number("a.length", 0.02)};
  CHECK_THAT(refused(options), Contains("'a.length' is given twice"));
  options.vary = {ball("a.from", 0.01), number("a.from.at.x", 0.02)};
  CHECK_THAT(refused(options), Contains("'a.from.at.x' varies twice: by 'a.from' and by 'a.from.at.x'"));
  options.vary = {number("a.length", 0.01), number("b.length", 0.01), cone("c.to", 0.1)};
  const auto grouped = [&](std::vector<std::string> names) {
    Options own = options;
    own.groups = {{std::move(names), Eigen::MatrixXd::Constant(1, 1, 0.5)}};
    return refused(own);
  };
  CHECK_THAT(grouped({"a.length"}), Contains("group 1: got 1 variables, expected at least 2"));
  CHECK_THAT(grouped({"a.length", "c.length"}), Contains("group 1: 'c.length' is not among the variables that vary"));
  CHECK_THAT(grouped({"a.length", "c.to"}), Contains("'c.to' has 2 components, 'a.length' has 1; expected as many"));
  CHECK_THAT(grouped({"a.length", "a.length"}), Contains("'a.length' belongs to group 1 already"));
  CHECK(grouped({"a.length", "b.length"}).empty());

  options.outcomes = 0;
  CHECK_THAT(refused(options), Contains("got 0 outcomes, expected at least 1"));
  options.outcomes = 10;
  options.effects = 11;
  CHECK_THAT(refused(options), Contains("got total effects of 11 outcomes, expected 0 to 10"));
  options.effects = 0;
  const auto measuring = [&](variation::MeasureRequest request) {
    Options own = options;
    own.measures = {std::move(request)};
    return refused(own);
  };
  CHECK_THAT(measuring(measure("a.min_bend_radios")),
             Contains("method.variation: unknown measure 'a.min_bend_radios'; did you mean 'a.min_bend_radius'?"));
  CHECK_THAT(measuring(measure("")), Contains("a measure has no name"));
  variation::MeasureRequest request = measure("gap");
  request.rod = "a";
  CHECK_THAT(measuring(request), Contains("measure 'gap': the scene has no obstacles"));
  request.function = [](const SceneEquilibrium&) { return 0.0; };
  CHECK_THAT(measuring(request), Contains("is given in more than one way"));
  request = measure("turn");
  request.built_in = SceneMeasure{"turn", 0, {}};
  request.built_in->measure.what = Measure::What::rotation;
  CHECK_THAT(measuring(request), Contains("has derivatives but no value of its own"));
  request.built_in->measure.what = Measure::What::position;
  request.built_in->measure.at = 0.6;
  CHECK_THAT(measuring(request), Contains("is at 0.6 m, expected 0 to 0.5 m"));
  request.built_in->measure.rod = 3;
  CHECK_THAT(measuring(request), Contains("got rod 3, expected one of 3"));
  request.built_in->system = 1;
  CHECK_THAT(measuring(request), Contains("belongs to system 1, expected one of 1"));
  Options twice = options;
  twice.measures = {measure("a.length"), measure("a.length")};
  CHECK_THAT(refused(twice), Contains("two measures are called 'a.length'"));

  const Study study(scene, options);
  CHECK(study.measures().size() == 9);
  CHECK_THROWS_WITH(study.run(0, 11), Contains("got outcomes 0 to 10 of 10"));
  CHECK_THROWS_WITH(study.variables_of(10), Contains("got outcome 10, expected 0 to 9"));
  CHECK_THROWS_WITH(study.measure("a.lenght"), Contains("unknown measure 'a.lenght'; did you mean 'a.length'?"));
  CHECK(study.measure("b.max_tension") == 4);
}

TEST_CASE("outcomes: a table puts its parts together and writes itself", "[variation]") {
  const std::vector<variation::Column> variables = {{"hose.length", "m", 1, 0}}, measures = {{"gap, least", "mm", 0, -1}};
  Outcomes a(0, 2, variables, measures, 0), b(2, 1, variables, measures, 0);
  const double x = 1.5, y = 2.25;
  a.set(0, OutcomeStatus::solved, {&x, 1}, {&y, 1}, {}, "");
  CHECK_THROWS_WITH(a.set(1, OutcomeStatus::failed, {&x, 1}, {}, {}, ""),
                    Catch::Contains("outcome 1 has 0 measures, expected 1"));
  CHECK_THROWS_WITH(a.set(2, OutcomeStatus::failed, {&x, 1}, {&y, 1}, {}, ""), Catch::Contains("got outcome 2, expected 0 to 1"));
  const double nothing = NAN;
  a.set(1, OutcomeStatus::failed, {&x, 1}, {&nothing, 1}, {}, "no \"equilibrium\", alas");
  b.set(2, OutcomeStatus::jumped, {&y, 1}, {&x, 1}, {}, "snaps");
  const Outcomes backwards[] = {b, a};
  const Outcomes all = Outcomes::merged(backwards);
  CHECK(all.csv() ==
        "outcome,status,hose.length [m],\"gap, least [mm]\",message\n"
        "1,solved,1.5,2.25,\n"
        "2,failed,1.5,,\"no \"\"equilibrium\"\", alas\"\n"
        "3,jumped,2.25,1.5,snaps\n");
  CHECK(all.column(0) == std::vector<double>{2.25, 1.5});
  const Outcomes twice[] = {a, a}, hole[] = {a, Outcomes(3, 1, variables, measures, 0)},
                 others[] = {a, Outcomes(2, 1, measures, measures, 0)};
  CHECK_THROWS_WITH(Outcomes::merged(twice), Catch::Contains("outcomes 0 and on are there twice"));
  CHECK_THROWS_WITH(Outcomes::merged(hole), Catch::Contains("outcomes 3 and on do not follow those before, which end at 1"));
  CHECK_THROWS_WITH(Outcomes::merged(others), Catch::Contains("their columns differ"));
  CHECK_THROWS_WITH(Outcomes::merged({}), Catch::Contains("there are no outcomes to put together"));
}
