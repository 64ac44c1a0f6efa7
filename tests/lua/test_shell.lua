-- What a script finds around it.
local check = require "check"

check.case("the script knows its name and its arguments", function()
  check.contains(arg[0], "test_shell.lua")
  check.is_true(#arg >= 1)
  check.is_true(arg[-1] ~= nil)
end)

check.case("modules are found beside the script, and tendril's own by name", function()
  check.equal(package.loaded.check, check)
  check.equal(require "units", units)
  check.is_true(package.searchpath("check", package.path) ~= nil)
  local ok, message = pcall(require, "no_such_module")
  check.equal(ok, false)
  check.contains(message, "module 'no_such_module' not found", "no_such_module.lua")
end)

check.case("time returns seconds and results", function()
  local seconds, a, b = time(function() return "x", nil end)
  check.is_true(seconds >= 0 and seconds < 60)
  check.equal(a, "x")
  check.equal(b, nil)
  check.raises(function() time(5) end, "time: argument 1 (run): got a number (5), expected a function")
  check.raises(function() time(function() error("inside") end) end, "inside")
end)

check.case("an error inside a coroutine keeps its line", function()
  check.raises(function() coroutine.wrap(function() vec(1) end)() end, "vec: argument 2 (y): got nothing")
end)

check.case("globals are the documented ones", function()
  for _, name in ipairs {"units", "vec", "frame", "curve", "rod", "scene", "view", "study", "help", "time"} do
    check.is_true(_G[name] ~= nil, name)
  end
end)

check.finish()
