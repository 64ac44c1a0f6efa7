-- The main harness of a car, from its maker's KBL file: imported, settled under gravity with its fixings as clips. The ten
-- sharpest bends, the farthest sag, and the lengths against those that the file states. The file is not part of this project;
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

-- How much of that hangs on the wires' slipping, which no file tells
for _, slip in ipairs{0.5, 0.7} do
  local stiffer = scene.import(file, {gravity = {0, 0, -9.81}, slip = slip})
  local there = stiffer:solve{}
  local most = 0
  for _, segment in ipairs(harness.segments) do
    if there.ok and segment.rod ~= "" then most = math.max(most, (segment:departure(there))) end
  end
  print(("slip %.1f: %s"):format(slip, there.ok and ("farthest sag %.0f mm"):format(most / mm) or there.message))
end

local picture = out .. "/old_beetle_harness.png"
view.new{car, eq, color = "tension", title = "Main harness at rest"}
  :save(picture, {size = {1600, 1200}, sheet = {"iso", "front", "top", "card"}})
harness:save(out .. "/old_beetle_settled.kbl", eq)
print("picture: " .. picture .. ", settled harness: " .. out .. "/old_beetle_settled.kbl")
