-- method.harness: what scripts give it and get from it. That trees and routes are right is tested in tests/unit/method.
local check = require "check"

local mm = units.mm
local pvc = rod.material{young = 30e6, poisson = 0.4, density = 1400}
local section = rod.section{outer = 8*mm, material = pvc}

local function asked(more)
  local options = {
    section = section, min_bend_radius = 40*mm, bundling = 0.9,
    connections = {frame{at = {0, 0, 0}, along = {1, 0, 0}}, frame{at = {0.6, 0.15, 0}, along = {-1, 0, 0}}, frame{at = {0.6, -0.15, 0}, along = {-1, 0, 0}}},
  }
  for k, v in pairs(more or {}) do options[k] = v end
  return options
end

check.case("three connections: a trunk and two branches, measured and settled", function()
  local s = scene.new{gravity = {0, 0, -9.81}}
  local h = method.harness(s, asked{names = {"ecu", "lamp", "horn"}})
  check.is_true(h.ok, h.message)
  check.equal(#h.branches, 3)
  check.equal(#h.junctions, 1)
  local sum, cable = 0, 0
  for _, b in ipairs(h.branches) do
    sum, cable = sum + b.length, cable + b.length * #b.wires
    check.near(b.curve.length, b.length, 1e-9)
    check.is_true(b.min_bend_radius >= 40*mm - 1e-6)
    check.equal(b.clearance.value, math.huge)
  end
  check.near(h.harness_length, sum, 1e-9)
  check.near(h.cable_length, cable, 1e-9)
  check.is_true(h.harness_length < 2 * 0.62, "shared length is saved")
  check.equal(#h.equilibrium.rods or 3, 3)
  check.is_true(h.equilibrium.ok)
  check.equal(h.length_in_collision, 0.0)
  for _, b in ipairs(h.branches) do
    local told = table.concat(h.settled_misses, "\n"):find(b.name .. ": bend radius", 1, true) ~= nil
    check.equal(told, b.settled_bend_radius < 40*mm * (1 - 1e-6), "a settled bend that is too sharp is told")
  end
  check.contains(tostring(h), "harness length", "ecu", "lamp", "horn", "junction 1")
  local again = h:scene():solve()
  check.is_true(again.ok)
end)

check.case("bundling: the harness gets shorter and the cable longer", function()
  local apart = method.harness(scene.new{}, asked{bundling = 0, settle = false})
  local together = method.harness(scene.new{}, asked{bundling = 1, settle = false})
  check.is_true(apart.ok and together.ok, apart.message .. together.message)
  check.is_true(together.harness_length <= apart.harness_length + 1e-6)
  check.is_true(together.cable_length >= apart.cable_length - 1e-6)
end)

check.case("infeasible, and what makes no sense", function()
  local s = scene.new{}
  s:obstacle("wall", scene.box{size = {10*mm, 4, 4}}, {pose = frame{at = {0.3, 0, 0}, along = {0, 0, 1}}})
  local h = method.harness(s, asked{keep_in = {{-0.2, -0.5, -0.5}, {0.8, 0.5, 0.5}}})
  check.is_true(not h.ok)
  check.equal(h.status, "infeasible")
  local function raises(more, ...)
    local words = {...}
    check.raises(function() method.harness(scene.new{}, asked(more)) end, table.unpack(words))
  end
  raises({connections = {frame{at = {0, 0, 0}, along = {1, 0, 0}}}}, "connection")
  raises({wires = {{1, 7}}}, "wires", "7", "1 to 3")
  raises({bundling = 2}, "bundling")
  raises({min_bend_radius = 1*mm}, "bend radius")
end)

check.finish()
