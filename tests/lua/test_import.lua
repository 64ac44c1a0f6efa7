-- scene.import from a script: the small harness that comes with the program, its report, and the way back into its file.
local check = dofile("tests/lua/check.lua")
local mm = units.mm
local folder = check.folder()

check.case("a harness becomes a scene with rods, a branch point and a clip", function()
  local s, harness = scene.import("builtin:t_harness", {gravity = {0, 0, -9.81}})
  check.equal(harness.format, "KBL 2.4")
  check.equal(#harness.segments, 3)
  check.equal(#harness.wires, 4)
  check.equal(#s.rods, 3)
  check.equal(harness.branches, 1)
  check.equal(harness.clips, 1)
  check.equal(harness.held_ends, 3)
  check.equal(#harness.notes, 0)
  check.is_true(harness.median_length_off < 0.01 * mm)
  local trunk = harness.segments[1]
  check.equal(trunk.rod, "trunk")
  check.equal(table.concat(trunk.wires, " "), "1 2 3 4")
  check.near(trunk.stated_length, 400.595 * mm, 1e-9)
  check.is_true(trunk.EI_slipping < trunk.EI and trunk.EI < trunk.EI_glued)
  check.near(harness.wires[1].length, harness.segments[1].length + harness.segments[2].length, 1e-12)
  check.contains(tostring(harness), "harness 'T harness'", "KBL 2.4", "lengths off", "branch points")
  check.contains(tostring(trunk), "segment 'trunk'", "stated 400.6 mm", "EI")
  check.contains(tostring(harness.wires[3]), "wire '3'", "2 segments")

  local eq = s:solve()
  check.is_true(eq.ok, eq.message)
  local far, at, way = trunk:departure(eq)
  check.is_true(far > 0 and at > 0 and at <= trunk.length)
  check.is_true(way.z < 0, "it sags downwards")

  harness:save(folder .. "/settled.kbl", eq)
  local again, settled = scene.import(folder .. "/settled.kbl")
  check.equal(#again.rods, 3)
  for i, segment in ipairs(settled.segments) do
    check.near(segment.length, eq:rod(harness.segments[i].rod).length, 0.05 * mm)
    if harness.segments[i].stated_length > 0 then check.near(segment.length, segment.stated_length, 0.01 * mm) end
  end
end)

check.case("without gravity it lies as it is drawn; options choose shape, clips and slip", function()
  local drawn, harness = scene.import("builtin:t_harness")
  check.is_true(harness.segments[3]:departure(drawn:solve()) < 1e-9)
  local straight = scene.import("builtin:t_harness", {shape = "straight"})
  check.is_true(straight:solve().energy.bend > 1e-4)
  local _, loose = scene.import("builtin:t_harness", {clips = "none"})
  check.equal(loose.clips, 0)
  local _, slipping = scene.import("builtin:t_harness", {slip = 1})
  local _, glued = scene.import("builtin:t_harness", {slip = 0})
  check.near(slipping.segments[1].EI, slipping.segments[1].EI_slipping, 1e-12)
  check.near(glued.segments[1].EI, glued.segments[1].EI_glued, 1e-12)
end)

check.case("what cannot be imported is said by name", function()
  check.raises(function() scene.import("bay.step") end, "'.step' is no harness file; expected .kbl")
  check.raises(function() scene.import("nowhere.kbl") end, "nowhere.kbl")
  check.raises(function() scene.import("builtin:t_harnes") end, "did you mean 't_harness'?")
  check.raises(function() scene.import("builtin:t_harness", {shape = "bent"}) end, "shape")
  check.raises(function() scene.import("builtin:t_harness", {slip = 2}) end, "slip")
  check.raises(function() scene.import("builtin:t_harness", {element = 0}) end, "element")
  local broken = folder .. "/broken.kbl"
  local file = assert(io.open(broken, "w"))
  file:write("<vec/>")
  file:close()
  check.raises(function() scene.import(broken) end, "broken.kbl:1: this is no KBL file")
  local _, harness = scene.import("builtin:t_harness")
  local other = scene.new{}
  local rubber = rod.material{young = 5e6, poisson = 0.4, density = 1100}
  other:rod("hose", rod.new{length = 1, section = rod.section{outer = 0.02, material = rubber}}, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}})
  check.raises(function() harness:save(folder .. "/none.kbl", other:solve()) end, "'trunk'")
end)

check.finish()
