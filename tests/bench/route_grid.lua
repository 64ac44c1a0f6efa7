-- Error against run time of method.route's nominal step: the step of its grid, the objective, what it took, with and without a
-- weight of clearance. Tree and field are there; the lattice of the step is made anew each time, as for every call.
--   build/tendril tests/bench/route_grid.lua
local mm = units.mm
local bay = scene.new{}
bay:obstacle("bay", "build/assets/engine_bay.ply", {unit = "mm"})
local section = rod.section{outer = 24*mm, inner = 16*mm, material = rod.material{young = 6e6, poisson = 0.49, density = 1150}}

local function route_between(ends, step, clearance)
  return method.route(bay, {from = ends.from, to = ends.to, section = section, min_bend_radius = 50*mm, min_straight = 20*mm,
    end_straight = 20*mm, clearance = 8*mm, grid = step, weights = {length = 1, clearance = clearance}, refine = false})
end

-- Random pairs of ends in the bay (always the same) between which there is a route, and none that is nearly straight.
math.randomseed(7)
local function random_end()
  local at = vec(0.1 + 1.1 * math.random(), 0.15 + 0.65 * math.random(), 0.1 + 0.5 * math.random())
  local up, around = 2 * math.random() - 1, 2 * math.pi * math.random()
  return frame{at = at, along = {math.sqrt(1 - up * up) * math.cos(around), math.sqrt(1 - up * up) * math.sin(around), up}}
end
local pairs_of_ends = {}
while #pairs_of_ends < 5 do
  local ends = {from = random_end(), to = random_end()}
  ends.apart = (ends.to.at - ends.from.at):length()
  if ends.apart > 0.6 and ends.apart < 1.3 then
    local routes = route_between(ends, 20*mm, 0)
    if routes.ok and routes[1].objective > 1.05 * ends.apart then pairs_of_ends[#pairs_of_ends + 1] = ends end
  end
end
local steps = {40, 30, 20, 15, 10}

print("| ends | weight | grid, mm | objective, mm | above the best of all | seconds |")
print("|---|---|---|---|---|---|")
for k, ends in ipairs(pairs_of_ends) do
  for _, weight in ipairs{0, 1} do
    local rows, best = {}, math.huge
    for _, step in ipairs(steps) do
      local seconds, routes = math.huge, nil
      for _ = 1, 2 do
        routes = route_between(ends, step*mm, weight)
        seconds = math.min(seconds, routes.seconds)
      end
      rows[#rows + 1] = {step, routes.ok and routes[1].objective, seconds}
      if routes.ok then best = math.min(best, routes[1].objective) end
    end
    for _, r in ipairs(rows) do
      print(("| %d, %.0f mm apart | %g | %g | %s | %s | %.2f |"):format(k, ends.apart / mm, weight, r[1],
        r[2] and ("%.1f"):format(r[2] / mm) or "none", r[2] and ("%.2f %%"):format(100 * (r[2] / best - 1)) or "", r[3]))
    end
  end
end
