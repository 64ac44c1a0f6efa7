-- Three cooler hoses that meet in a T. Lengths vary by 50 mm, the connections' directions within cones of 15 degrees: where can the
-- hoses be, how likely do they come too near to what is around, and which tolerance is to blame?
--
--   scripts/run scripts/studies/t_junction_variation.lua
-- Arguments: quick (fewer outcomes), out=FOLDER for the pictures, store=FILE to keep the outcomes.
local mm, deg, MPa = units.mm, units.deg, units.MPa

local given = {out = "out", store = ""}
local quick = false
for _, a in ipairs(arg) do
  local key, value = a:match("^(%w+)=(.+)$")
  if a == "quick" then quick = true
  elseif not (key and given[key]) then error("unknown argument '" .. a .. "'; known: quick, out=FOLDER, store=FILE", 0)
  else given[key] = value end
end
local outcomes = quick and 200 or 1000
local required = 8 * mm

-- The surroundings: a cooler's tank below, a pipe that crosses, a bracket beside.
local bay = scene.new{gravity = {0, 0, -9.81}}
bay:obstacle("tank", scene.box{size = {0.30, 0.16, 0.10}}, {pose = frame{at = {0.43, -0.15, -0.28}, along = {0, 0, 1}}, clearance = required})
bay:obstacle("pipe", scene.cylinder{radius = 15 * mm, length = 0.5}, {pose = frame{at = {0.66, 0.05, 0.075}, along = {0.2, 1, 0}}, clearance = required})
bay:obstacle("bracket", scene.box{size = {0.02, 0.12, 0.16}}, {pose = frame{at = {0.335, 0.25, -0.12}, along = {0, 0, 1}}, clearance = required})

-- Rubber hoses of 26 x 18 mm, half a metre each, filled with coolant.
local outer, inner, coolant = 26 * mm, 18 * mm, 1060
local rubber = rod.material{young = 5 * MPa, poisson = 0.49, density = 1150 + coolant * inner^2 / (outer^2 - inner^2)}
local hose = rod.new{length = 0.5, segments = 10, section = rod.section{outer = outer, inner = inner, material = rubber}}

-- The T: two arms in line and one square to them, each 15 mm long from the middle.
local middle = frame{at = {0.45, 0, -0.03}, along = {1, 0, 0}}
bay:rod("radiator", hose, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = middle:moved{by = {-15 * mm, 0, 0}}})
bay:rod("engine", hose, {from = middle:moved{by = {15 * mm, 0, 0}}, to = frame{at = {0.86, 0.10, 0.10}, along = {1, 0, 0}}})
bay:rod("heater", hose, {from = frame{at = middle.at + vec(0, 15 * mm, 0), along = {0, 1, 0}}, to = frame{at = {0.42, 0.50, -0.15}, along = {0, 1, 0}}})
bay:branch("tee", {{"radiator", "finish"}, {"engine", "start"}, {"heater", "start"}})

local eq = bay:solve{error = true}
print(eq)
assert(eq.ok, eq.message)

-- How the design answers to each number, to first order.
local stability = method.stability(bay, {
  vary = {["radiator.length"] = 50 * mm, ["engine.length"] = 50 * mm, ["heater.length"] = 50 * mm,
          ["radiator.from.turn.y"] = 15 * deg, ["engine.to.turn.y"] = 15 * deg, ["heater.to.turn.x"] = 15 * deg},
  measure = {"engine.min_bend_radius", "heater.min_bend_radius", "tee.place.z"}})
print(stability)
view.new{bay, eq, color = stability, title = "How far tolerances move the hoses, to first order"}
  :save(given.out .. "/t_junction_stability.png", {sheet = {"iso", "front", "top", "card"}})

-- All tolerances together.
local lengths, cones, all = {}, {}, {}
for _, name in ipairs{"radiator", "engine", "heater"} do
  lengths[name .. ".length"] = {tolerance = 50 * mm, spread = "uniform"}
  cones[name .. (name == "radiator" and ".from" or ".to")] = {cone = 15 * deg}
end
for _, part in ipairs{lengths, cones} do for name, how in pairs(part) do all[name] = how end end

local variation = method.variation(bay, {
  vary = all, outcomes = outcomes, seed = 7, effects = quick and 0 or 250, store = given.store ~= "" and given.store or nil,
  measure = {"engine.min_bend_radius", "heater.min_bend_radius", pipe = {rod = "engine", what = "clearance", to = "pipe"},
             tank = {rod = "radiator", what = "clearance", to = "tank"}, bracket = {rod = "heater", what = "clearance", to = "bracket"}}})
print(variation:report())
for _, name in ipairs{"pipe", "tank", "bracket"} do
  local below = variation[name]:below(required)
  print(("%-8s nearer than %.0f mm in %.1f %% of the outcomes (95 %%: %.1f ... %.1f %%)"):format(name, required / mm,
    100 * below.value, 100 * below.low, 100 * below.high))
end
variation:save(given.out .. "/t_junction_outcomes.csv")
study.sheet{
  variation.pipe:histogram{title = "Gap between engine hose and pipe", limit = required},
  variation.tank:histogram{title = "Gap between radiator hose and tank", limit = required},
  variation.pipe:scatter("engine.length"), variation.tank:scatter("radiator.length"),
  title = outcomes .. " outcomes of three hoses in a T", columns = 2,
}:save(given.out .. "/t_junction_charts.png")

-- The space that each kind of tolerance needs by itself.
for _, part in ipairs{{"lengths", lengths, "lengths within 50 mm"}, {"cones", cones, "cones of 15 degrees"}} do
  local name, vary, words = table.unpack(part)
  local mesh, about = method.variation(bay, {vary = vary, outcomes = outcomes, seed = 7}):envelope{resolution = 2 * mm}
  print("envelope of " .. words)
  print(about)
  assert(mesh.watertight)
  mesh:save(given.out .. "/t_junction_" .. name .. ".stl", {unit = "mm"})
  view.new{bay, eq, envelope = mesh, title = "Tolerance envelope: " .. words}
    :save(given.out .. "/t_junction_" .. name .. ".png", {sheet = {"iso", "front", "top", "card"}})
end

-- What the sampling's error costs: half the width of the mean's interval against seconds, for three ways to draw.
local series, counts = {}, quick and {64, 128, 256} or {128, 256, 512, 1024, 2048, 4096, 8192}
for i, sampling in ipairs{"random", "latin", "sobol"} do
  local x, y = {}, {}
  for k, count in ipairs(counts) do
    local v = method.variation(bay, {vary = all, outcomes = count, seed = 3, sampling = sampling, measure = {"engine.min_bend_radius"}})
    local mean = v["engine.min_bend_radius"].mean
    x[k], y[k] = v.seconds / 1e-3, (mean.high - mean.low) / 2 / mm
    print(("%-7s %5d outcomes  %8.2f ms  mean %.3f +- %.4f mm"):format(sampling, count, x[k], mean.value / mm, y[k]))
  end
  series[i] = {name = sampling, x = x, y = y}
end
study.chart{title = "Mean of the engine hose's smallest bend radius: error against time", x_label = "time [ms]",
  y_label = "half width of the 95 % interval [mm]", log_x = true, log_y = true, series = series}:save(given.out .. "/t_junction_sampling.png")
