-- What a harness is measured by.
local check = require "check"
local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}

check.case("lengths, clips, branch points, wires", function()
  local r = rod.new{length = 0.4, section = rod.section{outer = 0.012, material = rubber}}
  local s = scene.new{}
  s:rod("trunk", r, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}}):clip(0.2, frame{at = {0.2, 0, 0}, along = {1, 0, 0}})
  s:rod("left", r, {to = frame{at = {0.6, 0.3, 0}, along = {1, 0, 0}}})
  s:rod("right", r, {to = frame{at = {0.6, -0.3, 0}, along = {1, 0, 0}}})
  s:branch("fork", {{"trunk", "finish"}, {"left", "start"}, {"right", "start"}})
  local q = s:solve{}:quantities{wires = {W1 = {"trunk", "left"}, W2 = {"trunk", "right"}, W3 = {"left", "right"}}}
  check.equal(q.clips, 1)
  check.equal(q.held_ends, 3)
  check.equal(q.branches, 1)
  check.equal(#q.rods, 3)
  check.equal(q.rods[1].name, "trunk")
  check.near(q.unstressed_length, 1.2, 1e-12)
  check.near(q.length, q.rods[1].length + q.rods[2].length + q.rods[3].length, 1e-12)
  check.near(q.wire_lengths.W1, q.rods[1].length + q.rods[2].length, 1e-12)
  check.near(q.cable_length, 2 * q.length, 1e-12)
  check.near(q.volume, 1.2 * math.pi / 4 * 0.012^2, 1e-12)
  check.near(q.mass, 1150 * q.volume, 1e-12)
  check.equal(q.length_in_collision, 0.0)
  check.near(q.cost, q.length, 1e-12)
  check.contains(tostring(q), "clips", "3 wires", "trunk")
  check.contains(tostring(q.rods[1]), "'trunk'")
end)

check.case("an imported harness knows its wires", function()
  local s, harness = scene.import("builtin:t_harness")
  local rods = harness.wire_rods
  local q = s:solve{}:quantities{wires = rods}
  local count, sum = 0, 0
  for name, length in pairs(q.wire_lengths) do
    check.is_true(#rods[name] > 0, name)
    count, sum = count + 1, sum + length
  end
  check.equal(count, #harness.wires)
  check.near(q.cable_length, sum, 1e-12)
  local drawn = 0
  for _, w in ipairs(harness.wires) do drawn = drawn + w.length end
  check.near(q.cable_length / drawn, 1, 0.01)
end)

check.case("wrong names and numbers are told at the caller's line", function()
  local s = scene.new{}
  s:rod("hose", rod.new{length = 1, section = rod.section{outer = 0.02, material = rubber}}, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}})
  local eq = s:solve{}
  check.raises(function() eq:quantities{wires = {W1 = {"hos"}}} end, "did you mean 'hose'?")
  check.raises(function() eq:quantities{wires = {W1 = {"hose", "hose"}}} end, "wire 'W1' runs through 'hose' twice")
  check.raises(function() eq:quantities{range = 0} end, "range")
  check.raises(function() eq:quantities{wire = {}} end, "did you mean 'wires'?")
end)

check.finish()
