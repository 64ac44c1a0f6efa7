-- Branch points, slide clips, motions, modes: rods that hang together and rods that move.
local check = require "check"
local mm, deg = units.mm, units.deg

local rubber = rod.material {young = 5e6, poisson = 0.4, density = 1100}
local round = rod.section {outer = 12 * mm, material = rubber}
local hose = rod.new {length = 0.4, section = round, segments = 16}

local function fork()
  local s = scene.new {gravity = {0, 0, -9.81}}
  s:rod("trunk", hose, {from = frame {at = {0, 0, 0}, along = {1, 0, 0}}})
  s:rod("left", hose, {to = frame {at = {0.6, 0.3, 0}, along = {1, 0, 0}}})
  s:rod("right", hose, {to = frame {at = {0.6, -0.3, 0}, along = {1, 0, 0}}})
  return s, s:branch("fork", {{"trunk", "finish"}, {"left", "start"}, {"right", "start"}})
end

check.case("a free branch point finds its place and bears nothing", function()
  local s, b = fork()
  check.equal(b.name, "fork")
  check.equal(s.branches[1], "fork")
  check.equal(table.concat(b.rods, " "), "trunk left right")
  check.contains(b, "'left'", "its start", "finds its place")
  check.contains(s, "branch point 'fork'", "3 sections", "free")
  local eq = s:solve {}
  check.is_true(eq.ok and eq.stable)
  local at = eq:branch("fork").frame.at
  check.near(at.y, 0, 1e-9, "symmetry")
  check.near(eq:rod("trunk"):at(0.4).at, at, 1e-12)
  check.near(eq:rod("left"):at(0).at, at, 1e-12)
  check.near(eq:branch("fork").force, vec(0, 0, 0), 1e-8)
  check.near(eq:force("trunk", "finish") + eq:force("left", "start") + eq:force("right", "start"), vec(0, 0, 0), 1e-8)
  local weight = 3 * 0.4 * 9.81 * 1100 * math.pi * 0.006 ^ 2
  local support = eq:force("trunk", "start") + eq:force("left", "finish") + eq:force("right", "finish")
  check.near(support, vec(0, 0, weight), 1e-8)
end)

check.case("a held branch point stays, and tells what holds it", function()
  local s, b = fork()
  local place = frame {at = {0.38, 0.02, -0.05}, along = {1, 0, 0}}
  b:hold(place)
  local eq = s:solve {}
  check.is_true(eq.ok)
  check.near(eq:branch("fork").frame.at, place.at, 1e-12)
  check.is_true(eq:branch("fork").force:length() > 0.01)
  b:hold(place, {orientation = false})
  check.is_true(s:solve {}.energy.total < eq.energy.total)
  check.is_true(b:release() == b)
  check.near(s:solve {}:branch("fork").force, vec(0, 0, 0), 1e-8)
  check.raises(function() b:hold(place, {position = false, orientation = false}) end, "use release")
end)

check.case("relative frames come from the design", function()
  local s = scene.new {}
  s:rod("a", hose, {from = frame {at = {0, 0, 0}, along = {1, 0, 0}}, to = frame {at = {0.4, 0, 0}, along = {1, 0, 0}}})
  s:rod("b", hose, {from = frame {at = {0.4, 0, 0}, along = {0, 1, 0}}})
  s:branch("corner", {{"a", "finish"}, {"b", "start"}})
  local eq = s:solve {}
  check.is_true(eq.ok)
  -- Without gravity both rods stay straight, at the right angle that they were drawn with.
  check.near(eq:rod("b"):at(0.4).at, vec(0.4, 0.4, 0), 1e-9)
  -- An explicit relative frame counts for more.
  local t = scene.new {}
  t:rod("a", hose, {from = frame {at = {0, 0, 0}, along = {0, 0, 1}, up = {1, 0, 0}}})
  t:rod("b", hose)
  t:branch("corner", {{"a", "finish"}, {"b", "start", frame {at = {0, 0, 0.1}, along = {1, 0, 0}}}})
  check.near(t:solve {}:rod("b"):at(0.4).at, vec(0.4, 0, 0.5), 1e-9)
end)

check.case("what cannot be joined", function()
  local s = fork()
  check.raises(function() s:branch("fork", {{"left", "finish"}}) end, "already has a branch point 'fork'")
  check.raises(function() s:branch("other", {{"left", "start"}}) end, "belongs to branch point 'fork'", "its start")
  check.raises(function() s:branch("other", {{"lefd", "finish"}}) end, "did you mean 'left'?")
  check.raises(function() s:branch("other", {{"left", "end"}}) end, "unknown place 'end'")
  check.raises(function() s:branch("other", {{"left", 0.5}}) end, "0.5 m", "0 to 0.4 m")
  check.raises(function() s:branch("other", {}) end, "joins no rod")
  check.raises(function() s:branch("other", {{"left", "finish"}, {"left", "finish"}}) end, "twice")
  check.raises(function() s:branch("", {{"left", "finish"}}) end, "name is empty")
  check.raises(function() s:branch("other", {"left"}) end, "scene:branch")
  check.raises(function() s:rod("fork", hose) end, "branch point 'fork'")
  check.raises(function() s:remove("trunk") end, "belongs to branch point 'fork'")
  check.raises(function() s:placed("trunk"):hold("finish", frame {at = {0, 0, 0}, along = {1, 0, 0}}); s:solve {} end, "hold the branch point instead")
  local free = scene.new {}
  free:rod("a", hose)
  free:rod("b", hose)
  free:branch("knot", {{"a", "finish"}, {"b", "start"}})
  check.raises(function() free:solve {} end, "hang together", "hold a rod or a branch point")
  free:remove("knot"):remove("a")
  check.equal(#free.branches + #free.rods, 1)
end)

check.case("a warm start, an error estimate and both elements", function()
  local s = fork()
  local eq = s:solve {error = true}
  check.is_true(eq.error.valid)
  check.is_true(s:solve {from = eq}.iterations < eq.iterations)
  local other = s:solve {element = "staggered"}
  check.near(other:branch("fork").frame.at, eq:branch("fork").frame.at, 5e-3)
end)

check.case("clips", function()
  local s = scene.new {gravity = {0, 0, -9.81}}
  local long = rod.new {length = 1, section = round, segments = 40}
  local p = s:rod("cable", long, {from = frame {at = {0, 0, 0}, along = {1, 0, 0}}, to = frame {at = {0.98, 0, 0}, along = {1, 0, 0}}})
  local middle = frame {at = {0.49, 0, 0}, along = {1, 0, 0}}
  p:clip(0.495, middle, {kind = "slide"})
  check.contains(p, "slides through")
  check.contains(s:explain(), "slides through a clip at 0.495 m")
  local eq = s:solve {}
  check.is_true(eq.ok, eq.message)
  check.near(eq:rod("cable").supports[3].s, 0.5, 1e-6)
  check.near(eq:force("cable", 0.5).x, 0, 1e-6)
  p:release(0.495):clip(0.495, middle)
  check.is_true(s:solve {}.energy.total > eq.energy.total)
  p:release(0.495):clip(0.495, middle, {kind = "swivel"})
  check.contains(p, "pinned")
  check.raises(function() p:clip("start", middle, {kind = "slide"}) end, "cannot slide through a clip at its start")
  check.raises(function() p:clip(0.3, middle, {kind = "slid"}) end, "'slide'")
end)

check.case("a motion", function()
  local s = fork()
  local to = frame {at = {0.6, 0.35, 0.05}, along = {1, 0, 0}}
  local m = s:motion {steps = 5, holds = {["left.finish"] = {frame {at = {0.6, 0.3, 0}, along = {1, 0, 0}}, to}}}
  check.is_true(m.ok)
  check.equal(#m.equilibria, 6)
  check.equal(#m.times, 6)
  check.near(m.times[6], 1, 0)
  check.equal(#m.snaps, 0)
  check.near(m.equilibria[6]:rod("left"):at(0.4).at, to.at, 1e-12)
  check.contains(m, "solved", "none")
  s:placed("left"):release("finish"):hold("finish", to)
  check.near(s:solve {}:branch("fork").frame.at, m.equilibria[6]:branch("fork").frame.at, 1e-7)
  local same = s:motion {steps = 2, holds = {["left.0.4"] = function(t) return to end}}
  check.near(same.equilibria[1].energy.total, same.equilibria[3].energy.total, 1e-12)
end)

check.case("what cannot be moved", function()
  local s = fork()
  local f = function(t) return frame {at = {t, 0, 0}, along = {1, 0, 0}} end
  check.raises(function() s:motion {holds = {}} end, "nothing moves")
  check.raises(function() s:motion {} end, "'holds'")
  check.raises(function() s:motion {holds = {["lefd.finish"] = f}} end, "did you mean 'left'?")
  check.raises(function() s:motion {holds = {["left.start"] = f}} end, "not held at its start")
  check.raises(function() s:motion {holds = {fork = f}} end, "is free; hold it first")
  check.raises(function() s:motion {holds = {["left.finish"] = {}}} end, "empty")
  check.raises(function() s:motion {holds = {["left.finish"] = function() return 3 end}} end, "the function returned")
  check.raises(function() s:motion {holds = {["left.finish"] = function() error("no way") end}} end, "no way")
  check.raises(function() s:motion {steps = 0, holds = {["left.finish"] = f}} end, "'steps'")
end)

check.case("an arch that is turned over snaps through", function()
  local strip = rod.section {outer = 10 * mm, EA = 2000, GA = 800, EI = {0.1, 0.002}, GJ = 0.05, mass = 0.05}
  local s = scene.new {}
  local function tilt(x, angle)
    return frame {at = {x, 0, 0}, along = {math.cos(angle), 0, math.sin(angle)}, up = {-math.sin(angle), 0, math.cos(angle)}}
  end
  s:rod("arch", rod.new {length = 0.5, section = strip, segments = 40}, {from = tilt(0, 60 * deg), to = tilt(0.46, -60 * deg)})
  local m = s:motion {holds = {["arch.start"] = function(t) return tilt(0, 60 * deg * (1 - 2 * t)) end,
                               ["arch.finish"] = function(t) return tilt(0.46, -60 * deg * (1 - 2 * t)) end}}
  check.is_true(m.ok)
  check.equal(#m.snaps, 1)
  check.equal(m.snaps[1].rod, "arch")
  check.is_true(m.snaps[1].t > 0.5 and m.snaps[1].energy_drop > 0 and m.snaps[1].move > 50 * mm)
  check.contains(m, "snap-throughs", "arch")
end)

check.case("modes", function()
  local s = scene.new {gravity = {0, 0, -9.81}}
  local soft = rod.section {outer = 16 * mm, EA = 1005, GA = 335, EI = 0.01608495438638, GJ = 0.01072330292425, mass = 0.2211681228127}
  s:rod("hose", rod.new {length = 1.2, section = soft}, {from = frame {at = {0, 0, 0}, along = {1, 0, 0}}, to = frame {at = {0.8, 0, 0}, along = {1, 0, 0}}})
  local eq = s:solve {modes = true}
  check.is_true(eq.ok and eq.eigenvalues[1] > 0)
  check.is_true(#eq.modes >= 2)
  for i, other in ipairs(eq.modes) do
    check.is_true(other.ok and other.stable)
    check.is_true(other.energy.total > eq.energy.total)
    check.equal(other.modes, nil)
  end
  check.equal(#eq.softest_mode.hose, #eq:rod("hose").points)
  check.equal(s:solve {}.modes, nil)
  check.equal(s:solve {}.eigenvalues, nil)
end)

check.finish()
