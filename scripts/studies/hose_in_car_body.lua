-- A washer hose laid over the front wheelhouse of a car body, a surface model with open shells: it rests on the arch.
-- The model is not part of this project; without it the study says so and ends.
--
--   scripts/run scripts/studies/hose_in_car_body.lua [FILE.obj] [out=FOLDER]
local mm, MPa = units.mm, units.MPa

local here = arg[0]:match("^(.*)/") or "."
local shared = os.getenv("TENDRIL_SHARED") or here .. "/../../../shared"
local file, out = shared .. "/data/meshes/audi_chassis.obj", "out"
for _, a in ipairs(arg) do
  local key, value = a:match("^(%w+)=(.+)$")
  if key == "out" then out = value
  elseif key then error("unknown argument '" .. a .. "'; known: FILE.obj, out=FOLDER", 0)
  else file = a end
end
local found = io.open(file, "rb")
if not found then
  print("skipped: there is no car body at " .. file .. "; give its path: hose_in_car_body.lua FILE.obj")
  os.exit(0)
end
found:close()

local required = {bend_radius = 60 * mm, penetration = 0.2 * mm}

local car = scene.new{gravity = {0, 0, -9.81}}
car:obstacle("body", file, {unit = "m"})

local outer, inner, water = 15 * mm, 10 * mm, 1000
local rubber = rod.material{young = 6 * MPa, poisson = 0.49, density = 1150 + water * inner^2 / (outer^2 - inner^2)}
car:rod("hose", rod.new{length = 760 * mm, segments = 60, section = rod.section{outer = outer, inner = inner, material = rubber}}, {
  from = frame{at = {1.04, 0.74, 0.58}, along = {1, 0, 0}},
  to = frame{at = {1.74, 0.72, 0.46}, along = {1, 0, -1}},
})
print(car)

local eq = car:solve{error = true}
print(eq)
assert(eq.ok, eq.message)
local hose = eq:rod("hose")
assert(#eq.contacts > 0, "the hose should lie on the wheelhouse")
assert(eq.deepest_penetration <= required.penetration, "the hose is pressed too deep into the body")
print(("smallest bend radius %.1f mm, required %.1f mm"):format(hose.min_bend_radius / mm, required.bend_radius / mm))

local picture = out .. "/hose_in_car_body.png"
view.new{car, eq, color = "clearance", title = "Washer hose over the wheelhouse"}
  :save(picture, {size = {1600, 1200}, sheet = {"iso", "front", "top", "card"}, fit = "hose"})
print("picture: " .. picture)
assert(hose.min_bend_radius >= required.bend_radius, "the hose is bent too tightly")
