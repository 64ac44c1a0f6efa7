-- rod: materials, sections, designs.
local check = require "check"
local mm, MPa = units.mm, units.MPa

local rubber = rod.material {young = 6 * MPa, poisson = 0.49, density = 1150}
local tube = rod.section {outer = 18 * mm, inner = 10 * mm, material = rubber}

check.case("a material from Poisson's ratio or from the shear modulus", function()
  check.near(rubber.shear, 6e6 / (2 * 1.49), 1e-6)
  local same = rod.material {young = 6e6, shear = rubber.shear, density = 1150}
  check.equal(same.shear, rubber.shear)
  check.equal(same.young, 6e6)
  check.equal(same.density, 1150.0)
  check.contains(rubber, "6 MPa", "1150 kg/m^3")
  check.raises(function() rod.material {young = 6e6, density = 1} end, "exactly one of 'poisson' and 'shear'", "neither")
  check.raises(function() rod.material {young = 6e6, poisson = 0.4, shear = 1, density = 1} end, "both")
  check.raises(function() rod.material {poisson = 0.4, density = 1} end, "rod.material", "'young'")
  check.raises(function() rod.material {young = -1, poisson = 0.4, density = 1} end, "'young'", "> 0")
  check.raises(function() rod.material {young = 0 / 0, poisson = 0.4, density = 1} end, "'young'", "nan")
  check.raises(function() rod.material {young = math.huge, poisson = 0.4, density = 1} end, "'young'", "inf")
  check.raises(function() rod.material {young = 1, poisson = 0.6, density = 1} end, "'poisson'")
  check.raises(function() rod.material {young = 1, poisson = 0.4, density = -1} end, "'density'")
end)

check.case("stiffness and mass of a tube", function()
  local area, moment = math.pi / 4 * (0.018 ^ 2 - 0.010 ^ 2), math.pi / 64 * (0.018 ^ 4 - 0.010 ^ 4)
  check.near(tube.EA, 6e6 * area, 1e-9)
  check.near(tube.GA1, rubber.shear * area, 1e-9)
  check.near(tube.GA2, tube.GA1, 0)
  check.near(tube.EI1, 6e6 * moment, 1e-12)
  check.near(tube.EI2, tube.EI1, 0)
  check.near(tube.GJ, rubber.shear * 2 * moment, 1e-12)
  check.near(tube.mass, 1150 * area, 1e-12)
  check.contains(tube, "18 mm", "EI", "EA")
end)

check.case("a section from measured stiffnesses", function()
  local s = rod.section {outer = 0.02, EA = 500, GA = {160, 170}, EI = {0.02, 0.03}, GJ = 0.015, mass = 0.2}
  check.equal(s.GA2, 170.0)
  check.equal(s.EI1, 0.02)
  check.equal(s.EI2, 0.03)
  check.equal(s.inner, 0.0)
  check.raises(function() rod.section {outer = 0.02, EA = 500, EI = 1, GJ = 1, mass = 1} end, "'GA' is missing")
  check.raises(function() rod.section {outer = 0.02} end, "'EA' is missing", "'material'")
  check.raises(function() rod.section {outer = 0.02, material = rubber, EI = 1} end, "both 'material' and 'EI'")
  check.raises(function() rod.section {outer = 0.02, EA = -500, GA = 1, EI = 1, GJ = 1, mass = 1} end, "'EA'")
  check.raises(function() rod.section {outer = 0.02, EA = 500, GA = 1, EI = {1, -1}, GJ = 1, mass = 1} end, "EI (about d2)", "-1")
  check.raises(function() rod.section {outer = 0.02, EA = 500, GA = 1, EI = {1, 1, 1}, GJ = 1, mass = 1} end, "'EI'")
  check.raises(function() rod.section {outer = 0.02, EA = 500, GA = 1, EI = 1, GJ = 1, mass = -1} end, "'mass'")
end)

check.case("sizes that cannot be", function()
  check.raises(function() rod.section {outer = 0.01, inner = 0.01, material = rubber} end, "'inner'", "less than 'outer'")
  check.raises(function() rod.section {outer = 0, material = rubber} end, "'outer'")
  check.raises(function() rod.section {outer = -1, material = rubber} end, "'outer'")
  check.raises(function() rod.section {outter = 1, material = rubber} end, "unknown option 'outter'", "did you mean 'outer'?")
  check.raises(function() rod.section {outer = 1, material = "rubber"} end, "'material'", "a material")
  check.raises(function() rod.section {outer = "18 mm", material = rubber} end, "'outer'", "18 mm")
end)

check.case("a design", function()
  local r = rod.new {section = tube, length = 1.2}
  check.equal(r.length, 1.2)
  check.equal(r.segments, 40)
  check.near(r.mass, 1.2 * tube.mass, 1e-12)
  check.equal(r.shape, nil)
  check.near(r.section.EA, tube.EA, 0)
  check.contains(r, "1.2 m", "straight")
  check.raises(function() rod.new {section = tube} end, "'length' is missing")
  check.raises(function() rod.new {length = 1} end, "'section'")
  check.raises(function() rod.new {section = tube, length = 0} end, "'length'", "> 0")
  check.raises(function() rod.new {section = tube, length = 0 / 0} end, "'length'", "nan")
  check.raises(function() rod.new {section = tube, length = -1} end, "'length'")
  check.raises(function() rod.new {section = tube, length = 1, segments = 1e9} end, "'segments'", "1000000")
  check.raises(function() rod.new {section = tube, length = 1, segments = 0} end, "'segments'")
  check.raises(function() rod.new {section = tube, length = 1, segments = 2.5} end, "'segments'", "whole number")
end)

check.case("with makes a changed copy and leaves the original", function()
  local r = rod.new {section = tube, length = 1.2}
  local thick = rod.section {outer = 30 * mm, material = rubber}
  local other = r:with {length = 1.5, segments = 80, section = thick}
  check.equal(other.length, 1.5)
  check.equal(other.segments, 80)
  check.equal(other.section.outer, 30 * mm)
  check.equal(r.length, 1.2)
  check.equal(r.segments, 40)
  check.equal(r.section.outer, 18 * mm)
  check.equal(r:with {}.length, 1.2)
  check.raises(function() r.length = 3 end, "length")
  check.raises(function() r:with {lenght = 1} end, "did you mean 'length'?")
  check.raises(function() r:with {length = -1} end, "'length'")
end)

check.case("sections that vary along the rod", function()
  local thick = rod.section {outer = 30 * mm, material = rubber}
  local r = rod.new {section = {{upto = 0.3, tube}, {upto = 1.0, thick}}, length = 1}
  check.equal(#r.sections, 2)
  check.equal(r.sections[1].upto, 0.3)
  check.equal(r:section_at(0.1).outer, 18 * mm)
  check.equal(r:section_at(0.9).outer, 30 * mm)
  check.near(r.mass, 0.3 * tube.mass + 0.7 * thick.mass, 1e-12)
  local longer = r:with {length = 2}
  check.near(longer.sections[1].upto, 0.6, 1e-15)
  check.equal(longer.sections[2].upto, 2.0)
  check.raises(function() rod.new {section = {{upto = 0.3, tube}, {upto = 0.9, thick}}, length = 1} end, "ends at", "1.0")
  check.raises(function() rod.new {section = {{upto = 0.3, tube}, {upto = 0.2, thick}}, length = 1} end, "'upto'")
  check.raises(function() rod.new {section = {{upto = 0.3, tube}, {upto = 1}}, length = 1} end, "'section'")
  check.raises(function() rod.new {section = {}, length = 1} end, "'section'")
end)

check.case("a preformed rod has the length of its curve", function()
  local bow = curve.pcc {points = {{0, 0, 0}, {0.4, 0, 0}, {0.4, 0.4, 0}}, radius = 0.1}
  local r = rod.new {section = tube, shape = bow}
  check.near(r.length, 0.6 + math.pi / 2 * 0.1, 1e-12)
  check.equal(r.shape.kind, "pcc")
  check.equal(r:with {segments = 10}.shape.kind, "pcc")
  check.raises(function() rod.new {section = tube, shape = bow, length = 2} end, "'length' is 2 m", "'shape'")
  check.raises(function() r:with {length = 2} end, "preformed")
  check.raises(function() rod.new {section = tube, shape = curve.polyline {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}} end,
    "'shape' bends with a radius of 0 mm", "curve.pcc")
  check.raises(function() rod.new {section = tube, shape = curve.pcc {points = bow.points, radius = 5 * mm}} end, "5 mm")
end)

check.finish()
