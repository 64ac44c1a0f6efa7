--- Lua 5.1 habits in Lua 5.4: `require "compat51"` at the head of an older script.
--
-- What 5.4 has dropped is put back under its old name: unpack, loadstring, setfenv, getfenv, gcinfo; table.getn, .maxn,
-- .foreach, .foreachi; math.atan2, .pow, .cosh, .sinh, .tanh, .log10, .ldexp, .frexp, .mod; string.gfind; package.loaders.
-- What 5.4 does itself already is left alone. math.random and string.format("%d") take numbers that are not whole, as 5.1
-- did: they are cut towards zero.
--
-- What cannot be put back:
--   module(...)       refused, with what to write instead
--   table.setn        refused: the length of a table is what is in it
--   `arg` in a function with `...`: write `local arg = {n = select("#", ...), ...}`
--   setfenv, getfenv  work on functions written in Lua, by the debug library: not in a sandbox, not on level 0. A function
--                     that names no global has no environment of its own: getfenv then tells what setfenv was last told
--   10 / 2            is 5.0 and prints so; 10 // 2 is 5
-- Its value is a table: the names that were put back, in order.

local added = {}

local function put(home, prefix, name, value)
  if home[name] ~= nil then return end
  home[name] = value
  added[#added + 1] = prefix .. name
end

-- Globals ---------------------------------------------------------------------------------------------------------------

put(_G, "", "unpack", table.unpack)

put(_G, "", "loadstring", function(text, name)
  if type(text) ~= "string" then error("loadstring: got " .. type(text) .. ", expected a string", 2) end
  return load(text, name or text)
end)

put(_G, "", "gcinfo", function() return math.floor(collectgarbage("count")) end)

put(_G, "", "module", function(name)
  error(string.format("module(%q): Lua 5.4 has no such function; begin the file with `local M = {}`, write `function M.f() ... end` "
    .. "and end with `return M`", tostring(name)), 2)
end)

-- Environments: the upvalue _ENV of a function. Joined to a fresh one, so that no other function sees the change.
local without_globals = setmetatable({}, {__mode = "k"})

local function function_at(who, target)
  if not (debug and debug.getupvalue and debug.upvaluejoin and debug.getinfo) then
    error(who .. ": needs the debug library, which a sandbox does not have", 3)
  end
  if type(target) == "function" then return target end
  local level = math.tointeger(target)
  if not level then error(who .. ": got " .. type(target) .. ", expected a function or a level", 3) end
  if level < 1 then error(who .. ": level " .. level .. ": only levels from 1 on can be told in Lua 5.4", 3) end
  local info = debug.getinfo(level + 2, "f")
  if not info then error(who .. ": there is no level " .. level, 3) end
  return info.func
end

local function environment_of(f)
  local k = 1
  while true do
    local name, value = debug.getupvalue(f, k)
    if not name then return nil end
    if name == "_ENV" then return k, value end
    k = k + 1
  end
end

put(_G, "", "getfenv", function(target)
  local f = function_at("getfenv", target or 1)
  local k, value = environment_of(f)
  if k then return value end
  return without_globals[f] or _G
end)

put(_G, "", "setfenv", function(target, env)
  if type(env) ~= "table" then error("setfenv: got " .. type(env) .. ", expected a table", 2) end
  local f = function_at("setfenv", target)
  if debug.getinfo(f, "S").what == "C" then error("setfenv: a function that is not written in Lua has no environment", 2) end
  local k = environment_of(f)
  if k then
    local value = env
    debug.upvaluejoin(f, k, function() return value end, 1)
  else
    without_globals[f] = env
  end
  return f
end)

-- Tables ----------------------------------------------------------------------------------------------------------------

put(table, "table.", "getn", function(t) return #t end)

put(table, "table.", "setn", function()
  error("table.setn: the length of a table is what is in it; keep a count beside it, as t.n", 2)
end)

put(table, "table.", "maxn", function(t)
  local most = 0
  for key in pairs(t) do
    if type(key) == "number" and key > most then most = key end
  end
  return most
end)

put(table, "table.", "foreach", function(t, f)
  for key, value in pairs(t) do
    local found = f(key, value)
    if found ~= nil then return found end
  end
end)

put(table, "table.", "foreachi", function(t, f)
  for i = 1, #t do
    local found = f(i, t[i])
    if found ~= nil then return found end
  end
end)

-- Numbers ---------------------------------------------------------------------------------------------------------------

put(math, "math.", "atan2", function(y, x) return math.atan(y, x) end)
put(math, "math.", "pow", function(x, y) return x ^ y end)
put(math, "math.", "log10", function(x) return math.log(x, 10) end)
put(math, "math.", "mod", function(x, y) return math.fmod(x + 0.0, y + 0.0) end)

put(math, "math.", "cosh", function(x)
  local half = math.exp(math.abs(x) / 2)  -- its square may be beyond what half of it is
  return 0.5 * half * half + 0.5 / half / half
end)

local function sinh(x)
  if math.abs(x) < 0.5 then  -- the difference of exponentials would lose digits
    local term, sum = x, x
    for k = 2, 18, 2 do
      term = term * x * x / (k * (k + 1))
      sum = sum + term
    end
    return sum
  end
  local half = math.exp(math.abs(x) / 2)
  local value = 0.5 * half * half - 0.5 / half / half
  return x < 0 and -value or value
end
put(math, "math.", "sinh", sinh)

put(math, "math.", "tanh", function(x)
  if math.abs(x) < 0.5 then return sinh(x) / math.sqrt(1 + sinh(x) ^ 2) end
  local fading = math.exp(-2 * math.abs(x))
  local value = (1 - fading) / (1 + fading)
  return x < 0 and -value or value
end)

-- Powers of two in halves, so that neither overflows on the way.
put(math, "math.", "ldexp", function(m, e)
  e = math.max(-2200, math.min(2200, math.floor(e)))
  return m * 2.0 ^ (e // 2) * 2.0 ^ (e - e // 2)
end)

put(math, "math.", "frexp", function(x)
  if x == 0 or x ~= x or x == math.huge or x == -math.huge then return x + 0.0, 0 end
  local e = math.floor(math.log(math.abs(x), 2)) + 1
  local m = x / 2.0 ^ (e // 2) / 2.0 ^ (e - e // 2)
  while math.abs(m) >= 1 do m, e = m / 2, e + 1 end
  while math.abs(m) < 0.5 do m, e = m * 2, e - 1 end
  return m, e
end)

local function cut(x)
  if math.type(x) ~= "float" or x ~= x or math.abs(x) == math.huge or math.tointeger(x) then return x end
  return x < 0 and math.ceil(x) or math.floor(x)
end

-- What `f` returns; its errors stand at the line that called what calls this.
local function called(f, ...)
  local ok, result = pcall(f, ...)
  if not ok then error(result, 3) end
  return result
end

local random = math.random
function math.random(...)
  local low, high = ...
  if select("#", ...) == 0 then return random() end
  if high == nil then
    local n = called(random, cut(low))
    return n
  end
  local n = called(random, cut(low), cut(high))
  return n
end

-- Text ------------------------------------------------------------------------------------------------------------------

put(string, "string.", "gfind", string.gmatch)

local format = string.format
function string.format(pattern, ...)
  if type(pattern) ~= "string" then
    local text = called(format, pattern, ...)
    return text
  end
  local values, k = table.pack(...), 0
  local whole = pattern:gsub("%%([%-+ #0]*%d*%.?%d*)(.)", function(flags, kind)
    if kind == "%" then return end
    k = k + 1
    if kind:find("[diuoxXc]") then values[k] = cut(tonumber(values[k]) or values[k]) end
    if kind == "u" then return "%" .. flags .. "d" end
  end)
  local text = called(format, whole, table.unpack(values, 1, values.n))
  return text
end

put(package, "package.", "loaders", package.searchers)

return added
