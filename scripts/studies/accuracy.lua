-- Error against run time: ten cases of single rods, solved with 4 to 320 segments by both elements and by Richardson
-- extrapolation. How long does it take to be right to a thousandth, ... a millionth of the length?
--
--   scripts/run scripts/studies/accuracy.lua           all of it, about half a minute
--   scripts/run scripts/studies/accuracy.lua quick     a few meshes, a few solves each
-- Further arguments: out=FOLDER for the chart, case=NAME for one case alone.
--
-- The error is the largest distance of a vertex from the closed form (cantilever, column), else from a fine solution of the
-- fourth-order element whose own error Richardson extrapolation removes and tells. The time is the shortest of repeated cold
-- solves of the whole problem: first guess, iterations, and the description of the result.
local given = {out = "out", case = "", quick = false}
for _, a in ipairs(arg) do
  local key, value = a:match("^(%w+)=(.+)$")
  if a == "quick" then given.quick = true
  elseif key == "out" or key == "case" then given[key] = value
  else error("unknown argument '" .. a .. "'; known: quick, out=FOLDER, case=NAME", 0) end
end

local cases = require "accuracy.cases"
local goals = {1e-3, 1e-4, 1e-5, 1e-6}
local segments = given.quick and {8, 16, 32, 64, 128}
  or {4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 16, 18, 20, 24, 28, 32, 36, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320}
-- Meshes for Richardson extrapolation: their halves are solved too.
local doubled = {}
for _, n in ipairs(segments) do if n % 4 == 0 and n >= 8 then doubled[#doubled + 1] = n end end
-- A step's tolerance far below the error that is asked for buys nothing: each mesh is solved with these, and what a goal
-- needs is the least time of all rows that reach it.
local tolerances = given.quick and {1e-9} or {1e-4, 1e-6, 1e-9}

local methods = {
  {name = "SE(3)", options = {element = "se3", segments = segments}},
  {name = "SE(3), Richardson", options = {element = "se3", segments = doubled, extrapolate = true}},
  {name = "staggered", options = {element = "staggered", segments = segments}},
  {name = "staggered, Richardson", options = {element = "staggered", segments = doubled, extrapolate = true}},
}

-- All rows of one method: tables of segments, ms and error over length.
local function measure(case, method, s, exact)
  local rows, reference = {}, nil
  for _, tolerance in ipairs(tolerances) do
    local options = {exact = exact, tolerance = tolerance, ["repeat"] = given.quick and 0 or 0.03}
    for key, value in pairs(method.options) do options[key] = value end
    reference = study.accuracy(s, options)
    assert(reference.ok, case.name .. ": " .. reference.message)
    for _, row in ipairs(reference.rows) do
      if row.status == "solved" then
        rows[#rows + 1] = {segments = row.segments, ms = row.fastest / 1e-3, error = row.error / case.length}
      end
    end
  end
  return rows, reference
end

-- The rows that no other row beats in both time and error, by time.
local function best_of(rows)
  table.sort(rows, function(a, b) return a.ms < b.ms end)
  local best = {}
  for _, row in ipairs(rows) do
    if #best == 0 or row.error < best[#best].error then best[#best + 1] = row end
  end
  return best
end

local function first_below(rows, goal)
  for _, row in ipairs(rows) do if row.error <= goal then return row end end
end

local function chart(case, results)
  local series = {}
  for _, result in ipairs(results) do
    local x, y = {}, {}
    for i, row in ipairs(result.best) do x[i], y[i] = row.ms, row.error end
    series[#series + 1] = {name = result.name, x = x, y = y}
  end
  for _, peer in ipairs(case.peers) do
    series[#series + 1] = {name = peer.short, x = peer.ms, y = table.move(goals, 1, #peer.ms, 1, {})}
  end
  return study.chart{title = case.title, x_label = "time of one solve [ms]", y_label = "error / length", log_x = true, log_y = true,
    series = series, direct_labels = true}
end

local function line(name, cells) print(("  %-24s"):format(name) .. ("%16s"):rep(#cells):format(table.unpack(cells))) end

local function print_case(case, results)
  local reference = results[1].reference
  print(("%s: %s\n  reference: %s"):format(case.name, case.title, reference.reference_segments == 0 and "closed form"
    or ("%d segments, known to %.0e of the length"):format(reference.reference_segments, reference.reference_uncertainty / case.length)))
  local least = {}
  for _, result in ipairs(results) do
    local cells = {}
    for i, goal in ipairs(goals) do
      local row = first_below(result.best, goal)
      cells[i] = row and ("%.3f (%d)"):format(row.ms, row.segments) or "-"
      if row then least[i] = math.min(least[i] or row.ms, row.ms) end
    end
    line(result.name, cells)
  end
  for _, peer in ipairs(case.peers) do
    local cells = {}
    for i, ms in ipairs(peer.ms) do cells[i] = least[i] and ("%.2f: %.0fx"):format(ms, ms / least[i]) or "-" end
    line(peer.name, cells)
  end
end

print("ms of one solve (and its segments) for an error of       1e-3            1e-4            1e-5            1e-6 of the length")
local charts = {}
for _, case in ipairs(cases) do
  if given.case == "" or case.name == given.case then
    local s, exact = case.make()
    local results = {}
    for i, method in ipairs(methods) do
      local rows, reference = measure(case, method, s, exact)
      results[i] = {name = method.name, best = best_of(rows), reference = reference}
    end
    print_case(case, results)
    charts[#charts + 1] = chart(case, results)
  end
end
if #charts == 0 then error("no case is named '" .. given.case .. "'", 0) end
local path = given.out .. "/accuracy.png"
study.sheet{title = "Error against run time: the best meshes of each method, one core", columns = #charts > 1 and 2 or 1,
  size = #charts > 1 and {1600, 2600} or {1200, 800}, table.unpack(charts)}:save(path)
print("chart: " .. path)
