-- Scenes, equilibria and motions in files of other programs, read back.
local check = require "check"
local out = check.folder()
local mm = units.mm

local rubber = rod.material{young = 5e6, poisson = 0.4, density = 1100}
local hose = rod.new{length = 1, section = rod.section{outer = 20*mm, material = rubber}, segments = 40}

local function world()
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:obstacle("block", scene.box{size = {0.3, 0.2, 0.1}}, {pose = frame{at = {0.4, 0.5, 0}, along = {0, 0, 1}}})
  s:rod("hose", hose, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.9, 0, 0}, along = {1, 0, 0}}})
  return s
end

local function content(path)
  local file = assert(io.open(path, "rb"))
  local bytes = file:read("a")
  file:close()
  return bytes
end

--- The tube's volume: its section times its settled length, less what 16 sides cut off.
local function tube_volume(eq)
  return 8 * math.sin(math.pi / 8) * (10*mm)^2 * eq:rod("hose").length
end

check.case("a scene in every format, read back", function()
  local s = world()
  local eq = s:solve{}
  check.equal(eq.ok, true)
  local expected = tube_volume(eq) + 0.006
  for _, suffix in ipairs{"glb", "stl", "ply", "obj"} do
    local path = out .. "/scene." .. suffix
    local saved = s:export(path, {equilibrium = eq})
    check.equal(saved.ok, true)
    check.near(scene.mesh(path, {unit = "m"}).volume, expected, 2e-3 * expected, suffix)
  end
  check.contains(content(out .. "/scene.obj"), "\ng hose\n", "\ng block\n")
  check.contains(content(out .. "/scene.glb"), '"name":"hose"', '"name":"block"', '"alphaMode":"BLEND"')
  s:export(out .. "/mm.stl", {equilibrium = eq, unit = "mm", obstacles = false})
  check.near(scene.mesh(out .. "/mm.stl", {unit = "mm"}).volume, tube_volume(eq), 2e-3 * tube_volume(eq))
  s:export(out .. "/fine.stl", {equilibrium = eq, obstacles = false, tolerance = 1e-6})
  local round = math.pi * (10*mm)^2 * eq:rod("hose").length
  check.near(scene.mesh(out .. "/fine.stl", {unit = "m"}).volume, round, 1e-3 * round)
  s:export(out .. "/block.ply", {rods = false})
  check.near(scene.mesh(out .. "/block.ply", {unit = "m"}).volume, 0.006, 1e-9)
end)

check.case("an equilibrium as text and as surfaces", function()
  local s = world()
  local eq = s:solve{}
  eq:save(out .. "/rods.csv")
  local rows = {}
  for line in content(out .. "/rods.csv"):gmatch("[^\n]+") do rows[#rows + 1] = line end
  check.equal(rows[1], "rod,s (m),x (m),y (m),z (m),tangent x,tangent y,tangent z,bend radius (m),tension (N)")
  check.equal(#rows, 1 + #eq:rod("hose").points)
  local name, x, y, z = rows[21]:match("^(%w+),[^,]+,([^,]+),([^,]+),([^,]+),")
  check.equal(name, "hose")
  check.equal(vec(tonumber(x), tonumber(y), tonumber(z)), eq:rod("hose").points[20])
  eq:save(out .. "/hose.stl", {obstacles = false, unit = "mm"})
  check.near(scene.mesh(out .. "/hose.stl", {unit = "mm"}).volume, tube_volume(eq), 2e-3 * tube_volume(eq))
  check.raises(function() eq:save(out .. "/rods.csv", {unit = "mm"}) end, "equilibrium:save", "always in SI units")
end)

check.case("a motion as an animation", function()
  local s = world()
  local m = s:motion{steps = 6, holds = {["hose.finish"] = function(t) return frame{at = {0.9 - 0.2 * t, 0.1 * t, 0}, along = {1, 0, 0}} end}}
  check.equal(m.ok, true)
  m:save(out .. "/motion.glb", {seconds = 3})
  check.contains(content(out .. "/motion.glb"), '"animations"', '"skins"', '"max":[3]', '"hose.section_1"')
  -- Readers that know no animation see its beginning.
  local volume = tube_volume(m.equilibria[1]) + 0.006
  check.near(scene.mesh(out .. "/motion.glb", {unit = "m"}).volume, volume, 2e-3 * volume)
  check.raises(function() m:save(out .. "/motion.stl") end, "motion:save", "ends in .glb")
end)

check.case("a robot's motion: links move, the hose bends", function()
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:robot("arm", robot.load("builtin:six_axis"))
  s:rod("hose", rod.new{length = 1.6, section = rod.section{outer = 30*mm, inner = 20*mm, material = rubber}, segments = 16})
  s:attach("hose", "start", "arm", "link_2", frame{at = {0.05, 0.2, 0.75}, along = {1, 0, 1}})
  s:attach("hose", "finish", "arm", "link_6", frame{at = {0.05, 0, 0.15}, along = {1, 0, 0}})
  local m = s:motion{robot = "arm", path = {{0, 0, 0, 0, 0, 0}, {0.5, 0.1, -0.3, 0.3, 0.2, 0.2}}, steps = 8}
  check.equal(m.ok, true)
  m:save(out .. "/robot.glb", {obstacles = false})
  check.contains(content(out .. "/robot.glb"), '"name":"arm.link_6"', '"path":"rotation"', '"skins"')
end)

check.case("an installation as an animation, with its connectors", function()
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:obstacle("post", scene.cylinder{radius = 30*mm, length = 0.4}, {pose = frame{at = {0, 0.06, 0}, along = {0, 0, 1}}})
  local short = rod.new{length = 0.5, section = rod.section{outer = 16*mm, inner = 10*mm, material = rubber}, segments = 20}
  s:rod("hose", short, {from = frame{at = {-0.22, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.22, 0, 0}, along = {1, 0, 0}}})
  local a = method.assembly(s, {optimise = false, connectors = {{name = "plug", rod = "hose", at = "finish", size = {20*mm, 20*mm, 20*mm}}}})
  check.equal(a.ok, true)
  a:save(out .. "/way_in.glb")
  check.contains(content(out .. "/way_in.glb"), '"animations"', '"name":"plug"', '"name":"post"')
  check.raises(function() a:save(out .. "/way_in.obj") end, "assembly:save", ".csv, .json or .glb")
end)

check.case("what cannot be written says so", function()
  local s = world()
  check.raises(function() s:export(out .. "/a.glb") end, "scene:export", "rods have no shape without an equilibrium", "equilibrium = s:solve()")
  local eq = s:solve{}
  check.raises(function() s:export(out .. "/a.step", {equilibrium = eq}) end, "'.step' are not written")
  check.raises(function() s:export(out .. "/a.glb", {equilibrium = eq, unit = "mm"}) end, "glTF files are in metres")
  s:rod("other", hose, {from = frame{at = {0, 1, 0}, along = {1, 0, 0}}})
  check.raises(function() s:export(out .. "/a.glb", {equilibrium = eq}) end, "the equilibrium lacks rod 'other'")
  check.raises(function() scene.new{}:export(out .. "/a.glb") end, "there is nothing to write")
end)

check.finish()
