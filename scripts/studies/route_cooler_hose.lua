-- The vent hose of the cooling circuit, from the radiator's upper stub across the engine to the expansion tank: a moulded hose of
-- reinforced rubber that sags under its weight. Which shape should it be given, so that it keeps its distance and its bend radius
-- once it hangs, and what does more clearance cost?
--
--   scripts/run scripts/studies/route_cooler_hose.lua            the fine engine bay, over a million triangles
--   scripts/run scripts/studies/route_cooler_hose.lua light      its light form
-- Further arguments: assets=FOLDER where engine_bay.ply lies, out=FOLDER for pictures.
local mm, MPa = units.mm, units.MPa

local given = {assets = study.assets(), out = "out", form = ""}
for _, a in ipairs(arg) do
  local key, value = a:match("^(%w+)=(.+)$")
  if a == "light" then given.form = "_light"
  elseif a ~= "fine" and not (key and given[key]) then error("unknown argument '" .. a .. "'; known: light, fine, assets=FOLDER, out=FOLDER", 0)
  elseif key then given[key] = value end
end

local bay = scene.new{gravity = {0, 0, -9.81}}
bay:obstacle("bay", given.assets .. "/engine_bay" .. given.form .. ".ply", {unit = "mm"})
bay:obstacle("exhaust", given.assets .. "/engine_bay" .. given.form .. "_exhaust.ply", {unit = "mm", clearance = 60*mm})

local outer, inner, coolant = 16*mm, 10*mm, 1060
local rubber = rod.material{young = 80*MPa, poisson = 0.4, density = 1300 + coolant * inner^2 / (outer^2 - inner^2)}
local demands = {
  from = frame{at = {0.326, 0.190, 0.500}, along = {0, 1, 0}},
  to = frame{at = {1.105, 0.380, 0.450}, along = {1, 0, 0}},
  section = rod.section{outer = outer, inner = inner, material = rubber}, preformed = true,
  min_bend_radius = 55*mm, end_straight = 20*mm, clearance = 5*mm, free_ends = 25*mm,
}
local function with(t) for k, v in pairs(demands) do if t[k] == nil then t[k] = v end end return t end

-- Alternatives by weight (figure 3.3a of the thesis): nominal routes, before gravity.
local weights = {}
for _, w in ipairs(given.form == "" and {0, 0.5, 1, 2} or {0, 1}) do weights[#weights + 1] = {length = 1, clearance = w} end
local nominal = method.route(bay, with{weights = weights, refine = false})
print(nominal)
assert(nominal.ok, nominal.message)
view.new{bay, nominal, title = "Vent hose: nominal routes by weight of clearance"}:save(given.out .. "/route_cooler_hose_nominal.png")
nominal:chart{title = "Vent hose: what clearance costs"}:save(given.out .. "/route_cooler_hose_front.png")

-- In equilibrium under gravity. Where the hose sags too near or bends too sharply, it is routed again with something in reserve.
local routes = method.route(bay, with{weights = weights, restarts = 1})
print(routes)
for i, route in ipairs(routes) do print(route) print(route.refined) end
assert(routes.ok, routes.message)
local best = routes[1]
view.new{bay, best.equilibrium, color = "clearance", title = "Vent hose, settled under gravity"}:save(given.out .. "/route_cooler_hose.png", {fit = "route"})
-- Two cables by the metre after it, straight without load: each keeps clear of what was routed before it, on as few clips as hold it.
bay:obstacle("vent hose", best.mesh, {clip = false})
local cables = method.route_all(bay, {
  section = rod.section{outer = 9*mm, material = rod.material{young = 12*MPa, poisson = 0.4, density = 1900}},
  min_bend_radius = 40*mm, end_straight = 15*mm, clearance = 3*mm, free_ends = 30*mm, clips = 8, restarts = 1,
  {name = "fan cable", from = frame{at = {0.616, 0.219, 0.438}, along = {0, -1, 0}}, to = frame{at = {0.532, 0.752, 0.608}, along = {0, 1, 0}}},
  {name = "sensor cable", from = frame{at = {0.851, 0.731, 0.617}, along = {-1, 0, 0}}, to = frame{at = {0.329, 0.374, 0.599}, along = {0, 1, 0}}, apart = 5*mm}})
print(cables)
assert(cables.ok, cables.message)
local placed = cables:scene()
view.new{placed, placed:solve(), color = "clearance", title = "Two cables beside the vent hose"}:save(given.out .. "/route_cables.png", {fit = {"fan cable", "sensor cable", "vent hose"}})
