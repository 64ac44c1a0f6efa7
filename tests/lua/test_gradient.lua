-- eq:gradient: names, groups, tables, functions; derivatives against scenes solved anew.
local check = require "check"
local hose = require "sagging_hose"
local mm, deg = units.mm, units.deg

local function loaded()
  local s, p = hose.scene()
  p:load(0.4, {force = {0, 0.1, 0}})
  s:obstacle("pipe", scene.cylinder {radius = 40 * mm, length = 0.4}, {pose = frame {at = {0.25, 0, 0.45}, along = {0, 1, 0}}})
  return s, p
end

local s, p = loaded()
local eq = s:solve {tolerance = 1e-12}

check.case("by name, each against differences of scenes solved anew", function()
  local function solved(change)
    local t = scene.new {gravity = {0, 0, -9.81 + (change.gravity or 0)}}
    t:obstacle("pipe", scene.cylinder {radius = 40 * mm, length = 0.4}, {pose = frame {at = {0.25, 0, 0.45}, along = {0, 1, 0}}})
    local design = hose.design
    if change.length then design = design:with {length = 1.2 + change.length} end
    if change.young then
      local m = rod.material {young = hose.rubber.young + change.young, poisson = 0.49, density = 1150}
      design = design:with {section = rod.section {outer = 18 * mm, inner = 10 * mm, material = m}}
    end
    local to = frame {at = {0.8, 0, 1 + (change.z or 0)}, along = {1, 0, 0}}
    if change.turn then to = to:moved {turn = {vec(0, 1, 0), change.turn}} end
    local q = t:rod("hose", design, {from = hose.from, to = to})
    q:load(0.4 + (change.place or 0), {force = {0, 0.1 + (change.force or 0), 0}})
    return t:solve {tolerance = 1e-12}
  end
  local steps = {
    {"hose.length", "length", 1e-4}, {"gravity.z", "gravity", 1e-3}, {"hose.section.young", "young", 1e3},
    {"hose.to.at.z", "z", 1e-4}, {"hose.to.turn.y", "turn", 1e-4}, {"hose.load.1.force.y", "force", 1e-4},
    {"hose.load.1.place", "place", 1e-4},
  }
  local names = {}
  for i, step in ipairs(steps) do names[i] = step[1] end
  local measures = {
    ["hose.min_bend_radius"] = function(e) return e:rod("hose").min_bend_radius end,
    ["hose.max_tension"] = function(e) return e:rod("hose").max_tension end,
    ["hose.max_strain"] = function(e) return e:rod("hose").max_strain end,
    ["hose.length"] = function(e) return e:rod("hose").length end,
    ["hose.clearance"] = function(e) return e:clearance {}.value end,
    ["hose.energy.bend"] = function(e) return e.energy.bend end,
    ["hose.energy.total"] = function(e) return e.energy.total end,
    ["hose.from.force.z"] = function(e) return e:force("hose", "start").z end,
    ["hose.to.moment.y"] = function(e) return e:moment("hose", "finish").y end,
  }
  for name, value in pairs(measures) do
    local g = eq:gradient(name, names)
    check.is_true(g.ok)
    check.near(g.value, value(eq), 1e-9 * (1 + math.abs(g.value)), name)
    for _, step in ipairs(steps) do
      local more, less = solved {[step[2]] = step[3]}, solved {[step[2]] = -step[3]}
      local slope = (value(more) - value(less)) / (2 * step[3])
      check.near(g[step[1]], slope, 2e-4 * math.abs(slope) + 1e-7, name .. " by " .. step[1])
    end
  end
end)

check.case("groups, order and members", function()
  local g = eq:gradient("hose.min_bend_radius", {"hose.to", "gravity.z", "hose.from.at"})
  check.equal(#g.parameters, 10)
  check.equal(g.parameters[1], "hose.to.at.x")
  check.equal(g.parameters[7], "gravity.z")
  check.equal(g.measure, "hose.min_bend_radius")
  check.equal(g.unit, "m")
  check.equal(g.derivatives["gravity.z"], g["gravity.z"])
  check.contains(g, "hose.to.turn.x", "m/rad", "m/(m/s^2)", "gradient of hose.min_bend_radius")
  check.equal(#eq:gradient("hose.length", {"hose.section"}).parameters, 14)
  local all = eq:gradient("hose.length", {"hose", "gravity"})
  check.equal(#all.parameters, #eq.parameters)
  for _, name in ipairs(eq.measures) do check.is_true(eq:gradient(name, {"hose.length"}).ok, name) end
  check.raises(function() print(g["hose.lengt"]) end, "no member 'hose.lengt'")
end)

check.case("measures at a place", function()
  local by = {"hose.length", "hose.section.EI", "hose.to.at.z"}
  for _, what in ipairs {"position", "tangent", "force", "moment", "tension", "twist", "bend_radius", "rotation"} do
    check.is_true(eq:gradient({rod = "hose", what = what, at = 0.31, along = {0, 0, 1}}, by).ok, what)
  end
  local g = eq:gradient({rod = "hose", what = "position", at = 0.31, along = {0, 0, 1}}, by)
  check.near(g.value, eq:rod("hose"):at(0.31).at.z, 1e-9)
  check.near(eq:gradient({rod = "hose", what = "position", at = "finish"}, by)["hose.to.at.z"], 1, 1e-12)
  check.near(eq:gradient({rod = "hose", what = "position", at = "start"}, by)["hose.to.at.z"], 0, 1e-12)
  check.near(eq:gradient({rod = "hose", what = "clearance", to = "pipe"}, by)["hose.length"],
    eq:gradient("hose.clearance", by)["hose.length"], 1e-12)
end)

check.case("a function of an equilibrium, by differences", function()
  local by = {"hose.length", "hose.section.EI", "hose.to", "gravity.z", "hose.load.1"}
  local exact = eq:gradient("hose.min_bend_radius", by)
  local calls = 0
  local g = eq:gradient(function(e)
    calls = calls + 1
    return e:rod("hose").min_bend_radius
  end, by)
  check.equal(calls, 1 + 2 * #g.parameters)
  for _, name in ipairs(g.parameters) do check.near(g[name], exact[name], 1e-4 * math.abs(exact[name]) + 1e-6, name) end
  check.near(g.value, eq:rod("hose").min_bend_radius, 0)
end)

check.case("in contact", function()
  local t, q = hose.scene()
  t:obstacle("table", scene.plane {}, {pose = frame {at = {0, 0, 0.74}, along = {0, 0, 1}}})
  local lying = t:solve {}
  check.is_true(#lying.contacts > 0)
  local g = lying:gradient("hose.clearance", {"hose.length", "hose.section.EI"})
  check.is_true(g.ok)
  -- The hose rests on the table: a little more of it changes nothing there that the overlap of contact would not allow.
  check.near(g["hose.length"], 0, 0.05)
  local up = lying:gradient("hose.from.force.z", {"hose.section.mass", "hose.length"})
  check.is_true(up["hose.section.mass"] > 0)
end)

check.case("a measured section has no diameters to vary", function()
  local t = scene.new {gravity = {0, 0, -9.81}}
  local measured = rod.section {outer = 20 * mm, EA = 1e3, GA = 400, EI = 0.02, GJ = 0.01, mass = 0.2}
  t:rod("hose", rod.new {section = measured, length = 1}, {from = hose.from})
  local e = t:solve {}
  check.raises(function() e:gradient("hose.length", {"hose.section.outer"}) end, "belongs to a round section of one material")
  check.equal(#e:gradient("hose.length", {"hose.section"}).parameters, 11)
end)

check.case("what cannot be asked for", function()
  local by = {"hose.length"}
  check.raises(function() eq:gradient("hose.min_bend_raduis", by) end, "unknown measure", "did you mean 'hose.min_bend_radius'?")
  check.raises(function() eq:gradient("hose.bends", by) end, "'hose' goes on with: min_bend_radius", "clearance")
  check.raises(function() eq:gradient("hose.length", {"hose.lenght"}) end, "unknown parameter", "did you mean 'hose.length'?")
  check.raises(function() eq:gradient("hose.length", {"zzz"}) end, "they begin with: gravity, hose")
  check.raises(function() eq:gradient("hose.length", {5}) end, "equilibrium:gradient")
  check.raises(function() eq:gradient(5, by) end, "argument 1 (measure)", "a table {rod =, what =, at =, along =}")
  check.raises(function() eq:gradient({rod = "hose", what = "positoin", at = 0.6}, by) end, "did you mean 'position'?")
  check.raises(function() eq:gradient({rod = "hose", what = "position"}, by) end, "'at' is missing")
  check.raises(function() eq:gradient({rod = "hoes", what = "position", at = 0}, by) end, "did you mean 'hose'?")
  check.raises(function() eq:gradient({rod = "hose", what = "position", at = 2}, by) end, "lies outside 'hose' (0 to 1.2 m)")
  check.raises(function() eq:gradient({rod = "hose", what = "position", at = "end"}, by) end, "unknown place 'end'")
  check.raises(function() eq:gradient({rod = "hose", what = "clearance", to = "pope"}, by) end, "did you mean 'pipe'?")
  check.raises(function() eq:gradient(function() return "x" end, by) end, "the function returned a string ('x')")
  local bare = hose.scene()
  check.raises(function() bare:solve {}:gradient("hose.clearance", by) end, "unknown measure 'hose.clearance'")
  check.raises(function() bare:solve {element = "staggered"}:gradient("hose.length", by) end, "expected the se3 element")
end)

check.case("an equilibrium that is not one has no derivatives", function()
  local t = hose.scene()
  local stopped = t:solve {timeout = 1e-9}
  check.equal(stopped.ok, false)
  local g = stopped:gradient("hose.length", {"hose.length"})
  check.equal(g.ok, false)
  check.contains(g, "NOT VALID", "unknown")
  check.contains(g.message, "not solved")
  check.equal(stopped:gradient(function() return 1 end, {"hose.length"}).ok, false)
end)

check.finish()
