-- Runs in an installed program, from / and with nothing in the environment: every part that lies in a file of its own is asked for.
local out = ...
local mm, MPa = units.mm, units.MPa
local share = study.assets():match("^(.*)/assets$")
assert(share and share:match("/share/tendril$"), "the assets are those of another place: " .. study.assets())

-- Modules in Lua: the folder that came with the program.
local annotations = package.searchpath("meta/tendril", package.path)
assert(annotations == share .. "/lua/meta/tendril.lua", annotations)
assert(require "probe" == "found")  -- put there by the test

-- A harness in a format of the industry.
assert(scene.import("builtin:t_harness", {gravity = {0, 0, -9.81}}):solve().ok)

-- A robot, which may touch itself.
local arm = robot.load("builtin:six_axis")
assert(#arm.joints == 6)
local touching = arm:collides({0, 0, 0, 0, 0, 0})
assert(#touching == 0)

-- A hose over a mesh that went out to binary glTF and came back.
local s = scene.new{gravity = {0, 0, -9.81}}
local rim, sides = {}, {}
for k = 0, 23 do
  local angle = 2 * math.pi * k / 24
  for _, along in ipairs{-0.2, 0.2} do rim[#rim + 1] = {40*mm * math.cos(angle), 40*mm * math.sin(angle), along} end
  local a, b, c, d = 2*k + 1, 2*k + 2, (2*k + 2) % 48 + 1, (2*k + 3) % 48 + 1
  table.move({{a, c, d}, {a, d, b}}, 1, 2, #sides + 1, sides)
end
local pipe = scene.mesh({points = rim, triangles = sides})
pipe:save(out .. "/pipe.glb")
local again = scene.mesh(out .. "/pipe.glb", {unit = "m"})
assert(#again.triangles == 48)
s:obstacle("pipe", again, {pose = frame{at = {0.25, 0, -0.15}, along = {0, 1, 0}}})
local hose = rod.new{length = 0.7, segments = 40,
  section = rod.section{outer = 18*mm, inner = 10*mm, material = rod.material{young = 6*MPa, poisson = 0.49, density = 1150}}}
s:rod("hose", hose, {from = frame{at = {0, 0, 0}, along = {1, 0, -1}}, to = frame{at = {0.6, 0, 0}, along = {1, 0, 1}}})
local eq = s:solve()
assert(eq.ok and #eq.contacts > 0, eq.message)

-- A picture, charts, a study in threads with its store.
assert(view.new{s, eq}:save(out .. "/hose.png", {size = {320, 240}}).ok)
assert(study.chart{series = {{name = "sag", x = {1, 2, 3}, y = {1, 4, 9}}}}:save(out .. "/sag.png").ok)
local v = method.variation(s, {vary = {["hose.length"] = 10*mm}, measure = {"hose.min_bend_radius"}, outcomes = 32, store = out .. "/outcomes.sqlite"})
assert(v.ok, v.message)
print("installed: all parts found")
