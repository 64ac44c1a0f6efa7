-- The ten cases: what each is, its closed form where it has one, and what its errors are measured by.
local elastica = require "accuracy.elastica"
local mm, MPa, deg = units.mm, units.MPa, units.deg

-- A round section whose shear stiffness equals its stretch stiffness, and with its own bending stiffness about each axis:
-- with those the elastica is exact (see elastica.lua).
local function elastica_section(outer, young, EI)
  local EA = young * math.pi / 4 * outer ^ 2
  return rod.section{outer = outer, EA = EA, GA = EA, EI = EI, GJ = EI[1] / 1.5, mass = 0}
end

local function bending_stiffness(outer, young) return young * math.pi / 64 * outer ^ 4 end

local function hose_between_clamps(young)
  local s = scene.new{gravity = {0, 0, -9.81}}
  local rubber = rod.material{young = young, poisson = 0.5, density = 1100}
  s:rod("hose", rod.new{length = 1.2, section = rod.section{outer = 16 * mm, material = rubber}},
    {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.8, 0, 0}, along = {1, 0, 0}}})
  return s
end

local cases = {}

-- Each function gives a scene, and the exact centre line where there is a closed form.
local function case(name, title, length, make, peers)
  cases[#cases + 1] = {name = name, title = title, length = length, make = make, peers = peers or {}}
end

-- Figures given to us, not measured here: ms for an error of 1e-3, 1e-4, ... of the length.
local function discrete_elastic_rods(ms) return {name = "discrete elastic rods", short = "DER (given)", ms = ms} end
local function ancf_cable(ms) return {name = "cubic ANCF cable", short = "ANCF (given)", ms = ms} end

case("cantilever", "Cantilever, tip force 3 EI/L^2", 1, function()
  local outer, young = 10 * mm, 5 * MPa
  local EI = bending_stiffness(outer, young)
  local section = elastica_section(outer, young, {EI, EI})
  local s = scene.new{}
  local p = s:rod("rod", rod.new{length = 1, section = section}, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}})
  p:load("finish", {force = {0, 0, -3 * EI}})
  return s, elastica.cantilever(1, EI, section.EA, 3 * EI)
end, {discrete_elastic_rods{0.67, 2.1, 7.2, 23}, ancf_cable{0.6, 0.67, 0.99, 1.5}})

case("hose", "Hose under gravity", 1.2, function() return hose_between_clamps(5 * MPa) end,
  {discrete_elastic_rods{0.32, 1.05, 4.7, 19}, ancf_cable{1.0, 1.6, 2.0, 3.4}})

case("bend45", "45-degree bend, P = 600", 100 * 45 * deg, function()
  local reach = 100 * math.tan(22.5 * deg)
  local corner = vec(reach, 0, 0)
  local shape = curve.pcc{points = {{0, 0, 0}, corner, corner + reach * vec(math.cos(45 * deg), math.sin(45 * deg), 0)}, radius = 100}
  local E = 1e7
  local section = rod.section{outer = 1, EA = E, GA = E / 2, EI = E / 12, GJ = E / 12, mass = 0}
  local s = scene.new{}
  local p = s:rod("bend", rod.new{shape = shape, section = section}, {from = shape:at(0)})
  p:load("finish", {force = {0, 0, 600}})
  return s
end, {discrete_elastic_rods{0.79, 2.7, 9}})

-- Five coils of steel wire, pulled by a fifth of the height,the ends' orientations kept.
local coils = curve.helix{radius = 10 * mm, pitch = 6 * mm, turns = 5}

case("spring", "Helical spring, pulled", coils.length, function()
  local steel = rod.material{young = 200e9, poisson = 0.3, density = 7850}
  local s = scene.new{}
  s:rod("spring", rod.new{shape = coils, section = rod.section{outer = 1 * mm, material = steel}},
    {from = coils:at(0), to = coils:at(coils.length):moved{by = {0, 0, 6 * mm}}})
  return s
end)

case("twisted", "Clamped rod twisted by a turn", 1, function()
  local rubber = rod.material{young = 5 * MPa, poisson = 0.4, density = 1100}
  local s = scene.new{}
  local finish = frame{at = {0.7, 0, 0}, along = {math.cos(20 * deg), math.sin(20 * deg), 0}}
  s:rod("rod", rod.new{length = 1, section = rod.section{outer = 10 * mm, material = rubber}},
    {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = finish}):hold("finish", finish, {turns = 1})
  return s
end)

case("princeton", "Princeton beam, 45 degrees, 13.3 N", 0.508, function()
  local section = rod.section{outer = 3.2 * mm, EA = 2841908.71416, GA = 903914.98542, EI = {2.428734443354, 36.27936354403},
    GJ = 3.103338270807, mass = 0}
  local s = scene.new{}
  local p = s:rod("beam", rod.new{length = 0.508, section = section},
    {from = frame{at = {0, 0, 0}, along = {1, 0, 0}, up = {0, math.sin(45 * deg), math.cos(45 * deg)}}})
  p:load("finish", {force = {0, -13.345, 0}})
  return s
end)

case("stretched", "Stretched: chord 1.05 L, EA L^2/EI = 1e4", 1, function()
  local rubber = rod.material{young = 5 * MPa, poisson = 0.5, density = 1100}
  local tilt = 30 * deg
  local s = scene.new{}
  s:rod("rod", rod.new{length = 1, section = rod.section{outer = 40 * mm, material = rubber}},
    {from = frame{at = {0, 0, 0}, along = {math.cos(tilt), 0, math.sin(tilt)}},
     to = frame{at = {1.05, 0, 0}, along = {math.cos(tilt), 0, -math.sin(tilt)}}})
  return s
end)

case("column", "Buckled column, ends 0.7 L apart", 1, function()
  local outer, young = 10 * mm, 5 * MPa
  local EI = bending_stiffness(outer, young)
  local section = elastica_section(outer, young, {1.5 * EI, EI})  -- it bends about d2, along d1 or against it
  local s = scene.new{}
  local from = frame{at = {0, 0, 0}, along = {1, 0, 0}, up = {0, 0, 1}}
  s:rod("column", rod.new{length = 1, section = section}, {from = from, to = from:moved{by = {0.7, 0, 0}}})
  local middle = s:solve{}:rod("column"):at(0.5).at
  return s, elastica.column(1, EI, section.EA, 0.7, vec(0, 0, middle.z > 0 and 1 or -1))
end)

-- A heater hose of three bends, pushed from its own shape by its clamps and its weight.
local bent = curve.pcc{points = {{0, 0, 0}, {0.25, 0, 0}, {0.25, 0.2, 0}, {0.45, 0.2, 0.2}, {0.7, 0.2, 0.2}}, radius = 0.06}

case("preformed", "Preformed hose, clamps moved", bent.length, function()
  local rubber = rod.material{young = 6 * MPa, poisson = 0.49, density = 1150}
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:rod("hose", rod.new{shape = bent, section = rod.section{outer = 18 * mm, inner = 10 * mm, material = rubber}},
    {from = bent:at(0), to = bent:at(bent.length):moved{by = {-0.04, 0.06, 0.03}, turn = {{0, 1, 0}, 25 * deg}}})
  return s
end)

case("soft", "Soft hose, w L^3/EI = 2.3e4", 1.2, function() return hose_between_clamps(0.05 * MPa) end)

return cases
