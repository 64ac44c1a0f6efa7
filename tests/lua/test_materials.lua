-- The library of wires, conduits and hoses.
local check = require "check"
local materials = require "materials"
local mm, MPa = units.mm, units.MPa

check.case("every entry makes a rod, says where its figures come from, and lies within its own spread", function()
  local names = materials.list()
  check.is_true(#names >= 35)
  for _, name in ipairs(names) do
    local entry = materials[name]
    check.equal(entry.name, name)
    check.is_true(#entry.source > 40, name)
    check.is_true(#entry.text > 10, name)
    check.is_true(next(entry.spread) ~= nil, name)
    check.contains(tostring(entry), name, "source")
    if entry.kind == "rubber" then
      check.is_true(entry.material.young > 1 * MPa, name)
    else
      local r = rod.new{length = 1, section = entry.section}
      check.is_true(r.mass > 0, name)
      local low, high = table.unpack(entry.EI_range)
      check.is_true(low > 0 and low <= entry.section.EI1 and entry.section.EI1 <= high, name)
      if entry.min_bend_radius then check.is_true(entry.min_bend_radius > entry.section.outer / 2, name) end
    end
  end
end)

check.case("kinds", function()
  check.equal(#materials.list("wire"), 14)
  check.equal(#materials.list("conduit"), 5)
  local sum = 0
  for _, kind in ipairs{"wire", "cable", "conduit", "hose", "rubber"} do sum = sum + #materials.list(kind) end
  check.equal(sum, #materials.list())
  check.raises(function() materials.list("hoses") end, "unknown kind 'hoses'", "conduit")
end)

check.case("wires: sizes of the standard, stiffness grows with the area, copper and PVC weigh what is stated", function()
  local wire = materials["FLRY-B 0.5"].wire
  check.near(wire.outer, 1.6 * mm, 1e-15)
  check.near(wire.area, 0.5 * mm ^ 2, 1e-18)
  check.equal(wire.strands, 16)
  check.near(materials["FLRY-B 0.5"].min_bend_radius, 4.8 * mm, 1e-15)
  for _, family in ipairs{"FLRY-A", "FLRY-B", "FLY"} do
    local before
    for _, name in ipairs(materials.list()) do
      if name:sub(1, #family + 1) == family .. " " then
        local entry = materials[name]
        if before then
          -- (Not among FLRY-A: seven strands of 0.35 mm^2 are thicker than nineteen of 0.5 mm^2.)
          if family ~= "FLRY-A" then check.is_true(entry.section.EI1 > before.section.EI1, name) end
          check.is_true(entry.section.mass > before.section.mass, name)
        end
        local copper = 8960 * entry.wire.area
        check.is_true(entry.section.mass > copper and entry.section.mass < 2.2 * copper, name)
        before = entry
      end
    end
  end
  -- Few thick strands are stiffer than many thin ones.
  check.is_true(materials["FLRY-A 0.35"].EI_range[1] > materials["FLRY-B 0.35"].EI_range[1])
end)

check.case("a bundle of wires of the library", function()
  local section, about = rod.bundle{wires = {{wire = materials["FLRY-B 0.5"].wire, count = 12}, materials["FLRY-B 2.5"].wire}, taped = true}
  check.near(section.mass, 12 * 6e-3 + 26e-3, 20e-3)
  check.is_true(about.min_bend_radius > materials["FLRY-B 2.5"].min_bend_radius)
  check.is_true(about.EI_range[1] < section.EI1 and section.EI1 < about.EI_range[2])
end)

check.case("rubber by hardness: Gent's relation", function()
  check.near(materials.rubber(60) / MPa, 3.605, 0.002)
  check.near(materials.rubber(50) / MPa, 2.456, 0.002)
  check.raises(function() materials.rubber(90) end, "got 90", "20 to 80")
  check.raises(function() materials.rubber("60") end, "expected a Shore A hardness")
end)

check.case("hoses are tubes", function()
  local hose = materials.tube{material = "EPDM 60", inner = 16 * mm, wall = 4 * mm}
  local young = materials.rubber(60)
  check.near(hose.section.outer, 24 * mm, 1e-15)
  check.near(hose.section.EI1, young * math.pi / 64 * ((24 * mm) ^ 4 - (16 * mm) ^ 4), 1e-9)
  check.near(hose.section.mass, 1150 * math.pi / 4 * ((24 * mm) ^ 2 - (16 * mm) ^ 2), 1e-9)
  check.near(hose.EI_range[2] / hose.section.EI1, 1.4, 1e-12)
  check.equal(hose.section.EI1, materials["EPDM 60 hose 16x4"].section.EI1)
  check.near(hose.section.material.young, young, 1e-3)
  check.raises(function() materials.tube{material = "EPDM 60", inner = 0, wall = 1 * mm} end, "'inner' is 0")
  check.raises(function() materials.tube{material = "EPDM 60", inner = 1 * mm} end, "'wall' is nil")
  check.raises(function() materials.tube{material = "NW 10", inner = 1 * mm, wall = 1 * mm} end, "materials.list(\"rubber\")")
  check.raises(function() materials.tube{material = "EPDN 60", inner = 1 * mm, wall = 1 * mm} end, "'material' is EPDN 60")
  check.raises(function() materials.tube{inner = 1 * mm, wall = 1 * mm} end, "'material' is nil")
  check.raises(function() materials.tube{material = "EPDM 60", outer = 1} end, "unknown option 'outer'")
  check.raises(function() materials.tube(3) end, "expected {material =")
end)

check.case("conduits bend more easily than a tube of their wall would, and grow with their size", function()
  local before = 0
  for _, name in ipairs(materials.list("conduit")) do
    local entry = materials[name]
    local g = entry.figures
    local smooth = g.young * math.pi / 64 * (g.outer ^ 4 - (g.outer - 2 * g.wall) ^ 4)
    check.is_true(entry.section.EI1 < 0.1 * smooth, name)
    check.is_true(entry.section.mass > before, name)
    before = entry.section.mass
  end
end)

check.case("unknown names are told with the nearest", function()
  check.raises(function() return materials["FLRY-B 05"] end, "did you mean 'FLRY-B 0.5'?")
  check.raises(function() return materials["epdm 60"] end, "did you mean 'EPDM 60'?")
  check.raises(function() return materials[("x"):rep(10000)] end, "unknown name")
  check.equal(materials[1], nil)
  check.equal(materials["EPDM 60"].colour, nil)
  check.contains(tostring(materials), "FLRY-A 0.35", "NW 22")
end)

check.finish()
