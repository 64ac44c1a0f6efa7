-- method.route and method.refine: what scripts give them and get from them. That the answers are right is tested in tests/unit/method.
local check = require "check"

local mm, deg = units.mm, units.deg
local rubber = rod.material{young = 6e6, poisson = 0.49, density = 1150}
local section = rod.section{outer = 20*mm, inner = 12*mm, material = rubber}

local function asked(more)
  local options = {
    from = frame{at = {-0.3, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.3, 0, 0}, along = {1, 0, 0}},
    section = section, min_bend_radius = 50*mm,
  }
  for k, v in pairs(more or {}) do options[k] = v end
  return options
end

local function scene_with_post()
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:obstacle("post", scene.cylinder{radius = 30*mm, length = 3}, {clearance = 5*mm})
  return s
end

check.case("around a post: nominal route, design, equilibrium", function()
  local s = scene_with_post()
  local routes = method.route(s, asked{preformed = true, end_straight = 20*mm})
  check.is_true(routes.ok, routes.message)
  check.equal(routes.status, "solved")
  check.equal(#routes, 1)
  local names = {}
  for i, step in ipairs(routes.steps) do names[i] = step.name end
  check.equal(table.concat(names, " "), "distance_field nominal_routing local_refinement")
  local route = routes[1]
  check.is_true(route.ok)
  check.is_true(route.nominal_length > 0.6 and route.nominal_length < 0.7)
  check.near(route.nominal.length, route.nominal_length, 1e-9)
  check.is_true(route.nominal:min_bend_radius() >= 50*mm - 1e-9)
  check.is_true(route.min_bend_radius >= 50*mm - 1e-6)
  check.is_true(route.refined.clearance >= 5*mm - 1e-5)
  check.is_true(route.refined.min_bend_radius_at >= 0 and route.refined.min_bend_radius_at <= route.length)
  local solid = route.mesh
  check.is_true(solid.watertight)
  check.near(solid.volume, math.pi * (10*mm)^2 * route.refined.settled_length, 0.01 * solid.volume)
  check.equal(route.equilibrium.ok, true)
  -- The design placed and solved by hand comes to rest in the same state.
  s:rod("hose", route.rod, {from = route.from, to = route.to})
  local eq = s:solve{from = nil}
  check.is_true(eq.ok)
  check.near(route.equilibrium:rod("route").length, route.refined.settled_length, 1e-9)
  check.contains(tostring(routes), "routes", "kept")
  check.contains(tostring(route), "route 1", "nominal length")
  check.contains(tostring(route.refined), "refined design", "clearance")
end)

check.case("weights: alternatives with more and more clearance", function()
  local routes = method.route(scene_with_post(), asked{
    weights = {{length = 1, clearance = 0}, {length = 1, clearance = 4}}, refine = false, keep_in = {{-0.5, -0.3, -0.3}, {0.5, 0.3, 0.3}}})
  check.is_true(routes.ok, routes.message)
  check.equal(#routes, 2)
  check.equal(routes[1].weights.clearance, 0.0)
  check.is_true(routes[2].nominal_length > routes[1].nominal_length)
  check.equal(routes[1].equilibrium, nil)
  local path = os.tmpname() .. ".png"
  view.new{scene_with_post(), routes}:save(path, {size = {320, 240}, sheet = {"iso"}})
  os.remove(path)
end)

check.case("the front: no alternative is beaten in both length and clearance; its chart", function()
  local routes = method.route(scene_with_post(), asked{
    weights = {{clearance = 0}, {clearance = 0.3}, {clearance = 1}, {clearance = 4}}, refine = false, preformed = true, end_straight = 20*mm})
  check.is_true(routes.ok, routes.message)
  local front = routes.front
  check.is_true(#front >= 3)
  for i = 2, #front do
    check.is_true(front[i].length > front[i - 1].length)
    check.is_true(front[i].clearance > front[i - 1].clearance)
    check.is_true(front[i].preference > 0)
  end
  check.near(front[1].preference, 0, 1e-12)
  check.near(front[1].clearance, 5*mm, 0.1*mm)
  check.contains(tostring(front[1].clearance), "post")
  local path = os.tmpname() .. ".svg"
  routes:chart{title = "What clearance costs"}:save(path)
  local file = assert(io.open(path))
  local text = file:read("a")
  file:close()
  os.remove(path)
  check.contains(text, "What clearance costs", "weight 4", "length [mm]")
  check.raises(function() method.route(scene.new{}, asked{refine = false}):chart() end, "routes:chart", "no route")
end)

check.case("several objects: each an obstacle for the next", function()
  local s = scene.new{}
  local function one(name, along, more)
    local object = {name = name, from = frame{at = -0.2 * along, along = along}, to = frame{at = 0.2 * along, along = along}}
    for k, v in pairs(more or {}) do object[k] = v end
    return object
  end
  local function all(more)
    local options = {section = section, min_bend_radius = 50*mm, clearance = 3*mm, preformed = true, end_straight = 10*mm}
    for k, v in pairs(more) do options[k] = v end
    return method.route_all(s, options)
  end
  local set = all{one("feed", vec(1, 0, 0)), one("return", vec(0, 1, 0), {apart = 8*mm})}
  check.is_true(set.ok, set.message)
  check.equal(#set, 2)
  check.equal(set[1].name, "feed")
  check.near(set[1].route.length, 0.4, 1e-6)
  check.is_true(set[2].route.length > 0.4)
  check.near(set[2].route.clearance, 8*mm, 0.1*mm)
  check.contains(tostring(set[2].route.clearance), "feed")
  check.equal(#set[2].routes, 1)
  check.equal(set.steps[2].name, "return")
  check.contains(tostring(set), "feed", "return", "kept")
  check.is_true(set:scene():solve().ok)
  local path = os.tmpname() .. ".png"
  local placed = set:scene()
  view.new{placed, placed:solve()}:save(path, {size = {320, 240}, sheet = {"iso"}})
  os.remove(path)

  local boxed = all{one("feed", vec(1, 0, 0)), one("return", vec(0, 1, 0), {keep_in = {{-1, -1, -12*mm}, {1, 1, 12*mm}}}), refine = false}
  check.equal(boxed.status, "infeasible")
  check.contains(boxed.message, "'return'", "another order")
  check.equal(#boxed, 2)
  check.equal(boxed[2].route, nil)
  check.raises(function() all{one("feed", vec(1, 0, 0)), one("feed", vec(0, 1, 0))} end, "feed", "a name of its own")
  check.raises(function() all{{name = "a", from = frame{at = {0, 0, 0}, along = {1, 0, 0}}}} end, "object 1", "missing option 'to'")
  check.raises(function() all{one("a", vec(1, 0, 0), {timeout = 1})} end, "object 1", "unknown option", "timeout")
  check.raises(function() all{} end, "no objects")
  check.equal(all{one("a", vec(1, 0, 0)), timeout = 1e-9}.status, "timeout")
end)

check.case("straight without load, or preformed; what gravity makes of it is said", function()
  local formed = method.route(scene_with_post(), asked{preformed = true, refine = false})
  check.is_true(formed.ok, formed.message)
  check.near(formed[1].rod.shape.length, formed[1].nominal_length, 1e-9)
  check.near(formed[1].rod.length, formed[1].length, 1e-12)
  -- A soft hose by the metre does not stay bent around a post: it leans on it.
  local leaning = method.route(scene_with_post(), asked{restarts = 0})
  check.equal(leaning.status, "infeasible")
  check.equal(leaning[1].rod.shape, nil)
  check.contains(leaning.message, "post", "5 mm required")
end)

check.case("infeasible: the widest passage is named; time runs out", function()
  local s = scene.new{}
  s:obstacle("wall", scene.box{size = {10*mm, 4, 4}})
  local routes = method.route(s, asked{keep_in = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}})
  check.is_true(not routes.ok)
  check.equal(routes.status, "infeasible")
  check.contains(routes.message, "wall")
  check.raises(function() view.new{s, routes} end, "view.new", "no routes")
  local late = method.route(scene_with_post(), asked{timeout = 1e-9})
  check.equal(late.status, "timeout")
end)

check.case("refine: a hose over a floor keeps its clearance, by both solvers alike", function()
  local s = scene.new{gravity = {0, 0, -9.81}}
  s:obstacle("floor", scene.box{size = {4, 4, 0.1}}, {pose = frame{at = {0, 0, -0.25}, along = {0, 0, 1}}})
  local hose = rod.new{length = 0.6, section = section}
  local function refined(solver)
    return method.refine(s, {rod = hose, from = frame{at = {0, 0, 0}, along = {0, 0, -1}, up = {0, 1, 0}}, to = frame{at = {0.3, 0, 0}, along = {0, 0, 1}, up = {0, 1, 0}},
                             min_bend_radius = 60*mm, clearance = 20*mm, solver = solver})
  end
  local gradient, free = refined("gradient"), refined("gradient_free")
  check.is_true(gradient.ok, gradient.message)
  check.is_true(free.ok, free.message)
  check.near(gradient.objective, free.objective, 2e-4)
  check.is_true(gradient.evaluations < free.evaluations)
  check.is_true(gradient.clearance >= 20*mm - 1e-5)
  check.is_true(gradient.min_bend_radius >= 60*mm * (1 - 1e-6))
  check.equal(gradient.adjusted[1].name, "length")
  check.near(gradient.adjusted[1].before, 0.6, 1e-12)
  check.near(gradient.adjusted[1].after, gradient.rod.length, 1e-12)
  check.contains(tostring(gradient.adjusted[1]), "length", "->")
end)

check.case("refine: what cannot be kept is said", function()
  local s = scene.new{gravity = {0, 0, -9.81}}
  local r = method.refine(s, {rod = rod.new{length = 1, section = section}, min_bend_radius = 0.5,
                              from = frame{at = {0, 0, 0}, along = {0, 0, -1}, up = {0, 1, 0}}, to = frame{at = {0.3, 0, 0}, along = {0, 0, 1}, up = {0, 1, 0}}})
  check.is_true(not r.ok)
  check.equal(r.status, "infeasible")
  check.contains(r.message, "bend radius")
  check.equal(r.unmet[1].demanded, 0.5)
  check.is_true(r.unmet[1].value < 0.5)
  check.contains(tostring(r.unmet[1]), "bend radius")
end)

check.case("what makes no sense is refused at the caller's line", function()
  local s = scene.new{}
  local function raises(more, ...)
    local words = {...}
    check.raises(function() method.route(s, asked(more)) end, table.unpack(words))
  end
  raises({section = false, outer = 20*mm}, "method.route", "section")
  raises({min_bend_radius = 5*mm}, "bend radius", "own radius")
  raises({weights = {length = 0}}, "weight of length")
  raises({weights = {speed = 1}}, "'weights'", "speed")
  raises({adjust = {"lenght"}}, "adjust", "lenght", "length")
  raises({grid = 1e-5}, "grid")
  raises({solver = "magic"}, "solver", "gradient")
  raises({to = frame{at = {-0.3, 0, 0}, along = {1, 0, 0}}}, "one place")
end)

check.finish()
