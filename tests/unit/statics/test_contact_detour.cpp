#include <catch2/catch.hpp>

#include <cmath>

#include "statics/contact_detour.h"
#include "test_contact_fields.h"

using namespace tendril;
using namespace tendril::test;

namespace {

/// A straight rod of 1 m along x through the origin at half its length, 10 mm thick.
struct StraightRod {
  std::vector<Frame> frames;
  std::vector<double> s;
  StraightRod() {
    for (int i = 0; i <= 40; ++i) {
      s.push_back(i / 40.0);
      frames.push_back(Frame::looking({s.back() - 0.5, 0, 0}, Vec3::UnitX()));
    }
  }
};

TriangleSheet upright(double half) {
  return grid_sheet(2, 2, [=](double u, double v) { return Vec3(0, half * (2 * u - 1), half * (2 * v - 1)); });
}

bool passes(const TriangleSheet& sheet, const std::vector<Frame>& frames) {
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (sheet.ray(frames[i - 1].at, frames[i].at)) return true;
  return false;
}

}  // namespace

TEST_CASE("contact detour: ways around a plate pass its rim, keep what is held and stay smooth") {
  const StraightRod rod;
  const TriangleSheet plate = upright(0.1);
  const std::vector<int> held{0, 40};
  const CrossingPlace crossing{0.5, Vec3::Zero(), Vec3::UnitX()};
  const auto ways = detours({rod.frames, rod.s, held, 0.005}, crossing, plate);
  // Eight directions within the plate and two off it, each at three distances.
  REQUIRE(ways.size() == 30);
  int clear = 0;
  for (const std::vector<Frame>& way : ways) {
    REQUIRE(way.size() == rod.frames.size());
    clear += !passes(plate, way);
    for (int end : held) {
      CHECK(way[end].at == rod.frames[end].at);
      CHECK(way[end].rotation.coeffs() == rod.frames[end].rotation.coeffs());
    }
    for (std::size_t i = 1; i + 1 < way.size(); ++i) {
      CHECK(std::abs(way[i].rotation.norm() - 1) < 1e-12);
      // The sections look along the centre line.
      const Vec3 chord = (way[i + 1].at - way[i - 1].at).normalized();
      CHECK(chord.dot(way[i].d3()) > 0.99);
    }
    CHECK(length_of(way) >= length_of(rod.frames) - 1e-12);
  }
  CHECK(clear == 24);
}

TEST_CASE("contact detour: a free end goes along with the place that is carried aside") {
  const StraightRod rod;
  const TriangleSheet plate = upright(0.05);
  const std::vector<int> held{0};
  const auto ways = detours({rod.frames, rod.s, held, 0.005}, {0.5, Vec3::Zero(), Vec3::UnitX()}, plate);
  REQUIRE(!ways.empty());
  for (const std::vector<Frame>& way : ways) {
    const Vec3 aside = way[20].at - rod.frames[20].at;
    CHECK(aside.norm() > 0.01);
    for (std::size_t i = 20; i < way.size(); ++i) CHECK((way[i].at - rod.frames[i].at - aside).norm() < 1e-12);
    CHECK(way[0].at == rod.frames[0].at);
  }
}

TEST_CASE("contact detour: where no rim is within reach nothing leads around") {
  const StraightRod rod;
  const TriangleSheet wall = upright(3);
  const std::vector<int> held{0, 40};
  for (const std::vector<Frame>& way : detours({rod.frames, rod.s, held, 0.005}, {0.5, Vec3::Zero(), Vec3::UnitX()}, wall))
    CHECK(passes(wall, way));
}
