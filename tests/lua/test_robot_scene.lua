-- robots in scenes: links as bodies, rods that are attached to them.
local check = require "check"
local out = check.folder()
local mm, deg = units.mm, units.deg
local bot = robot.load("builtin:six_axis")
local rubber = rod.material{young = 5e6, poisson = 0.45, density = 1150}
local hose = rod.new{length = 1.5, section = rod.section{outer = 30*mm, inner = 20*mm, material = rubber}, segments = 24}

-- A hose from the forearm's back over the wrist to the hand.
local function cell()
  local s = scene.new{gravity = {0, 0, -9.81}}
  local arm = s:robot("arm", bot, {at = frame{at = {0, 0, 0.5}, along = {0, 0, 1}, up = {1, 0, 0}}, joints = {0, 0, 0, 0, 30*deg, 0}})
  s:obstacle("floor", scene.plane{}, {clearance = 20*mm})
  s:rod("hose", hose)
  s:attach("hose", "start", "arm", "link_3", frame{at = {0.1, 0, 0.4}, along = {1, 0, 0}})
  s:attach("hose", "finish", "arm", "link_6", frame{at = {0.05, 0, 0.25}, along = {1, 0, 0}})
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
  check.near(points[#points], hand.at + 0.05 * x + 0.25 * z, 1e-9)
  check.near((eq:force("hose", "start") + eq:force("hose", "finish")).z > 0 and 1 or 0, 1, 0)
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

check.finish()
