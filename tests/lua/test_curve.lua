-- curve: lengths, frames, bend radii and errors of the three kinds.
local check = require "check"

check.case("a polyline", function()
  local c = curve.polyline {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}}
  check.equal(c.kind, "polyline")
  check.near(c.length, 3, 1e-15)
  check.near(c:at(2).at, vec(1, 1, 0), 1e-15)
  check.near(c:at(2).along, vec(0, 1, 0), 1e-15)
  check.equal(#c.points, 3)
  local radius, where = c:min_bend_radius()
  check.equal(radius, 0.0)
  check.near(where, 1, 1e-15)
  check.equal((curve.polyline {{0, 0, 0}, {1, 0, 0}}:min_bend_radius()), math.huge)
end)

check.case("piecewise constant curvature", function()
  local c = curve.pcc {points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, radius = 0.25}
  check.near(c.length, 2 * 0.75 + math.pi / 2 * 0.25, 1e-12)
  check.near(c:min_bend_radius(), 0.25, 1e-12)
  check.near(c:at(c.length).at, vec(1, 1, 0), 1e-12)
  check.near(c:at(0.75 + math.pi / 4 * 0.25).along, vec(1, 1, 0):unit(), 1e-12)
  local two = curve.pcc {points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}}, radius = {0.1, 0.2}}
  check.near(two:min_bend_radius(), 0.1, 1e-12)
end)

check.case("a spline passes through its points", function()
  local c = curve.spline {{0, 0, 0}, {0.5, 0.2, 0}, {1, 0, 0}, start = {1, 0, 0}, finish = {1, 0, 0}}
  check.near(c:at(0).along, vec(1, 0, 0), 1e-9)
  check.near(c:at(c.length / 2).at, vec(0.5, 0.2, 0), 1e-6)
  check.is_true(c.length > 1.07 and c.length < 1.3)
  check.is_true(c:min_bend_radius() > 0)
end)

check.case("a helix about z", function()
  local c = curve.helix {radius = 0.02, pitch = 0.01, turns = 3}
  check.equal(c.kind, "helix")
  check.near(c.length, 3 * math.sqrt((2 * math.pi * 0.02) ^ 2 + 0.01 ^ 2), 1e-12)
  check.near(c:at(c.length).at, vec(0.02, 0, 0.03), 1e-12)
  check.near(c:at(0).up, vec(-1, 0, 0), 1e-12)
  check.is_true(curve.helix {radius = 1, pitch = 1, turns = 1, left_handed = true}:at(0.1).at.y < 0)
  check.raises(function() curve.helix {radius = 1, turns = 1} end, "'pitch'")
  check.raises(function() curve.helix {radius = -1, pitch = 1, turns = 1} end, "'radius'")
end)

check.case("what is no curve", function()
  check.raises(function() curve.polyline {{0, 0, 0}} end, "polyline")
  check.raises(function() curve.polyline {{0, 0, 0}, {0, 0, 0}} end, "polyline")
  check.raises(function() curve.polyline {{0, 0, 0}, {0, 0 / 0, 0}} end, "curve.polyline")
  check.raises(function() curve.polyline {{0, 0, 0}, "x"} end, "curve.polyline", "'x'")
  check.raises(function() curve.pcc {points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, radius = 3} end, "pcc")
  check.raises(function() curve.pcc {points = {{0, 0, 0}, {1, 0, 0}}} end, "'radius'")
  check.raises(function() curve.pcc {point = {{0, 0, 0}, {1, 0, 0}}, radius = 1} end, "did you mean 'points'?")
  check.raises(function() curve.spline {{0, 0, 0}, {1, 0, 0}, start = {0, 0, 0}} end, "spline")
  check.raises(function() curve.polyline {{0, 0, 0}, {1, 0, 0}}:at(2) end, "2")
end)

check.finish()
