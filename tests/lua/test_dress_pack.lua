-- method.dress_pack: a robot's path that spares its hose, simulated before and after, written as a program.
local check = require "check"
local out = check.folder()
local deg, mm = units.deg, units.mm

local function degrees(rows)
  for _, row in ipairs(rows) do
    for k = 1, #row do row[k] = row[k] * deg end
  end
  return rows
end

--- The six-axis arm with a hose of 1.6 m from its upper arm to its hand.
local function cell(length)
  local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}
  local s = scene.new{gravity = {0, 0, -9.81}}
  local arm = s:robot("arm", robot.load("builtin:six_axis"))
  s:rod("hose", rod.new{length = length or 1.6, section = rod.section{outer = 40 * mm, inner = 28 * mm, material = rubber}, segments = 16})
  s:attach("hose", "start", "arm", "link_2", frame{at = {0.05, 0.2, 0.75}, along = {1, 0, 1}})
  s:attach("hose", "finish", "arm", "link_6", frame{at = {0.13, 0, 0.15}, along = {1, 0, 0}})
  return s, arm
end
local taut = degrees{{0, 0, 0, 0, 0, 0}, {30, 10, -75, 20, 40, 0}, {60, 0, 0, 0, 0, 0}}

local s = cell()
local r = method.dress_pack(s, {path = taut, via = 8, max_tension = 100, checked_steps = 60})

check.case("the hose is spared", function()
  check.equal(r.ok, true, r.message)
  check.equal(r.status, "solved")
  assert(r.before.max_tension > 200, r.before.max_tension)
  assert(r.after.max_tension <= 100 * 1.001, r.after.max_tension)
  check.equal(#r.unmet, 0)
  assert(#r.unmet_before >= 1)
  local worst = r.unmet_before[1]
  check.equal(worst.what, "tension")
  check.near(worst.value, r.before.max_tension, 1e-9)
  check.equal(worst.demanded, 100)
  check.contains(worst.text, "a force of", "at most 100 N asked for")
  assert(worst.from < worst.t and worst.t < worst.to)
  check.equal(worst.at_end, false)
end)

check.case("the path keeps its ends and the robot's limits", function()
  check.equal(#r.path, 8)
  for k = 1, 6 do
    check.near(r.path[1][k], taut[1][k], 1e-12)
    check.near(r.path[8][k], taut[3][k], 1e-12)
  end
  local bot = robot.load("builtin:six_axis")
  for _, q in ipairs(r.path) do assert(bot:within_limits(q)) end
  assert(r.after.length > 0 and r.before.length > 0)
end)

check.case("every state is an equilibrium of the scene itself", function()
  assert(r.after.residual < 1e-4, r.after.residual)
  for _, t in ipairs{0, 0.5, 1} do
    local eq = r:frame(t)
    check.equal(eq.ok, true)
    local forces = 0
    for _, support in ipairs(eq:rod("hose").supports) do forces = math.max(forces, support.force:length()) end
    local i = math.floor(t * 60 + 0.5) + 1
    check.near(r.after.times[i], t, 1e-12)
    check.near(forces, r.after.tensions[i], 1e-6 * (1 + forces))
  end
  -- The same hose by the scene's own solver, with the robot standing there.
  local again, arm = cell()
  local half = r:frame(0.5)
  arm:move(r.after:joints(0.5))
  local there = again:solve{from = half}
  check.equal(there.ok, true)
  check.near(there:rod("hose"):at(0.8).at, half:rod("hose"):at(0.8).at, 1e-4)
end)

check.case("a motion of its own, for envelopes and gaps", function()
  local m = r.after:motion{states = 11}
  check.equal(#m.equilibria, 11)
  check.equal(m.times[1], 0)
  check.equal(m.times[11], 1)
  check.equal(m.ok, true)
  local gaps = m:clearance{from = "hose"}
  check.equal(#gaps, 11)
  local least = math.huge
  for _, gap in ipairs(gaps) do least = math.min(least, gap + 0) end
  assert(least >= r.after.clearance - 1e-3, least)
end)

check.case("cards and charts", function()
  check.contains(r, "dress pack", "largest force of a hold", "given path", "optimised path")
  check.contains(r.after, "motion on the optimised path", "largest force")
  local saved = r:chart{title = "Spared"}:save(out .. "/chart.png")
  check.equal(saved.ok, true)
  check.equal(r.steps[1].name, "simulation of the given path")
  assert(#r.history > 0 and r.history[#r.history].objective <= r.objective_before)
end)

check.case("programs of the optimised path", function()
  local rapid = r:program("rapid", {speed = 0.3, name = "weld"})
  check.contains(rapid, "weld", "MoveAbsJ")
  local path = out .. "/weld.csv"
  local file = assert(io.open(path, "w"))
  file:write(r:program("csv"))
  file:close()
  local back = robot.load("builtin:six_axis"):read_program(path)
  check.equal(#back, 8)
  for i, q in ipairs(back) do
    for k = 1, 6 do check.near(q[k], r.path[i][k], 1e-6) end
  end
  check.raises(function() r:program("basic") end, "dialect", "rapid")
end)

check.case("a path that is only looked at", function()
  local seen = method.dress_pack(s, {path = taut, optimise = false, checked_steps = 30})
  check.equal(#seen.steps, 1)
  check.equal(seen.ok, true)
  check.near(seen.before.max_tension, seen.after.max_tension, 0)
end)

check.case("what the first configuration breaks already, no path keeps", function()
  local floor = method.dress_pack(s, {path = taut, via = 8, max_tension = 60, checked_steps = 30})
  check.equal(floor.ok, false)
  check.equal(floor.status, "infeasible")
  check.equal(floor.unmet[1].at_end, true)
  check.contains(floor.message, "the best path found has a force of", "at t = 0, an end of the path")
end)

check.case("a hose that must keep clear of a post does", function()
  local conduit = rod.material{young = 30e6, poisson = 0.4, density = 1200}
  local posted = scene.new{gravity = {0, 0, -9.81}}
  posted:obstacle("post", scene.box{size = {60 * mm, 60 * mm, 1.2}}, {pose = frame{at = {1.85, 0.45, 0.95}, along = {0, 0, 1}}})
  posted:robot("arm", robot.load("builtin:six_axis"))
  posted:rod("hose", rod.new{length = 1.9, section = rod.section{outer = 50 * mm, inner = 36 * mm, material = conduit}, segments = 16})
  posted:attach("hose", "start", "arm", "link_3", frame{at = {0, 0, 0.50}, along = {1, 0, 1.4}})
  posted:attach("hose", "finish", "arm", "link_6", frame{at = {0.22, 0, 0.10}, along = {-1, 0, 1}, up = {0, 1, 0}})
  local path = degrees{{18, 8, 37, 25, -48, -17}, {-22, 9, 35, -30, -49, 21}}
  local wish = {path = path, via = 6, max_tension = 130, checked_steps = 60}
  local free = method.dress_pack(posted, wish)
  wish.clearance = 15 * mm
  local kept = method.dress_pack(posted, wish)
  check.equal(kept.ok, true, kept.message)
  assert(free.after.clearance < 14 * mm, free.after.clearance)
  assert(kept.after.clearance >= 15 * mm - 1e-5, kept.after.clearance)
  -- Ends that do not keep it are refused at once.
  wish.clearance = 2
  local never = method.dress_pack(posted, wish)
  check.equal(never.status, "infeasible")
  check.contains(never.message, "at the start of the path", "hose")
end)

check.case("the length of a hose is adjusted for a motion", function()
  local function wish(low, high)
    return {adjust = {["hose.length"] = {low, high}}, steps = 12, max_tension = 10, motions = {{taut[1], degrees{{15, 5, -30, 10, 20, 0}}[1]}}}
  end
  local d = method.dress_pack_design(cell(), wish(1.4, 2.2))
  check.equal(d.ok, true, d.message)
  local length = d.values["hose.length"]
  assert(length >= 1.4 and length <= 2.2, length)
  assert(d.objective < d.objective_before)
  -- Neither a little shorter nor a little longer is better, by scenes made anew.
  for _, other in ipairs{length - 0.02, length + 0.02} do
    if other > 1.4 and other < 2.2 then
      local made = method.dress_pack_design(cell(other), wish(other - 1e-3, other + 1e-3))
      assert(made.objective_before >= d.objective - 1e-9, made.objective_before .. " at " .. other)
    end
  end
  check.equal(#d.after, 1)
  assert(d.after[1].max_tension <= d.before[1].max_tension)
  check.equal(d.after[1]:frame(1).ok, true)
  check.contains(d, "dress pack design", "hose.length", "largest force, motion 1")
  check.raises(function() method.dress_pack_design(cell(), {adjust = {["hose.lenth"] = {1, 2}}, motions = {taut}}) end, "hose.lenth", "hose.length")
  check.raises(function() method.dress_pack_design(cell(), {adjust = {["hose.length"] = {1, 2}}, motions = {}}) end, "no paths")
  check.raises(function() method.dress_pack_design(cell(), {adjust = {}, motions = {taut}}) end, "parameter")
  check.raises(function() method.dress_pack_design(cell(), {adjust = {["hose.length"] = {1, 2}}, motions = {taut}, weights = {1, 2}}) end, "2 weights for 1 motions")
end)

check.case("what cannot be is refused, with the reason", function()
  check.raises(function() method.dress_pack(scene.new{}, {path = taut}) end, "the scene has no robot", "scene:robot")
  local bare = scene.new{}
  bare:robot("arm", robot.load("builtin:six_axis"))
  check.raises(function() method.dress_pack(bare, {path = taut}) end, "no rods are attached", "scene:attach")
  check.raises(function() method.dress_pack(s, {path = {{0, 0}}}) end, "point 1 has 2 joint values, expected 6")
  check.raises(function() method.dress_pack(s, {path = {}}) end, "via point")
  check.raises(function() method.dress_pack(s, {}) end, "path")
  check.raises(function() method.dress_pack(s, {path = taut, robot = "amr"}) end, "amr", "arm")
  check.raises(function() method.dress_pack(s, {path = taut, max_tension = -1}) end, "max_tension")
  check.raises(function() r:frame(2) end, "expected 0 to 1")
  local beyond = method.dress_pack(s, {path = degrees{{0, 0, 0, 0, 0, 0}, {0, 0, 90, 0, 0, 0}}})
  check.equal(beyond.status, "infeasible")
  check.contains(beyond.message, "joint_3")
  local fast = method.dress_pack(s, {path = taut, seconds = 0.1})
  check.equal(fast.status, "infeasible")
  check.contains(fast.message, "joint_")
end)

check.finish()
