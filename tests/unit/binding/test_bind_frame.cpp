#include <catch2/catch.hpp>

#include "unit/binding/script.h"

TEST_CASE("frame: along and up are made a right-angled pair of unit vectors") {
  Script lua;
  CHECK(lua("local f = frame{at = {1, 2, 3}, along = {5, 0, 0}, up = {1, 0, 2}} return f.at, f.along, f.up") ==
        "vec(1, 2, 3), vec(1, 0, 0), vec(0, 0, 1)");
  CHECK(lua("return frame{at = vec(0, 0, 1), along = vec(0, 0, 2)}.along") == "vec(0, 0, 1)");
  CHECK(lua("return frame{at = {0, 0, 1}, along = {1, 0, 0}}") == "frame{at = {0, 0, 1}, along = {1, 0, 0}, up = {0, 0, 1}}");
}

TEST_CASE("frame: what it prints reads back as the same frame") {
  Script lua;
  CHECK(lua("local f = frame{at = {0.1, -2, 3}, along = {1, 2, 3}, up = {0, 1, 0}}\n"
            "local g = load('return ' .. tostring(f))()\n"
            "return (f.along - g.along):length() < 1e-5 and (f.up - g.up):length() < 1e-5 and f.at == g.at") == "true");
}

TEST_CASE("frame:moved displaces and turns a copy") {
  Script lua;
  const std::string start = "local f = frame{at = {1, 0, 0}, along = {1, 0, 0}, up = {0, 0, 1}}\n";
  CHECK(lua(start + "local g = f:moved{by = {0, 0, 2}} return g.at, f.at") == "vec(1, 0, 2), vec(1, 0, 0)");
  CHECK(lua(start + "local g = f:moved{turn = {{0, 0, 3}, 90*units.deg}}\n"
                    "return g.at, (g.along - {0, 1, 0}):length() < 1e-15, (g.up - {0, 0, 1}):length() < 1e-15") ==
        "vec(1, 0, 0), true, true");
  CHECK(lua(start + "local g = f:moved{turn = {{1, 2, 3}, 2}}:moved{turn = {{1, 2, 3}, -2}}\n"
                    "return (g.along - f.along):length() < 1e-15") == "true");
  CHECK(lua(start + "return f:moved{} ~= nil, f:moved().at") == "true, vec(1, 0, 0)");
}

TEST_CASE("frame errors") {
  Script lua;
  CHECK(lua("frame{at = {0, 0, 0}}") ==
        "code:1: frame: missing option 'along': expected a vec or {x, y, z} of finite numbers; Direction of d3, the rod's tangent "
        "there; any length");
  CHECK(lua("frame()") ==
        "code:1: frame: missing option 'at': expected a vec or {x, y, z} of finite numbers (m); Place");
  CHECK(lua("frame(1)") == "code:1: frame: got a number (1), expected a table of options");
  CHECK(lua("frame{at = {0, 0, 0}, along = {0, 0, 0}}") == "code:1: frame: 'along' must be a finite vector other than zero");
  CHECK(lua("frame{at = {0, 0, 0}, along = {1, 0, 0}, up = {2, 0, 0}}") == "code:1: frame: 'up' must not be parallel to 'along'");
  CHECK(lua("frame{at = {0, 0, 0}, along = {1, 0, 0}, up = {0, 0, 0}}") == "code:1: frame: 'up' must not be the zero vector");
  CHECK(lua("frame{at = {0, 0, 1/0}, along = {1, 0, 0}}") ==
        "code:1: frame: option 'at': got a table whose entry 3 is inf, expected a vec or {x, y, z} of finite numbers (m)");
  CHECK(lua("frame{{0, 0, 0}, {1, 0, 0}}") ==
        "code:1: frame: got an entry without a name (key: a number (1)), expected named options");
  const std::string start = "local f = frame{at = {1, 0, 0}, along = {1, 0, 0}} ";
  CHECK(lua(start + "f:moved{turn = {{0, 0, 1}}}") ==
        "code:1: frame:moved: option 'turn': got a table with 1 list entries, expected {a vec or {x, y, z} of finite numbers, a "
        "finite number} (rad)");
  CHECK(lua(start + "f:moved{turn = {{0, 0, 0}, 1}}") == "code:1: frame: the axis of a turn must not be zero");
  CHECK(lua(start + "f:moved{tunr = {{0, 0, 1}, 1}}") ==
        "code:1: frame:moved: unknown option 'tunr'; did you mean 'turn'? (options: by, turn)");
}

TEST_CASE("units") {
  Script lua;
  CHECK(lua("return 60*units.mm == 0.06, 180*units.deg == math.pi, 5*units.MPa == 5e6, units.g*1000, 2*units.kN") ==
        "true, true, true, 1.0, 2000.0");
  CHECK(lua("return units.MPA") ==
        "code:1: units: no member 'MPA'; did you mean 'MPa'? (members: m, cm, mm, rad, deg, N, kN, Pa, kPa, MPa, GPa, kg, g)");
}
