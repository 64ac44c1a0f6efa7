-- Small means of testing: named cases, comparisons that say what they saw, errors by their words.
local check = {cases = 0, assertions = 0}

local failures = {}

--- Runs one case. A failure is kept, so that the others still run.
function check.case(name, body)
  check.cases = check.cases + 1
  local ok, message = xpcall(body, debug.traceback)
  if not ok then failures[#failures + 1] = name .. "\n  " .. tostring(message):gsub("\n", "\n  ") end
end

local function fail(text)
  error(text, 3)
end

function check.equal(got, expected, what)
  check.assertions = check.assertions + 1
  if got ~= expected then
    fail(string.format("%sgot %s, expected %s", what and what .. ": " or "", tostring(got), tostring(expected)))
  end
end

function check.is_true(value, what)
  check.assertions = check.assertions + 1
  if value ~= true then fail(string.format("%sgot %s, expected true", what and what .. ": " or "", tostring(value))) end
end

--- |got - expected| <= tolerance; for vectors the length of the difference.
function check.near(got, expected, tolerance, what)
  check.assertions = check.assertions + 1
  local distance = got - expected
  distance = type(distance) == "number" and math.abs(distance) or distance:length()
  if not (distance <= tolerance) then
    fail(string.format("%sgot %s, expected %s within %s", what and what .. ": " or "", tostring(got), tostring(expected),
      tostring(tolerance)))
  end
end

--- The text contains every one of the given pieces.
function check.contains(text, ...)
  check.assertions = check.assertions + 1
  for _, piece in ipairs {...} do
    if not tostring(text):find(piece, 1, true) then fail(string.format("'%s' does not contain '%s'", tostring(text), piece)) end
  end
end

--- The body raises an error at a line of the calling file, and its message contains every piece.
function check.raises(body, ...)
  check.assertions = check.assertions + 1
  local ok, message = pcall(body)
  if ok then fail("no error was raised") end
  message = tostring(message)
  for _, piece in ipairs {...} do
    if not message:find(piece, 1, true) then fail(string.format("the error '%s' does not contain '%s'", message, piece)) end
  end
  local here = debug.getinfo(2, "S").short_src
  if message:sub(1, #here) ~= here then fail(string.format("the error '%s' does not begin with the line of %s", message, here)) end
end

--- Prints the sum and ends the script: with an error when a case failed.
function check.finish()
  print(string.format("%d cases, %d checks, %d failed", check.cases, check.assertions, #failures))
  if #failures > 0 then error(table.concat(failures, "\n"), 0) end
end

--- The folder for files that a test writes: the script's first argument.
function check.folder()
  return arg and arg[1] or os.tmpname() .. ".d"
end

return check
