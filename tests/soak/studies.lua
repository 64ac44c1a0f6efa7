-- Studies drawn at random, one of each kind. Each takes a random number generator and a folder, and fails where what it gets back is
-- no answer: a number that is not finite, a status that is none, an error that is no message.
local studies = {}

local mm = units.mm

--- Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014): the same studies for the same seed everywhere.
function studies.random(seed)
  local state = seed
  local function bits()
    state = state + 0x9E3779B97F4A7C15
    local z = state
    z = (z ~ (z >> 30)) * 0xBF58476D1CE4E5B9
    z = (z ~ (z >> 27)) * 0x94D049BB133111EB
    return z ~ (z >> 31)
  end
  local random = {}
  function random.between(low, high) return low + (high - low) * ((bits() >> 11) * 2.0 ^ -53) end
  function random.below(n) return (bits() >> 1) % n end
  function random.chance(share) return random.between(0, 1) < share end
  function random.one(list) return list[random.below(#list) + 1] end
  return random
end

local function finite(value, what)
  if value ~= value or value == math.huge or value == -math.huge then error(what .. " is " .. tostring(value), 2) end
  return value
end

--- A result is one, whatever came out.
local function judged(result, what)
  if type(result.ok) ~= "boolean" then error(what .. ": ok is no boolean", 2) end
  if type(result.status) ~= "string" or #result.status == 0 then error(what .. ": no status", 2) end
  if not result.ok and #tostring(result.message) == 0 then error(what .. ": failed without a message", 2) end
  finite(result.seconds, what .. ": seconds")
  return result
end

local function direction(random)
  return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1) + 1e-3}
end

local function section(random)
  local outer = random.between(4, 30) * mm
  return rod.section{outer = outer, inner = random.chance(0.5) and outer * random.between(0.1, 0.9) or nil,
                     material = rod.material{young = 10 ^ random.between(5.5, 9), poisson = random.between(0.1, 0.49), density = random.between(300, 3000)}}
end

local function obstacle(random)
  local kind = random.below(4)
  if kind == 0 then return scene.sphere{radius = random.between(0.01, 0.1)} end
  if kind == 1 then return scene.box{size = {random.between(0.02, 0.3), random.between(0.02, 0.3), random.between(0.02, 0.3)}} end
  if kind == 2 then return scene.cylinder{radius = random.between(0.01, 0.08), length = random.between(0.05, 0.5)} end
  return {points = {{-0.2, -0.2, 0}, {0.2, -0.2, 0}, {0.2, 0.2, random.between(0, 0.05)}, {-0.2, 0.2, 0}}, triangles = {{1, 2, 3}, {1, 3, 4}}}
end

--- A hose between two holds, perhaps under gravity and among obstacles.
local function hanging(random)
  local s = scene.new{gravity = random.chance(0.7) and {0, 0, -9.81} or nil}
  local length, share = random.between(0.2, 2), random.between(0.3, 0.97)
  local placed = s:rod("hose", rod.new{length = length, section = section(random), segments = 4 + random.below(30)},
                       {from = frame{at = {0, 0, 0}, along = direction(random)},
                        to = random.chance(0.9) and frame{at = {share * length, 0, random.between(-0.1, 0.1)}, along = direction(random)} or nil})
  for k = 1, random.below(4) do
    s:obstacle("body " .. k, obstacle(random), {clearance = random.chance(0.3) and random.between(0, 10) * mm or nil,
      pose = frame{at = {random.between(0, length), random.between(-0.2, 0.2), random.between(-0.5, -0.1)}, along = direction(random)}})
  end
  return s, placed, length
end

local function look_at(eq)
  if not eq.ok then return end
  local hose = eq:rod("hose")
  for i = 1, #hose.points do
    local p = hose.points[i]
    finite(p.x + p.y + p.z, "a point")
  end
  finite(hose.length, "length")
  finite(eq.residual, "residual")
  finite(eq.energy.total, "energy")
end

function studies.equilibrium(random)
  local s, placed, length = hanging(random)
  if random.chance(0.3) then placed:load(random.between(0, length), {force = direction(random)}) end
  local eq = judged(s:solve{modes = random.chance(0.1), error = random.chance(0.1)}, "solve")
  look_at(eq)
  assert(#tostring(eq) > 0 and #tostring(s:explain()) > 0)
  if eq.ok and random.chance(0.3) then
    look_at(judged(s:solve{from = eq}, "solve again"))
    eq:clearance{from = "hose"}
  end
end

function studies.variation(random)
  local s = hanging(random)
  local v = judged(method.variation(s, {outcomes = 1 + random.below(40), seed = random.below(1000), timeout = 2, threads = 1 + random.below(2),
    vary = {["hose.length"] = {tolerance = random.between(0.1, 20) * mm}}, measure = {"hose.min_bend_radius", low = function(eq)
      return finite(eq:rod("hose").points[1].z, "a measure")
    end}}), "variation")
  assert(#tostring(v) > 0)
end

local function past_post(random)
  local s = scene.new{}
  s:obstacle("post", scene.cylinder{radius = random.between(20, 60) * mm, length = 0.5}, {pose = frame{at = {0, random.between(-0.05, 0.05), 0}, along = {0, 0, 1}}})
  return s
end

function studies.route(random)
  local hose = section(random)
  local routes = judged(method.route(past_post(random), {from = frame{at = {-0.3, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.3, 0, 0}, along = {1, 0, 0}},
    section = hose, min_bend_radius = random.between(30, 90) * mm, clearance = random.between(0, 10) * mm, refine = random.chance(0.5),
    timeout = random.between(0.01, 2)}), "route")
  for i = 1, #routes do finite(routes[i].nominal_length, "length of a route") end
end

function studies.preform(random)
  local hoses = judged(method.preform(past_post(random), {from = frame{at = {-0.3, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.3, 0, 0}, along = {1, 0, 0}},
    outer = random.between(8, 25) * mm, min_bend_radius = random.between(30, 80) * mm, clearance = 2 * mm, max_bends = 1 + random.below(4),
    timeout = random.between(0.01, 2)}), "preform")
  for i = 1, #hoses do finite(hoses[i].length, "length of a hose") end
end

function studies.assembly(random)
  local s = past_post(random)
  s:rod("hose", rod.new{length = random.between(0.5, 0.7), section = section(random), segments = 16},
        {from = frame{at = {-0.22, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.22, 0, 0}, along = {1, 0, 0}}})
  judged(method.assembly(s, {rods = {"hose"}, timeout = random.between(0.01, 3)}), "assembly")
end

function studies.picture(random, folder)
  local s = hanging(random)
  local eq = s:solve{}
  local saved = view.new{s, eq, color = random.one{"curvature", "tension", "twist"}}:save(folder .. "/picture.png", {size = {160, 120}, sheet = {"iso"}})
  assert(saved.ok)
  local y = {}
  for i = 1, 20 do y[i] = random.between(-1, 1) end
  assert(study.chart{kind = "histogram", title = "random", series = {{name = "a", y = y}}}:save(folder .. "/chart.svg").ok)
end

function studies.saved(random, folder)
  local s = hanging(random)
  local eq = s:solve{}
  for _, suffix in ipairs{".stl", ".obj", ".ply", ".glb"} do
    local path = folder .. "/scene" .. suffix
    s:export(path, {equilibrium = eq})
    if suffix ~= ".glb" then assert(#scene.mesh(path, {unit = "m"}).triangles > 0) end
  end
end

function studies.robot(random)
  local bot = robot.load("builtin:six_axis")
  local q = {}
  for k = 1, 6 do q[k] = random.between(-1, 1) end
  local place = bot:link_frame("link_6", q)
  local found = bot:reaches(place, {near = q})
  finite(place.at.x + place.at.y + place.at.z, "a link")
  assert(found == nil or #found > 0)
  local text = bot:program({q, q}, {dialect = random.one{"rapid", "krl", "urscript", "ls", "csv"}})
  assert(#text > 0)
end

--- Wrong options end in an error with the line of this file.
function studies.errors(random)
  local odd = {0 / 0, math.huge, -1, 0, 1e308, 5e-324, "x", true, {}, print, {{}}, vec(1, 2, 3)}
  local attempts = {
    function(x) return rod.section{outer = x, material = x} end,
    function(x) return rod.new{length = 1, section = x, segments = x} end,
    function(x) return scene.new{gravity = x}:obstacle(x, x, x) end,
    function(x) return method.route(scene.new{}, {from = x, to = x, section = x}) end,
    function(x) return method.variation(scene.new{}, {vary = x, measure = x, outcomes = x}) end,
    function(x) return study.chart{kind = x, series = x} end,
    function(x) return frame{at = x, along = x, up = x} end,
    function(x) return scene.load(x) end,
    function(x) return curve.pcc{points = x, radius = x} end,
    function(x) return hanging(random):solve{[tostring(x)] = x} end,
  }
  local ok, message = pcall(random.one(attempts), random.one(odd))
  if not ok then assert(type(message) == "string" and message:find("studies.lua:%d+: "), message) end
end

--- Stopped at any point: a state, and the same scene still solves.
function studies.stopped(random)
  local s = hanging(random)
  local late = judged(s:solve{timeout = 10 ^ random.between(-7, -3), modes = true}, "stopped")
  look_at(late)
  look_at(judged(s:solve{}, "solve"))
end

return studies
