#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/frame.h"
#include "base/units.h"

using namespace tendril;

TEST_CASE("exp and log of a rotation are each other's inverse over all angles", "[base]") {
  const Vec3 axis = Vec3(1, -2, 3).normalized();
  for (const double angle : {0.0, 1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-2, 1.0, 3.0, units::pi - 1e-6, units::pi - 1e-9}) {
    CAPTURE(angle);
    const Quat turned = exp_rotation(axis * angle);
    CHECK(turned.norm() == Approx(1).epsilon(1e-15));
    CHECK((log_rotation(turned) - axis * angle).norm() < 1e-14 + 1e-14 * angle);
    CHECK((log_rotation(Quat(-turned.coeffs())) - axis * angle).norm() < 1e-14 + 1e-14 * angle);
  }
}

TEST_CASE("a frame looks along its tangent with d1 from up", "[base]") {
  const Frame f = Frame::looking({1, 2, 3}, {0, 2, 0}, {0, 1, 5});
  CHECK((f.d3() - Vec3::UnitY()).norm() < 1e-15);
  CHECK((f.d1() - Vec3::UnitZ()).norm() < 1e-15);
  CHECK((f.d1().cross(f.d2()) - f.d3()).norm() < 1e-15);
  CHECK((f * f.inverse()).at.norm() < 1e-15);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(Frame::looking({0, 0, 0}, {0, 0, 0}), UsageError);
  CHECK_THROWS_AS(Frame::looking({0, 0, 0}, {0, nan, 0}), UsageError);
  CHECK_THROWS_AS(Frame::looking({nan, 0, 0}, {0, 1, 0}), UsageError);
  CHECK_THROWS_AS(Frame::looking({0, 0, 0}, {0, 1, 0}, {0, -3, 0}), UsageError);
}

TEST_CASE("the shortest turn takes one vector to another, opposite ones too", "[base]") {
  for (const Vec3& to : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 1e-9, 0), Vec3(0.3, -0.4, 0.5)}) {
    const Vec3 unit = to.normalized();
    CHECK((shortest_turn(Vec3::UnitX(), unit) * Vec3::UnitX() - unit).norm() < 1e-8);
  }
}
