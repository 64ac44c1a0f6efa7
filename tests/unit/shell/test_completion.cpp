#include <catch2/catch.hpp>
#include <random>

#include "binding/lua_class.h"
#include "shell/completion.h"
#include "unit/binding/script.h"

using namespace tendril::lua;
using tendril::shell::complete;
using tendril::shell::Completion;

namespace {

struct Completing : Script {
  Completing() {
    Module(L, "test", "For tests")
        .function("make", {.takes = {"name"},
                           .options = Schema{option<double>("outer", "m", "Outer"), option<double>("inner", "m", "Inner"),
                                             option<std::string>("kind", "", "Kind").one_of({"near", "neutral", "avoid"})},
                           .does = "Makes a vec."},
                  [](const std::string&, const Options&) { return tendril::Vec3(1, 2, 3); })
        .function("several", {.does = "A list."}, [] { return std::vector<tendril::Vec3>(2); });
    (*this)("v = vec(1, 2, 3) place = frame{at = {0, 0, 0}, along = {1, 0, 0}} plain = {alpha = 1, beta = {gamma = print}, [5] = 1, "
            "['not a name'] = 1} inherits = setmetatable({own = 1}, {__index = {inherited = print}})");
  }

  /// The candidates, joined by spaces.
  std::string of(const std::string& text) {
    const int top = lua_gettop(L);
    std::string all;
    for (const std::string& name : complete(L, text).candidates) all += (all.empty() ? "" : "|") + name;
    CHECK(lua_gettop(L) == top);
    return all;
  }
};

}  // namespace

TEST_CASE("globals and keywords") {
  Completing lua;
  CHECK(lua.of("pla") == "place|plain");
  CHECK(lua.of("print(pla") == "place|plain");
  CHECK(lua.of("x = coro") == "coroutine");
  CHECK(lua.of("whi") == "while");
  CHECK(lua.of("x = 1 .. pla") == "place|plain");
  CHECK(lua.of("nothing_starts_so").empty());
  CHECK(complete(lua.L, "print(pla").typed == 3);
}

TEST_CASE("members of tables, modules, objects and strings") {
  Completing lua;
  CHECK(lua.of("plain.") == "alpha|beta");
  CHECK(lua.of("plain.beta.ga") == "gamma");
  CHECK(lua.of("inherits.") == "inherited|own");
  CHECK(lua.of("inherits:") == "inherited");
  CHECK(lua.of("units.M") == "MPa");
  CHECK(lua.of("v.") == "x|y|z");
  CHECK(lua.of("v:") == "cross|dot|length|unit");
  CHECK(lua.of("string.fo") == "format");
  CHECK(lua.of("place.") == "along|at|up");
  CHECK(lua.of("unknown.").empty());
  CHECK(lua.of("unknown.x.y:").empty());
}

TEST_CASE("members of results, by their declared types, without running anything") {
  Completing lua;
  CHECK(lua.of("place.at:le") == "length");
  CHECK(lua.of("test.make('x').") == "x|y|z");
  CHECK(lua.of("test.make('x', {outer = 1}):un") == "unit");
  CHECK(lua.of("test.several()[1]:un") == "unit");
  CHECK(lua.of("place:moved{by = {1, 2, 3}}.al") == "along");
  CHECK(lua.of("print('x').").empty());
}

TEST_CASE("option names in the braces of a known call") {
  Completing lua;
  CHECK(lua.of("frame{") == "along = |at = |up = ");
  CHECK(lua.of("frame {a") == "along = |at = ");
  CHECK(lua.of("frame{at = {1, 2, 3}, ") == "along = |up = ");
  CHECK(lua.of("frame{\n  at = {1, 2, 3},\n  al") == "along = ");
  CHECK(lua.of("frame({u") == "up = ");
  CHECK(lua.of("test.make('x', {") == "inner = |kind = |outer = ");
  CHECK(lua.of("test.make('x', {inner = 1, ou") == "outer = ");
  CHECK(lua.of("place:moved{t") == "turn = ");
  CHECK(lua.of("place:moved{turn = {").find("turn = ") == std::string::npos);  // the braces of a value
  CHECK(lua.of("frame{at = pla") == "place|plain");
  CHECK(lua.of("print{a").find("along") == std::string::npos);
}

TEST_CASE("choices of an option") {
  Completing lua;
  CHECK(lua.of("test.make('x', {kind = \"ne") == "near|neutral");
  CHECK(lua.of("test.make('x', {kind = '") == "avoid|near|neutral");
  CHECK(lua.of("x = 'pla").empty());
  CHECK(lua.of("-- pla").empty());
}

TEST_CASE("no text makes completion fail, run code or leave something behind") {
  Completing lua;
  lua("trap = setmetatable({}, {__index = function() error('ran') end, __len = error, __pairs = error})");
  std::mt19937 random(11);
  INFO("seed 11");
  const std::vector<std::string> parts = {"v", "place", "trap", "plain", ".", ":", "(", ")", "{", "}", "[", "]", ",", " ", "\n",
                                          "\"", "'", "--", "[[", "]]", "frame", "at", "=", "moved", "x", "1", "test.make"};
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int n = std::uniform_int_distribution<int>(0, 12)(random); n > 0; --n)
      text += parts[std::uniform_int_distribution<std::size_t>(0, parts.size() - 1)(random)];
    const int top = lua_gettop(lua.L);
    const Completion found = complete(lua.L, text);
    REQUIRE(lua_gettop(lua.L) == top);
    REQUIRE(found.typed <= text.size());
  }
}
