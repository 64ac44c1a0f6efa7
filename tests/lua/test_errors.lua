-- Files that are missing, broken or of another kind, and numbers that are none: each a clear error, never a crash.
local check = require "check"
local hose = require "sagging_hose"
local out = check.folder()
os.execute("mkdir -p '" .. out .. "'")

local function write(name, content)
  local file = assert(io.open(out .. "/" .. name, "wb"))
  file:write(content)
  file:close()
  return out .. "/" .. name
end

local square = "v 0 0 0\nv 1000 0 0\nv 1000 1000 0\nv 0 1000 0\nf 1 2 3 4\n"
local s = scene.new {}

check.case("a mesh file needs its unit, which is never guessed", function()
  local path = write("square.obj", square)
  check.raises(function() s:obstacle("a", path) end, "'unit' is missing", "never guessed")
  check.raises(function() s:obstacle("a", path, {unit = "yard"}) end, "'unit'", "mm")
  s:obstacle("mm", path, {unit = "mm"})
  s:obstacle("inch", path, {unit = "in"})
  local t = scene.new {}
  t:obstacle("square", path, {unit = "mm", pose = frame {at = {-0.5, -0.5, 0}, along = {0, 0, 1}, up = {1, 0, 0}}})
  t:rod("bar", hose.design:with {length = 0.4}, {from = frame {at = {-0.2, 0, 0.3}, along = {1, 0, 0}}})
  check.near(t:solve {}:clearance {}, 0.3 - 9 * units.mm, 1e-9)
end)

check.case("files that cannot be read", function()
  check.raises(function() s:obstacle("a", out .. "/missing.obj", {unit = "mm"}) end, "missing.obj")
  check.raises(function() s:obstacle("a", out, {unit = "mm"}) end, out)
  check.raises(function() s:obstacle("a", write("empty.obj", ""), {unit = "mm"}) end, "empty.obj", "empty")
  check.raises(function() s:obstacle("a", write("part.step", "ISO-10303-21;"), {unit = "mm"}) end, "part.step")
  check.raises(function() s:obstacle("a", write("picture.obj", "\x89PNG\r\n\x1a\n"), {unit = "mm"}) end, "picture.obj", "PNG")
  check.raises(function() s:obstacle("a", write("points.obj", "v 0 0 0\nv 1 0 0\n"), {unit = "mm"}) end, "points.obj", "no triangles")
  check.raises(function() s:obstacle("a", write("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {unit = "mm"}) end, "nan.obj")
  check.raises(function() s:obstacle("a", write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n"), {unit = "mm"}) end, "index.obj")
  local stl = string.rep("\0", 80) .. string.pack("<I4", 1000) .. string.rep("\0", 50)
  check.raises(function() s:obstacle("a", write("short.stl", stl), {unit = "mm"}) end, "short.stl")
  check.raises(function() s:obstacle("a", write("short.glb", "glTF\2\0\0\0\255\0\0\0"), {unit = "mm"}) end, "short.glb", "truncated")
  check.equal(#s.obstacles, 2)
end)

check.case("whatever a number is replaced by, an error comes, and no NaN", function()
  local odd = {0 / 0, math.huge, -math.huge, -1, 0, 1e308, -1e308, 5e-324, "x", true, {}, print}
  local attempts = {
    function(x) return rod.material {young = x, poisson = 0.3, density = 1000} end,
    function(x) return rod.material {young = 1e6, poisson = 0.3, density = x} end,
    function(x) return rod.section {outer = x, material = hose.rubber} end,
    function(x) return rod.section {outer = 0.02, inner = x, material = hose.rubber} end,
    function(x) return rod.section {outer = 0.02, EA = x, GA = 1, EI = 1, GJ = 1, mass = 1} end,
    function(x) return rod.new {section = hose.tube, length = x} end,
    function(x) return rod.new {section = hose.tube, length = 1, segments = x} end,
    function(x) return scene.new {gravity = {0, 0, x}} end,
    function(x) return frame {at = {x, 0, 0}, along = {1, 0, 0}} end,
    function(x) return frame {at = {0, 0, 0}, along = {x, 0, 0}} end,
    function(x) return curve.pcc {points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, radius = x} end,
    function(x) return scene.sphere {radius = x} end,
  }
  for i, attempt in ipairs(attempts) do
    for _, value in ipairs(odd) do
      local ok, result = pcall(attempt, value)
      if not ok then check.contains(result, "test_errors.lua:") end
      if ok then check.equal(tostring(result):lower():find("nan", 1, true), nil, "attempt " .. i .. " with " .. tostring(value)) end
    end
  end
end)

check.case("extreme but sane rods solve or say that they did not", function()
  for _, gravity in ipairs {0.001, 9.81, 100} do
    for _, length in ipairs {0.01, 1, 30} do
      local t = scene.new {gravity = {0, 0, -gravity}}
      local stiff = rod.section {outer = length / 50, material = rod.material {young = 1e9, poisson = 0.3, density = 1000}}
      t:rod("r", rod.new {section = stiff, length = length}, {from = frame {at = {0, 0, 0}, along = {1, 0, 0}}})
      local e = t:solve {}
      check.is_true(e.ok, "gravity " .. gravity .. ", length " .. length)
      for _, point in ipairs(e:rod("r").points) do check.is_true(point:length() <= 1.01 * length) end
    end
  end
end)

check.finish()
