// Ctrl-C in a script: it ends, whatever it does, with exit code 130.
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "process.h"

using cli::Outcome;
using cli::run_and_interrupt;

TEST_CASE("an interrupt ends any Lua loop with exit code 130") {
  const std::string start = "io.write('ready\\n') io.flush() ";
  const auto code = GENERATE(
      as<std::string>(), "while true do end", "repeat until false", "for i = 1, math.huge do end",
      "while true do pcall(function() while true do end end) end",
      "local function f() while true do pcall(f) end end f()",
      "while true do xpcall(function() while true do end end, function() while true do end end) end",
      "coroutine.wrap(function() while true do end end)()",
      "while true do coroutine.resume(coroutine.create(function() while true do end end)) end",
      "while true do pcall(coroutine.wrap(function() while true do pcall(coroutine.yield) end end)) end",
      "local c = coroutine.create(function() while true do coroutine.yield() end end) while true do coroutine.resume(c) end",
      "time(function() while true do end end)", "table.sort({3, 1, 2}, function() while true do end end)",
      "setmetatable({}, {__index = function() while true do end end}).x = nil local t = setmetatable({}, {__index = function() "
      "while true do end end}) print(t.x)",
      "string.gsub('aaa', 'a', function() while true do end end)", "while true do vec(1, 2, 3) end",
      "while true do pcall(vec, 1) end", "io.read()");
  INFO(code);
  const Outcome o = run_and_interrupt({"-e", start + code});
  CHECK(o.code == 130);
  CHECK(o.err.find("interrupted\n") != std::string::npos);
  CHECK(o.err.find('\033') == std::string::npos);
}

TEST_CASE("an interrupt is told with the line it struck") {
  const Outcome o = run_and_interrupt({"-e", "local n = 0\n\nwhile true do n = n + 1 if n == 1 then io.write('ready\\n') io.flush() end end"});
  CHECK(o.err == "tendril: (command line):3: interrupted\n");
  CHECK(o.code == 130);
}

namespace {
/// A scene whose equilibrium takes many seconds.
const std::string long_solve =
    "local m = rod.material{young = 5e6, poisson = 0.4, density = 1100}\n"
    "s = scene.new{gravity = {0, 0, -9.81}}\n"
    "s:rod('hose', rod.new{length = 1, segments = 200000, section = rod.section{outer = 0.02, material = m}},\n"
    "  {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.9, 0, 0}, along = {1, 0, 0}}})\n";
}  // namespace

TEST_CASE("an interrupt ends a solve; its best state so far is still handed over; then the script ends") {
  const Outcome o = run_and_interrupt({"-e", long_solve + "io.write('ready\\n') io.flush()\n"
                                             "local eq = s:solve{error = true} print(eq.ok, eq.status)\n"
                                             "while true do end"},
                                      std::chrono::milliseconds(300));
  CHECK(o.out == "ready\nfalse\tcancelled\n");
  CHECK(o.code == 130);
}

TEST_CASE("a loop of solves, each in a pcall, is ended by one interrupt") {
  const Outcome o = run_and_interrupt({"-e", long_solve + "io.write('ready\\n') io.flush()\n"
                                             "while true do pcall(s.solve, s, {error = true}) end"});
  CHECK(o.out == "ready\n");
  CHECK(o.code == 130);
}

TEST_CASE("Ctrl-C in an interactive solve keeps the session and the cancelled result", "[terminal]") {
  const cli::Folder folder;
  cli::TerminalSession session({"-i", folder.file("scene.lua", long_solve)});
  session.wait_for("> ");
  session.type("io.write('run' .. 'ning') io.flush() eq = s:solve{error = true}\r");
  session.wait_for("running");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the solve has begun
  session.type("\x03");
  session.wait_for("> ");
  session.type("eq.status .. ' by hand'\r");
  session.wait_for("cancelled by hand");
  session.wait_for("> ");
  session.type("'se' .. 'ven'\r");
  session.wait_for("seven");
  session.wait_for("> ");
  session.type("\x04");
  CHECK(session.finish() == 0);
}
