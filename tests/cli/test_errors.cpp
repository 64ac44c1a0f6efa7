// What an uncaught error says, and what hostile scripts cannot do.
#include <catch2/catch.hpp>

#include "process.h"

using cli::Folder;
using cli::Outcome;
using cli::run;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("an error carries the script's own line, also from inside a bound function") {
  const Folder folder;
  const std::string script = folder.file("s.lua", "local v = vec(1, 2, 3)\n\nprint(v.x)\nlocal w = vec(1, 'b', 3)\n");
  const Outcome o = run({script});
  CHECK(o.out == "1.0\n");
  CHECK_THAT(o.err, StartsWith("tendril: " + script + ":4: vec: argument 2 (y): got a string ('b'), expected a finite number\n"
                               "stack traceback:"));
  CHECK_THAT(o.err, Contains(script + ":4: in main chunk"));
  CHECK(o.code == 1);
}

TEST_CASE("an unknown option is an error at the caller's line with the nearest name") {
  const Folder folder;
  const std::string script = folder.file("s.lua", "local place =\n  frame\n  {\n  at = {0, 0, 0}, alnog = {0, 0, 1}}\n");
  CHECK_THAT(run({script}).err,
             StartsWith("tendril: " + script + ":2: frame: unknown option 'alnog'; did you mean 'along'? (options: at, along, up)\n"));
}

TEST_CASE("a tail call and a protected call keep the line") {
  const Folder folder;
  const std::string tail = folder.file("t.lua", "local function f()\n  return vec(1)\nend\nf()\n");
  CHECK_THAT(run({tail}).err, StartsWith("tendril: " + tail + ":2: vec: argument 2 (y): got nothing"));
  const std::string guarded = folder.file("p.lua", "print(pcall(vec, 1))\n");
  CHECK_THAT(run({guarded}).out, StartsWith("false\t" + guarded + ":1: vec: argument 2 (y): got nothing"));
}

TEST_CASE("errors that are no strings") {
  CHECK_THAT(run({"-e", "error(setmetatable({}, {__tostring = function() return 'my own error' end}))"}).err,
             StartsWith("tendril: my own error\n"));
  CHECK_THAT(run({"-e", "error({})"}).err, StartsWith("tendril: (error object is a table value)\n"));
  CHECK_THAT(run({"-e", "error()"}).err, StartsWith("tendril: (error object is a nil value)\n"));
  CHECK_THAT(run({"-e", "error(42)"}).err, StartsWith("tendril: 42\n"));
  for (const char* code : {"error({})", "error()", "error(vec(1, 2, 3))"}) CHECK(run({"-e", code}).code == 1);
}

TEST_CASE("endless recursion ends in an error") {
  const auto code = GENERATE(as<std::string>(), "local function f() return 1 + f() end f()",
                             "local t = setmetatable({}, {}) getmetatable(t).__index = function(s, k) return s[k] end print(t.x)",
                             "local function f() string.gsub('a', 'a', f) end f()",
                             "local s = ('('):rep(1e5) .. '1' .. (')'):rep(1e5) assert(load('return ' .. s))",
                             "local function f() return time(f) end f()",
                             "local c c = function() return coroutine.wrap(c)() end c()");
  INFO(code);
  const Outcome o = run({"-e", code});
  CHECK_THAT(o.err, Contains("overflow") || Contains("too many"));
  CHECK(o.code == 1);
}

TEST_CASE("a script that eats memory is stopped at the limit, and can go on after it") {
  const cli::Environment small{{"TENDRIL_MEMORY", "64M"}};
  const auto code = GENERATE(as<std::string>(), "local s = ('x'):rep(1e9)", "local t = {} for i = 1, 1e9 do t[i] = i end",
                             "local s = 'x' while true do s = s .. s end", "local t = {} while true do t[#t + 1] = vec(1, 2, 3) end");
  INFO(code);
  const Outcome o = run({"-e", code}, "", small);
  CHECK_THAT(o.err, Contains("not enough memory"));
  CHECK(o.code == 1);
  const Outcome caught = run({"-e", "print(pcall(function() " + code + " end)) collectgarbage() print('on')"}, "", small);
  CHECK(caught.out == "false\tnot enough memory\non\n");
  CHECK(caught.code == 0);
}

TEST_CASE("binary chunks and native libraries are not loaded") {
  CHECK(run({"-e", "print(load(string.dump(function() end)))"}).out == "nil\tattempt to load a binary chunk (mode is 't')\n");
  CHECK(run({"-e", "print(load('return 1', 'x', 'b'))"}).out == "nil\tbinary chunks are not loaded (mode is 'b')\n");
  CHECK(run({"-e", "print(load('return x', 'x', 'bt', {x = 5})())"}).out == "5\n");
  CHECK(run({"-e", "print(load(function() return nil end) ~= nil, package.loadlib, package.cpath)"}).out == "true\tnil\t\n");
  const Folder folder;
  const std::string binary = folder.file("b.lua", std::string("\x1bLua", 4));
  CHECK_THAT(run({"-e", "print(loadfile('" + binary + "'))"}).out, Contains("binary chunk"));
  CHECK_THAT(run({"-e", "print(pcall(dofile, '" + binary + "'))"}).out, StartsWith("false") && Contains("binary chunk"));
  CHECK_THAT(run({"-e", "require 'b'"}, "", {{"TENDRIL_LUA", folder.path()}}).err, Contains("binary chunk"));
}

TEST_CASE("dofile, loadfile and require find and run text") {
  const Folder folder;
  folder.file("lib/part.lua", "local name, file = ... return {name = name, file = file}");
  folder.file("beside.lua", "return 'beside'");
  folder.file("pack/init.lua", "return 'package'");
  const std::string script =
      folder.file("main.lua", "print(require 'beside', require 'pack', require('lib.part').name, require('lib.part').file)\n"
                              "print(dofile('" + folder.path() + "/beside.lua'), loadfile('" + folder.path() + "/beside.lua')())\n");
  CHECK(run({script}).out == "beside\tpackage\tlib.part\t" + folder.path() + "/lib/part.lua\nbeside\tbeside\n");
  const Outcome broken = run({folder.file("m.lua", "require 'bad'"), folder.file("bad.lua", "x = = 1")});
  CHECK_THAT(broken.err, Contains("error loading module 'bad'") && Contains("bad.lua:1:"));
}

TEST_CASE("warnings are off until asked for") {
  CHECK(run({"-e", "warn('a', 'b')"}).err.empty());
  CHECK(run({"-W", "-e", "warn('a', 'b')"}).err == "warning: ab\n");
  CHECK(run({"-e", "warn('@on') warn('x') warn('@off') warn('y')"}).err == "warning: x\n");
}

TEST_CASE("pipes get no escapes, prompts or progress") {
  const Outcome o = run({"-i"}, "1 + 1\nerror('no')\nvec(1, 2, 3)\n", {{"TERM", "xterm"}});
  CHECK(o.out == "2\nvec(1, 2, 3)\n");
  CHECK(o.err.find('\033') == std::string::npos);
  CHECK_THAT(o.err, StartsWith("tendril: stdin:1: no\n"));
  CHECK(o.code == 0);
}
