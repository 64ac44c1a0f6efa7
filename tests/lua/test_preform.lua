-- method.preform: what scripts give it and get from it. That the hoses are right is tested in tests/unit/method.
local check = require "check"

local mm, deg = units.mm, units.deg
local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}

local function straight_ends(more)
  local options = {
    from = frame{at = {-0.3, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.3, 0, 0}, along = {1, 0, 0}},
    outer = 20*mm, min_bend_radius = 50*mm, min_straight = 10*mm,
  }
  for k, v in pairs(more or {}) do options[k] = v end
  return options
end

local function scene_with_post()
  local s = scene.new{}
  s:obstacle("post", scene.cylinder{radius = 40*mm, length = 3}, {clearance = 5*mm})
  return s
end

check.case("nothing in the way: one straight hose", function()
  local hoses = method.preform(scene.new{}, straight_ends())
  check.is_true(hoses.ok, hoses.message)
  check.equal(hoses.status, "solved")
  check.near(hoses[1].length, 0.6, 1e-9)
  check.equal(#hoses[1].bends, 0)
  check.equal(hoses[1].clearance.value, math.huge)
  check.near(hoses[1].from.at, vec(-0.3, 0, 0), 1e-12)
  check.near(hoses[1].to.at, vec(0.3, 0, 0), 1e-9)
  check.near(hoses[1].to.along, vec(1, 0, 0), 1e-9)
end)

check.case("a post: two ways round it, with bends, clearances and tables that agree", function()
  local hoses = method.preform(scene_with_post(), straight_ends{keep_in = {{-0.5, -0.3, -0.03}, {0.5, 0.3, 0.03}}})
  check.is_true(hoses.ok, hoses.message)
  check.equal(hoses.passages, 2)
  check.contains(tostring(hoses), "preformed hoses", "passage", "shortest")
  check.contains(hoses:report(), "global_search", "pcc_sampling", "pcc_optimization", "pcc_filtering", "hose 1")
  local names = {}
  for i, step in ipairs(hoses.steps) do names[i] = step.name; check.is_true(step.seconds >= 0) end
  check.equal(table.concat(names, " "), "distance_field global_search pcc_sampling pcc_optimization pcc_filtering")
  check.is_true(hoses.steps[3].counts.candidates > 0)
  for i, hose in ipairs(hoses) do
    check.is_true(i == 1 or hose.objective >= hoses[i - 1].objective - 1e-9 or hose.passage ~= hoses[i - 1].passage, "ranked")
    check.is_true(hose.clearance >= 5*mm - 1e-5, "clearance")
    check.near(hose.clearance.required, 5*mm, 1e-12)
    check.is_true(hose.clearance.ok)
    check.contains(tostring(hose.clearance), "post")
    local sum = 0
    for k, bend in ipairs(hose.bends) do
      check.near(bend.radius, 50*mm, 1e-9)
      check.is_true(bend.straight_before >= 10*mm - 1e-5, "straight before bend " .. k)
      check.is_true(bend.angle > 0 and bend.angle <= 3.0 + 1e-9)
      sum = sum + bend.straight_before + bend.radius * bend.angle
    end
    check.is_true(hose.length - sum >= 10*mm - 1e-5, "straight at the finish")
    check.near(hose.curve.length, hose.length, 1e-9)
    check.near(hose.curve:at(0).at, vec(-0.3, 0, 0), 1e-12)
    check.near(hose.curve:at(hose.length).at, vec(0.3, 0, 0), 1e-9)
    check.is_true(hose.curve:min_bend_radius() >= 50*mm - 1e-9)
  end
end)

check.case("a hose as a file, a mesh, an obstacle and a picture", function()
  local s = scene_with_post()
  local hoses = method.preform(s, straight_ends{keep_in = {{-0.5, -0.3, -0.03}, {0.5, 0.3, 0.03}}})
  local hose, dir = hoses[1], os.tmpname()
  os.remove(dir)
  check.contains(hose:table(), "R_deg", "A_deg")
  check.contains(hose:table("XYZ"), "x_mm", "radius_mm")
  check.raises(function() hose:table("ABC") end, "hose:table", "'ABC'", "LRA")
  hose:save(dir .. "/hose.csv", {table = "XYZ"})
  local file = assert(io.open(dir .. "/hose.csv"))
  check.contains(file:read("a"), "-300")
  file:close()
  hose:save(dir .. "/hose.stl", {unit = "mm"})
  check.raises(function() hose:save(dir .. "/hose.txt") end, ".txt")
  check.is_true(hose.mesh.watertight)
  check.near(hose.mesh.volume, math.pi * (10*mm)^2 * hose.length, 0.01 * hose.mesh.volume)
  s:obstacle("first", hose.mesh, {clearance = 2*mm})
  local second = method.preform(s, straight_ends{
    from = frame{at = {-0.3, 0, 25*mm}, along = {1, 0, 0}}, to = frame{at = {0.3, 0, 25*mm}, along = {1, 0, 0}}})
  check.is_true(second.ok, second.message)
  for _, h in ipairs(second) do check.is_true(h.clearance >= 2*mm - 1e-5) end
  view.new{s, hoses}:save(dir .. "/all.png", {size = {320, 240}, sheet = {"iso"}})
  view.new{s, hose}:save(dir .. "/one.png", {size = {320, 240}, sheet = {"iso", "card"}})
  check.raises(function() view.new{s, hoses, hose} end, "view.new", "hoses twice")
  os.remove(dir .. "/hose.csv") os.remove(dir .. "/hose.stl") os.remove(dir .. "/all.png") os.remove(dir .. "/one.png") os.remove(dir)
end)

check.case("gravity check: as a rod of the scene and by settle, the same", function()
  local s = scene.new{gravity = {0, 0, -9.81}}
  local hoses = method.preform(s, {
    from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.4, 0.2, 0.1}, along = {0, 1, 0}},
    section = rod.section{outer = 20*mm, inner = 12*mm, material = rubber}, min_bend_radius = 50*mm, min_straight = 10*mm})
  local hose = hoses[1]
  local settled = hose:settle()
  check.is_true(settled.ok)
  check.is_true(settled > 0 and settled < 50*mm)
  s:rod("hose", hose.rod, {from = hose.from, to = hose.to})
  local eq = s:solve()
  check.near(eq.energy.total, settled.equilibrium.energy.total, 1e-6 * math.abs(eq.energy.total))
  check.near(hose.rod.shape.length, hose.length, 1e-12)
  local weightless = scene.new{}
  local light = method.preform(weightless, {from = hose.from, to = hose.to, section = hose.rod.section, min_bend_radius = 50*mm, min_straight = 10*mm})
  check.near(light[1]:settle().value, 0, 1e-9, "without gravity a preformed hose stays as it is")
  local bare = method.preform(weightless, {from = hose.from, to = hose.to, outer = 20*mm, min_bend_radius = 50*mm})
  check.raises(function() bare[1]:settle() end, "hose:settle", "section")
  check.raises(function() return bare[1].rod end, "hose.rod", "section")
end)

check.case("infeasible: a wall without a window, and who is too near", function()
  local s = scene.new{}
  s:obstacle("wall", scene.box{size = {10*mm, 4, 4}})
  local hoses = method.preform(s, straight_ends{keep_in = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}})
  check.is_true(not hoses.ok)
  check.equal(hoses.status, "infeasible")
  check.equal(#hoses, 0)
  check.contains(tostring(hoses), "infeasible")
  check.contains(hoses.message, "wall")
  check.raises(function() view.new{s, hoses} end, "view.new", "no hoses")
  local near = method.preform(s, straight_ends{from = frame{at = {-12*mm, 0, 0}, along = {-1, 0, 0}}})
  check.equal(near.status, "infeasible")
  check.contains(near.message, "start", "wall", "mm")
end)

check.case("limits: length, bends, tools, cones", function()
  local long = method.preform(scene.new{}, straight_ends{min_length = 0.7})
  check.is_true(long.ok, long.message)
  for _, h in ipairs(long) do check.is_true(h.length >= 0.7 - 1e-5) end
  local none = method.preform(scene_with_post(), straight_ends{max_bends = 0})
  check.equal(none.status, "infeasible")
  local tools = method.preform(scene_with_post(), straight_ends{min_bend_radius = {40*mm, 60*mm, 80*mm}})
  check.is_true(tools.ok, tools.message)
  for _, h in ipairs(tools) do
    for _, b in ipairs(h.bends) do
      local known = false
      for _, radius in ipairs{40*mm, 60*mm, 80*mm} do known = known or math.abs(b.radius - radius) < 1e-9 end
      check.is_true(known, "radius " .. b.radius)
    end
  end
  local tilted = straight_ends{to = frame{at = {0.3, 0.1, 0}, along = {1, 0, 0}}}
  local stiff = method.preform(scene.new{}, tilted)
  tilted.from_cone, tilted.to_cone = 20*deg, 20*deg
  local free = method.preform(scene.new{}, tilted)
  check.is_true(free[1].length < stiff[1].length - 1e-4, "an end that may turn makes it shorter")
  check.near(free[1].length, (vec(0.6, 0.1, 0)):length(), 1e-6, "straight")
end)

check.case("what makes no sense is refused at the caller's line", function()
  local s = scene.new{}
  local function raises(more, ...)
    local words = {...}
    check.raises(function() method.preform(s, straight_ends(more)) end, table.unpack(words))
  end
  raises({outer = false}, "method.preform", "'outer'")
  raises({min_bend_radius = 8*mm}, "bend radius", "own radius")
  raises({min_bend_radius = {}}, "min_bend_radius", "empty list")
  raises({min_bend_radius = -1}, "bend radius")
  raises({clearance = -1}, "'clearance'")
  raises({clearence = 1}, "clearence", "clearance")
  raises({max_length = 0.5}, "600 mm apart", "500 mm")
  raises({keep_in = {{0, 0, 0}, {1, 1, 1}}}, "keep_in")
  raises({to = frame{at = {-0.3, 0, 0}, along = {1, 0, 0}}}, "one place")
  raises({grid = 1e-5}, "grid")
  raises({section = rod.section{outer = 30*mm, material = rubber}}, "'outer'", "section")
end)

check.case("seeds, threads, progress and stopping", function()
  local s = scene_with_post()
  local one, two = method.preform(s, straight_ends{threads = 1}), method.preform(s, straight_ends{threads = 2})
  check.equal(#one, #two)
  for i = 1, #one do check.equal(one[i].length, two[i].length, "the same bits") end
  local late = method.preform(s, straight_ends{timeout = 1e-9})
  check.equal(late.status, "timeout")
  check.is_true(not late.ok)
end)

check.finish()
