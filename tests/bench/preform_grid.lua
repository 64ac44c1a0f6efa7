-- Error against run time of method.preform: the step of its grid, the best hose, what it took.
--   build/tendril tests/bench/preform_grid.lua
local mm = units.mm
local bay = scene.new{}
bay:obstacle("bay", "build/assets/engine_bay.ply", {unit = "mm"})

local demands = {outer = 23*mm, min_bend_radius = 45*mm, min_straight = 15*mm, clearance = 8*mm}
local function hoses_between(ends, step)
  local options = {from = ends.from, to = ends.to, grid = step}
  for k, v in pairs(demands) do options[k] = v end
  return method.preform(bay, options)
end

-- Random pairs of ends in the bay (always the same) between which no hose is nearly straight.
math.randomseed(3)
local function random_end()
  local at = vec(0.1 + 1.1 * math.random(), 0.15 + 0.65 * math.random(), 0.1 + 0.5 * math.random())
  local up, around = 2 * math.random() - 1, 2 * math.pi * math.random()
  return frame{at = at, along = {math.sqrt(1 - up * up) * math.cos(around), math.sqrt(1 - up * up) * math.sin(around), up}}
end
local pairs_of_ends = {}
while #pairs_of_ends < 5 do
  local ends = {from = random_end(), to = random_end()}
  ends.apart = (ends.to.at - ends.from.at):length()
  if ends.apart > 0.5 and ends.apart < 0.9 then
    local hoses = hoses_between(ends, 20*mm)
    if hoses.ok and hoses[1].length > 1.2 * ends.apart then pairs_of_ends[#pairs_of_ends + 1] = ends end
  end
end
local steps = {40, 30, 20, 15, 10}

print("| ends | grid, mm | best length, mm | above the best of all | hoses | seconds |")
print("|---|---|---|---|---|---|")
for k, ends in ipairs(pairs_of_ends) do
  local rows, best = {}, math.huge
  for _, step in ipairs(steps) do
    local hoses = hoses_between(ends, step*mm)
    rows[#rows + 1] = {step, hoses.ok and hoses[1].length, #hoses, hoses.seconds}
    if hoses.ok then best = math.min(best, hoses[1].length) end
  end
  for _, r in ipairs(rows) do
    print(("| %d, %.0f mm apart | %g | %s | %s | %d | %.2f |"):format(k, ends.apart / mm, r[1], r[2] and ("%.1f"):format(r[2] / mm) or "none",
      r[2] and ("%.2f %%"):format(100 * (r[2] / best - 1)) or "", r[3], r[4]))
  end
end
