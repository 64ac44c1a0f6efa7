-- view: pictures of scenes and equilibria.
local check = require "check"
local hose = require "sagging_hose"
local out = check.folder()

local function size_of(path)
  local file = assert(io.open(path, "rb"))
  local head = file:read(24)
  file:close()
  check.equal(head:sub(2, 4), "PNG")
  return string.unpack(">I4I4", head, 17)
end

local s = hose.scene()
s:obstacle("floor", scene.plane {}, {clearance = 0.01, pose = frame {at = {0, 0, 0.58}, along = {0, 0, 1}}})
s:obstacle("wall", {points = {{0, 0.3, 0}, {1, 0.3, 0}, {1, 0.3, 1}, {0, 0.3, 1}}, triangles = {{1, 2, 3}, {1, 3, 4}}})
local eq = s:solve {}

check.case("a sheet is written into a folder that did not exist", function()
  local saved = view.new {s, eq, title = "Test"}:save(out .. "/new/sheet.png", {size = {640, 480}})
  check.is_true(saved.ok)
  check.equal(saved.status, "saved")
  check.contains(saved, "sheet.png")
  local width, height = size_of(saved.path)
  check.equal(width, 640)
  check.equal(height, 480)
end)

check.case("every colour, one view, fitted to what is named", function()
  for _, colour in ipairs {"clearance", "curvature", "tension", "twist"} do
    local saved = view.new {eq, color = colour}:save(out .. "/" .. colour .. ".png", {size = {160, 120}, sheet = {"iso"}, fit = "hose"})
    check.is_true(saved.ok, colour)
  end
  local plain = view.new {s, eq, color = {1, 0.5, 0}, ghost = {"floor"}}
  check.is_true(plain:save(out .. "/plain.png", {size = {160, 120}, sheet = {"front"}, fit = {"hose", "wall"}}).ok)
end)

check.case("the same picture gives the same bytes", function()
  local bytes = {}
  for i = 1, 2 do
    local path = out .. "/same" .. i .. ".png"
    view.new {s, eq}:save(path, {size = {160, 120}, sheet = {"iso"}})
    local file = assert(io.open(path, "rb"))
    bytes[i] = file:read("a")
    file:close()
  end
  check.is_true(bytes[1] == bytes[2])
end)

check.case("a scene that is not solved shows its obstacles", function()
  check.is_true(view.new {s}:save(out .. "/unsolved.png", {size = {160, 120}, sheet = {"top"}}).ok)
end)

check.case("what cannot be drawn", function()
  check.raises(function() view.new {} end, "nothing to show")
  check.raises(function() view.new {s, s} end, "two scenes")
  check.raises(function() view.new {5} end, "a scene, an equilibrium")
  check.raises(function() view.new {s, eq, color = "curvatur"} end, "did you mean 'curvature'?")
  check.raises(function() view.new {s, eq, color = {2, 0, 0}} end, "'color'", "0 to 1")
  check.raises(function() view.new {s, eq, ghost = {"flor"}} end, "did you mean 'floor'?")
  check.raises(function() view.new {s, eq, colour = "twist"} end, "did you mean 'color'?")
  local v = view.new {s, eq}
  check.raises(function() v:save(out .. "/x.jpg") end, ".png")
  check.raises(function() v:save(out .. "/x.png", {fit = "hoes"}) end, "did you mean 'hose'?")
  check.raises(function() v:save(out .. "/x.png", {sheet = {"back"}}) end, "back")
  check.raises(function() v:save(out .. "/x.png", {size = {10, 10}}) end, "10")
  check.raises(function() v:save("/proc/none/x.png", {size = {160, 120}}) end, "/proc/none")
  check.equal(io.open(out .. "/x.png"), nil)
end)

check.case("out of time nothing is written", function()
  local saved = view.new {s, eq}:save(out .. "/late.png", {timeout = 1e-9})
  check.equal(saved.ok, false)
  check.equal(saved.status, "timeout")
  check.equal(io.open(out .. "/late.png"), nil)
end)

check.finish()
