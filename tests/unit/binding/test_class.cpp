// The layer itself, with a class of the tests' own.
#include <catch2/catch.hpp>

#include "unit/binding/probe.h"
#include "unit/binding/script.h"

namespace {
struct Probed : Script {
  Probed() { bind_probe(L); }
};
}  // namespace

TEST_CASE("objects: properties, methods, identity") {
  Probed lua;
  CHECK(lua("local p = probe.new('a') return p, p.name, p:renamed('b').name, p.name") == "probe a, a, b, a");
  CHECK(lua("local p = probe.new('a') p:rename('c') return p.name") == "c");
  CHECK(lua("local p = probe.new('a') local q = p:self() q:rename('d') return p.name, p == q, p == p:renamed('d')") ==
        "d, true, false");
  CHECK(lua("return getmetatable(probe.new('a'))") == "probe");
  CHECK(lua("return type(probe.new('a').frames[2]), #probe.new('a').frames, probe.new('a').frames[2]") ==
        "userdata, 2, vec(4, 5, 6)");
}

TEST_CASE("objects that are lists") {
  Probed lua;
  CHECK(lua("local p = probe.new('a') return #p, p[1], p[3], p[0], p[4], p[-1]") == "3, 10.0, 30.0, nil, nil, nil");
  CHECK(lua("local sum = 0 for i, x in ipairs(probe.new('a')) do sum = sum + i * x end return sum") == "140.0");
}

TEST_CASE("members that depend on the object") {
  Probed lua;
  CHECK(lua("return probe.new('a').gap") == "0.25");
  CHECK(lua("return probe.new('a').gpa") ==
        "code:1: probe: no member 'gpa'; did you mean 'gap'? (members: frames, name, rename, renamed, self, gap)");
}

TEST_CASE("objects live as long as Lua holds them, and not longer") {
  Probe::alive = 0;
  {
    Probed lua;
    lua("kept = probe.new('a') for i = 1, 100 do local p = probe.new('x') end");
    lua("collectgarbage() collectgarbage()");
    CHECK(Probe::alive == 1);
    CHECK(lua("local twin = kept:self() kept = nil collectgarbage() collectgarbage() return twin.name") == "a");
  }
  CHECK(Probe::alive == 0);
}

TEST_CASE("all memory goes back") {
  tendril::lua::Context context;
  lua_State* L = tendril::lua::open_state(context);
  tendril::lua::open_tendril(L);
  CHECK(context.memory_used > 1000);
  lua_close(L);
  CHECK(context.memory_used == 0);
}

TEST_CASE("C++ exceptions become errors at the caller's line") {
  Probed lua;
  CHECK(lua("\nprobe.usage()") == "code:2: probe.usage: no");
  CHECK(lua("\nprobe.memory()") == "code:2: not enough memory");
  CHECK(lua("\nprobe.surprise()") == "code:2: surprise");
  CHECK(lua("return pcall(probe.usage)") == "false, code:1: probe.usage: no");
  CHECK(lua("return select(2, xpcall(probe.usage, function(m) return 'seen: ' .. m end))") == "seen: code:1: probe.usage: no");
}

TEST_CASE("mistakes in a binding are told, not hidden") {
  Probed lua;
  CHECK(lua("probe.wrong_name{outer = 1}") == "code:1: probe.wrong_name: the schema has no option 'outre'");
  CHECK(lua("probe.wrong_type{outer = 1}") == "code:1: probe.wrong_type: option 'outer' is of another type in the schema");
  CHECK(lua("probe.absent{outer = 1}") == "code:1: probe.absent: option 'cold' has neither a value nor a preset");
}

TEST_CASE("optional arguments") {
  Probed lua;
  CHECK(lua("return probe.maybe(), probe.maybe(nil), probe.maybe(4)") == "nil, nil, 8.0");
  CHECK(lua("probe.maybe('x')") == "code:1: probe.maybe: argument 1 (n): got a string ('x'), expected a finite number or nil");
  CHECK(lua("probe.maybe(1, 2)") == "code:1: probe.maybe: got 2 arguments, expected at most 1: probe.maybe(n) -> number?");
}

TEST_CASE("callbacks: values go in and out") {
  Probed lua;
  CHECK(lua("return probe.call(function(n, v) return n + v.z end, 4)") == "7.0");
  CHECK(lua("probe.call(function() return 'x' end, 4)") ==
        "code:1: probe.call: the function returned a string ('x'), expected a finite number");
  CHECK(lua("probe.call(function() return 0/0 end, 4)") == "code:1: probe.call: the function returned nan, expected a finite number");
  CHECK(lua("probe.call(3, 4)") == "code:1: probe.call: argument 1 (run): got a number (3), expected a function");
}

TEST_CASE("a Lua error in a callback passes through C++ unchanged") {
  Probed lua;
  CHECK(lua("probe.call(function()\n error('inside') end, 4)") == "code:2: inside");
  CHECK(lua("local mine = {} local ok, e = pcall(probe.call, function() error(mine) end, 4) return e == mine") == "true");
  const std::string trace = lua("return select(2, xpcall(function() probe.call(function() local function deep() error('x') end deep() end, 4) end,"
                                " debug.traceback))");
  CHECK_THAT(trace, Catch::Matchers::Contains("in local 'deep'") && Catch::Matchers::Contains("probe.call"));
  CHECK(lua("local ok, e = pcall(probe.call, function() vec(1) end, 4) return e") ==
        "code:1: vec: argument 2 (y): got nothing, expected a finite number");
}

TEST_CASE("a callback may not yield across C++") {
  Probed lua;
  CHECK_THAT(lua("return coroutine.resume(coroutine.create(function() probe.call(function() coroutine.yield() end, 1) end))"),
             Catch::Matchers::StartsWith("false, attempt to yield across a C-call boundary"));
}

TEST_CASE("a module says what it has") {
  Probed lua;
  CHECK(lua("return probe.newt") ==
        "code:1: probe: no member 'newt'; did you mean 'new'? (members: new, options, list, maybe, call, wrong_name, wrong_type, "
        "absent, usage, memory, surprise)");
  CHECK(lua("local n = 0 for name in pairs(probe) do n = n + 1 end return n") == "11");
}

TEST_CASE("methods refuse objects of another class") {
  Probed lua;
  CHECK(lua("local p = probe.new('a') p.rename(vec(1, 2, 3), 'x')") ==
        "code:1: probe:rename: got a vec as the object, expected a probe; is it called with ':'?");
  CHECK(lua("local p = probe.new('a') p.rename('x')") ==
        "code:1: probe:rename: got a string ('x') as the object, expected a probe; is it called with ':'?");
}
