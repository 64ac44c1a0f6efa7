-- Can it be installed, and how? A hose past a post and through a ring; then the ignition harness of the engine bay, nine rods with
-- six connectors: its coupling, four ignition coils, the throttle's sensor.
--
--   scripts/run scripts/studies/install_harness.lua              the fine engine bay, over a million triangles
--   scripts/run scripts/studies/install_harness.lua light        its light form
-- Further arguments: assets=FOLDER where engine_bay.ply lies, out=FOLDER for pictures and files.
local mm, MPa = units.mm, units.MPa

local given = {assets = study.assets(), out = "out", form = ""}
for _, a in ipairs(arg) do
  local key, value = a:match("^(%w+)=(.+)$")
  if a == "light" then given.form = "_light"
  elseif a ~= "fine" and not (key and given[key]) then error("unknown argument '" .. a .. "'; known: light, fine, assets=FOLDER, out=FOLDER", 0)
  elseif key then given[key] = value end
end

--- Prints how it went, writes pictures, chart and paths, and says when hands get free.
local function report(a, name, title, fit)
  print(a)
  print(a.paths)
  for i, attempt in ipairs(a.attempts) do print(("attempt %d: %s"):format(i, attempt)) end
  for _, step in ipairs(a.steps) do print(step) end
  assert(a.ok, a.message)
  local hands = {}
  for i = 0, 1000 do
    local now = a:hands_at(i / 1000)
    if i == 0 or now ~= a:hands_at((i - 1) / 1000) then hands[#hands + 1] = ("%d from t = %.3f"):format(now, i / 1000) end
  end
  print("hands: " .. table.concat(hands, ", "))
  view.new{a, title = title}:save(("%s/%s.png"):format(given.out, name), {frames = 5, size = {1600, 1200}, sheet = {"iso", "front", "top", "card"}, fit = fit})
  a:chart{title = title}:save(("%s/%s_chart.png"):format(given.out, name))
  a:save(("%s/%s_paths.csv"):format(given.out, name))
  a:save(("%s/%s_paths.json"):format(given.out, name))
end

--- A ring of 24 straight bars about a rod where it lies.
local function ring(world, around, hole, wire)
  local sides, first, second = 24, around.up, around.along:cross(around.up)
  for k = 1, sides do
    local angle = 2 * math.pi * k / sides
    local out, along = first * math.cos(angle) + second * math.sin(angle), second * math.cos(angle) - first * math.sin(angle)
    world:obstacle("ring " .. k, scene.cylinder{radius = wire, length = 2.1 * (hole + wire) * math.tan(math.pi / sides)},
                   {pose = frame{at = around.at + out * (hole + wire), along = along}})
  end
end

-- The hose: past the post, and through a ring.
local rubber = rod.material{young = 6 * MPa, poisson = 0.49, density = 1150}
local yard = scene.new{gravity = {0, 0, -9.81}}
yard:obstacle("post", scene.cylinder{radius = 30 * mm, length = 0.3}, {pose = frame{at = {0.12, -0.005, 0.15}, along = {0, 0, 1}}})
yard:rod("hose", rod.new{length = 0.66, section = rod.section{outer = 16 * mm, inner = 10 * mm, material = rubber}, segments = 40},
         {from = frame{at = {-0.32, 0, 0.2}, along = {1, 0, 0}}, to = frame{at = {0.26, 0.10, 0.2}, along = {0.6, 0.8, 0}}})
local hangs = yard:solve{}
assert(hangs.ok, hangs.message)
ring(yard, hangs:rod("hose"):at(0.2), 34 * mm, 6 * mm)
local threaded = yard:solve{from = hangs}
assert(threaded.ok, threaded.message)
report(method.assembly(yard, {routed = threaded, optimise_seconds = 2}), "install_hose", "A hose past a post and through a ring")

-- The harness: PVC bundles, a lead of 13 mm, a trunk of 11 mm behind the valve cover, cables of 7 mm to the coils and the throttle.
local bundle = rod.material{young = 20 * MPa, poisson = 0.4, density = 1500}
local lead, trunk, twig = rod.section{outer = 13 * mm, material = bundle}, rod.section{outer = 11 * mm, material = bundle}, rod.section{outer = 7 * mm, material = bundle}

local tees = {}
for k = 1, 4 do tees[k] = frame{at = {0.51 + 0.11 * k, 0.614, 0.596}, along = {1, 0, 0}} end

--- The bay with the harness in it; `held`: its branch points are, where they belong.
local function harness(held)
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:obstacle("bay", given.assets .. "/engine_bay" .. given.form .. ".ply", {unit = "mm"})
  s:obstacle("coupling", scene.box{size = {40 * mm, 36 * mm, 30 * mm}}, {pose = frame{at = {0.380, 0.600, 0.500}, along = {0, 0, 1}}})
  s:obstacle("bracket", scene.box{size = {24 * mm, 3 * mm, 110 * mm}}, {pose = frame{at = {0.374, 0.6195, 0.460}, along = {0, 0, 1}}})
  local spine = {"lead", "trunk 1", "trunk 2", "trunk 3", "throttle cable"}
  s:rod("lead", rod.new{length = 0.236, section = lead, segments = 20}, {from = frame{at = {0.410, 0.600, 0.500}, along = {1, 0, 0}}, to = tees[1]})
  for k = 1, 3 do s:rod(spine[k + 1], rod.new{length = 0.11, section = trunk, segments = 10}, {from = tees[k], to = tees[k + 1]}) end
  s:rod("throttle cable", rod.new{length = 0.350, section = twig, segments = 32},
        {from = tees[4], to = frame{at = {1.030, 0.350, 0.532}, along = {-0.35, -1, -0.1}}})
  for k = 1, 4 do
    local coil = "coil cable " .. k
    s:rod(coil, rod.new{length = 0.0442, section = twig, segments = 10},
          {from = frame{at = tees[k].at, along = {0, -1, 0}}, to = frame{at = {0.51 + 0.11 * k, 0.570, 0.598}, along = {0, -1, 0}}})
    s:branch("tee " .. k, {{spine[k], "finish"}, {spine[k + 1], "start"}, {coil, "start"}}, held and {frame = tees[k]} or {})
  end
  return s
end

local bay = harness(false)
local routed = bay:solve{from = harness(true):solve{}}
print(routed)
assert(routed.ok, routed.message)

local function plug(name, of, at, size, ahead)
  return {name = name, rod = of, at = at, size = size, pose = frame{at = {0, 0, (at == "start" and 1 or -1) * (size[3] / 2 - ahead)}, along = {0, 0, 1}}}
end
local connectors = {
  plug("lead plug", "lead", "start", {30 * mm, 26 * mm, 30 * mm}, 11 * mm),
  plug("throttle plug", "throttle cable", "finish", {18 * mm, 18 * mm, 22 * mm}, 6 * mm),
}
for k = 1, 4 do connectors[k + 2] = plug("coil plug " .. k, "coil cable " .. k, "finish", {18 * mm, 24 * mm, 22 * mm}, 6 * mm) end

local installed = method.assembly(bay, {connectors = connectors, routed = routed, optimise = false})
report(installed, "install_harness", "The ignition harness in the engine bay", {"lead", "throttle cable"})

-- The same harness as it lies on the build board.
local board = method.flatten(harness(true), {})
print(board)
assert(board.ok, board.message)
view.new{board, color = {0.2, 0.4, 0.65}, title = "The ignition harness on its build board"}:save(given.out .. "/install_harness_board.png")
board:save(given.out .. "/install_harness_board.csv")
