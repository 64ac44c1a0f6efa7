#include <catch2/catch.hpp>
#include <random>

#include "binding/lua_class.h"
#include "unit/binding/script.h"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using tendril::Vec3;

TEST_CASE("vec arithmetic") {
  Script lua;
  CHECK(lua("return vec(1, 2, 3) + vec(4, 5, 6)") == "vec(5, 7, 9)");
  CHECK(lua("return vec(1, 2, 3) + {4, 5, 6}") == "vec(5, 7, 9)");
  CHECK(lua("return {4, 5, 6} - vec(1, 2, 3)") == "vec(3, 3, 3)");
  CHECK(lua("return 2 * vec(1, 2, 3), vec(1, 2, 3) * 2, vec(2, 4, 6) / 2") == "vec(2, 4, 6), vec(2, 4, 6), vec(1, 2, 3)");
  CHECK(lua("return -vec(1, 2, 3)") == "vec(-1, -2, -3)");
  CHECK(lua("return vec(1, 2, 3) == vec(1, 2, 3), vec(1, 2, 3) == vec(1, 2, 4), vec(1, 2, 3) == 3") == "true, false, false");
  CHECK(lua("return vec(1, 2, 3) == frame{at = {0, 0, 0}, along = {1, 0, 0}}") == "false");
  CHECK(lua("local v = vec(1, 2, 3) return v.x, v.y, v.z") == "1.0, 2.0, 3.0");
}

TEST_CASE("vec products, length and direction") {
  Script lua;
  CHECK(lua("return vec(1, 2, 3):dot(vec(4, 5, 6)), vec(1, 2, 3):dot{4, 5, 6}") == "32.0, 32.0");
  CHECK(lua("return vec(1, 2, 3):cross{4, 5, 6}") == "vec(-3, 6, -3)");
  CHECK(lua("return vec(3, 4, 12):length()") == "13.0");
  CHECK(lua("return vec(0, 0, -7):unit()") == "vec(0, 0, -1)");
}

TEST_CASE("length and direction hold for the largest and the smallest numbers") {
  Script lua;
  CHECK(lua("return math.abs(vec(3e200, 4e200, 0):length() / 5e200 - 1) < 1e-15") == "true");
  CHECK(lua("return math.abs(vec(3e-200, 4e-200, 0):length() / 5e-200 - 1) < 1e-15") == "true");
  CHECK(lua("return (vec(3e200, 4e200, 0):unit() - {0.6, 0.8, 0}):length() < 1e-15") == "true");
  CHECK(lua("return (vec(3e-300, 4e-300, 0):unit() - {0.6, 0.8, 0}):length() < 1e-15") == "true");
}

TEST_CASE("identities hold for random vectors") {
  Script lua;
  std::mt19937 random(20260301);
  std::normal_distribution<double> normal;
  INFO("seed 20260301");
  luaL_dostring(lua.L,
                "function residual(a, b, c, k) return (a:cross(b)):dot(a), (a + b - b - a):length(), (a * k / k - a):length(),"
                " (a:cross(b:cross(c)) - (b * a:dot(c) - c * a:dot(b))):length(), a:unit():length() - 1 end");
  for (int i = 0; i < 200; ++i) {
    lua_settop(lua.L, 0);
    lua_getglobal(lua.L, "residual");
    for (int v = 0; v < 3; ++v)
      tendril::lua::Value<Vec3>::push(lua.L, Vec3(normal(random), normal(random), normal(random)));
    lua_pushnumber(lua.L, 0.1 + std::abs(normal(random)));
    REQUIRE(lua_pcall(lua.L, 4, 5, 0) == LUA_OK);
    for (int r = 1; r <= 5; ++r) CHECK(std::abs(lua_tonumber(lua.L, r)) < 1e-13);
  }
}

TEST_CASE("vec errors say who, what was got and what was expected") {
  Script lua;
  CHECK(lua("vec(1, 2)") == "code:1: vec: argument 3 (z): got nothing, expected a finite number");
  CHECK(lua("vec(1, 'b', 3)") == "code:1: vec: argument 2 (y): got a string ('b'), expected a finite number");
  CHECK(lua("vec(1, '2', 3)") == "code:1: vec: argument 2 (y): got a string ('2'), expected a finite number");
  CHECK(lua("vec(0/0, 1, 2)") == "code:1: vec: argument 1 (x): got nan, expected a finite number");
  CHECK(lua("vec(1, -1/0, 2)") == "code:1: vec: argument 2 (y): got -inf, expected a finite number");
  CHECK(lua("vec(1, 2, 3, 4)") == "code:1: vec: got 4 arguments, expected at most 3: vec(x, y, z) -> vec");
  CHECK(lua("local a = vec(1, 2, 3):dot{1, 2}") ==
        "code:1: vec:dot: argument 1 (other): got a table with 2 list entries, expected a vec or {x, y, z} of finite numbers");
  CHECK(lua("local a = vec(1, 2, 3):dot{1, 2, {}}") ==
        "code:1: vec:dot: argument 1 (other): got a table whose entry 3 is a table, expected a vec or {x, y, z} of finite numbers");
  CHECK(lua("local a = vec(1, 2, 3).length()") ==
        "code:1: vec:length: got nothing as the object, expected a vec or {x, y, z} of finite numbers; is it called with ':'?");
  CHECK(lua("local a = vec(1, 2, 3) * vec(1, 2, 3)") ==
        "code:1: vec *: one operand must be a number; for two vectors there are v:dot(w) and v:cross(w)");
  CHECK(lua("local a = vec(1, 2, 3) + 1") ==
        "code:1: vec +: right operand: got a number (1), expected a vec or {x, y, z} of finite numbers");
  CHECK(lua("local a = 'x' * vec(1, 2, 3)") ==
        "code:1: vec *: left operand: got a string ('x'), expected a finite number or a vec or {x, y, z} of finite numbers");
  CHECK(lua("local a = vec(1, 2, 3) / 0") == "code:1: vec /: division by zero");
  CHECK(lua("local a = vec(1e308, 0, 0) * 10 + {0, 0, 0}") ==
        "code:1: vec +: left operand: got a vec with an entry that is not finite, expected a vec or {x, y, z} of finite numbers");
  CHECK(lua("local a = vec(0, 0, 0):unit()") == "code:1: vec:unit: the zero vector has no direction");
  CHECK(lua("vec(1, 2, 3).x = 4") == "code:1: vec: member 'x' cannot be assigned to: the object is read-only");
  CHECK(lua("return vec(1, 2, 3)[1]") == "code:1: vec: a number (1) is no member");
  CHECK(lua("return vec(1, 2, 3).lenght") ==
        "code:1: vec: no member 'lenght'; did you mean 'length'? (members: x, y, z, cross, dot, length, unit)");
}
