#include <catch2/catch.hpp>

#include "base/error.h"
#include "geometry/surroundings.h"
#include "statics/field_along.h"

using namespace tendril;
using Catch::Matchers::Contains;

namespace {

/// Balls of radius 1 at x = 0, 10, 20.
Surroundings balls() {
  Surroundings all;
  for (int k = 0; k < 3; ++k) all.add({Solid(Sphere{1}), {{10.0 * k, 0, 0}, Quat::Identity()}, 0.1, "ball " + std::to_string(k)});
  return all;
}

}  // namespace

TEST_CASE("surroundings without some of their obstacles", "[geometry]") {
  const Surroundings all = balls();
  const auto rest = all.without({1});
  const Vec3 p(10, 0, 3);
  CHECK(all.closest(p, 100).obstacle == 1);
  const ClosestPoint near = rest->closest(p, 100);
  CHECK(near.obstacle == 0);
  CHECK(near.distance == Approx(std::hypot(10, 3) - 1));
  CHECK(rest->closest({10, 0, 0}, 5).obstacle == -1);
  std::vector<DistanceTerm> terms;
  rest->terms(p, 100, terms);
  REQUIRE(terms.size() == 2);
  CHECK(terms[0].obstacle == 0);
  CHECK(terms[1].obstacle == 2);
  CHECK(all.ray({10, 0, 5}, {10, 0, -5}).has_value());
  CHECK(!rest->ray({10, 0, 5}, {10, 0, -5}));
  CHECK(rest->ray({20, 0, 5}, {20, 0, -5})->obstacle == 2);
  CHECK(rest->name(2) == "obstacle 'ball 2'");
  CHECK(rest->clearance(1) == 0.1);
  CHECK(all.without({0, 1, 2})->closest(p, std::numeric_limits<double>::infinity()).obstacle == -1);
  CHECK(all.closest(p, 100).obstacle == 1);
  CHECK_THROWS_WITH(all.without({3}), Contains("no obstacle of the number 3"));
}

TEST_CASE("what a rod meets along itself", "[geometry]") {
  const Surroundings all = balls();
  const FieldAlong along(all, {{0, 0.0, 0.4}, {1, 0.3, 0.6}, {2, 2, 2}});
  const auto meets = [&](const ContactField& field, int k) { return field.closest({10.0 * k, 0, 1.5}, 2).obstacle == k; };
  const auto at = [&](double s) { return std::array{meets(along.at(s), 0), meets(along.at(s), 1), meets(along.at(s), 2)}; };
  CHECK(at(-0.1) == std::array{true, true, true});
  CHECK(at(0.1) == std::array{false, true, true});
  CHECK(at(0.35) == std::array{false, false, true});
  CHECK(at(0.5) == std::array{true, false, true});
  CHECK(at(0.7) == std::array{true, true, true});
  CHECK(at(2) == std::array{true, true, true});
  CHECK(&along.at(1) == &all);
  CHECK(&along.all() == &all);
  CHECK(&along.between(0.7, 0.8) == &all);
  CHECK(&along.between(0.5, 0.7) == &along.at(0.5));
  CHECK(&along.between(0.7, 0.5) == &along.at(0.5));
  CHECK(&FieldAlong(all).at(0.3) == &all);
}
