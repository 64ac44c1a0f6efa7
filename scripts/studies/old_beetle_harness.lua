-- The main harness of a car, from its maker's KBL file: imported, settled under gravity with its fixings as clips. The ten
-- sharpest bends, the farthest sag and what it hangs on, and the lengths against those that the file states. The file is not part of this project;
-- without it the study says so and ends.
--
--   scripts/run scripts/studies/old_beetle_harness.lua [FILE.kbl] [out=FOLDER]
local mm = units.mm

local here = arg[0]:match("^(.*)/") or "."
local shared = os.getenv("TENDRIL_SHARED") or here .. "/../../../shared"
local file, out = shared .. "/data/kbl/old_beetle_main.kbl", "out"
for _, a in ipairs(arg) do
  local key, value = a:match("^(%w+)=(.+)$")
  if key == "out" then out = value
  elseif key then error("unknown argument '" .. a .. "'; known: FILE.kbl, out=FOLDER", 0)
  else file = a end
end
local found = io.open(file, "rb")
if not found then
  print("skipped: there is no harness at " .. file .. "; give its path: old_beetle_harness.lua FILE.kbl")
  os.exit(0)
end
found:close()

-- What the file holds
local seconds, car, harness = time(function() return scene.import(file, {gravity = {0, 0, -9.81}}) end)
print(harness)
print(("imported in %.0f ms"):format(seconds * 1e3))
assert(harness.median_length_off < 0.01 * mm, "the lengths do not fit those in the file")

-- At rest
local eq = car:solve{}
assert(eq.ok, eq.message)
print(("settled in %.0f ms, %d iterations, largest unbalanced force %.1e N"):format(eq.seconds * 1e3, eq.iterations, eq.residual))

local bends, farthest = {}, {distance = 0}
for _, segment in ipairs(harness.segments) do
  if segment.rod ~= "" then
    local rod = eq:rod(segment.rod)
    bends[#bends + 1] = {segment = segment, radius = rod.min_bend_radius, share = rod.min_bend_radius / segment.min_bend_radius}
    local distance, s, way = segment:departure(eq)
    if distance > farthest.distance then farthest = {segment = segment, distance = distance, s = s, way = way} end
  end
end
table.sort(bends, function(a, b) return a.share < b.share end)

print("\nthe ten sharpest bends at rest, against what wires and nodes allow")
print(("%-14s %10s %10s %10s %8s %6s"):format("segment", "radius mm", "allowed mm", "drawn mm", "outer mm", "wires"))
for k = 1, 10 do
  local b = bends[k]
  print(("%-14s %10.1f %10.1f %10.1f %8.1f %6d"):format(b.segment.rod, b.radius / mm, b.segment.min_bend_radius / mm,
    b.segment.drawn_bend_radius / mm, b.segment.outer / mm, #b.segment.wires))
end
print(("\nfarthest sag: %s, %.0f mm at s = %.0f mm of %.0f mm, %.0f mm of it downwards"):format(farthest.segment.rod,
  farthest.distance / mm, farthest.s / mm, farthest.segment.length / mm, -farthest.way.z / mm))

local function sag(options)
  options.gravity = {0, 0, -9.81}
  local other, report = scene.import(file, options)
  local there = other:solve{}
  assert(there.ok, there.message)
  return report.segments[tonumber(farthest.segment.rod:match("%d+$"))]:departure(there), there, other
end

-- How much of that hangs on the wires' slipping, which no file tells
print("\nslip of the wires in their bundles, and the sag of " .. farthest.segment.rod)
for _, slip in ipairs{1.0, 0.85, 0.7, 0.5, 0.3} do print(("  %.2f  %4.0f mm"):format(slip, sag{slip = slip} / mm)) end

-- Error against run time: the sag on ever finer elements
print("\nlongest element, elements, sag, time")
for _, element in ipairs{50 * mm, 25 * mm, 12.5 * mm, 6.25 * mm} do
  local far, rest, other = sag{element = element}
  local elements = 0
  for _, name in ipairs(other.rods) do elements = elements + other:placed(name).design.segments end
  print(("  %5.2f mm  %5d  %.2f mm  %.0f ms"):format(element / mm, elements, far / mm, rest.seconds * 1e3))
end

local picture = out .. "/old_beetle_harness.png"
view.new{car, eq, color = "tension", title = "Main harness at rest"}
  :save(picture, {size = {1600, 1200}, sheet = {"iso", "front", "top", "card"}})
harness:save(out .. "/old_beetle_settled.kbl", eq)
print("picture: " .. picture .. ", settled harness: " .. out .. "/old_beetle_settled.kbl")
