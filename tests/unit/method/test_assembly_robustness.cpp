// Replays of a proven manipulation by hands that stray from their paths.
#include <catch2/catch.hpp>

#include "method/assembly/path_smoothing.h"
#include "method/assembly/proof.h"
#include "method/assembly/pull.h"
#include "method/assembly/robustness.h"
#include "unit/method/assembly_scenes.h"

using namespace tendril;
using namespace tendril::assembly_scenes;

namespace {

assembly::Manipulation two_grips() {
  assembly::Manipulation straight;
  straight.grips = {{"hose.start", 0, -1, 0, true}, {"hose.50", 0, -1, 0.4, false}};
  straight.times = {0, 0.3, 1};
  for (const double y : {0.0, 0.2}) straight.poses.push_back({{{0, y, 0}, Quat::Identity()}, {{0.3, y, 0}, Quat::Identity()}, {{0.4, y, 0}, Quat::Identity()}});
  return straight;
}

}  // namespace

TEST_CASE("assembly: grips led astray stay near their paths and begin and end on them", "[assembly]") {
  const assembly::Manipulation exact = two_grips();
  const double most = 2e-3;
  double farthest = 0;
  for (int number = 0; number < 50; ++number) {
    const assembly::Manipulation astray = assembly::led_astray(exact, most, 7, number);
    REQUIRE(astray.times.front() == 0);
    REQUIRE(astray.times.back() == 1);
    for (std::size_t i = 1; i < astray.times.size(); ++i) CHECK(astray.times[i] > astray.times[i - 1]);
    for (int g = 0; g < 2; ++g) {
      CHECK((astray.pose(g, 0).at - exact.pose(g, 0).at).norm() == 0);
      CHECK((astray.pose(g, 1).at - exact.pose(g, 1).at).norm() < 1e-17);
      Vec3 before = Vec3::Zero();
      for (double t = 0; t <= 1; t += 1e-3) {
        const Vec3 away = astray.pose(g, t).at - exact.pose(g, t).at;
        CHECK(away.norm() <= most);
        // No jerks: three waves and the way there within a tenth of the time.
        CHECK((away - before).norm() <= most * 1e-3 * (1.5 / 0.1 + 2 * units::pi * 3) * 1.01);
        CHECK(astray.pose(g, t).rotation.angularDistance(exact.pose(g, t).rotation) < 1e-12);
        before = away;
        farthest = std::max(farthest, away.norm());
      }
    }
  }
  CHECK(farthest > 0.7 * most);
  // Its own way for each grip, number and seed; the same way again for the same.
  const auto middle = [&](int g, std::uint64_t seed, int number) { return assembly::led_astray(exact, most, seed, number).pose(g, 0.5).at; };
  CHECK(middle(0, 7, 0) == middle(0, 7, 0));
  CHECK((middle(0, 7, 0) - middle(1, 7, 0) + Vec3(0, 0.2, 0)).norm() > 0.01 * most);
  CHECK((middle(0, 7, 0) - middle(0, 7, 1)).norm() > 0.01 * most);
  CHECK((middle(0, 7, 0) - middle(0, 8, 0)).norm() > 0.01 * most);
}

TEST_CASE("assembly: replays are counted by what they prove, the same for any number of threads", "[assembly]") {
  const assembly::Manipulation exact = two_grips();
  assembly::InstalledSystem system;
  system.radius = 0.008;
  // Proven where the second grip passes the middle above the path.
  const assembly::Prove prove = [&](const assembly::Manipulation& manipulation, const RunContext&) {
    assembly::Played played;
    played.proof.ok = manipulation.pose(1, 0.5).at.z() > 0;
    if (!played.proof.ok) played.proof.message = "below";
    return played;
  };
  int expected = 0;
  for (int number = 0; number < 40; ++number)
    expected += assembly::kept_clear(system, assembly::led_astray(exact, 0.25 * 0.008, 3, number)).pose(1, 0.5).at.z() > 0;
  REQUIRE(expected > 5);
  REQUIRE(expected < 35);
  RunContext context;
  context.seed = 3;
  std::vector<std::string> failures;
  for (const int threads : {1, 2, 3}) {
    context.threads = threads;
    const assembly::Robustness found = assembly::robustness(system, exact, prove, 40, context);
    CHECK(found.replays == 40);
    CHECK(found.arrived == expected);
    REQUIRE(found.failures.size() == 40);
    CHECK(std::count(found.failures.begin(), found.failures.end(), "below") == 40 - expected);
    if (threads == 1) failures = found.failures;
    CHECK(found.failures == failures);
  }
  CHECK(assembly::robustness(system, exact, prove, 0, context).replays == 0);
  CHECK(assembly::robustness(system, exact, prove, -2, context).arrived == 0);
  context.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
  const assembly::Robustness late = assembly::robustness(system, exact, prove, 3, context);
  CHECK(late.arrived == 0);
  CHECK(late.failures == std::vector<std::string>(3, name_of(Status::timeout)));
}

TEST_CASE("assembly: a hose between two posts arrives though hands stray by a quarter of its radius", "[assembly]") {
  Case c = two_posts(2);
  c.options.optimise = false;
  const assembly::Result result = assembly::run(c.scene, c.options);
  REQUIRE(result.ok);
  const assembly::InstalledSystem system = assembly::installed_system(c.scene, c.options, 2);
  REQUIRE_FALSE(result.play.empty());
  assembly::DriveOptions drive;
  drive.radius = system.radius;
  drive.most_strain = 0.3;
  const auto grip = std::find_if(system.extra.begin(), system.extra.end(), [&](const auto& g) { return g.name == result.attempts.back().handle; });
  REQUIRE(grip != system.extra.end());
  const assembly::Pulled pulled = assembly::pull(system, *grip, result.handle_path, result.attempts.back().gravity, drive, {});
  REQUIRE(pulled.ok);
  const assembly::Prove prove = [&](const assembly::Manipulation& manipulation, const RunContext& context) {
    return assembly::play(system, manipulation, pulled.pulled.passed.back().equilibrium, 0.05 * radius, drive, {}, context);
  };
  const assembly::Robustness found = assembly::robustness(system, result.manipulation, prove, 4, {});
  INFO(found.failures[0] << "; " << found.failures[1] << "; " << found.failures[2] << "; " << found.failures[3]);
  CHECK(found.arrived == 4);
}
