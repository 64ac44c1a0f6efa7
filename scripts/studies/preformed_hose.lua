-- A preformed coolant hose for the heater. Which ways could it take from the radiator, and what would each ask of the bending
-- machine? Then, with that hose chosen, a vacuum hose from the front to the firewall, which should run beside it.
--
--   scripts/run scripts/studies/preformed_hose.lua            the fine engine bay, over a million triangles
--   scripts/run scripts/studies/preformed_hose.lua light      its light form
-- Further arguments: assets=FOLDER where engine_bay.ply lies, out=FOLDER for pictures and tables.
local mm, deg, MPa = units.mm, units.deg, units.MPa

local given = {assets = study.assets(), out = "out", form = ""}
for _, a in ipairs(arg) do
  local key, value = a:match("^(%w+)=(.+)$")
  if a == "light" then given.form = "_light"
  elseif a ~= "fine" and not (key and given[key]) then error("unknown argument '" .. a .. "'; known: light, fine, assets=FOLDER, out=FOLDER", 0)
  elseif key then given[key] = value end
end

-- The surroundings: the whole bay, and its hot parts once more under a name of their own, with the gap that they ask for.
local bay = scene.new{gravity = {0, 0, -9.81}}
bay:obstacle("bay", given.assets .. "/engine_bay" .. given.form .. ".ply", {unit = "mm"})
bay:obstacle("exhaust", given.assets .. "/engine_bay" .. given.form .. "_exhaust.ply", {unit = "mm", clearance = 60*mm})

-- Moulded rubber of 23 x 16 mm, full of coolant.
local outer, inner, coolant = 23*mm, 16*mm, 1060
local rubber = rod.material{young = 6*MPa, poisson = 0.49, density = 1150 + coolant * inner^2 / (outer^2 - inner^2)}
local demands = {
  section = rod.section{outer = outer, inner = inner, material = rubber},
  min_bend_radius = 45*mm, min_straight = 15*mm, clearance = 8*mm, free_ends = 40*mm, max_bends = 6,
}
local function with(t) for k, v in pairs(demands) do t[k] = v end return t end

-- The feed: from the radiator's upper stub to the heater's inlet.
local feed = method.preform(bay, with{
  from = frame{at = {0.326, 0.190, 0.500}, along = {0, 1, 0}},
  to = frame{at = {0.478, 0.814, 0.440}, along = {0, 1, 0}},
})
print(feed:report())
assert(feed.ok, feed.message)

-- How much of the thesis's assumption holds: a preformed hose hardly moves under its weight.
print("\nhose   moved by gravity   by its weight of")
for i, hose in ipairs(feed) do
  local moved = hose:settle()
  print(("%4d   %10.1f mm %s   %8.2f N"):format(i, moved.value / mm, moved.ok and "" or moved.equilibrium.message, 9.81 * hose.rod.mass))
end

local function picture(name, shown, options)
  options.size = options.size or {1600, 1200}
  view.new{bay, shown, title = options.title, ghost = {"bay", "exhaust"}}:save(given.out .. "/" .. name .. ".png", {size = options.size, sheet = options.sheet})
end
picture("preformed_hose", feed, {title = "Feed to the heater: alternatives"})
for i = 1, math.min(#feed, 3) do
  picture("preformed_hose_" .. i, feed[i], {title = "Feed to the heater, hose " .. i})
end
local chosen = feed[1]
chosen:save(given.out .. "/heater_feed_lra.csv", {table = "LRA"})
chosen:save(given.out .. "/heater_feed_xyz.csv", {table = "XYZ"})
chosen:save(given.out .. "/heater_feed_centre_line.csv", {table = "centre_line"})
chosen:save(given.out .. "/heater_feed.stl", {unit = "mm"})
chosen:save(given.out .. "/heater_feed.glb")

-- A thinner hose runs beside it: the feed is an obstacle now, one to keep near. Distances that are known stay known.
bay:obstacle("feed", chosen.mesh, {prefer = "near", clearance = 10*mm})
local beside = method.preform(bay, with{
  from = frame{at = {0.360, 0.235, 0.560}, along = {0, 1, 0}},
  to = frame{at = {0.400, 0.740, 0.500}, along = {0, 1, 0}},
  section = rod.section{outer = 14*mm, inner = 8*mm, material = rubber}, free_ends = 0,
  preference = 2, preference_range = 80*mm,
})
print("\n" .. tostring(beside))
assert(beside.ok, beside.message)
picture("preformed_hose_beside", beside, {title = "Vacuum hose beside the heater's feed"})
print("\nstep of the first and of the second search, in ms")
for i, step in ipairs(feed.steps) do print(("%-20s %8.1f %8.1f"):format(step.name, step.seconds * 1e3, beside.steps[i].seconds * 1e3)) end
