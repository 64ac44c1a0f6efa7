-- method.flatten from a script: a routed harness on its build board.
local check = dofile("tests/lua/check.lua")
local mm = units.mm
local folder = check.folder()

local pvc = rod.material{young = 30e6, poisson = 0.4, density = 1400}
local cable = rod.section{outer = 8*mm, material = pvc}

local s = scene.new{gravity = {0, 0, -9.81}}
local routed = method.harness(s, {section = cable, min_bend_radius = 40*mm, bundling = 0.9,
  connections = {frame{at = {0, 0, 0}, along = {1, 0, 0}}, frame{at = {0.6, 0.15, 0}, along = {-1, 0, 0}},
                 frame{at = {0.6, -0.15, 0}, along = {-1, 0, 0}}}})
local harness = routed:scene()
local board = method.flatten(harness)

check.case("a routed harness lies flat, with the lengths of its rods", function()
  check.is_true(board.ok, board.message)
  check.equal(board.status, "solved")
  check.equal(board.crossings, 0)
  check.equal(#board.lines, 3)
  check.equal(#board.points, 4)
  for i, line in ipairs(board.lines) do
    check.near(line.length, line.design_length, 1e-3 * line.design_length)
    check.near(line.design_length, routed.branches[i].rod_length, 1e-9)
    for _, p in ipairs(line.points) do check.near(p.z, 0, 1e-6) end
    for _, p in ipairs(line.points) do check.is_true(p.x <= board.width + 1e-9 and p.y <= board.height + 1e-9 and p.x >= -1e-9 and p.y >= -1e-9) end
  end
  check.contains(tostring(board), "build board", "length on the board", "crossings")
  check.equal(#board.equilibrium.rods, 3)
end)

check.case("a harness of thirteen branches past a box: no crossings, lengths kept, all in the plane", function()
  local world = scene.new{gravity = {0, 0, -9.81}}
  world:obstacle("box", scene.box{size = {0.3, 0.2, 0.2}}, {pose = frame{at = {0.5, 0, -0.05}, along = {0, 0, 1}}})
  local function place(at, along) return frame{at = at, along = along} end
  local large = method.harness(world, {section = cable, min_bend_radius = 40*mm, bundling = 0.8, clearance = 5*mm, refine = false,
    connections = {place({0, 0, 0}, {1, 0, 0}), place({1, 0.3, 0}, {-1, 0, 0}), place({1, -0.3, 0}, {-1, 0, 0}), place({0.7, 0.4, 0.2}, {0, -1, 0}),
                   place({0.7, -0.4, 0.2}, {0, 1, 0}), place({1.1, 0, 0.3}, {-1, 0, 0}), place({0.2, 0.4, -0.1}, {0, -1, 0}), place({0.2, -0.4, 0.1}, {0, 1, 0})}})
  local flat = method.flatten(large:scene())
  check.is_true(flat.ok, flat.message)
  check.equal(flat.crossings, 0)
  check.equal(#flat.lines, #large.branches)
  for _, line in ipairs(flat.lines) do
    check.near(line.length, line.design_length, 1e-3 * line.design_length)
    for _, p in ipairs(line.points) do check.near(p.z, 0, 1e-6) end
  end
end)

check.case("files and pictures", function()
  board:save(folder .. "/board.csv")
  local file = assert(io.open(folder .. "/board.csv"))
  local text = file:read("a")
  file:close()
  check.contains(text, "kind,name,x [mm],y [mm]\npoint,", "\nline,")
  check.is_true(view.new{board}:save(folder .. "/board.png", {size = {640, 320}}).ok)
end)

check.case("errors name what is wrong", function()
  check.raises(function() method.flatten(harness, {rods = {"nothing"}}) end, "flatten", "nothing")
  check.raises(function() method.flatten(harness, {spacing = -1}) end, "spacing")
  check.raises(function() method.flatten(scene.new{}) end, "no rods")
  check.raises(function() board:save("board.txt") end, "board:save", ".csv")
end)

check.finish()
