#include <catch2/catch.hpp>

#include "base/units.h"
#include "scene/sampled_motion.h"

using namespace tendril;
using Catch::Matchers::Contains;

TEST_CASE("a sampled motion is read with its units, and what turns with it follows", "[motion]") {
  const SampledMotion m = parse_motion("# an engine\n\"t\"; x;y;z; rx;ry;rz; rpm\n0; 0;0;0; 0;0;0; 800\r\n\n2;10;0;-4;0;0;1.5707963267948966;900\n", 1e-3, "m");
  REQUIRE(m.times == std::vector<double>{0, 2});
  CHECK((m.frames[1].at - Vec3(0.010, 0, -0.004)).norm() < 1e-15);
  CHECK((m.at(1).at - Vec3(0.005, 0, -0.002)).norm() < 1e-15);
  CHECK((m.at(1).rotation * Vec3::UnitX() - Vec3(std::sqrt(0.5), std::sqrt(0.5), 0)).norm() < 1e-12);
  CHECK((m.at(-1).at - m.frames[0].at).norm() == 0);
  CHECK((m.at(9).at - m.frames[1].at).norm() == 0);
  const Frame stub = Frame::looking({0.1, 0, 0}, {0, 0, 1}, {1, 0, 0});
  const std::vector<Frame> places = m.carried(stub);
  CHECK((places[0].at - stub.at).norm() < 1e-15);
  CHECK((places[1].at - Vec3(0.010, 0.1, -0.004)).norm() < 1e-12);
  CHECK((places[1].d1() - Vec3(0, 1, 0)).norm() < 1e-12);
  const SampledMotion q = parse_motion("t,x,y,z,qw,qx,qy,qz\n0,0,0,0,0.70710678,0,0,0.70710678", 1, "q");
  CHECK((q.frames[0].rotation * Vec3::UnitX() - Vec3::UnitY()).norm() < 1e-9);
}

TEST_CASE("a sampled motion that makes no sense says where", "[motion]") {
  const auto refused = [](const char* text, const char* why) { CHECK_THROWS_WITH(parse_motion(text, 1, "m"), Contains(why)); };
  refused("", "m: holds no samples");
  refused("t,x,y,z\n", "holds no samples");
  refused("time,x,y,z\n0,0,0,0", "line 1: the head line names no columns t, x, y, z");
  refused("t,x,y\n0,0,0", "column 'z' is missing beside 'x'");
  refused("t,x,y,z\n0,0,zero,0", "line 2: got 'zero', expected a finite number");
  refused("t,x,y,z\n0,0,0", "line 2: got ''");
  refused("t,x,y,z\n0,0,0,nan", "expected a finite number");
  refused("t,x,y,z\n0,0,0,-1e10", "got -1e+10, expected at most 1e9");
  refused("t,x,y,z\n1,0,0,0\n1,0,0,0", "line 3: time 1 s does not rise above 1 s");
  refused("t,x,y,z,qw,qx,qy,qz\n0,0,0,0,2,0,0,0", "the quaternion has length 2, expected 1");
  refused("t,x,y,z,qw,qx,qy,qz,rx,ry,rz\n", "both a quaternion and a rotation vector");
  CHECK_THROWS_WITH(read_motion("/nonexistent/motion.csv", 1), Contains("/nonexistent/motion.csv"));
}
