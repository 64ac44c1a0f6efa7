-- robot: links and joints, kinematics both ways, collision, the surroundings of a scene.
local check = require "check"
local out = check.folder()
local bot = robot.load("builtin:six_axis")
local home = {0, 0, 0, 0, 0, 0}

local function write(path, text)
  local file = assert(io.open(path, "w"))
  file:write(text)
  file:close()
end

check.case("what a robot is made of", function()
  check.equal(bot.name, "six_axis")
  check.equal(#bot.joints, 6)
  check.equal(bot.joints[2].name, "joint_2")
  check.equal(bot.joints[2].kind, "revolute")
  check.equal(bot.joints[2].link, "link_2")
  check.near(bot.joints[2].lower, -65 * units.deg, 1e-12)
  check.near(bot.joints[2].upper, 85 * units.deg, 1e-12)
  check.near(bot.joints[2].velocity, 95 * units.deg, 1e-12)
  check.equal(bot.links[1], "base")
  check.equal(#bot.links, 8)
  check.equal(bot.tip, "flange")
  check.contains(bot, "six_axis", "joint_6", "-360 deg ... 360 deg", "220 deg/s")
  check.contains(bot.joints[1], "joint_1", "revolute", "110 deg/s")
end)

check.case("forward kinematics and its derivatives", function()
  local f = bot:link_frame("flange", home)
  check.near(f.at, vec(1.665, 0, 2.015), 1e-12)
  check.near(f.along, vec(1, 0, 0), 1e-12)
  check.near(bot:link_frame("flange", {math.pi / 2, 0, 0, 0, 0, 0}).at, vec(0, 1.665, 2.015), 1e-12)
  local q, h = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, 1e-6
  local J, here = bot:jacobian("link_6", q), bot:link_frame("link_6", q)
  local x, z = here.up, here.along
  local y = z:cross(x)
  check.equal(#J, 6)
  for k = 1, 6 do
    local moved = {table.unpack(q)}
    moved[k] = q[k] + h
    local ahead = bot:link_frame("link_6", moved).at
    moved[k] = q[k] - h
    local step = (ahead - bot:link_frame("link_6", moved).at) / (2 * h)
    check.near(vec(J[1][k], J[2][k], J[3][k]), vec(step:dot(x), step:dot(y), step:dot(z)), 1e-8)
  end
end)

check.case("inverse kinematics", function()
  local q = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}
  local f = bot:link_frame("flange", q)
  local all, note = bot:reaches(f, {near = q})
  check.equal(note, nil)
  check.is_true(#all >= 4)
  for k = 1, 6 do check.near(all[1][k], q[k], 1e-9) end
  for _, solution in ipairs(all) do
    local there = bot:link_frame("flange", solution)
    check.near(there.at, f.at, 1e-9)
    check.near(there.along, f.along, 1e-9)
    check.near(there.up, f.up, 1e-9)
    check.is_true(bot:within_limits(solution))
  end
  check.is_true(#bot:reaches(f, {turns = false}) <= 8)
  check.is_true(#bot:reaches(f, {limits = false}) >= #bot:reaches(f, {turns = false}))
  local none, why = bot:reaches(frame{at = {5, 0, 1}, along = {0, 0, -1}})
  check.equal(none, nil)
  check.contains(why, "wrist centre", "the arm reaches")
  local wrist, free = bot:reaches(bot:link_frame("flange", home), {near = {0, 0, 0, 0.7, 0, 0}})
  check.near(wrist[1][4], 0.7, 1e-12)
  check.contains(free, "'joint_4' is free")
  -- A link in the middle has fewer joints: by search.
  local elbow = bot:reaches(bot:link_frame("link_3", q), {link = "link_3", starts = 20})
  check.near(elbow[1][3], 0.3, 1e-6)
  check.equal(elbow[1][6], 0.0)
end)

check.case("limits", function()
  local good, text = bot:within_limits(home)
  check.equal(good, true)
  check.equal(text, nil)
  good, text = bot:within_limits({0, 2, 0, 0, 0, 0})
  check.equal(good, false)
  check.contains(text, "'joint_2' at 2", "1.48353")
end)

check.case("collision with itself and with a scene", function()
  check.equal(#bot:collides(home), 0)
  local folded = {0, -65 * units.deg, -100 * units.deg, 0, 0.3, 0}
  local pairs_there = bot:collides(folded)
  check.equal(#pairs_there, 1)
  check.equal(table.concat(pairs_there[1], " "), "link_1 link_3")
  local kinds = {}
  for _, pair in ipairs(bot:pairs()) do kinds[pair[1] .. " " .. pair[2]] = pair[3] end
  check.equal(kinds["link_2 link_3"], "neighbours")
  check.equal(kinds["link_1 link_3"], "checked")
  check.equal(kinds["link_2 link_4"], "never")

  local s = scene.new{}
  s:obstacle("floor", scene.plane{})
  s:obstacle("post", scene.box{size = {0.1, 0.3, 3}}, {pose = frame{at = {1.5, 0, 1.5}, along = {0, 0, 1}}})
  local touching = bot:collides(home, {scene = s})
  check.equal(#touching, 2)
  for _, pair in ipairs(touching) do check.equal(pair[2], "post") end
  check.equal(#bot:collides({0.5, 0, 0, 0, 0, 0}, {scene = s}), 0)
  -- Moved with its base, it is as it was.
  local moved = scene.new{}
  moved:obstacle("post", scene.box{size = {0.1, 0.3, 3}}, {pose = frame{at = {2.5, 1, 1.5}, along = {0, 0, 1}}})
  check.equal(#bot:collides(home, {scene = moved}), 0)
  check.equal(#bot:collides(home, {scene = moved, at = frame{at = {1, 1, 0}, along = {0, 0, 1}, up = {1, 0, 0}}}), 2)
  -- A link as an obstacle to another robot.
  local other = scene.new{}
  other:obstacle("arm", bot:mesh("link_2"), {pose = frame{at = {1.2, -0.23, 1.5}, along = {0, 0, 1}, up = {1, 0, 0}}})
  check.is_true(#bot:collides(home, {scene = other}) > 0)
end)

check.case("a robot of one's own", function()
  os.execute("mkdir -p '" .. out .. "'")
  bot:mesh("link_6"):save(out .. "/hand.stl")
  local path = out .. "/one.urdf"
  write(path, [[<robot name="one"><link name="post"><collision><geometry><cylinder radius="0.1" length="1"/></geometry></collision></link>
    <link name="arm"><visual><geometry><mesh filename="hand.stl"/></geometry></visual></link>
    <joint name="turn" type="continuous"><parent link="post"/><child link="arm"/><origin xyz="0 0 0.5"/><axis xyz="0 0 1"/></joint></robot>]])
  local one = robot.load(path)
  check.equal(one.joints[1].kind, "continuous")
  check.equal(one.joints[1].upper, math.huge)
  check.equal(one.joints[1].velocity, math.huge)
  check.contains(one, "endless")
  check.near(one:mesh("arm").volume, bot:mesh("link_6").volume, 1e-12)
  check.near(one:mesh("post").volume, 0.01 * math.pi, 2e-4)
  check.equal(#one:collides({1}), 0)
end)

check.case("programs there and back", function()
  os.execute("mkdir -p '" .. out .. "'")
  local path = {{0, 0, 0, 0, 0.5, 0}, {0.4, 0.2, -0.3, 0.1, 0.5, 1}, {-0.4, 0.1, 0.2, 0.3, -0.5, 2}}
  local files = {rapid = "weld.mod", krl = "weld.src", urscript = "weld.script", ls = "weld.ls", csv = "weld.csv"}
  for dialect, file in pairs(files) do
    local text = bot:program(path, {dialect = dialect, name = "weld", speed = 0.3, zone = 0.01})
    write(out .. "/" .. file, text)
    local back = bot:read_program(out .. "/" .. file)
    check.equal(#back, 3)
    for i = 1, 3 do
      for k = 1, 6 do check.near(back[i][k], path[i][k], 2e-6, dialect) end
    end
  end
  check.contains(bot:program(path, {dialect = "rapid", name = "weld"}), "MODULE weld", "MoveAbsJ p3", "fine")
  -- Maps of one's own: a controller that counts the fifth axis the other way, from 90 degrees on.
  local map = {dialect = "csv", sign = {1, 1, 1, 1, -1, 1}, zero = {0, 0, 0, 0, math.pi / 2, 0}}
  check.contains(bot:program({{0, 0, 0, 0, math.pi / 6, 0}}, map), "60.0000000")
  write(out .. "/mapped.csv", bot:program(path, map))
  local mapped = bot:read_program(out .. "/mapped.csv", {sign = map.sign, zero = map.zero})
  check.near(mapped[2][5], 0.5, 1e-9)
  write(out .. "/rad.csv", "0.1 0.2 0.3 0.4 0.5 0.6")
  check.equal(bot:read_program(out .. "/rad.csv", {unit = "rad"})[1][6], 0.6)
  check.raises(function() bot:program(path, {dialect = "karel"}) end, "'dialect'", "'ls'")
  check.raises(function() bot:program({}, {dialect = "ls"}) end, "no points")
  check.raises(function() bot:program({{0, 3, 0, 0, 0, 0}}, {dialect = "ls"}) end, "point 1", "joint_2")
  check.raises(function() bot:program(path, {dialect = "ls", sign = {1, 1}}) end, "got 2 signs")
  check.raises(function() bot:read_program(out .. "/none.ls") end, "no such file")
  check.raises(function() bot:read_program(out .. "/none.doc") end, "'.doc' are not known")
end)

check.case("mistakes", function()
  check.raises(function() robot.load("builtin:six") end, "no builtin robot 'six'")
  check.raises(function() robot.load("none.urdf") end, "none.urdf", "no such file")
  write(out .. "/broken.urdf", "<robot name='x'>\n<link name='a'>\n</robot>")
  check.raises(function() robot.load(out .. "/broken.urdf") end, "broken.urdf:3", "XML")
  check.raises(function() bot:link_frame("flang", home) end, "did you mean 'flange'")
  check.raises(function() bot:link_frame("flange", {0, 0}) end, "got 2 joint values, expected 6")
  check.raises(function() bot:link_frame("flange", {0, 0, 0, 0, 0, 0 / 0}) end, "finite")
  check.raises(function() bot:reaches(home) end, "robot:reaches", "expected a frame")
  check.raises(function() bot:reaches(bot:link_frame("flange", home), {near = {1}}) end, "near")
  check.raises(function() bot:reaches(bot:link_frame("flange", home), {near = home, start = 3}) end, "did you mean 'starts'")
  check.raises(function() bot:collides(home, {at = frame{at = {0, 0, 0}, along = {0, 0, 1}}}) end, "'at' needs a 'scene'")
  check.raises(function() bot:mesh("flange") end, "has no body")
end)

check.finish()
