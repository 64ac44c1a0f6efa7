-- Lua 5.1 habits behind require "compat51".
local check = require "check"

check.case("nothing is there before it is asked for", function()
  check.equal(rawget(_G, "unpack"), nil)
  check.equal(rawget(_G, "setfenv"), nil)
  check.equal(table.getn, nil)
end)

local added = require "compat51"

check.case("the value lists what was put back", function()
  check.is_true(#added > 10)
  local seen = {}
  for _, name in ipairs(added) do
    check.equal(seen[name], nil, name)
    seen[name] = true
    local home, key = name:match("^(%a+)%.(%w+)$")
    check.is_true((home and _G[home][key] or _G[name]) ~= nil, name)
  end
  check.equal(require "compat51", added)
end)

check.case("unpack, loadstring, gcinfo", function()
  local a, b, c = unpack{1, 2, 3}
  check.equal(a + b + c, 6)
  check.equal(select("#", unpack({1, nil, 3}, 1, 3)), 3)
  check.equal(assert(loadstring("return 6 * 7"))(), 42)
  local f, why = loadstring("return +")
  check.equal(f, nil)
  check.is_true(why:find("unexpected symbol") ~= nil)
  check.raises(function() loadstring(nil) end, "expected a string")
  check.is_true(gcinfo() > 0)
end)

check.case("tables", function()
  check.equal(table.getn{5, 6, 7}, 3)
  check.equal(table.maxn{1, 2, [10] = 3, [2.5] = 1, x = 99}, 10)
  check.equal(table.maxn{}, 0)
  local sum = 0
  check.equal(table.foreachi({1, 2, 3}, function(_, v) sum = sum + v end), nil)
  check.equal(sum, 6)
  check.equal(table.foreachi({1, 2, 3}, function(i, v) if v == 2 then return i * 10 end end), 20)
  local keys = {}
  table.foreach({a = 1, b = 2}, function(k, v) keys[k] = v end)
  check.equal(keys.a + keys.b, 3)
  check.equal(table.foreach({a = 1}, function(k) return k end), "a")
  check.raises(function() table.setn({}, 3) end, "keep a count")
end)

check.case("numbers", function()
  check.near(math.atan2(1, -1), 0.75 * math.pi, 1e-15)
  check.near(math.atan2(-1, -1), -0.75 * math.pi, 1e-15)
  check.equal(math.pow(2, 10), 1024.0)
  check.near(math.log10(1000), 3, 1e-14)
  check.equal(math.mod(-7, 3), -1.0)
  check.near(math.cosh(1), 1.5430806348152437, 1e-15)
  check.near(math.sinh(1), 1.1752011936438014, 1e-15)
  check.near(math.tanh(0.5), 0.46211715726000975, 1e-15)
  check.near(math.sinh(1e-8), 1e-8, 1e-23)
  check.near(math.tanh(1e-8), 1e-8, 1e-23)
  check.near(math.sinh(0.25), 0.25261231680816831, 1e-16)
  check.near(math.cosh(710) / 1.1169973830808557e308, 1, 1e-12)
  check.equal(math.tanh(1000), 1.0)
  check.equal(math.tanh(-1000), -1.0)
  check.equal(math.sinh(-2), -math.sinh(2))
  check.equal(math.cosh(1000), math.huge)
end)

check.case("frexp and ldexp are each other's inverse, to the last bit and at the ends of the range", function()
  local state = 12345
  for _ = 1, 2000 do
    state = (state * 1103515245 + 12345) % 2^31
    local x = (state / 2^31 - 0.5) * 2.0 ^ (state % 2000 - 1000)
    local m, e = math.frexp(x)
    check.is_true(math.abs(m) >= 0.5 and math.abs(m) < 1, tostring(x))
    check.equal(math.ldexp(m, e), x)
  end
  for _, x in ipairs{5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 1, 0.5, 8, -3} do
    local m, e = math.frexp(x)
    check.is_true(math.abs(m) >= 0.5 and math.abs(m) < 1, tostring(x))
    check.equal(math.ldexp(m, e), x + 0.0)
  end
  local m, e = math.frexp(8)
  check.equal(m, 0.5)
  check.equal(e, 4)
  check.equal(select(2, math.frexp(0)), 0)
  check.equal(math.frexp(math.huge), math.huge)
  check.equal(math.ldexp(1, 5000), math.huge)
  check.equal(math.ldexp(1, -5000), 0.0)
end)

check.case("numbers that are not whole where 5.1 took them", function()
  for _ = 1, 100 do
    local n = math.random(1.5, 3.9)
    check.is_true(n >= 1 and n <= 3)
  end
  check.is_true(math.random() < 1)
  check.is_true(math.random(2.7) <= 2)
  check.equal(string.format("%d", 3.7), "3")
  check.equal(("%5d|%x|%s|%%|%.2f"):format(-3.7, 255.9, "a", 1.255), "   -3|ff|a|%|" .. ("%.2f"):format(1.255))
  check.equal(string.format("%u items", 7), "7 items")
  check.equal(string.format("%-5d|", 7.2), "7    |")
  check.equal(string.format("%d", "12"), "12")
  check.equal(string.format("%c%c", 72.5, 105), "Hi")
  check.raises(function() string.format("%d", "x") end, "number expected")
  check.raises(function() string.format() end, "string expected")
  check.raises(function() math.random(3, 1) end, "interval is empty")
  check.equal(string.format("plain %%"), "plain %")
end)

check.case("string.gfind", function()
  local words = {}
  for word in string.gfind("one two", "%a+") do words[#words + 1] = word end
  check.equal(table.concat(words, "|"), "one|two")
end)

check.case("environments of functions", function()
  local function f() return wanted end
  local function g() return wanted end
  local env = {wanted = 7}
  check.equal(setfenv(f, env), f)
  check.equal(f(), 7)
  check.equal(g(), nil, "another function sees nothing of it")
  check.equal(getfenv(f), env)
  check.equal(getfenv(g), _G)
  check.equal(getfenv(1), _G)
  check.equal(getfenv(), _G)
  local function bare() return 1 end
  check.equal(getfenv(bare), _G)
  setfenv(bare, env)
  check.equal(getfenv(bare), env)
  check.equal(bare(), 1)
  -- As older configuration files were read.
  local chunk = assert(loadstring("width = 3; height = width * 2"))
  local settings = {}
  setfenv(chunk, settings)()
  check.equal(settings.height, 6)
  local function inner()
    setfenv(1, {x = 5, check = check})
    check.equal(x, 5)
  end
  inner()
  check.equal(rawget(_G, "x"), nil)
  check.raises(function() setfenv(print, {}) end, "not written in Lua")
  check.raises(function() setfenv(f, 3) end, "expected a table")
  check.raises(function() setfenv("f", {}) end, "expected a function or a level")
  check.raises(function() getfenv(0) end, "levels from 1 on")
  check.raises(function() getfenv(1000) end, "no level 1000")
end)

check.case("module is refused with what to write instead", function()
  check.raises(function() module("study") end, "local M = {}")
end)

check.finish()
