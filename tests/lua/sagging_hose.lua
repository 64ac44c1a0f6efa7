-- The scene that several tests look at: a hose that sags between two holds.
local mm, MPa = units.mm, units.MPa
local made = {}

made.rubber = rod.material {young = 6 * MPa, poisson = 0.49, density = 1150}
made.tube = rod.section {outer = 18 * mm, inner = 10 * mm, material = made.rubber}
made.design = rod.new {section = made.tube, length = 1.2}
made.from = frame {at = {0, 0, 1}, along = {1, 0, 0}}
made.to = frame {at = {0.8, 0, 1}, along = {1, 0, 0}}

--- A fresh scene under gravity with the hose in it, and the placed hose.
function made.scene()
  local s = scene.new {gravity = {0, 0, -9.81}}
  return s, s:rod("hose", made.design, {from = made.from, to = made.to})
end

return made
