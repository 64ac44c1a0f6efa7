-- Scenes in files: saved, loaded, solved again to the same numbers.
local check = require "check"
local mm, MPa = units.mm, units.MPa
local folder = check.folder()

local function read(path)
  local file = assert(io.open(path, "rb"))
  local text = file:read("a")
  file:close()
  return text
end

local function write(path, text)
  local file = assert(io.open(path, "wb"))
  file:write(text)
  file:close()
end

local rubber = rod.material{young = 6*MPa, poisson = 0.49, density = 1150}

local function study()
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:obstacle("floor", scene.plane{}, {pose = frame{at = {0, 0, -0.2}, along = {0, 0, 1}}, clearance = 5*mm, prefer = "avoid"})
  s:obstacle("sheet", {points = {{0, 1, 0}, {1, 1, 0}, {0, 2, 0}}, triangles = {{1, 2, 3}}}, {clip = false})
  local hose = rod.new{length = 1.2, segments = 30, section = rod.section{outer = 18*mm, inner = 10*mm, material = rubber}}
  local bent = rod.new{shape = curve.pcc{points = {{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.4, 0}}, radius = 0.08}, segments = 30,
                       section = rod.section{outer = 12*mm, EA = 500, GA = {160, 170}, EI = {0.02, 0.03}, GJ = 0.015, mass = 0.1}}
  local p = s:rod("hose", hose, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.9, 0, 0}, along = {1, 0, 0}}})
  p:clip(0.5, frame{at = {0.4, 0, -0.05}, along = {1, 0, 0}}, {kind = "slide"})
  p:load(0.3, {force = {0, 0.5, 0}})
  s:rod("bent", bent, {from = frame{at = {0, 0.5, 0}, along = {1, 0, 0}}})
  return s
end

check.case("saved and loaded: the same scene, the same bytes, the same equilibrium", function()
  local s = study()
  local path = folder .. "/study.scene.json"
  check.equal(s:save(path), s)
  local again, warnings = scene.load(path)
  check.equal(#warnings, 0)
  check.equal(table.concat(again.rods, " "), "hose bent")
  check.equal(table.concat(again.obstacles, " "), "floor sheet")
  again:save(folder .. "/again.scene.json")
  check.equal(read(folder .. "/again.scene.json"), read(path))
  local a, b = s:solve{}, again:solve{}
  check.is_true(a.ok)
  for _, name in ipairs(s.rods) do
    local p, q = a:rod(name).points, b:rod(name).points
    check.equal(#p, #q)
    for k = 1, #p do check.equal(p[k], q[k]) end
  end
  check.equal(again:placed("bent").design.shape.kind, "pcc")
  check.equal(again:placed("hose").design.section.material.young, 6*MPa)
  check.equal(again:placed("bent").design.section.material, nil)
  check.contains(read(path), '"format": "tendril scene"', '"gravity": [0, 0, -9.81]')
end)

check.case("a robot, what it carries, and meshes by their files", function()
  local s = scene.new{gravity = {0, 0, -9.81}}
  scene.mesh({points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles = {{1, 2, 3}}}):save(folder .. "/parts/sheet.stl", {unit = "mm"})
  s:obstacle("sheet", folder .. "/parts/sheet.stl", {unit = "mm", pose = frame{at = {3, 0, 0}, along = {0, 0, 1}}})
  s:obstacle("same", scene.mesh(folder .. "/parts/sheet.stl", {unit = "mm"}), {pose = frame{at = {4, 0, 0}, along = {0, 0, 1}}})
  local arm = s:robot("arm", robot.load("builtin:six_axis"), {at = frame{at = {0, 0, 0.1}, along = {0, 0, 1}}, clearance = 2*mm})
  s:rod("hose", rod.new{length = 1.6, section = rod.section{outer = 0.03, inner = 0.02, material = rubber}})
  s:attach("hose", "start", "arm", "link_3", frame{at = {0, 0, 0.3}, along = {0, 0, 1}})
  s:attach("hose", "finish", "arm", "flange", frame{at = {0, 0, 0.05}, along = {0, 0, -1}})
  arm:move{0.3, 0.2, 0, 0, 0.5, 0}
  local path = folder .. "/robot.scene.json"
  s:save(path)
  check.contains(read(path), '"file": "parts/sheet.stl"', '"robot": "builtin:six_axis"', '"link": "flange"')
  local again = scene.load(path)
  check.equal(again:placed_robot("arm").joints[5], 0.5)
  check.equal(#again:placed_robot("arm").rods, 1)
  check.equal(again:placed_robot("arm"):frame("flange").at, arm:frame("flange").at)
  again:save(folder .. "/robot_again.scene.json")
  check.equal(read(folder .. "/robot_again.scene.json"), read(path))
  s:save(folder .. "/embedded.scene.json", {embed = true})
  os.remove(folder .. "/parts/sheet.stl")
  check.raises(function() scene.load(path) end, "scene.load: " .. path .. ": obstacles[1].mesh: ", "sheet.stl")
  check.equal(#scene.load(folder .. "/embedded.scene.json").obstacles, 2)
end)

check.case("a harness: branch points stay as they are", function()
  local r = rod.new{length = 0.4, section = rod.section{outer = 0.012, material = rubber}}
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:rod("trunk", r, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}})
  s:rod("left", r, {to = frame{at = {0.6, 0.3, 0}, along = {1, 0, 0}}})
  s:rod("right", r, {to = frame{at = {0.6, -0.3, 0}, along = {1, 0, 0}}})
  s:branch("fork", {{"trunk", "finish"}, {"left", "start"}, {"right", "start"}})
  local path = folder .. "/fork.scene.json"
  s:save(path)
  local again = scene.load(path)
  check.equal(again.branches[1], "fork")
  check.equal(again:solve{}:branch("fork").frame.at, s:solve{}:branch("fork").frame.at)
end)

check.case("what is wrong is told, and a file that cannot be replaced stays as it was", function()
  local path = folder .. "/study.scene.json"
  local text = read(path)
  write(folder .. "/cut.scene.json", text:sub(1, #text // 2))
  check.raises(function() scene.load(folder .. "/cut.scene.json") end, "scene.load: ", "cut.scene.json: ")
  write(folder .. "/new.scene.json", (text:gsub('"version": 1', '"version": 9')))
  check.raises(function() scene.load(folder .. "/new.scene.json") end, "version 9", "up to 1")
  write(folder .. "/key.scene.json", (text:gsub('"segments"', '"segment"', 1)))
  check.raises(function() scene.load(folder .. "/key.scene.json") end, "rods[1]: unknown key 'segment'", "did you mean 'segments'?")
  check.raises(function() scene.load(folder .. "/none.scene.json") end, "scene.load: cannot read")
  check.raises(function() scene.new{}:save("/proc/none/study.scene.json") end, "/proc/none/study.scene.json")
  check.raises(function() scene.new{}:save(path, {embedded = true}) end, "unknown option 'embedded' (options: embed)")
  check.equal(read(path), text)
end)

check.finish()
