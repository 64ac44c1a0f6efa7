-- The vent hose of the cooling circuit, from the radiator's upper stub across the engine to the expansion tank: a hose by the
-- metre, straight without load, which gravity bends. How long must it be, and what does more clearance cost?
--
--   scripts/run scripts/studies/route_cooler_hose.lua            the fine engine bay, over a million triangles
--   scripts/run scripts/studies/route_cooler_hose.lua light      its light form
-- Further arguments: assets=FOLDER where engine_bay.ply lies, out=FOLDER for pictures.
local mm, MPa = units.mm, units.MPa

local here = arg[0]:match("^(.*)/") or "."
local given = {assets = here .. "/../../build/assets", out = "out", form = ""}
for _, a in ipairs(arg) do
  local key, value = a:match("^(%w+)=(.+)$")
  if a == "light" then given.form = "_light"
  elseif a ~= "fine" and not (key and given[key]) then error("unknown argument '" .. a .. "'; known: light, fine, assets=FOLDER, out=FOLDER", 0)
  elseif key then given[key] = value end
end

local bay = scene.new{gravity = {0, 0, -9.81}}
bay:obstacle("bay", given.assets .. "/engine_bay" .. given.form .. ".ply", {unit = "mm"})
bay:obstacle("exhaust", given.assets .. "/engine_bay" .. given.form .. "_exhaust.ply", {unit = "mm", clearance = 60*mm})

local outer, inner, coolant = 18*mm, 11*mm, 1060
local rubber = rod.material{young = 9*MPa, poisson = 0.49, density = 1200 + coolant * inner^2 / (outer^2 - inner^2)}
local demands = {
  from = frame{at = {0.326, 0.190, 0.500}, along = {0, 1, 0}},
  to = frame{at = {1.152, 0.380, 0.446}, along = {1, 0, 0}},
  section = rod.section{outer = outer, inner = inner, material = rubber},
  min_bend_radius = 60*mm, min_straight = 0, clearance = 5*mm, free_ends = 40*mm,
}
local function with(t) for k, v in pairs(demands) do if t[k] == nil then t[k] = v end end return t end

-- Alternatives by weight (figure 3.3a of the thesis): nominal routes, before gravity.
local weights = {{length = 1, clearance = 0}, {length = 1, clearance = 1}, {length = 1, clearance = 4}, {length = 1, clearance = 16}}
local nominal = method.route(bay, with{weights = weights, refine = false})
print(nominal)
assert(nominal.ok, nominal.message)
view.new{bay, nominal, title = "Vent hose: nominal routes by weight of clearance"}:save(given.out .. "/route_cooler_hose_nominal.png")

-- In equilibrium: the length is adjusted, and clips are added where nothing else helps.
local routes = method.route(bay, with{weights = weights, clips = 4})
print(routes)
for i, route in ipairs(routes) do print(route) print(route.refined) end
assert(routes.ok, routes.message)
local best = routes[1]
view.new{bay, best.equilibrium, color = "clearance", title = "Vent hose, settled"}:save(given.out .. "/route_cooler_hose.png", {fit = "route"})

-- What clearance costs: length over smallest gap.
local x, y = {}, {}
for i, route in ipairs(routes) do
  if route.ok then x[#x + 1], y[#y + 1] = route.refined.clearance.value / mm, route.length / mm end
end
study.chart{kind = "scatter", title = "Vent hose: what clearance costs", x_label = "smallest gap in equilibrium [mm]", y_label = "length [mm]",
            series = {{name = "routes", x = x, y = y}}}:save(given.out .. "/route_cooler_hose_front.png")
