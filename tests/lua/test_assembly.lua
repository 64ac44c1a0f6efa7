-- method.assembly from a script; and its manipulations replayed by scene:motion, which shares none of its code but statics.
local check = dofile("tests/lua/check.lua")
local mm = units.mm
local folder = check.folder()

local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}
local hose = rod.section{outer = 16*mm, inner = 10*mm, material = rubber}

--- A hose past a post, 0.44 m between its ends.
local function past_post()
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:obstacle("post", scene.cylinder{radius = 30*mm, length = 0.4}, {pose = frame{at = {0, 0.06, 0}, along = {0, 0, 1}}})
  s:rod("hose", rod.new{length = 0.5, section = hose, segments = 20},
        {from = frame{at = {-0.22, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.22, 0, 0}, along = {1, 0, 0}}})
  return s
end

local function read(path)
  local file = assert(io.open(path))
  local text = file:read("a")
  file:close()
  return text
end


--- The scene with the hose held by all grips where they are at t = 0, moved along their paths; then those that are no connections
--- let go. Gives the motion and the last equilibrium.
local function replay(a, gravity, obstacles, length)
  local s = scene.new{gravity = gravity}
  obstacles(s)
  local p = s:rod("hose", rod.new{length = length, section = hose, segments = 20}, {})
  local holds = {}
  for i = 1, #a.paths do
    local path = a.paths[i]
    p:hold(path.s, path(0), {})
    holds[string.format("hose.%.17g", path.s)] = function(t) return path(t) end
  end
  local motion = s:motion{steps = 60, largest_move = 0.01, holds = holds}
  if not motion.ok then return motion end
  for i = 1, #a.paths do
    local path = a.paths[i]
    p:release(path.s)
    if path.connection then p:hold(path.s, path(1), {}) end
  end
  return motion, s:solve{from = motion.equilibria[#motion.equilibria]}
end

local s = past_post()
local a = method.assembly(s, {optimise = false})

check.case("a hose past a post can be installed, and the result says how", function()
  check.is_true(a.ok, a.message)
  check.equal(a.status, "solved")
  check.is_true(a.proof.ok)
  check.is_true(a.proof.steps > 3)
  check.is_true(a.proof.deviation <= 0.05 * 8*mm)
  check.equal(a.hands, #a.paths)
  check.is_true(#a.attempts >= 1)
  local last = a.attempts[#a.attempts]
  check.equal(last.outcome, "proven")
  check.equal(last.grips, #a.paths)
  check.is_true(last.seconds > 0)
  check.contains(tostring(last), last.handle, "grips: proven")
  check.is_true(a.worst.strain > 0 and a.worst.strain <= 0.3)
  check.equal(a.worst.where.strain, "hose")
  check.is_true(a.worst.when.strain >= 0 and a.worst.when.strain <= 1)
  check.contains(tostring(a), "hands", "deviation", "min bend radius")
end)

check.case("paths end where the hose is held, and begin elsewhere", function()
  check.near(a.paths["hose.start"](1).at, vec(-0.22, 0, 0), 1e-9)
  check.near(a.paths["hose.finish"](1).at, vec(0.22, 0, 0), 1e-9)
  check.near(a.paths["hose.start"](1).along, vec(1, 0, 0), 1e-9)
  check.is_true((a.paths["hose.start"](0).at - vec(-0.22, 0, 0)):length() > 0.1)
  check.equal(a.paths["hose.start"].connection, true)
  check.equal(a.paths["hose.finish"].s, 0.5)
  check.equal(#a.paths[1].times, #a.paths[1].frames)
  check.equal(a.paths[1].times[1], 0)
  check.equal(a.paths[1].times[#a.paths[1].times], 1)
  check.near(a.paths[1]:at(0.5).at, a.paths[1](0.5).at, 0)
end)

check.case("the state at t = 1 is the routed configuration, held by the connections alone", function()
  local routed, last = s:solve{}, a:frame(1)
  check.is_true(last.ok)
  local worst = 0
  for i = 0, 20 do
    local at = math.min(0.5, 0.025 * i)
    worst = math.max(worst, (routed:rod("hose"):at(at).at - last:rod("hose"):at(at).at):length())
  end
  check.is_true(worst < 0.5*mm, "deviation " .. worst)
  check.near(a:frame(0):rod("hose"):at(0).at, a.paths["hose.start"](0).at, 1e-6)
end)

check.case("replayed by scene:motion it ends in the routed configuration, and touches nothing too deep on the way", function()
  local motion, last = replay(a, {0, 0, -9.81}, function(world)
    world:obstacle("post", scene.cylinder{radius = 30*mm, length = 0.4}, {pose = frame{at = {0, 0.06, 0}, along = {0, 0, 1}}})
  end, 0.5)
  check.is_true(motion.ok, motion.message)
  check.equal(#motion.snaps, 0)
  check.is_true(last.ok)
  local routed = s:solve{}
  local worst = 0
  for i = 0, 20 do
    local at = math.min(0.5, 0.025 * i)
    worst = math.max(worst, (routed:rod("hose"):at(at).at - last:rod("hose"):at(at).at):length())
  end
  check.is_true(worst < 0.05 * 8*mm, "the replay ends " .. worst .. " m away")
  for _, gap in ipairs(motion:clearance{from = "hose"}) do check.is_true(gap.value > -0.02 * 8*mm) end
end)

check.case("files: every grip at every time", function()
  a:save(folder .. "/paths.csv")
  local text, rows = read(folder .. "/paths.csv"), 0
  for _ in text:gmatch("\n") do rows = rows + 1 end
  check.equal(rows, 1 + #a.paths * #a.paths[1].times)
  check.contains(text, "grip,t [s],x [mm]", "hose.start,0,", "hose.finish,1,220,")
  a:save(folder .. "/paths.json")
  check.contains(read(folder .. "/paths.json"), "\"duration\": 1", "\"name\": \"hose.start\", \"connection\": true")
  check.is_true(a:chart{}:save(folder .. "/chart.svg").ok)
  check.is_true(view.new{a, color = {0.2, 0.4, 0.7}}:save(folder .. "/strip.png", {frames = 4, size = {400, 300}, sheet = {"top"}}).ok)
end)

check.case("errors name what is wrong", function()
  check.raises(function() a:save("paths.txt") end, "assembly:save", "'paths.txt'", ".csv, .json or .glb")
  check.raises(function() a:frame(1.5) end, "assembly:frame", "1.5", "0 to 1")
  check.raises(function() a.paths[1](2) end, "grip_path", "0 to 1")
  check.raises(function() return a.paths["hose.begin"] end, "hose.begin")
  check.raises(function() method.assembly(s, {grip = "fork"}) end, "grip", "fork")
  check.raises(function() method.assembly(s, {rods = {"hoes"}}) end, "hoes", "hose")
  check.raises(function() method.assembly(s, {attempts = 0}) end, "attempts")
  check.raises(function() method.assembly(s, {connectors = {{name = "plug", rod = "hose"}}}) end, "'plug'", "'size' or 'shape'")
  check.raises(function() method.assembly(s, {connectors = {{name = "plug", rod = "hose", size = {0, 1, 1}}}}) end, "connectors")
  check.raises(function() method.assembly(scene.new{}, {}) end, "no rods")
end)

check.finish()
