-- Envelopes of studies and motions: what they contain, and what they are good for.
local check = require "check"
local mm, deg = units.mm, units.deg

local rubber = rod.material {young = 5e6, poisson = 0.4, density = 1100}
local hose = rod.new {length = 1, segments = 16, section = rod.section {outer = 16 * mm, inner = 10 * mm, material = rubber}}
local from = frame {at = {0, 0, 0}, along = {1, 0, 0}}
local to = frame {at = {0.85, 0, 0.05}, along = {1, 0, 0}}

local function hanging()
  local s = scene.new {gravity = {0, 0, -9.81}}
  s:rod("hose", hose, {from = from, to = to})
  return s
end

--- Points on the hose's surface.
local function surface(eq)
  local points = {}
  for _, f in ipairs(eq:rod("hose").frames) do
    for k = 0, 5 do
      local side = f.up * math.cos(k) + f.along:cross(f.up) * math.sin(k)
      points[#points + 1] = f.at + 7.99 * mm * side
    end
  end
  return points
end

check.case("an envelope contains every outcome it was made of", function()
  local s = hanging()
  local v = method.variation(s, {vary = {["hose.length"] = {tolerance = 30 * mm, spread = "uniform"}, ["hose.to"] = {cone = 10 * deg}}, outcomes = 40, seed = 4})
  local mesh, about = v:envelope {resolution = 4 * mm, uniform = false}
  check.is_true(mesh.watertight and about.ok)
  check.equal(about.outcomes, 40)
  check.near(mesh.volume, about.volume, 1e-6 * about.volume)
  check.is_true(about.margin > 0 and about.margin < 1 * mm)
  check.contains(about, "envelope", "grid step", "40")
  for _, k in ipairs {1, 13, 40} do
    for _, p in ipairs(surface(v:equilibrium(k))) do check.is_true(mesh:contains(p), "outcome " .. k) end
  end
  check.is_true(not mesh:contains(vec(0.4, 0, 0.3)))
  local smaller, left = v:envelope {resolution = 4 * mm, uniform = false, share = 0.5}
  check.equal(left.outcomes, 20)
  check.equal(left.left_out, 20)
  check.is_true(smaller.volume < mesh.volume)
end)

check.case("over the whole tolerance domain it is larger than over the likely outcomes", function()
  local v = method.variation(hanging(), {vary = {["hose.length"] = 30 * mm}, outcomes = 200, seed = 4})
  local likely, whole = v:envelope {resolution = 4 * mm, uniform = false}, v:envelope {resolution = 4 * mm}
  check.is_true(whole.volume > 1.02 * likely.volume)
end)

check.case("an envelope is an obstacle for the next study", function()
  local v = method.variation(hanging(), {vary = {["hose.length"] = 30 * mm}, outcomes = 30})
  local other = scene.new {gravity = {0, 0, -9.81}}
  other:obstacle("first hose", (v:envelope {resolution = 4 * mm}), {clearance = 5 * mm})
  other:rod("second", hose, {from = from:moved {by = {0, 0.2, 0}}, to = to:moved {by = {0, 0.2, 0}}})
  local gap = other:solve {}:clearance {from = "second"}
  check.is_true(gap > 0.15 and gap < 0.2, tostring(gap))
end)

check.case("a motion from a file sweeps an envelope, with the gap at each time", function()
  local path = os.tmpname() .. ".csv"
  local file = assert(io.open(path, "w"))
  file:write("t,x,y,z,rx,ry,rz\n")
  for k = 0, 10 do file:write(("%g,0,0,%g,%g,0,0\n"):format(0.1 * k, 20 * math.sin(2 * math.pi * k / 10), 0.1 * math.sin(2 * math.pi * k / 10))) end
  file:close()
  local engine = study.motion(path, {unit = "mm"})
  os.remove(path)
  check.equal(#engine.times, 11)
  check.contains(engine, "sampled motion", "11")
  local s = hanging()
  s:obstacle("floor", scene.plane(), {pose = frame {at = {0, 0, -0.4}, along = {0, 0, 1}}})
  local m = s:motion {steps = 10, holds = {["hose.finish"] = engine:carried(to)}}
  check.is_true(m.ok, m.message)
  local gaps, worst = m:clearance {from = "hose"}, 1
  check.equal(#gaps, 11)
  for k, gap in ipairs(gaps) do if gap < gaps[worst] then worst = k end end
  check.is_true(worst > 6 and worst < 10, "lowest in the second half of the period, at " .. worst)
  local mesh, about = m:envelope {resolution = 4 * mm}
  check.is_true(mesh.watertight)
  check.equal(about.outcomes, 11)
  for _, k in ipairs {1, 4, 9} do
    for _, p in ipairs(surface(m.equilibria[k])) do check.is_true(mesh:contains(p)) end
  end
  -- The same places as a table of outcomes: each starts from the nominal design, and is the same equilibrium.
  local v = method.variation(s, {vary = {["hose.to"] = {frames = engine:carried(to)}}, outcomes = 11,
    measure = {gap = {rod = "hose", what = "clearance"}}})
  for k, o in ipairs(v.outcomes) do check.near(o.measures.gap, gaps[k].value, 1e-6) end
end)

check.case("what an envelope cannot be", function()
  local v = method.variation(hanging(), {vary = {["hose.length"] = 30 * mm}, outcomes = 10})
  check.raises(function() v:envelope {resolution = 20 * mm} end, "radius")
  check.raises(function() v:envelope {resolution = 0} end, "resolution")
  check.raises(function() v:envelope {share = 1.5} end, "share")
  check.raises(function() v:envelope {resolution = 0.01 * mm} end, "memory")
  check.raises(function() study.motion("no_such_motion.csv", {unit = "mm"}) end, "no_such_motion.csv")
  check.raises(function() study.motion("no_such_motion.csv", {}) end, "unit")
end)

check.finish()
