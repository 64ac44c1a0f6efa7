#include <catch2/catch.hpp>

#include "unit/binding/probe.h"
#include "unit/binding/script.h"

namespace {
struct Probed : Script {
  Probed() { bind_probe(L); }
};
}  // namespace

TEST_CASE("given options and presets") {
  Probed lua;
  CHECK(lua("return probe.options{outer = 2}") == "2.000000 0.500000 40 coarse fixed");
  CHECK(lua("return probe.options{outer = 2, share = 1, count = 3.0, fine = true, kind = 'slide'}") ==
        "2.000000 1.000000 3 fine slide");
  CHECK(lua("return probe.options{outer = 2, EI = 5}") == "2.000000 0.500000 40 coarse fixed EI 5.000000");
  CHECK(lua("return probe.options{outer = 2, EI = {5, 6}}") == "2.000000 0.500000 40 coarse fixed EI2 6.000000");
  CHECK(lua("return probe.options{outer = 2, probe = probe.new('p'), points = {{1, 2, 3}, vec(4, 5, 6)}}") ==
        "2.000000 0.500000 40 coarse fixed p points 2");
  CHECK(lua("return probe.options{outer = 2, weights = {b = 2, a = 1}}") == "2.000000 0.500000 40 coarse fixed a1 b2");
}

TEST_CASE("wrong options are told with what was got and what was expected") {
  Probed lua;
  const auto [code, message] = GENERATE(table<std::string, std::string>({
      {"{}", "missing option 'outer': expected a finite number (m) > 0; Outer diameter"},
      {"nil", "missing option 'outer': expected a finite number (m) > 0; Outer diameter"},
      {"{outer = 0}", "option 'outer': got 0, expected a finite number (m) > 0"},
      {"{outer = -1}", "option 'outer': got -1, expected a finite number (m) > 0"},
      {"{outer = 1/0}", "option 'outer': got inf, expected a finite number (m) > 0"},
      {"{outer = 0/0}", "option 'outer': got nan, expected a finite number (m) > 0"},
      {"{outer = '1'}", "option 'outer': got a string ('1'), expected a finite number (m) > 0"},
      {"{outer = 1, share = 1.5}", "option 'share': got 1.5, expected a finite number in 0 ... 1"},
      {"{outer = 1, cold = 300}", "option 'cold': got 300, expected a finite number (K) < 300"},
      {"{outer = 1, count = 0}", "option 'count': got 0, expected a whole number >= 1"},
      {"{outer = 1, count = 2.5}", "option 'count': got 2.5, expected a whole number >= 1"},
      {"{outer = 1, count = 1e12}", "option 'count': got 1e+12, expected a whole number >= 1"},
      {"{outer = 1, fine = 1}", "option 'fine': got a number (1), expected true or false"},
      {"{outer = 1, kind = 'swivle'}", "option 'kind': got 'swivle' (did you mean 'swivel'?), expected 'fixed', 'swivel' or 'slide'"},
      {"{outer = 1, kind = 'glue'}", "option 'kind': got 'glue', expected 'fixed', 'swivel' or 'slide'"},
      {"{outer = 1, kind = 3}", "option 'kind': got a number (3), expected 'fixed', 'swivel' or 'slide'"},
      {"{outer = 1, EI = {1, 2, 3}}",
       "option 'EI': got a table, expected a finite number or a list of 2, each entry a finite number (N m^2)"},
      {"{outer = 1, points = {{1, 2, 3}, {1, 2}}}",
       "option 'points': got a table whose entry 2 is a table with 2 list entries, expected a list, each entry a vec or {x, y, z} of "
       "finite numbers (m)"},
      {"{outer = 1, weights = {a = 'b'}}",
       "option 'weights': got a table whose entry 'a' is a string ('b'), expected a table of names, each entry a finite number"},
      {"{outer = 1, weights = {1}}",
       "option 'weights': got a table with a number (1) in place of a name, expected a table of names, each entry a finite number"},
      {"{outer = 1, probe = vec(1, 2, 3)}", "option 'probe': got a vec, expected a probe"},
      {"{outer = 1, measure = 5}", "option 'measure': got a number (5), expected a function"},
      {"{outer = 1, outter = 2}",
       "unknown option 'outter'; did you mean 'outer'? (options: outer, share, cold, count, fine, kind, EI, points, weights, probe, "
       "measure)"},
      {"{5}", "got an entry without a name (key: a number (1)), expected named options"},
      {"{[vec] = 1}", "got an entry without a name (key: a function), expected named options"},
      {"7", "got a number (7), expected a table of options"},
  }));
  INFO(code);
  CHECK(lua("\nprobe.options(" + code + ")") == "code:2: probe.options: " + message);
}

TEST_CASE("long and unprintable strings are shown shortened") {
  Probed lua;
  CHECK(lua("probe.options{outer = ('x'):rep(1e6)}") ==
        "code:1: probe.options: option 'outer': got a string ('" + std::string(40, 'x') + "...'), expected a finite number (m) > 0");
  CHECK(lua("probe.options{outer = 'a\\0\\27b'}") ==
        "code:1: probe.options: option 'outer': got a string ('a??b'), expected a finite number (m) > 0");
}

TEST_CASE("a table of options with a list in it") {
  Probed lua;
  CHECK(lua("return probe.list{probe.new('a'), probe.new('b'), scale = 10}") == "20.0");
  CHECK(lua("return probe.list{}, probe.list()") == "0.0, 0.0");
  CHECK(lua("probe.list{probe.new('a'), 5}") ==
        "code:1: probe.list: got a table whose entry 2 is a number (5), expected a list of probe, each a probe");
  CHECK(lua("probe.list{[3] = probe.new('a')}") ==
        "code:1: probe.list: got an entry without a name (key: a number (3)), expected a list and named options");
}

TEST_CASE("options behind a metatable are not seen: what is checked is what is used") {
  Probed lua;
  CHECK(lua("return probe.options(setmetatable({outer = 1}, {__index = function() return 'trap' end}))") ==
        "1.000000 0.500000 40 coarse fixed");
  CHECK(lua("local t = setmetatable({1, 2, 3}, {__index = error, __len = function() return 1e15 end})\n"
            "return probe.options{outer = 1, points = {t}}") == "1.000000 0.500000 40 coarse fixed points 1");
}

TEST_CASE("entries as help shows them") {
  using namespace tendril::lua;
  CHECK(option<double>("a", "m", "").above(0).range() == "> 0");
  CHECK(option<double>("a", "m", "").at_least(0).below(2).range() == ">= 0 and < 2");
  CHECK(option<double>("a", "m", "").at_least(0).at_most(2).range() == "0 ... 2");
  CHECK(option<double>("a", "m", "").range().empty());
  CHECK(option<double>("a", "", "").preset(0.25).preset_text() == "0.25");
  CHECK(option<bool>("a", "", "").preset(true).preset_text() == "true");
  CHECK(option<std::string>("a", "", "").preset("x").preset_text() == "\"x\"");
  CHECK(option<double>("a", "", "").preset_text().empty());
}
