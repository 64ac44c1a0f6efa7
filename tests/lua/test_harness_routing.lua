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

check.case("weights and preferences: a harness keeps off, and says what it pays", function()
  local s = scene.new{}
  s:obstacle("post", scene.cylinder{radius = 30*mm, length = 0.6}, {pose = frame{at = {0.3, 0.02, 0}, along = {0, 0, 1}}})
  local short = method.harness(s, asked{settle = false})
  local off = method.harness(s, asked{settle = false, weights = {length = 1, clearance = 8}, preference_range = 80*mm})
  check.is_true(short.ok and off.ok, short.message .. off.message)
  local function nearest(h)
    local least = math.huge
    for _, b in ipairs(h.branches) do least = math.min(least, b.clearance.value) end
    return least
  end
  check.is_true(nearest(off) > nearest(short) + 5*mm)
  check.equal(short.preference, 0.0)
  check.is_true(off.preference > 0)
  check.is_true(off.cost > short.cost)
  check.equal(#off.wire_lengths, 2)
  check.near(off.wire_lengths[1] + off.wire_lengths[2], off.cable_length, 1e-9)
  check.contains(tostring(off), "preference", "cost")
  local twice = method.harness(s, asked{settle = false, weights = {length = 2, clearance = 16}, preference_range = 80*mm})
  check.near(twice.cost, off.cost, 1e-9)
end)

check.case("clips: as few as hold the harness where its route keeps clear", function()
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:obstacle("floor", scene.box{size = {1.6, 0.8, 0.2}}, {pose = frame{at = {0.6, 0, -0.13}, along = {0, 0, 1}}})
  local function over(more)
    local options = asked{clearance = 5*mm,
      connections = {frame{at = {0, 0, 0}, along = {1, 0, 0}}, frame{at = {1.2, 0.2, 0}, along = {-1, 0, 0}}, frame{at = {1.2, -0.2, 0}, along = {-1, 0, 0}}}}
    for k, v in pairs(more) do options[k] = v end
    return method.harness(s, options)
  end
  local without = over{}
  check.is_true(without.ok)
  check.is_true(#without.settled_misses > 0)
  check.contains(table.concat(without.settled_misses, "\n"), "floor")
  local h = over{clips = 12}
  check.equal(#h.settled_misses, 0, table.concat(h.settled_misses, "; "))
  check.is_true(#h.clips >= 1 and #h.clips < 12)
  for _, clip in ipairs(h.clips) do
    check.equal(clip.obstacle, "floor")
    check.is_true(clip.at > 0 and clip.at < h.branches[clip.branch].rod_length)
    check.is_true(clip.route_at > 0 and clip.route_at < h.branches[clip.branch].length)
    check.is_true(clip.force >= 0)
    check.near((h.equilibrium:rod(h.branches[clip.branch].name):at(clip.at).at - clip.frame.at):length(), 0, 1e-9)
  end
  for _, b in ipairs(h.branches) do
    check.is_true(b.settled_clearance >= 5*mm - 2e-5)
    check.is_true(b.settled_bend_radius >= 40*mm * (1 - 1e-6))
  end
  check.contains(tostring(h), "of 12 allowed", "force", "floor")
  check.is_true(h:scene():solve().ok)
  check.equal(#over{refine = false, clips = 12}.clips, 0)
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
  raises({weights = {clearence = 1}}, "weights", "clearence", "'length' and 'clearance'")
  raises({weights = {length = 0, clearance = 1}}, "weights", "above 0")
  raises({clips = -1}, "clips")
  raises({max_stretch = 0}, "max_stretch")
  raises({min_bend_radius = 1*mm}, "bend radius")
end)

check.finish()
