-- robots in scenes: links as bodies, rods that are attached to them.
local check = require "check"
local out = check.folder()
local mm, deg = units.mm, units.deg
local bot = robot.load("builtin:six_axis")
local rubber = rod.material{young = 5e6, poisson = 0.45, density = 1150}
local hose = rod.new{length = 1.9, section = rod.section{outer = 45*mm, inner = 30*mm, material = rubber}, segments = 24}

-- A hose from the forearm's back over the wrist to the hand.
local function cell()
  local s = scene.new{gravity = {0, 0, -9.81}}
  local arm = s:robot("arm", bot, {at = frame{at = {0, 0, 0.5}, along = {0, 0, 1}, up = {1, 0, 0}}, joints = {0, 0, 0, 0, 30*deg, 0}})
  s:obstacle("floor", scene.plane{}, {clearance = 20*mm})
  s:rod("hose", hose)
  s:attach("hose", "start", "arm", "link_3", frame{at = {0.05, 0, 0.42}, along = {1, 0, 0.3}})
  s:attach("hose", "finish", "arm", "link_6", frame{at = {0.12, 0, 0.22}, along = {0.2, 0, -1}})
  return s, arm
end

check.case("a robot in a scene", function()
  local s, arm = cell()
  check.equal(arm.name, "arm")
  check.equal(arm.design.name, "six_axis")
  check.equal(s.robots[1], "arm")
  check.near(arm.joints[5], 30*deg, 1e-15)
  check.near(arm.at.at, vec(0, 0, 0.5), 1e-15)
  check.near(arm:frame("flange").at, bot:link_frame("flange", arm.joints).at + vec(0, 0, 0.5), 1e-12)
  check.equal(arm.rods[1], "hose")
  check.equal(#arm.rods, 1)
  check.contains(arm, "robot 'arm' in a scene", "six_axis", "joint_5", "carries 'hose'", "link_3", "link_6")
  check.contains(s, "robot 'arm'", "7 solid links")
  check.contains(s:placed("hose"), "on robot 'arm'")
  check.equal(s:placed_robot("arm").name, "arm")
end)

check.case("holds go with the links, and the rod with them", function()
  local s, arm = cell()
  local q = {20*deg, 10*deg, -5*deg, 30*deg, 20*deg, -15*deg}
  local before = s:solve{}
  check.is_true(before.ok, before.message)
  arm:move(q)
  for k = 1, 6 do check.near(arm.joints[k], q[k], 1e-15) end
  local eq = s:solve{from = before}
  check.is_true(eq.ok, eq.message)
  local points = eq:rod("hose").points
  local hand = arm:frame("link_6")
  local x, z = hand.up, hand.along
  check.near(points[#points], hand.at + 0.12 * x + 0.22 * z, 1e-9)
  local weight = 9.81 * hose.mass
  check.near(eq:force("hose", "start") + eq:force("hose", "finish"), vec(0, 0, weight), 1e-6 * weight)
end)

check.case("links are obstacles to rods", function()
  local s = cell()
  local eq = s:solve{}
  local gap = eq:clearance{from = "hose", to = "arm.link_5"}
  check.is_true(gap.value > 0 and gap.value < 1)
  check.is_true(eq:clearance{from = "hose", to = "floor"}.value > 1)
  check.contains(s:explain(), "carries 'hose' at its start on link_3", "solid links", "on robot 'arm'")
  check.is_true(s:explain():uses("robot"))
end)

check.case("kinds of attachments", function()
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:robot("arm", bot)
  s:rod("hose", hose, {from = frame{at = {1.0, 0, 3.2}, along = {1, 0, 0}}})
  s:attach("hose", "finish", "arm", "flange", frame{at = {0, 0, 0.6}, along = {0, 0, 1}}, {kind = "swivel"})
  local eq = s:solve{}
  check.is_true(eq.ok, eq.message)
  check.near(eq:moment("hose", "finish"):length(), 0, 1e-6)
  check.is_true(eq:moment("hose", "start"):length() > 0.01)
  s:attach("hose", 0.7, "arm", "link_3", frame{at = {0.5, 0, 0.6}, along = {1, 0, 0}}, {kind = "slide"})
  check.contains(s:placed("hose"), "slides through")
end)

check.case("errors name what is wrong", function()
  local s, arm = cell()
  check.raises(function() arm:move{0, 0, 0, 0, 3, 0} end, "placed_robot:move", "'joint_5' at 3, limits")
  check.raises(function() arm:move{0, 0} end, "2 joint values, expected 6")
  check.near(arm.joints[5], 30*deg, 1e-15)
  check.raises(function() s:remove("arm") end, "carries 'hose' at its start, 'hose' at its finish")
  check.raises(function() s:robot("arm", bot) end, "already has a robot 'arm'")
  check.raises(function() s:robot("other", bot, {joints = {}}) end, "0 joint values, expected 6")
  check.raises(function() s:attach("hose", "start", "arm", "link_3", frame{at = {0, 0, 0}, along = {0, 0, 1}}) end, "attached to 'arm' at its start already")
  check.raises(function() s:attach("hose", 0.5, "arm", "link_9", frame{at = {0, 0, 0}, along = {0, 0, 1}}) end, "link", "link_9")
  check.raises(function() s:attach("hose", 0.5, "amr", "link_1", frame{at = {0, 0, 0}, along = {0, 0, 1}}) end, "did you mean 'arm'")
  check.raises(function() s:attach("hose", 0.5, "arm", "link_1", frame{at = {0, 0, 0}, along = {0, 0, 1}}, {kind = "slide", orientation = false}) end,
    "holds its orientation")
  check.raises(function() s:placed_robot("legs") end, "unknown robot 'legs'")
  s:placed("hose"):release("start"):release("finish")
  s:remove("arm")
  check.equal(#s.robots, 0)
  check.raises(function() return arm.joints end, "unknown robot 'arm'")
end)

check.case("a picture shows the robot", function()
  local s = cell()
  view.new{s, s:solve{}}:save(out .. "robot.png", {size = {640, 480}, sheet = {"iso"}, fit = {"hose", "arm.link_3", "arm.base"}})
  local file = assert(io.open(out .. "robot.png", "rb"))
  check.is_true(#file:read("a") > 10000)
  file:close()
end)

-- The floor is far below; the hose is the only rod.
local function moved(steps)
  local s, arm = cell()
  return s:motion{robot = "arm", steps = steps, path = {{0, 0, 0, 0, 30*deg, 0}, {20*deg, 5*deg, 0, 20*deg, 20*deg, 10*deg}}}, s, arm
end

check.case("a robot moves along a path", function()
  local m, s, arm = moved(8)
  check.is_true(m.ok, m.message)
  check.equal(#m.equilibria, 9)
  check.near(m.times[9], 1, 1e-12)
  check.near(arm.joints[1], 0, 1e-15)
  arm:move{20*deg, 5*deg, 0, 20*deg, 20*deg, 10*deg}
  local there = s:solve{from = m.equilibria[9]}
  check.is_true(there.ok, there.message)
  local a, b = there:rod("hose").points, m.equilibria[9]:rod("hose").points
  for k = 1, #a do check.near(a[k], b[k], 1e-6) end
  local gaps = m:clearance{from = "hose"}
  check.equal(#gaps, 9)
  check.near(gaps[9].value, there:clearance{from = "hose"}.value, 1e-6)
  -- On the way the hose falls to the arm's other side.
  check.equal(#m.snaps, 1)
  check.equal(m.snaps[1].rod, "hose")
  check.is_true(m.snaps[1].t > 0.5 and m.snaps[1].t < 0.56 and m.snaps[1].move > 0.3)
  check.contains(m, "motion", "solved", "snap-throughs")
end)

check.case("the envelope of a motion contains the hose between its steps too", function()
  local mesh = moved(24):envelope{resolution = 12*mm}
  check.is_true(mesh.watertight)
  local fine = moved(48)
  for _, eq in ipairs(fine.equilibria) do
    for _, p in ipairs(eq:rod("hose").points) do check.is_true(mesh:contains(p)) end
  end
end)

check.case("what a robot's motion refuses", function()
  local s, arm = cell()
  local q = arm.joints
  check.raises(function() s:motion{robot = "arm"} end, "'path' is missing")
  check.raises(function() s:motion{path = {q, q}} end, "'robot' is missing")
  check.raises(function() s:motion{steps = 3} end, "nothing moves")
  check.raises(function() s:motion{robot = "arm", path = {q}, holds = {["hose.start"] = {arm.at}}} end, "'holds' beside a robot's path")
  check.raises(function() s:motion{robot = "arm", path = {{0, 0}, {0, 0}}} end, "2 joint values, expected 6")
  check.raises(function() s:motion{robot = "arm", path = {q, {0}}} end, "via point")
  local m = s:motion{robot = "arm", path = {q, {0, 0, 0, 0, 3, 0}}}
  check.equal(m.ok, false)
  check.equal(m.status, "infeasible")
  check.contains(m.message, "joint_5")
end)

check.case("pictures of a motion: a strip, the space that is swept, numbered frames", function()
  local m, s = moved(4)
  local strip = view.new{s, m, title = "reach"}:save(out .. "strip.png", {size = {900, 500}, frames = 4})
  check.is_true(strip.ok)
  local swept = view.new{s, m, color = {0.2, 0.4, 0.7}, envelope = m:envelope{resolution = 12*mm}}:save(out .. "swept.png", {size = {640, 480}, sheet = {"iso"}})
  check.is_true(swept.ok)
  local files = view.new{s, m}:save_frames(out .. "frames", {size = {320, 240}})
  check.equal(#files, 5)
  check.contains(files[5].path, "frame_0005.png")
  local first, last
  for k, name in ipairs{"frame_0001.png", "frame_0005.png"} do
    local file = assert(io.open(out .. "frames/" .. name, "rb"))
    if k == 1 then first = file:read("a") else last = file:read("a") end
    file:close()
  end
  check.is_true(#first > 1000 and first ~= last)
  check.raises(function() view.new{s, m.equilibria[1]}:save_frames(out .. "frames") end, "expected a motion")
end)

check.finish()
