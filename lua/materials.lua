--- Wires, cables, conduits and hoses of cars and robots: `local materials = require "materials"`.
--
--   materials["FLRY-B 0.5"]          an entry: .name .kind .text .source .spread, and what it is made of:
--       .section                     for rod.new
--       .wire                        of wires and battery cables: for rod.bundle
--       .min_bend_radius             m; nil where no source states one
--       .EI_range                    N m^2, {lower, upper}: what the spread of its figures means for bending
--   materials.list("hose")           names of one kind ("wire", "cable", "conduit", "hose", "rubber"), or of all, in order
--   materials.tube{material = "EPDM 60", inner =, wall =}    an entry of any size of hose, computed as a tube
--   materials.rubber(60)             Pa: Young's modulus of a rubber of this Shore A hardness
--
-- Every entry says where its figures come from, and how far to trust them. They are for a first study: where stiffness
-- decides, measure the part and give rod.section what was measured.

local mm, MPa, GPa = units.mm, units.MPa, units.GPa

local materials = {}
local entries, order = {}, {}

-- Sources that several entries share ------------------------------------------------------------------------------------

local sources = {
  wire = "outside diameter: largest of ISO 6722 thin wall; mass and bend radius (3 outside diameters): car maker's test harness "
    .. "published by prostep ivip (KBL 2.4); copper 115 GPa, soft PVC 30 MPa +-50 %",
  battery = "outside diameter: largest of ISO 6722 thick wall, +-5 %; strands of ISO 6722 class B; bend radius: IEC 62440 for fixed "
    .. "installation (3 outside diameters up to 12 mm, 4 above), as LEONI states it; mass from copper 8960 and PVC 1400 kg/m^3",
  gent = "Young's modulus from Shore A hardness: Gent, On the relation between indentation hardness and Young's modulus, 1958, good "
    .. "from 20 to 80 Shore A; hardness +-5",
  epdm = "density of filled compounds 1150 kg/m^3, +-15 %: typical value",
  silicone = "density 1200 kg/m^3, +-5 %: typical value",
  tpu82 = "TPU of 82 Shore A: flexural modulus 36 MPa, density 1120 kg/m^3 (Elasthane 80A data sheet); +-30 % among makes",
  tpu55d = "TPU of 55 Shore D: flexural modulus 149 MPa, density 1160 kg/m^3 (Elasthane 55D data sheet); +-30 % among makes",
  conduit = "inner and outer diameter, wall and pitch: typical of catalogues, +-10 %; bending stiffness computed from one convolution's "
    .. "axial spring rate (EJMA, unreinforced U-shaped bellows, C_f = 1.5) and Young's modulus of polypropylene 1.3 GPa, +-20 %; bend "
    .. "radius four outside diameters: typical value",
}

-- How entries are made --------------------------------------------------------------------------------------------------

local entry_meta = {}

--- What an entry is asked for is made when it is first asked for. Unknown fields: nil.
function entry_meta.__index(entry, key)
  local make = rawget(entry, "make")[key]
  if not make then return nil end
  local value = make(entry)
  rawset(entry, key, value)
  return value
end

local function quantity(value, unit, scale) return string.format("%.4g %s", value / scale, unit) end

function entry_meta.__tostring(entry)
  local lines = {entry.name .. ": " .. entry.text}
  local function row(name, text) lines[#lines + 1] = string.format("  %-16s %s", name, text) end
  if entry.section then
    local s, range = entry.section, entry.EI_range
    row("outer", quantity(s.outer, "mm", mm))
    row("mass", quantity(s.mass, "g/m", 1e-3))
    row("EI", string.format("%.3g N m^2 (%.3g ... %.3g)", s.EI1, range[1], range[2]))
  else
    row("young", quantity(entry.material.young, "MPa", MPa))
    row("density", quantity(entry.material.density, "kg/m^3", 1))
  end
  if entry.min_bend_radius then row("min bend radius", quantity(entry.min_bend_radius, "mm", mm)) end
  row("source", entry.source)
  return table.concat(lines, "\n")
end

local function add(entry, make)
  entry.make = make
  setmetatable(entry, entry_meta)
  entries[entry.name] = entry
  order[#order + 1] = entry.name
end

--- A factor on the bending stiffness either way.
local function by_spread(entry)
  local EI = entry.section.EI1
  return {EI / (1 + entry.spread.EI), EI * (1 + entry.spread.EI)}
end

-- Wires -----------------------------------------------------------------------------------------------------------------

--- Of one wire alone, with what is between slipping and glued strands as its range.
local wire_makers = {
  wire = function(entry) return rod.wire(entry.figures) end,
  section = function(entry) return (rod.bundle{wires = {entry.wire}}) end,
  EI_range = function(entry) return (select(2, rod.bundle{wires = {entry.wire}})).EI_range end,
  min_bend_radius = function(entry) return entry.wire.min_bend_radius end,
}

local function add_wires(family, make_up, rows)
  for _, row in ipairs(rows) do
    local area, outer, mass, strands = table.unpack(row)
    add({
      name = string.format("%s %g", family, area), kind = "wire",
      text = string.format("car wire, %g mm^2 of copper in %d strands, PVC of thin wall, %s", area, strands, make_up),
      source = sources.wire, spread = {outer = 0.05, mass = 0.1},
      figures = {outer = outer * mm, area = area * mm ^ 2, mass = mass * 1e-3, strands = strands, min_bend_radius = 3 * outer * mm},
    }, wire_makers)
  end
end

-- mm^2, mm, g/m, strands
add_wires("FLRY-A", "strands in even layers", {
  {0.35, 1.3, 4.5, 7}, {0.5, 1.6, 6.0, 19}, {0.75, 1.9, 9.0, 19}, {1, 2.1, 11, 19}, {1.5, 2.4, 16, 19}, {2.5, 3.0, 26, 19},
})
add_wires("FLRY-B", "strands bunched", {
  {0.35, 1.3, 4.5, 12}, {0.5, 1.6, 6.0, 16}, {0.75, 1.9, 9.0, 24}, {1, 2.1, 11, 32}, {1.5, 2.4, 16, 30}, {2.5, 3.0, 26, 50},
  {4, 3.7, 42, 56}, {6, 4.3, 61, 84},
})

for _, row in ipairs{{10, 6.5, 80}, {16, 8.3, 126}, {25, 10.4, 196}, {35, 11.6, 276}, {50, 13.5, 396}, {70, 15.5, 360}} do
  local area, outer, strands = table.unpack(row)
  add({
    name = string.format("FLY %g", area), kind = "cable",
    text = string.format("battery cable, %g mm^2 of copper in %d strands, PVC of thick wall", area, strands),
    source = sources.battery, spread = {outer = 0.05, mass = 0.1},
    figures = {outer = outer * mm, area = area * mm ^ 2, strands = strands, min_bend_radius = (outer <= 12 and 3 or 4) * outer * mm},
  }, wire_makers)
end

-- Conduits --------------------------------------------------------------------------------------------------------------

--- An unreinforced bellows: EJMA's axial spring rate f of a convolution (N/m) gives EI = f (mean diameter)^2 / 8 times the
--- pitch; twist and shear as the tube of its wall, stretched by f times the pitch.
local function conduit_section(entry)
  local g = entry.figures
  local mean, depth = (g.inner + g.outer) / 2, (g.outer - g.inner) / 2
  local rate = 1.7 * mean * g.young * g.wall ^ 3 / (depth ^ 3 * 1.5)
  local unfolded = 1 + 2 * (depth - g.wall) / g.pitch  -- length of wall to length of conduit
  local wall_area = math.pi * mean * g.wall
  local shear = g.young / (2 * (1 + 0.4))
  return rod.section{
    outer = g.outer, inner = g.inner, EA = rate * g.pitch, GA = shear * wall_area / 2 / unfolded,
    EI = rate * mean ^ 2 / 8 * g.pitch, GJ = shear * wall_area * mean ^ 2 / 4 / unfolded, mass = g.density * wall_area * unfolded,
  }
end

for _, row in ipairs{{"7.5", 7.1, 10.0, 2.4}, {"10", 9.8, 13.0, 2.6}, {"13", 12.7, 15.8, 3.0}, {"17", 16.7, 21.2, 3.5}, {"22", 21.9, 25.5, 3.8}} do
  local name, inner, outer, pitch = table.unpack(row)
  add({
    name = "NW " .. name, kind = "conduit", text = "corrugated conduit of polypropylene, without a slit, empty",
    source = sources.conduit, spread = {EI = 1, outer = 0.1, mass = 0.3}, min_bend_radius = 4 * outer * mm,
    figures = {inner = inner * mm, outer = outer * mm, wall = 0.3 * mm, pitch = pitch * mm, young = 1.3 * GPa, density = 910},
  }, {section = conduit_section, EI_range = by_spread})
end

-- Rubbers and hoses -----------------------------------------------------------------------------------------------------

--- Gent 1958: E in Pa of Shore A hardness.
function materials.rubber(shore)
  if type(shore) ~= "number" or not (shore >= 20 and shore <= 80) then
    error("materials.rubber: got " .. tostring(shore) .. ", expected a Shore A hardness from 20 to 80, where the relation holds", 2)
  end
  return 0.0981 * MPa * (56 + 7.62336 * shore) / (0.137505 * (254 - 2.54 * shore))
end

local rubber_makers = {
  material = function(entry)
    return rod.material{young = entry.figures.young, poisson = entry.figures.poisson, density = entry.figures.density}
  end,
}

local function add_rubber(name, text, source, young, density, spread)
  add({name = name, kind = "rubber", text = text, source = source, spread = spread,
       figures = {young = young, poisson = 0.49, density = density}}, rubber_makers)
end

for _, shore in ipairs{50, 60, 70} do
  add_rubber("EPDM " .. shore, "EPDM rubber of " .. shore .. " Shore A, without fabric", sources.gent .. "; " .. sources.epdm,
    materials.rubber(shore), 1150, {young = 0.3, density = 0.15})
end
for _, shore in ipairs{50, 60, 70} do
  add_rubber("silicone " .. shore, "silicone rubber of " .. shore .. " Shore A, without fabric", sources.gent .. "; " .. sources.silicone,
    materials.rubber(shore), 1200, {young = 0.3, density = 0.05})
end
add_rubber("TPU 82A", "thermoplastic polyurethane of 82 Shore A: sheaths that bend much", sources.tpu82, 36 * MPa, 1120, {young = 0.3, density = 0.03})
add_rubber("TPU 55D", "thermoplastic polyurethane of 55 Shore D: air and water hoses", sources.tpu55d, 149 * MPa, 1160, {young = 0.3, density = 0.03})

local tube_makers = {
  section = function(entry)
    local g = entry.figures
    return rod.section{outer = g.inner + 2 * g.wall, inner = g.inner, material = g.rubber.material}
  end,
  EI_range = by_spread,
}

local function check_length(options, key)
  local value = options[key]
  if type(value) ~= "number" or not (value > 0 and value < math.huge) then
    error("materials.tube: '" .. key .. "' is " .. tostring(value) .. ", expected a length above 0 (m)", 3)
  end
  return value
end

local function tube_entry(rubber, inner, wall)
  return {
    name = string.format("%s hose %gx%g", rubber.name, inner / mm, wall / mm), kind = "hose",
    text = string.format("hose of %s, inside %g mm, wall %g mm, as a plain tube", rubber.name, inner / mm, wall / mm),
    source = rubber.source .. "; size: an example, nothing is claimed of it; layers of fabric make a hose up to twice as stiff",
    spread = {EI = rubber.spread.young + 0.1, mass = rubber.spread.density + 0.05},
    figures = {inner = inner, wall = wall, rubber = rubber},
  }
end

--- {material = "EPDM 60", inner = m, wall = m}
function materials.tube(options)
  if type(options) ~= "table" then error("materials.tube: got " .. type(options) .. ", expected {material =, inner =, wall =}", 2) end
  for key in pairs(options) do
    if key ~= "material" and key ~= "inner" and key ~= "wall" then
      error("materials.tube: unknown option '" .. tostring(key) .. "' (options: material, inner, wall)", 2)
    end
  end
  local rubber = options.material ~= nil and entries[options.material]
  if not rubber or rubber.kind ~= "rubber" then
    error("materials.tube: 'material' is " .. tostring(options.material) .. ", expected one of materials.list(\"rubber\")", 2)
  end
  local entry = tube_entry(rubber, check_length(options, "inner"), check_length(options, "wall"))
  entry.make = tube_makers
  return setmetatable(entry, entry_meta)
end

for _, row in ipairs{{"EPDM 60", 8, 3}, {"EPDM 60", 16, 4}, {"EPDM 60", 20, 4}, {"EPDM 60", 32, 4.5}, {"silicone 60", 8, 3}, {"silicone 60", 16, 4},
                     {"silicone 60", 32, 4.5}, {"TPU 55D", 4, 1}, {"TPU 55D", 5.5, 1.25}, {"TPU 55D", 8, 2}, {"TPU 82A", 10, 2}, {"TPU 82A", 19, 3}} do
  add(tube_entry(entries[row[1]], row[2] * mm, row[3] * mm), tube_makers)
end

-- Names -----------------------------------------------------------------------------------------------------------------

local kinds = {"wire", "cable", "conduit", "hose", "rubber"}

--- Names of one kind, or of all, in the order of this file.
function materials.list(kind)
  local known = kind == nil
  for _, name in ipairs(kinds) do known = known or name == kind end
  if not known then
    error("materials.list: unknown kind '" .. tostring(kind) .. "' (kinds: " .. table.concat(kinds, ", ") .. ")", 2)
  end
  local names = {}
  for _, name in ipairs(order) do
    if kind == nil or entries[name].kind == kind then names[#names + 1] = name end
  end
  return names
end

--- Smallest number of characters inserted, deleted or replaced.
local function edits(a, b)
  local row = {}
  for j = 0, #b do row[j] = j end
  for i = 1, #a do
    local diagonal = row[0]
    row[0] = i
    for j = 1, #b do
      local above = row[j]
      row[j] = math.min(above + 1, row[j - 1] + 1, diagonal + (a:byte(i) == b:byte(j) and 0 or 1))
      diagonal = above
    end
  end
  return row[#b]
end

local function nearest(wanted)
  local best, least = nil, math.huge
  for _, name in ipairs(order) do
    local distance = edits(wanted:lower(), name:lower())
    if distance < least then best, least = name, distance end
  end
  return best
end

return setmetatable(materials, {
  __index = function(_, name)
    if type(name) ~= "string" then return nil end
    local entry = entries[name]
    if not entry then
      error(string.format("materials: unknown name '%s'; did you mean '%s'? (materials.list() names all)", name:sub(1, 40),
        nearest(name:sub(1, 40))), 2)
    end
    return entry
  end,
  __tostring = function() return "materials: " .. table.concat(order, ", ") end,
})
