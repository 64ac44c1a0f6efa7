-- Prints the table of scripts/bench: bench_table.lua MARKS RESULT.json...
local function fields_of(block)
  local fields = {}
  for key, value in block:gmatch('"([^"]+)": ([^\n]+)') do
    value = value:gsub(",$", "")
    fields[key] = tonumber(value) or value:match('^"(.*)"$') or value
  end
  return fields
end

local function read_marks(path)
  local marks = {}
  for line in io.lines(path) do
    local name, figure, mark, unit, words = line:match("^([^#|]+)|([^|]+)|([^|]+)|([^|]+)|(.+)$")
    if name then
      local function trim(text) return text:match("^%s*(.-)%s*$") end
      name = trim(name)
      marks[name] = marks[name] or {}
      table.insert(marks[name], {figure = trim(figure), mark = tonumber(mark), unit = trim(unit), words = trim(words)})
    end
  end
  return marks
end

-- Google Benchmark's counters of kind "inverted rate" are in seconds; times are in the benchmark's own unit.
local seconds = {us = 1e-6, ms = 1e-3, ns = 1e-9, s = 1}
local function figure_of(run, figure, unit)
  local time = {cpu = run.cpu_time, real = run.real_time}
  if time[figure] then return time[figure] * seconds[run.time_unit] / seconds[unit] end
  local value = run[figure]
  if value and figure:match("^per_") and seconds[unit] then value = value / seconds[unit] end
  return value
end

local function row(what, value, unit, mark)
  local ratio = mark and ("%8.2f"):format(value / mark) or ""
  print(("%-76s %10.4g %-3s %8s %8s"):format(what, value, unit, mark and ("%g"):format(mark) or "", ratio))
end

local function readable(time)
  for _, unit in ipairs{"s", "ms", "us"} do
    if time >= seconds[unit] then return time / seconds[unit], unit end
  end
  return time / seconds.ns, "ns"
end

local marks = read_marks(arg[1])
print(("%-76s %10s %-3s %8s %8s"):format("benchmark", "figure", "", "mark", "ratio"))
local met, measured = {}, {}
for i = 2, #arg do
  local file = assert(io.open(arg[i]))
  local text = file:read("a")
  file:close()
  local runs = text:match('"benchmarks": %[(.*)%]') or error(arg[i] .. " holds no results", 0)
  for block in runs:gmatch("{(.-)\n%s*}") do
    local run = fields_of(block)
    measured[run.name] = true
    if run.error_occurred then error(run.name .. ": " .. tostring(run.error_message), 0) end
    for _, m in ipairs(marks[run.name] or {}) do
      local value = figure_of(run, m.figure, m.unit)
      if not value then error("marks: " .. run.name .. " has no figure '" .. m.figure .. "'", 0) end
      row(m.words, value, m.unit, m.mark)
      table.insert(met, value <= m.mark)
    end
    if not marks[run.name] then
      local label = run.label and run.label ~= "" and run.label or nil
      local wall = run.name:match("real_time") or run.name:match("manual_time")
      row(run.name:gsub("/process_time", ""):gsub("/real_time", ""):gsub("/manual_time", "") .. (label and ": " .. label or ""),
          readable((wall and run.real_time or run.cpu_time) * seconds[run.time_unit]))
    end
  end
end
local kept = 0
for _, ok in ipairs(met) do kept = kept + (ok and 1 or 0) end
print(("%d of %d marks kept"):format(kept, #met))
local missing = {}
for name in pairs(marks) do
  if not measured[name] then table.insert(missing, name) end
end
table.sort(missing)
if #missing > 0 then print("not measured: " .. table.concat(missing, ", ")) end
