-- Error against run time of method.preform: the step of its grid, the best hose, what it took.
--   build/tendril tests/bench/preform_grid.lua
local mm = units.mm
local bay = scene.new{}
bay:obstacle("bay", "build/assets/engine_bay.ply", {unit = "mm"})

-- Ends of four hoses: the heater's feed and return, across the engine, and from the battery's corner to the intake.
local pairs_of_ends = {
  {"heater feed", {0.326, 0.190, 0.500}, {0, 1, 0}, {0.478, 0.814, 0.440}, {0, 1, 0}},
  {"heater return", {0.558, 0.814, 0.440}, {0, -1, 0}, {0.486, 0.470, 0.472}, {1, 0, 0}},
  {"radiator to heater", {0.326, 0.190, 0.500}, {0, 1, 0}, {0.558, 0.814, 0.440}, {0, 1, 0}},
  {"thermostat to heater", {0.486, 0.470, 0.472}, {-1, 0, 0}, {0.478, 0.814, 0.440}, {0, 1, 0}},
}
local steps = {40, 30, 20, 15, 10, 7, 5}

print("| hose | grid, mm | best length, mm | above the best of all | hoses | passages | seconds |")
print("|---|---|---|---|---|---|---|")
for _, ends in ipairs(pairs_of_ends) do
  local rows, best = {}, math.huge
  for _, step in ipairs(steps) do
    local hoses = method.preform(bay, {
      from = frame{at = ends[2], along = ends[3]}, to = frame{at = ends[4], along = ends[5]},
      outer = 23*mm, min_bend_radius = 45*mm, min_straight = 15*mm, clearance = 8*mm, free_ends = 40*mm, grid = step*mm,
    })
    rows[#rows + 1] = {step, hoses.ok and hoses[1].length, #hoses, hoses.passages, hoses.seconds}
    if hoses.ok then best = math.min(best, hoses[1].length) end
  end
  for _, r in ipairs(rows) do
    print(("| %s | %g | %s | %s | %d | %d | %.3f |"):format(ends[1], r[1], r[2] and ("%.2f"):format(r[2] / mm) or "none",
      r[2] and ("%.2f %%"):format(100 * (r[2] / best - 1)) or "", r[3], r[4], r[5]))
  end
end
