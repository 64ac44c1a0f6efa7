-- A headlamp harness from the wires of the library: bundles, how stiff they may be, how it hangs, what it is measured by.
-- Its scene goes into a file, from which it settles to the same numbers.
--
--   scripts/run scripts/studies/headlamp_harness.lua [out=FOLDER]
local materials = require "materials"
local mm, MPa = units.mm, units.MPa

local out = "out"
for _, a in ipairs(arg) do
  out = a:match("^out=(.+)$") or error("unknown argument '" .. a .. "'; known: out=FOLDER", 0)
end

-- Which wire runs where: two lamps, one of them with a levelling motor, fed through one trunk.
local runs = {trunk = {}, left = {}, right = {}}
local wires = {}  -- by name, the rods it runs through
local function wire(name, kind, branch)
  for _, rod_name in ipairs{"trunk", branch} do table.insert(runs[rod_name], materials[kind].wire) end
  wires[name] = {"trunk", branch}
end
for k = 1, 4 do wire("left lamp " .. k, "FLRY-B 1.5", "left") end
for k = 1, 4 do wire("right lamp " .. k, "FLRY-B 1.5", "right") end
for k = 1, 6 do wire("left motor " .. k, "FLRY-B 0.5", "left") end
wire("left ground", "FLRY-B 2.5", "left")
wire("right ground", "FLRY-B 2.5", "right")

local function world(slip)
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:obstacle("cross member", scene.box{size = {60*mm, 1.4, 40*mm}}, {pose = frame{at = {0.46, 0, -60*mm}, along = {0, 0, 1}}})
  local length = {trunk = 0.52, left = 0.62, right = 0.60}
  local ends = {
    trunk = {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}},
    left = {to = frame{at = {0.62, 0.5, -20*mm}, along = {1, 0, 0}}},
    right = {to = frame{at = {0.62, -0.5, -20*mm}, along = {1, 0, 0}}},
  }
  local report = {}
  for _, name in ipairs{"trunk", "left", "right"} do
    local section, about = rod.bundle{wires = runs[name], taped = true, slip = slip}
    report[name] = about
    s:rod(name, rod.new{length = length[name], section = section}, ends[name])
  end
  s:placed("trunk"):clip(0.25, frame{at = {0.25, 0, 0}, along = {1, 0, 0}}, {kind = "slide"})
  s:branch("fork", {{"trunk", "finish"}, {"left", "start"}, {"right", "start"}})
  return s, report
end

local s, bundles = world()
for _, name in ipairs{"trunk", "left", "right"} do print(name .. ": " .. #runs[name] .. " wires") print(bundles[name]) end

local eq = s:solve{}
assert(eq.ok, eq.message)
local q = eq:quantities{wires = wires}
print(q)
for _, name in ipairs{"trunk", "left", "right"} do
  print(("%-6s bends to %.0f mm at rest, allowed %.0f mm"):format(name, eq:rod(name).min_bend_radius / mm, bundles[name].min_bend_radius / mm))
end
assert(q.clips == 1 and q.branches == 1)
local sum = 0
for _, length in pairs(q.wire_lengths) do sum = sum + length end
assert(math.abs(sum - q.cable_length) < 1e-12)

-- How far the fork hangs if the wires slip more or less than assumed: nothing of it is known beforehand.
for _, slip in ipairs{0.9, 0.7, 0.5} do
  local other = world(slip):solve{}
  assert(other.ok, other.message)
  print(("slip %.1f: the fork hangs %.1f mm low"):format(slip, -other:branch("fork").frame.at.z / mm))
end

-- The file holds it all.
s:save(out .. "/headlamp.scene.json")
local again = scene.load(out .. "/headlamp.scene.json"):solve{}
assert(again:branch("fork").frame.at == eq:branch("fork").frame.at)
view.new{s, eq, color = "curvature", title = "Headlamp harness"}:save(out .. "/headlamp_harness.png", {sheet = {"iso", "front", "top", "card"}})
