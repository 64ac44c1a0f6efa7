-- equilibrium: measures, reactions, energies, errors, invariances.
local check = require "check"
local hose = require "sagging_hose"
local mm, deg = units.mm, units.deg

local s = hose.scene()
s:obstacle("floor", scene.plane {}, {clearance = 8 * mm, pose = frame {at = {0, 0, 0.3}, along = {0, 0, 1}}})
s:obstacle("roof", scene.box {size = {2, 2, 0.1}}, {pose = frame {at = {0.4, 0, 1.55}, along = {0, 0, 1}}})
local eq = s:solve {error = true}
local weight = hose.design.mass * 9.81

check.case("how it went", function()
  check.is_true(eq.ok)
  check.equal(eq.status, "solved")
  check.equal(eq.message, "solved")
  check.is_true(eq.stable)
  check.is_true(eq.seconds > 0 and eq.seconds < 60)
  check.is_true(eq.iterations >= 2 and eq.iterations < 50)
  local steps = eq.convergence
  check.is_true(#steps >= 2 and #steps <= eq.iterations)
  for i, step in ipairs(steps) do check.is_true(step >= 0 and step < math.huge) end
  check.is_true(steps[#steps] < 1e-6 and steps[1] > 1e3 * steps[#steps])
  check.contains(eq, "convergence", "steps of Newton's method")
  check.is_true(eq.residual < 1e-6)
  check.equal(eq.deepest_penetration, 0.0)
  check.contains(eq, "solved, stable", "min bend radius", "'floor'", "required 8 mm")
end)

check.case("the supports carry the weight, each half of it", function()
  local a, b = eq:force("hose", "start"), eq:force("hose", "finish")
  check.near(a + b, vec(0, 0, weight), 1e-7)
  check.near(a.z, weight / 2, 1e-6)
  check.near(eq:moment("hose", "start").y, -eq:moment("hose", "finish").y, 1e-6)
  check.near(eq:force("hose", 0), a, 0)
  check.raises(function() eq:force("hose", 0.5) end, "not held at 0.5 m", "start, finish")
  check.raises(function() eq:force("hoes", "start") end, "did you mean 'hose'?")
  check.raises(function() eq:moment("hose", "end") end, "unknown place 'end'")
end)

check.case("energies have their signs and sum", function()
  local e = eq.energy
  check.is_true(e.bend > 0 and e.stretch > 0 and e.shear > 0 and e.gravity > 0)
  check.equal(e.contact, 0.0)
  check.equal(e.load, 0.0)
  check.near(e.twist, 0, 1e-12)
  check.near(e.total, e.bend + e.twist + e.stretch + e.shear + e.gravity + e.contact + e.load, 1e-15)
  check.contains(e, "bend", "mJ")
end)

check.case("the rod in it", function()
  local r = eq:rod("hose")
  check.equal(#r.points, 41)
  check.equal(#r.frames, 41)
  check.equal(#r.bend_radius, 41)
  check.equal(#r.tension, 40)
  check.near(r.points[1], vec(0, 0, 1), 1e-12)
  check.near(r.frames[41].along, vec(1, 0, 0), 1e-12)
  check.near(r:at(0.6).at, r.points[21], 1e-12)
  check.near(r.length, 1.2, 0.01)
  local least = math.huge
  for _, radius in ipairs(r.bend_radius) do least = math.min(least, radius) end
  check.near(r.min_bend_radius, least, 0)
  check.is_true(least > 0.05 and least < 0.2)
  check.is_true(r.max_tension > 0 and r.max_tension < weight)
  check.is_true(r.max_strain > 0.03 and r.max_strain < 0.2)
  check.is_true(r.ok)
  check.equal(r.design.length, 1.2)
  check.raises(function() r:at(2) end, "solved_rod:at", "0 to 1.2")
  check.raises(function() eq:rod("hoes") end, "did you mean 'hose'?")
  check.raises(function() print(r.pionts) end, "points")
end)

check.case("a clearance computes as a number", function()
  local c = eq:clearance {from = "hose"}
  local lowest = math.huge
  for i = 0, 20000 do lowest = math.min(lowest, eq:rod("hose"):at(1.2 * i / 20000).at.z) end
  check.near(c.value, lowest - 9 * mm - 0.3, 1e-9)
  check.near(c / mm, c.value / mm, 0)
  check.near(c + 1, 1 + c, 0)
  check.near(2 * c, c * 2, 0)
  check.near(c - c, 0, 0)
  check.near(-c, -c.value, 0)
  check.near(1 / c, 1 / c.value, 0)
  check.near(c ^ 2, c.value ^ 2, 0)
  check.is_true(c > 5 * mm)
  check.is_true(c <= c)
  check.is_true(1 * mm < c)
  check.equal(c < 0, false)
  check.equal(c.on, "floor")
  check.near(c.s, 0.6, 1e-5)
  check.near(c.at.x, 0.4, 1e-6)
  check.near(c.point, vec(c.at.x, c.at.y, 0.3), 1e-9)
  check.equal(c.required, 8 * mm)
  check.is_true(c.ok)
  check.contains(c, "'floor'", "mm")
  check.near(eq:rod("hose").clearance, c, 0)
  check.near(eq:clearance {}, c, 0)
  check.near(eq:clearance {from = "hose", to = "floor"}, c, 0)
  local roof = eq:clearance {from = "hose", to = "roof"}
  check.near(roof, 1.5 - 1 - 9 * mm, 1e-6)
  check.equal(roof.on, "roof")
  check.raises(function() eq:clearance {from = "hose", to = "flor"} end, "did you mean 'floor'?")
  check.raises(function() eq:clearance {form = "hose"} end, "did you mean 'from'?")
end)

check.case("without obstacles there is no clearance to name", function()
  local c = hose.scene():solve {}:clearance {from = "hose"}
  check.equal(c.value, math.huge)
  check.equal(c.on, nil)
  check.is_true(c.ok)
  check.contains(c, "no obstacle")
end)

check.case("the estimated error", function()
  check.is_true(eq.error.valid)
  check.near(eq.error / mm, eq.error.value / mm, 0)
  check.is_true(eq.error < 0.1 * mm and eq.error > 0)
  check.equal(hose.scene():solve {}.error, nil)
  local coarse, fine = hose.scene(), hose.scene()
  local a = coarse:solve {element = "staggered", error = true}
  check.is_true(a.error > 10 * eq.error)
end)

check.case("a rod that lies on the floor", function()
  local t, p = hose.scene()
  t:obstacle("table", scene.plane {}, {pose = frame {at = {0, 0, 0.75}, along = {0, 0, 1}}})
  local lying = t:solve {}
  check.is_true(lying.ok)
  check.is_true(#lying.contacts > 0)
  local carried = lying:force("hose", "start") + lying:force("hose", "finish")
  for _, contact in ipairs(lying.contacts) do
    carried = carried + contact.force
    check.equal(contact.on, "table")
    check.equal(contact.rod, "hose")
    check.is_true(contact.force.z > 0)
    check.is_true(contact.gap < 0.1 * mm)
    check.near(contact.at.z, 0.759, 1e-4)
  end
  check.near(carried, vec(0, 0, weight), 1e-5)
  check.is_true(lying:clearance {} > -0.05 * mm)
  check.is_true(lying.energy.contact >= 0)
  check.contains(lying.contacts[1], "'table'")
  check.near(lying.deepest_penetration, math.max(0, -lying:clearance {}.value), 1e-5)
end)

check.case("a clearance that is judged, or kept", function()
  local t = hose.scene()
  t:obstacle("table", scene.plane {}, {clearance = 12 * mm, pose = frame {at = {0, 0, 0.75}, along = {0, 0, 1}}})
  t:obstacle("post", scene.sphere {radius = 20 * mm}, {clearance = 5 * mm, pose = frame {at = {0.4, 0, 0.75}, along = {0, 0, 1}}})
  local judged, kept = t:solve {}, t:solve {clearance = "push"}
  check.is_true(judged.ok and kept.ok)
  check.equal(judged:clearance {to = "table"}.ok, false)
  check.near(judged:rod("hose").min_bend_radius, t:solve {clearance = "judge"}:rod("hose").min_bend_radius, 0)
  for name, required in pairs {table = 12 * mm, post = 5 * mm} do
    check.is_true(kept:clearance {to = name} > required - 0.01 * mm)
  end
  check.near(kept:clearance {to = "table"}, 12 * mm, 0.01 * mm)
  local carried = kept:force("hose", "start") + kept:force("hose", "finish")
  for _, contact in ipairs(kept.contacts) do
    carried = carried + contact.force
    check.is_true(contact.gap > 4.9 * mm)
  end
  check.near(carried, vec(0, 0, weight), 1e-5)
  check.equal(t:explain():uses("kept clearance"), false)
  check.is_true(t:explain {clearance = "push"}:uses("kept clearance"))
  check.contains(t:explain {clearance = "push"}, "up to 12 mm off")
  check.raises(function() t:solve {clearance = "pull"} end, "'clearance'", "judge", "push")
end)

check.case("a start across a sheet is led around it; where there is no way around, the place is told", function()
  local t, p = hose.scene()
  local at = hose.scene():solve {}:rod("hose").points[21]
  local function plate(half)
    return {points = {{0, -half, -half}, {0, half, -half}, {0, half, half}, {0, -half, half}}, triangles = {{1, 2, 3}, {1, 3, 4}}}
  end
  t:obstacle("plate", plate(0.03), {pose = frame {at = at, along = {0, 0, 1}}})
  local free = t:solve {}
  check.is_true(free.ok)
  check.is_true(free:clearance {} > -0.1 * mm)
  t:remove("plate")
  t:obstacle("wall", plate(9), {pose = frame {at = at, along = {0, 0, 1}}})
  local stuck = t:solve {}
  check.equal(stuck.ok, false)
  check.equal(stuck.status, "stalled")
  check.contains(stuck.message, "hose", "crosses obstacle 'wall' at s = ", "(")
end)

check.case("turning the world turns the answer", function()
  local turned = scene.new {gravity = vec(0, 9.81, 0)}
  local function moved(f) return frame {at = {f.at.x, -f.at.z, f.at.y}, along = {f.along.x, -f.along.z, f.along.y}, up = {f.up.x, -f.up.z, f.up.y}} end
  turned:rod("hose", hose.design, {from = moved(hose.from), to = moved(hose.to)})
  local other = turned:solve {}
  for i, point in ipairs(eq:rod("hose").points) do
    check.near(other:rod("hose").points[i], vec(point.x, -point.z, point.y), 1e-8)
  end
end)

check.case("a warm start needs no more steps, and old equilibria stay", function()
  local t, p = hose.scene()
  local first = t:solve {}
  p:release("finish"):hold("finish", frame {at = {0.81, 0, 1}, along = {1, 0, 0}})
  local cold, warm = t:solve {}, t:solve {from = first}
  check.is_true(warm.ok)
  check.is_true(warm.iterations <= cold.iterations)
  check.near(warm:rod("hose").points[21], cold:rod("hose").points[21], 1e-7)
  check.near(first:rod("hose").points[41].x, 0.8, 1e-12)
end)

check.case("extra turns twist the rod", function()
  local t, p = hose.scene()
  p:hold("finish", hose.to, {turns = 1})
  local twisted = t:solve {}
  check.is_true(twisted.ok)
  local total = 0
  for _, twist in ipairs(twisted:rod("hose").twist) do total = total + twist * 1.2 / 40 end
  check.is_true(math.abs(total) > 0.5)
  check.is_true(twisted.energy.twist > 0)
  check.near(eq.energy.twist, 0, 1e-12)
end)

check.case("a tip load on a cantilever without gravity", function()
  local t = scene.new {}
  local p = t:rod("bar", hose.design, {from = hose.from})
  p:load("finish", {force = {0, 0, -0.001}})
  local bent = t:solve {}
  local EI, GA = hose.tube.EI1, hose.tube.GA1
  check.near(bent:rod("bar").points[41].z, 1 - 0.001 * (1.2 ^ 3 / (3 * EI) + 1.2 / GA), 1e-5)
  check.near(bent:force("bar", "start"), vec(0, 0, 0.001), 1e-10)
  check.near(bent:moment("bar", "start").y, -0.001 * bent:rod("bar").points[41].x, 1e-8)
  check.is_true(bent.energy.load ~= 0)
  check.equal(bent.energy.gravity, 0.0)
end)

check.case("a preformed rod keeps its shape without load", function()
  local bow = curve.pcc {points = {{0, 0, 0}, {0.5, 0, 0}, {0.5, 0.5, 0}}, radius = 0.2}
  local t = scene.new {}
  t:rod("bow", rod.new {section = hose.tube, shape = bow, segments = 30}, {from = bow:at(0)})
  local free = t:solve {}
  check.is_true(free.ok)
  check.near(free:rod("bow").points[#free:rod("bow").points], vec(0.5, 0.5, 0), 1e-9)
  check.near(free.energy.total, 0, 1e-12)
  check.near(free:rod("bow").min_bend_radius, 0.2, 0.01)
end)

check.case("several rods", function()
  local t = hose.scene()
  t:rod("second", hose.design, {from = hose.from:moved {by = {0, 0.2, 0}}, to = hose.to:moved {by = {0, 0.2, 0}}})
  local both = t:solve {}
  check.equal(#both.rods, 2)
  check.near(both:rod("second").points[21] - both:rod("hose").points[21], vec(0, 0.2, 0), 1e-8)
  check.near(both.energy.bend, 2 * eq.energy.bend, 1e-8)
  check.raises(function() both:clearance {} end, "'from' is missing", "2 rods")
  check.contains(both, "second: min bend radius")
end)

check.finish()
