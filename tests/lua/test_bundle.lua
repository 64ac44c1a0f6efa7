-- Wires and bundles of them.
local check = require "check"
local mm = units.mm

check.case("a wire from its sizes", function()
  local w = rod.wire{outer = 1.6*mm, area = 0.5*mm^2}
  check.near(w.area, 0.5*mm^2, 1e-18)
  check.equal(w.strands, 14)
  check.near(w.mass, 6.3e-3, 0.3e-3)
  check.near(w.min_bend_radius, 4.8*mm, 1e-15)
  check.contains(tostring(w), "14 strands")
  local measured = rod.wire{outer = 1.6*mm, area = 0.5*mm^2, mass = 7e-3, min_bend_radius = 10*mm, strands = 19, young = 70e9}
  check.equal(measured.mass, 7e-3)
  check.equal(measured.min_bend_radius, 10*mm)
  check.equal(measured.strands, 19)
  check.equal(measured.young, 70e9)
  local solid = rod.wire{outer = 2*mm, area = math.pi/4*mm^2, conductor = 1.0000001*mm, strands = 1, mass = 0.01}
  check.near((rod.bundle{wires = {solid}}).EI1, 115e9*math.pi/64*mm^4 + 30e6*math.pi/64*15*mm^4, 1e-8)
  local filler = rod.wire{outer = 3*mm, area = 0, mass = 5e-3}
  check.near((rod.bundle{wires = {filler}}).EI1, 30e6*math.pi/64*81*mm^4, 1e-12)
end)

check.case("wires that make no sense are refused", function()
  check.raises(function() rod.wire{outer = 1*mm, area = 6*mm^2} end, "less than 'outer' = 1 mm")
  check.raises(function() rod.wire{outer = 1*mm, area = 0} end, "'mass' is missing")
  check.raises(function() rod.wire{outer = 3*mm, area = 1*mm^2, conductor = 2*mm} end, "'mass' is missing")
  check.raises(function() rod.wire{outer = 3*mm, area = 6*mm^2, conductor = 2*mm, mass = 0.1} end, "larger than the circle")
  check.raises(function() rod.wire{outer = 3*mm, area = 0, conductor = 2*mm, mass = 0.1} end, "without metal")
  check.raises(function() rod.wire{outer = 3*mm, area = 1*mm^2, conductor = 4*mm, mass = 0.1} end, "'conductor' of wire 1")
  check.raises(function() rod.wire{outer = 3*mm} end, "missing option 'area'")
end)

check.case("a bundle makes a rod", function()
  local w = rod.wire{outer = 1.6*mm, area = 0.5*mm^2, mass = 6e-3}
  local section, about = rod.bundle{wires = {{wire = w, count = 7}}}
  check.near(section.outer, 4.8*mm, 1e-15)
  check.near(section.mass, 42e-3, 1e-12)
  check.near(about.min_bend_radius, 4.8*mm + 1.6*mm, 1e-15)
  check.is_true(about.EI_range[1] < section.EI1 and section.EI1 < about.EI_range[2])
  check.is_true(about.GJ_range[1] < section.GJ and section.GJ < about.GJ_range[2])
  check.equal(about.slip, 0.85)
  check.equal(about.section.EI1, section.EI1)
  check.equal(about.outer, section.outer)
  check.contains(tostring(about), "slipping", "glued")
  check.near((rod.bundle{wires = {{wire = w, count = 7}}, slip = 1}).EI1, about.EI_range[1], 1e-15)
  check.near((rod.bundle{wires = {w, w, w, w, w, w, w}}).EI1, section.EI1, 1e-12)
  local taped = rod.bundle{wires = {{wire = w, count = 7}}, taped = true}
  check.near(taped.outer, 4.8*mm + 0.52*mm, 1e-15)
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:rod("harness", rod.new{length = 0.5, section = section},
    {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.45, 0, 0}, along = {1, 0, 0}}})
  check.is_true(s:solve{}.ok)
end)

check.case("bundles that make no sense are refused", function()
  local w = rod.wire{outer = 1.6*mm, area = 0.5*mm^2}
  check.raises(function() rod.bundle{wires = {}} end, "no wires")
  check.raises(function() rod.bundle{wires = {{wire = w, count = 0}}} end, "'count' of wire 1 is 0")
  check.raises(function() rod.bundle{wires = {{wire = w, number = 3}}} end, "'number'")
  check.raises(function() rod.bundle{wires = {{count = 3}}} end, "wire")
  check.raises(function() rod.bundle{wires = {{wire = w, count = "x"}}} end, "count")
  check.raises(function() rod.bundle{wires = {3}} end, "a wire, or a table")
  check.raises(function() rod.bundle{wires = {w}, slip = 2} end, "slip")
  check.raises(function() rod.bundle{} end, "missing option 'wires'")
  check.raises(function() rod.bundle{wires = {w}, tapped = true} end, "did you mean 'taped'?")
end)

check.finish()
