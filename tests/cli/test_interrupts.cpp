// Ctrl-C in a script: it ends, whatever it does, with exit code 130.
#include <catch2/catch.hpp>

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
  CHECK(o.err.find('\033') == std::string::npos);
}

TEST_CASE("an interrupt is told with the line it struck") {
  const Outcome o = run_and_interrupt({"-e", "local n = 0\n\nwhile true do n = n + 1 if n == 1 then io.write('ready\\n') io.flush() end end"});
  CHECK(o.err == "tendril: (command line):3: interrupted\n");
  CHECK(o.code == 130);
}
