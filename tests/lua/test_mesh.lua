-- mesh: a value to measure, save, place and draw.
local check = require "check"
local hose = require "sagging_hose"
local out = check.folder()

local function box(low, high)
  local p = {}
  for i = 0, 7 do
    p[i + 1] = {i % 2 == 0 and low[1] or high[1], i // 2 % 2 == 0 and low[2] or high[2], i // 4 == 0 and low[3] or high[3]}
  end
  return {points = p, triangles = {{1, 3, 4}, {1, 4, 2}, {5, 6, 8}, {5, 8, 7}, {1, 2, 6}, {1, 6, 5},
                                   {3, 7, 8}, {3, 8, 4}, {1, 5, 7}, {1, 7, 3}, {2, 4, 8}, {2, 8, 6}}}
end

check.case("what a mesh knows", function()
  local m = scene.mesh(box({0, 0, 0}, {1, 2, 3}))
  check.equal(m.vertex_count, 8)
  check.equal(m.triangle_count, 12)
  check.equal(m.watertight, true)
  check.near(m.volume, 6, 1e-12)
  check.near(m.area, 22, 1e-12)
  check.equal(m.vertices[8], vec(1, 2, 3))
  check.equal(m.triangles[1][2], 3)
  check.contains(m, "watertight", "yes", "12")
  check.equal(m:contains({0.5, 0.5, 0.5}), true)
  check.equal(m:contains(vec(1.5, 0.5, 0.5)), false)
  check.near(scene.mesh(box({0, 0, 0}, {1, 2, 3}), {unit = "mm"}).volume, 6e-9, 1e-20)
end)

check.case("a mesh with a hole has no inside", function()
  local data = box({0, 0, 0}, {1, 1, 1})
  table.remove(data.triangles)
  local m = scene.mesh(data)
  check.equal(m.watertight, false)
  check.contains(m, "no")
  check.raises(function() m:contains({0.5, 0.5, 0.5}) end, "mesh:contains", "no inside")
end)

check.case("saved and read again", function()
  local m = scene.mesh(box({0, 0, 0}, {0.1, 0.2, 0.3}))
  for _, name in ipairs {"a.stl", "b.ply", "c.obj", "d.glb"} do
    m:save(out .. "/meshes/" .. name)
    local back = scene.mesh(out .. "/meshes/" .. name, {unit = "m"})
    check.near(back.volume, 0.006, 1e-9, name)
    check.equal(back.watertight, true)
  end
  m:save(out .. "/meshes/mm.stl", {unit = "mm"})
  check.near(scene.mesh(out .. "/meshes/mm.stl", {unit = "mm"}).volume, 0.006, 1e-9)
  check.raises(function() m:save(out .. "/a.step") end, ".stl, .ply, .obj, .glb")
  check.raises(function() m:save(out .. "/a.glb", {unit = "mm"}) end, "glTF files are in metres")
  check.raises(function() m:save(out .. "/a.stl", {unit = "ft"}) end, "'unit'")
end)

check.case("what is no mesh", function()
  check.raises(function() scene.mesh({points = {{0, 0, 0}}, triangles = {}}) end, "no triangles")
  check.raises(function() scene.mesh({points = {{0, 0, 0}}, triangles = {{1, 2, 3}}}) end, "triangle 1")
  check.raises(function() scene.mesh(out .. "/none.stl", {unit = "m"}) end, "no such file")
  check.raises(function() scene.mesh(out .. "/meshes/a.stl") end, "'unit' is missing")
  check.raises(function() scene.mesh(5) end, "scene.mesh")
end)

check.case("an obstacle, and a shell in a picture", function()
  local s = hose.scene()
  local floor = scene.mesh(box({-0.5, -0.5, 0.3}, {1.5, 0.5, 0.4}))
  s:obstacle("floor", floor, {clearance = 0.02})
  check.raises(function() s:obstacle("other", floor, {unit = "mm"}) end, "a mesh is in m")
  local eq = s:solve {}
  check.is_true(eq:clearance {from = "hose", to = "floor"}.value > 0)
  local shell = scene.mesh(box({0.1, -0.1, 0.41}, {0.6, 0.1, 0.9}))
  for i, color in ipairs {"clearance", "curvature"} do
    local saved = view.new {s, eq, color = color, envelope = shell}:save(out .. "/shell" .. i .. ".png", {size = {320, 240}})
    check.is_true(saved.ok)
  end
  check.is_true(view.new {s, envelope = shell}:save(out .. "/unsolved.png", {size = {160, 120}, sheet = {"iso"}, fit = "envelope"}).ok)
  check.raises(function() view.new {s, eq, envelope = "shell"} end, "'envelope'", "a mesh")
end)

check.finish()
