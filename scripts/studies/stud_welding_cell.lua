-- Stud welding: a robot with a hose from its forearm housing to its hand, four weld places around a door frame. On the way from the
-- first place to the second the hose is caught by a post; the two others are easy. Each way is simulated, optimised and written as a
-- program.
--
--   scripts/run scripts/studies/stud_welding_cell.lua              pictures of 1600 x 1200, 120 time steps
--   scripts/run scripts/studies/stud_welding_cell.lua quick        fewer steps
-- Further arguments: out=FOLDER for pictures and programs.
local mm, MPa, deg = units.mm, units.MPa, units.deg

local given = {out = "out", steps = 120}
for _, a in ipairs(arg) do
  local folder = a:match("^out=(.+)$")
  if a == "quick" then given.steps = 40
  elseif folder then given.out = folder
  else error("unknown argument '" .. a .. "'; known: quick, out=FOLDER", 0) end
end

local bot = robot.load("builtin:six_axis")
local conduit = rod.material{young = 30 * MPa, poisson = 0.4, density = 1200}
local hose = rod.new{length = 1.9, section = rod.section{outer = 50 * mm, inner = 36 * mm, material = conduit}, segments = 24}

local cell = scene.new{gravity = {0, 0, -9.81}}
local function beam(name, from, to)
  local a, b = vec(table.unpack(from)), vec(table.unpack(to))
  local upright = math.abs((b - a):unit().z) > 0.5
  cell:obstacle(name, scene.box{size = {60 * mm, 60 * mm, (b - a):length() + 60 * mm}},
                {pose = frame{at = (a + b) / 2, along = b - a, up = upright and {1, 0, 0} or {0, 0, 1}}})
end
beam("left post", {1.85, 0.45, 0.4}, {1.85, 0.45, 1.5})
beam("right post", {1.85, -0.55, 0.4}, {1.85, -0.55, 1.5})
beam("lintel", {1.85, 0.45, 1.5}, {1.85, -0.55, 1.5})
beam("sill", {1.85, 0.45, 0.4}, {1.85, -0.55, 0.4})
cell:obstacle("floor", scene.plane{}, {pose = frame{at = {0, 0, 0}, along = {0, 0, 1}}})

cell:robot("welder", bot, {joints = {0, 0, 0, 0, 30 * deg, 0}})
cell:rod("hose", hose)
cell:attach("hose", "start", "welder", "link_3", frame{at = {0, 0, 0.50}, along = {1, 0, 1.4}})
cell:attach("hose", "finish", "welder", "link_6", frame{at = {0.22, 0, 0.10}, along = {-1, 0, 1}, up = {0, 1, 0}})

--- Joint values of a weld place: of all that inverse kinematics knows those nearest to what the programmer took, in degrees.
local function weld(place, taken)
  for k = 1, 6 do taken[k] = taken[k] * deg end
  local all, why = bot:reaches(place, {link = "flange", near = taken})
  assert(all, why)
  return all[1]
end
local places = {
  weld(frame{at = {1.75, 0.20, 0.90}, along = {0, 1, 0}, up = {0, 0, -1}}, {0, 32, 20, -90, -90, 38}),    -- the left post from within
  weld(frame{at = {1.55, 0.45, 1.15}, along = {1, 0, 0}, up = {0, 0, -1}}, {18, 8, 37, 25, -48, -17}),    -- and from the front,
  weld(frame{at = {1.55, -0.55, 1.15}, along = {1, 0, 0}, up = {0, 0, -1}}, {-22, 9, 35, -30, -49, 21}),  -- the right post,
  weld(frame{at = {1.60, 0.00, 0.90}, along = {1, 0, 0}, up = {0, 0, -1}}, {0, 17, 42, 0, -59, 0}),       -- the sill
}

local limits = {max_tension = 130, min_bend_radius = 110 * mm, clearance = 15 * mm, robot_clearance = 10 * mm, via = 8, seconds = 2.5, checked_steps = given.steps}

--- One way: before and after, in numbers, charts and pictures.
local function way(number, from, to)
  local wish = {path = {places[from], places[to]}}
  for key, value in pairs(limits) do wish[key] = value end
  local r = method.dress_pack(cell, wish)
  local name = ("%s/stud_welding_%d"):format(given.out, number)
  print(("\nway %d, from place %d to place %d"):format(number, from, to))
  print(r)
  for _, unmet in ipairs(r.unmet_before) do print("given path: " .. unmet.text) end
  for _, step in ipairs(r.steps) do print(step) end
  r:chart{title = ("Way %d: what the hose bears"):format(number)}:save(name .. "_chart.png")
  local file = assert(io.open(name .. ".mod", "w"))
  file:write(r:program("rapid", {name = ("way%d"):format(number), speed = 0.4, zone = 10 * mm}))
  file:close()
  return r, name
end

for number = 1, 3 do
  local r, name = way(number, number, number + 1)
  assert(r.ok, r.message)
  if number == 1 then
    assert(not r.before.ok or r.before.max_tension > 2 * r.after.max_tension, "the hose is not spared")
    local fit = {"hose", "left post"}
    for _, when in ipairs{"before", "after"} do
      local motion = r[when]:motion{states = 6}
      view.new{cell, motion, color = "tension", title = "Way 1, " .. (when == "before" and "given path" or "optimised path")}
        :save(("%s_%s.png"):format(name, when), {fit = fit, frames = 6})
    end
    local swept = r.after:motion{states = given.steps}
    view.new{cell, swept, envelope = (swept:envelope{resolution = 10 * mm}), title = "What the hose sweeps on way 1"}:save(name .. "_sweep.png", {fit = fit, frames = 4})
  end
end
