#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/units.h"
#include "scene/placed_rod.h"

using namespace tendril;
using Catch::Matchers::Contains;

namespace {

const Section section = Section::round(0.02, 0.01, Material::from_poisson(5e6, 0.4, 1100));
const Frame here = Frame::looking({0, 0, 0}, {1, 0, 0});
const Frame there = Frame::looking({0.8, 0, 0}, {1, 0, 0});

PlacedRod hose(std::optional<Frame> from = {}, std::optional<Frame> to = {}) {
  return PlacedRod("hose", Rod::uniform(1, section), from, to);
}

}  // namespace

TEST_CASE("from and to become full holds at the ends, nil leaves them free", "[scene]") {
  const PlacedRod both = hose(here, there);
  REQUIRE(both.holds().size() == 2);
  CHECK(both.hold_at(0)->position);
  CHECK(both.hold_at(1)->orientation);
  CHECK(both.hold_at(1)->frame.at == there.at);
  CHECK(both.hold_at(0.5) == nullptr);
  CHECK(hose().holds().empty());
  CHECK(hose({}, there).holds().front().at == 1);
}

TEST_CASE("a place is a word or an arc length within the rod", "[scene]") {
  PlacedRod rod = hose(here);
  CHECK(rod.place("start") == 0);
  CHECK(rod.place("finish") == 1);
  CHECK_THROWS_WITH(rod.place("end"), Contains("unknown place 'end'") && Contains("\"finish\""));
  CHECK_THROWS_WITH(rod.hold({1.2, there}), Contains("1.2 m, expected 0 to 1 m"));
  CHECK_THROWS_WITH(rod.hold({-0.1, there}), Contains("-0.1 m"));
  CHECK_THROWS_AS(rod.load({std::nan(""), {0, 0, 1}, {0, 0, 0}}), UsageError);
}

TEST_CASE("a second hold at one place may not contradict the first", "[scene]") {
  PlacedRod rod = hose(here, there);
  CHECK_THROWS_WITH(rod.hold({1, here}), Contains("contradictory holds") && Contains("its finish") &&
                                             Contains("{0.8, 0, 0}") && Contains("{0, 0, 0}"));
  const Frame turned = there.moved(Vec3::Zero(), Vec3::UnitX(), 0.1);
  CHECK_THROWS_WITH(rod.hold({1, turned}), Contains("contradictory holds") && Contains("5.729"));

  SECTION("the same frame changes turns") {
    rod.hold({1, there, true, true, 2});
    CHECK(rod.holds().size() == 2);
    CHECK(rod.hold_at(1)->turns == 2);
  }
  SECTION("the same frame without orientation makes a pin") {
    rod.hold({1, there, true, false});
    CHECK_FALSE(rod.hold_at(1)->orientation);
    rod.hold({1, turned, false, true});
    CHECK(rod.hold_at(1)->position);
    CHECK(rod.hold_at(1)->orientation);
    CHECK(rod.hold_at(1)->frame.at == there.at);
    CHECK(rod.hold_at(1)->frame.rotation.angularDistance(turned.rotation) < 1e-12);
  }
  SECTION("after a release any frame is free") {
    rod.release(1);
    CHECK(rod.hold_at(1) == nullptr);
    rod.hold({1, turned});
    CHECK_THROWS_WITH(rod.release(0.5), Contains("not held at 0.5 m"));
  }
}

TEST_CASE("holds and loads reject what is no number or holds nothing", "[scene]") {
  PlacedRod rod = hose(here);
  Frame bad = there;
  bad.at.y() = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(rod.hold({1, bad}), Contains("not finite"));
  CHECK_THROWS_WITH(rod.hold({1, there, false, false}), Contains("neither position nor orientation"));
  CHECK_THROWS_WITH(rod.hold({1, there, true, true, std::nan("")}), Contains("'turns'"));
  CHECK_THROWS_WITH(rod.load({0.5, {std::nan(""), 0, 0}, {0, 0, 0}}), Contains("'force'"));
  CHECK_THROWS_WITH(rod.load({0.5, {0, 0, 0}, {0, 0, std::nan("")}}), Contains("'moment'"));
  rod.load({0.5, {0, 0, -1}, {0, 0, 0}});
  CHECK(rod.loads().size() == 1);
  CHECK_THROWS_AS(PlacedRod("", Rod::uniform(1, section), {}, {}), UsageError);
}
