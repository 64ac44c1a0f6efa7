-- A heater hose between the radiator's upper stub and the heater stub in the firewall, filled with coolant. It lies in
-- the trough on the gearbox. Does it keep its bend radius, and its distance from the exhaust?
--
--   scripts/run                                                   the fine engine bay, over a million triangles
--   scripts/run scripts/studies/hose_in_engine_bay.lua light      its light form
-- Further arguments: assets=FOLDER where engine_bay.ply lies, out=FOLDER for the pictures.
local mm, MPa = units.mm, units.MPa

local given = {assets = study.assets(), out = "out", form = ""}
for _, a in ipairs(arg) do
  local key, value = a:match("^(%w+)=(.+)$")
  if a == "light" then given.form = "_light"
  elseif a ~= "fine" and not (key and given[key]) then error("unknown argument '" .. a .. "'; known: light, fine, assets=FOLDER, out=FOLDER", 0)
  elseif key then given[key] = value end
end

-- What the design asks for.
local required = {bend_radius = 90 * mm, exhaust = 60 * mm, penetration = 0.2 * mm}

-- The surroundings: the whole bay, and its hot parts once more under a name of their own, with the gap they ask for.
local bay = scene.new{gravity = {0, 0, -9.81}}
bay:obstacle("bay", given.assets .. "/engine_bay" .. given.form .. ".ply", {unit = "mm"})
bay:obstacle("exhaust", given.assets .. "/engine_bay" .. given.form .. "_exhaust.ply", {unit = "mm", clearance = required.exhaust})

-- The hose: rubber of 23 x 16 mm. The coolant bends with it and weighs on it: its mass counts with the wall's.
local outer, inner, coolant = 23 * mm, 16 * mm, 1060
local rubber = rod.material{young = 6 * MPa, poisson = 0.49, density = 1150 + coolant * inner^2 / (outer^2 - inner^2)}
local hose = rod.new{length = 720 * mm, segments = 60, section = rod.section{outer = outer, inner = inner, material = rubber}}

-- Held where it leaves its clamps, 12 mm in front of the stubs.
local ends = {
  from = frame{at = {0.326, 0.190, 0.500}, along = {0, 1, 0}},
  to = frame{at = {0.478, 0.814, 0.440}, along = {0, 1, 0}},
}
bay:rod("hose", hose, ends)
print(bay)
print(bay:explain())

local eq = bay:solve{error = true}
print(eq)
assert(eq.ok, eq.message)

local settled, exhaust = eq:rod("hose"), eq:clearance{from = "hose", to = "exhaust"}
local function check(what, value, least)
  print(("%-32s %8.2f mm  required %6.1f mm  %s"):format(what, value / mm, least / mm, value >= least and "kept" or "VIOLATED"))
  return value >= least
end
local kept = check("smallest bend radius", settled.min_bend_radius, required.bend_radius)
kept = check("smallest gap to the exhaust", exhaust.value, required.exhaust) and kept
assert(eq.deepest_penetration <= required.penetration, "the hose is pressed too deep into the bay")

local weight = -bay.gravity.z * hose.length * hose.section.mass
local carried = 0
for _, c in ipairs(eq.contacts) do carried = carried + c.force.z end
print(("%-32s %8.2f N   of its weight of %.2f N"):format("carried by the bay", carried, weight))

local picture, chart = given.out .. "/hose_in_engine_bay.png", given.out .. "/hose_in_engine_bay_accuracy.png"
view.new{bay, eq, color = "clearance", ghost = {"bay"}, title = "Heater hose in the engine bay"}
  :save(picture, {size = {1600, 1200}, sheet = {"iso", "front", "top", "card"}, fit = "hose"})

-- Error against time: lying in the bay, and for comparison hanging free, with both elements.
local segments = {15, 30, 60, 120, 240}
local free = scene.new{gravity = {0, 0, -9.81}}
free:rod("hose", hose, ends)
local accuracies = {
  {"in the bay", study.accuracy(bay, {segments = segments})},
  {"free", study.accuracy(free, {segments = segments})},
  {"free, staggered element", study.accuracy(free, {segments = segments, element = "staggered"})},
}
local series = {}
for i, named in ipairs(accuracies) do
  local x, y = {}, {}
  for k, row in ipairs(named[2].rows) do x[k], y[k] = row.seconds / 1e-3, row.error / mm end
  series[i] = {name = named[1], x = x, y = y}
  print(named[1] .. ": " .. tostring(named[2]))
end
study.chart{
  title = "Heater hose of 15 to 240 segments: error against time", x_label = "time to solve [ms]",
  y_label = "largest error of the centre line [mm]", log_x = true, log_y = true, series = series,
}:save(chart)

print("pictures: " .. picture .. ", " .. chart)
if not kept then error("the design does not keep what is required", 0) end
