-- method.stability and method.variation: what varies, what is measured, what comes out.
local check = require "check"
local mm, deg = units.mm, units.deg

local rubber = rod.material {young = 5e6, poisson = 0.4, density = 1100}
local round = rod.section {outer = 16 * mm, inner = 10 * mm, material = rubber}

local function hanging()
  local s = scene.new {gravity = {0, 0, -9.81}}
  s:rod("hose", rod.new {length = 1, section = round, segments = 16},
    {from = frame {at = {0, 0, 0}, along = {1, 0, 0}}, to = frame {at = {0.85, 0, 0.05}, along = {1, 0, 0}}})
  return s
end

local function lowest(eq)
  local z = math.huge
  for _, p in ipairs(eq:rod("hose").points) do z = math.min(z, p.z) end
  return z
end

check.case("stability: the matrix is the gradient, with what each variable does within its tolerance", function()
  local s = hanging()
  local st = method.stability(s, {vary = {["hose.length"] = 5 * mm, ["hose.to.at.x"] = 2 * mm}, measure = {"hose.min_bend_radius", "hose.from.force.z"}})
  check.is_true(st.ok, st.message)
  local eq = s:solve {tolerance = 1e-12}
  for _, measure in ipairs(st.measures) do
    local g = eq:gradient(measure, {"hose.length", "hose.to.at.x"})
    check.near(st.matrix[measure]["hose.length"], g["hose.length"], 1e-5 * math.abs(g["hose.length"]))
    check.near(st.within[measure]["hose.to.at.x"], 2 * mm * g["hose.to.at.x"], 1e-8 + 1e-5 * math.abs(2 * mm * g["hose.to.at.x"]))
  end
  check.contains(st, "hose.length", "within it", "5 mm")
  local moves = st:moves("hose")
  check.equal(#moves, 17)
  check.near(moves[1], 0, 1e-9)
  check.is_true(moves[9] > 2 * mm, "the middle sinks by more than the tolerance")
  local picture = os.tmpname() .. ".png"
  view.new {s, st.equilibrium, color = st}:save(picture, {size = {400, 300}, sheet = {"iso"}})
  check.is_true(os.remove(picture))
  local other = scene.new {}
  other:rod("cable", rod.new {length = 1, section = round}, {from = frame {at = {0, 0, 0}, along = {1, 0, 0}}})
  check.raises(function() view.new {other, other:solve {}, color = st} end, "another equilibrium")
  check.raises(function() method.stability(s, {vary = {"hose.lenght"}}) end, "did you mean 'hose.length'")
  check.raises(function() method.stability(s, {measure = {"hose.clearence"}}) end, "unknown measure")
end)

check.case("variation: small tolerances spread a measure as its gradient says", function()
  local s = hanging()
  local v = method.variation(s, {
    vary = {["hose.length"] = 1 * mm, ["hose.to"] = {box = {1 * mm, 0, 2 * mm}}},
    measure = {"hose.min_bend_radius", sag = lowest}, outcomes = 400, seed = 3, sampling = "sobol"})
  check.is_true(v.ok, v.message)
  check.equal(#v.outcomes, 400)
  local g = s:solve {}:gradient("hose.min_bend_radius", {"hose.length", "hose.to.at.x", "hose.to.at.z"})
  local expected = math.sqrt((g["hose.length"] * mm / 3) ^ 2 + (g["hose.to.at.x"] * mm / 3) ^ 2 + (g["hose.to.at.z"] * 2 * mm / 3) ^ 2)
  local found = v["hose.min_bend_radius"].deviation
  check.is_true(math.abs(found.value - expected) < 0.1 * expected, found.value .. " against " .. expected)
  check.is_true(v.sag.mean < 0 and v.sag.q05 < v.sag.q50 and v.sag.q50 < v.sag.q95)
  check.is_true(v.sag.interval.mean[1] <= v.sag.mean.value and v.sag.mean.value <= v.sag.interval.mean[2])
  check.is_true(v.sag:below(v.sag.max + 1).value == 1 and v.sag:above(v.sag.max).value == 0)
  local blame = v["hose.min_bend_radius"].contributors
  check.equal(blame[1].name, "hose.to")
  check.near(blame[2].linear, (g["hose.length"] * mm / 3 / expected) ^ 2, 1e-4)
  check.near(blame[1].linear + blame[2].linear, 1, 1e-6)
  check.contains(v, "400 outcomes", "sobol", "sag", "hose.min_bend_radius")
  check.contains(v:report(), "shares of the variance")
end)

check.case("variation: an outcome can be looked at again, alone", function()
  local s = hanging()
  local v = method.variation(s, {vary = {["hose.length"] = {tolerance = 20 * mm, spread = "uniform"}}, measure = {sag = lowest}, outcomes = 20})
  for _, k in ipairs {1, 7, 20} do
    check.near(lowest(v:equilibrium(k)), v.outcomes[k].measures.sag, 1e-9)
    check.near(v:equilibrium(k):rod("hose").length, v.outcomes[k].variables["hose.length"], 0.01)
  end
  check.equal(v.outcomes[21], nil)
  check.raises(function() v:equilibrium(21) end, "expected 1 to 20")
end)

check.case("variation: the same seed gives the same bits, whatever the number of threads", function()
  local s = hanging()
  local function csv(threads, seed)
    local path = os.tmpname() .. ".csv"
    method.variation(s, {vary = {["hose.to"] = {ball = 5 * mm, cone = 5 * deg}}, measure = {"hose.max_tension"}, outcomes = 50,
      threads = threads, seed = seed}):save(path)
    local file = assert(io.open(path))
    local text = file:read("a")
    file:close()
    os.remove(path)
    return text
  end
  check.equal(csv(1, 5), csv(4, 5))
  check.is_true(csv(1, 5) ~= csv(1, 6))
end)

check.case("variation: a function may say how a variable spreads, tables may give it", function()
  local s = hanging()
  local v = method.variation(s, {vary = {["hose.length"] = {spread = function(u) return u < 0.5 and -5 * mm or 5 * mm end}},
    measure = {"hose.length"}, outcomes = 30})
  for _, o in ipairs(v.outcomes) do check.near(math.abs(o.variables["hose.length"] - 1), 5 * mm, 1e-12) end
  local lengths = {0.95, 1, 1.05}
  v = method.variation(s, {vary = {["hose.length"] = {values = lengths}}, measure = {"hose.length"}, outcomes = 3})
  for k, o in ipairs(v.outcomes) do check.near(o.variables["hose.length"], lengths[k], 0) end
  local frames = {}
  for k = 1, 5 do frames[k] = frame {at = {0.8 + 0.01 * k, 0, 0}, along = {1, 0, 0}} end
  v = method.variation(s, {vary = {["hose.to"] = {frames = frames}}, measure = {reach = function(eq) return eq:rod("hose"):at(1).at.x end}, outcomes = 5})
  for k, o in ipairs(v.outcomes) do check.near(o.measures.reach, 0.8 + 0.01 * k, 1e-9) end
end)

check.case("variation: variables that depend on each other", function()
  local s = hanging()
  local v = method.variation(s, {vary = {["hose.to.at.x"] = 5 * mm, ["hose.to.at.z"] = 5 * mm}, measure = {"hose.max_tension"},
    together = {{"hose.to.at.x", "hose.to.at.z", correlation = 1}}, outcomes = 20})
  local x, z = v:column("hose.to.at.x"), v:column("hose.to.at.z")
  for k = 1, 20 do check.near(x[k] - 0.85, z[k] - 0.05, 1e-12) end
  check.raises(function()
    method.variation(s, {vary = {["hose.to.at.x"] = 1 * mm, ["hose.to.at.z"] = 1 * mm}, together = {{"hose.to.at.x", "hose.to.at.z", correlation = 2}}})
  end, "correlation")
end)

check.case("variation: the length in contact is that of outcomes that touch, and zero for the others", function()
  local s = hanging()
  s:obstacle("floor", scene.plane(), {pose = frame {at = {0, 0, -0.235}, along = {0, 0, 1}}})
  local v = method.variation(s, {vary = {["hose.length"] = {tolerance = 80 * mm, spread = "uniform"}}, outcomes = 60,
    measure = {"hose.contact_length", "hose.clearance", touching = "hose.contact_length", by_hand = function(eq)
      local sum = 0
      for _, c in ipairs(eq.contacts) do sum = sum + c.length end
      return sum
    end}})
  check.is_true(v.ok, v.message)
  local touch, free = 0, 0
  for _, o in ipairs(v.outcomes) do
    local m = o.measures
    check.near(m["hose.contact_length"], m.touching, 0)
    check.near(m["hose.contact_length"], m.by_hand, 1e-12)
    if m.touching > 0 then touch = touch + 1 else free = free + 1 end
    check.is_true((m.touching > 0) == (m["hose.clearance"] < 1e-5), m.touching .. " m touch, gap " .. m["hose.clearance"])
    check.is_true(m.touching < 0.6)
  end
  check.is_true(touch > 5 and free > 5, touch .. " touch, " .. free .. " do not")
  check.raises(function() method.variation(s, {vary = {["hose.length"] = 1 * mm}, measure = {"hoze.contact_length"}}) end, "did you mean 'hose'")
end)

check.case("variation: charts", function()
  local s = hanging()
  local v = method.variation(s, {vary = {["hose.length"] = 10 * mm}, measure = {sag = lowest}, outcomes = 100})
  check.contains(v.sag:histogram {limit = -0.2}, "histogram")
  check.contains(v.sag:scatter("hose.length"), "scatter")
  check.raises(function() v.sag:scatter("hose.lenght") end, "did you mean 'hose.length'")
end)

check.case("variation: a study kept in a file goes on where it was", function()
  local s = hanging()
  local path = os.tmpname()
  os.remove(path)
  local calls = 0
  local function study(options)
    local o = {vary = {["hose.length"] = 10 * mm}, outcomes = 60, seed = 9, store = path,
      measure = {sag = function(eq) calls = calls + 1 return lowest(eq) end}}
    for k, value in pairs(options or {}) do o[k] = value end
    return method.variation(s, o)
  end
  local first = study()
  local called = calls
  check.is_true(called >= 60)
  local again = study()
  check.is_true(calls - called <= 1, "only the nominal design is measured again")
  for k = 1, 60 do check.near(again.outcomes[k].measures.sag, first.outcomes[k].measures.sag, 0) end
  check.raises(function() study {seed = 10} end, "holds another study", "its seed is 9, here it is 10")
  check.raises(function() study {vary = {["hose.length"] = 11 * mm}} end, "holds another study", "fingerprint")
  local file = assert(io.open(path, "w"))
  file:write(("no database "):rep(100))
  file:close()
  check.raises(study, "not a database")
  os.remove(path)
end)

check.case("variation: what cannot be", function()
  local s = hanging()
  local function refused(options, ...) check.raises(function() method.variation(s, options) end, ...) end
  refused({vary = {}}, "vary")
  refused({vary = {["hose.lenght"] = 1 * mm}}, "did you mean 'hose.length'")
  refused({vary = {["hose.length"] = {cone = 1}}}, "hose.length")
  refused({vary = {["hose.length"] = {spread = "gaussian", tolerance = 1 * mm}}}, "gaussian", "normal")
  refused({vary = {["hose.length"] = 1 * mm}, sampling = "halton"}, "sampling", "sobol")
  refused({vary = {["hose.length"] = 1 * mm}, outcomes = 0}, "outcomes")
  refused({vary = {["hose.length"] = 1 * mm}, measure = {gap = 5}}, "measure")
  refused({vary = {["hose.length"] = 1 * mm}, measure = {gap = function() return "wide" end}}, "gap", "expected a finite number")
  refused({vary = {["hose.length"] = {values = {1, 2}}}, outcomes = 3}, "2")
end)

check.finish()
