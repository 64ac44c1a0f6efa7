-- Ten thousand scenes leave nothing behind: no memory, no open files.
local check = require "check"
package.path = "tests/soak/?.lua;" .. package.path
local process = require "process"
local mm = units.mm

local out = check.folder()
os.execute("mkdir -p '" .. out .. "'")
local mesh = out .. "/plate.obj"
local file = assert(io.open(mesh, "w"))
for x = 0, 4 do for y = 0, 4 do file:write(string.format("v %g %g %g\n", x, y, 0.1 * ((x + y) % 2))) end end
for x = 0, 3 do for y = 0, 3 do local a = 5 * x + y + 1 file:write(string.format("f %d %d %d %d\n", a, a + 5, a + 6, a + 1)) end end
file:close()

local section = rod.section{outer = 10 * mm, material = rod.material{young = 5e6, poisson = 0.4, density = 1100}}

local function one(k)
  local s = scene.new{gravity = {0, 0, -9.81}}
  if k % 2 == 0 then s:obstacle("ball", scene.sphere{radius = 0.1}, {pose = frame{at = {0.2, 0, -0.15}, along = {1, 0, 0}}})
  else s:obstacle("plate", mesh, {unit = "cm", pose = frame{at = {0.2, 0, -0.3}, along = {1, 0, 0}}}) end
  s:rod("hose", rod.new{length = 0.5, section = section, segments = 8},
        {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.42, 0, 0}, along = {1, 0, 0}}})
  local eq = s:solve{}
  assert(eq.ok, eq.message)
  return #eq:rod("hose").points
end

check.case("scenes, rods, obstacles and equilibria are given back", function()
  for k = 1, 1000 do one(k) end
  local memory, files, values = process.memory(), process.files(), collectgarbage("count")
  for k = 1, 10000 do one(k) end
  local grown = process.memory() - memory
  check.is_true(grown < 8 * 2 ^ 20, string.format("resident memory grows by less than 8 MB, grew by %.1f", grown / 2 ^ 20))
  check.equal(process.files(), files, "open files")
  check.is_true(collectgarbage("count") - values < 100, "Lua's own values stay the same")
end)

check.case("so are files that cannot be read and computations that fail", function()
  local function failing()
    check.is_true(not pcall(scene.mesh, out .. "/none.obj", {unit = "m"}))
    check.is_true(not pcall(robot.load, mesh))
    check.is_true(not pcall(study.motion, mesh))
    check.is_true(not pcall(rod.section, {outer = -1}))
  end
  for _ = 1, 100 do failing() end
  local memory, files = process.memory(), process.files()
  for _ = 1, 2000 do failing() end
  check.is_true(process.memory() - memory < 4 * 2 ^ 20, "resident memory grows by less than 4 MB")
  check.equal(process.files(), files, "open files")
end)

check.finish()
