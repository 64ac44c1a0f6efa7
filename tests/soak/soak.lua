-- Random studies for as long as is wished, with a bound on what they may leave behind.
--   tendril tests/soak/soak.lua [minutes [seed [KIND]]]
-- A failure tells the seed of its study: `soak.lua 0 SEED KIND` runs that one alone.
local here = arg[0]:match("^(.*)/") or "."
package.path = here .. "/?.lua;" .. package.path
local process, studies = require "process", require "studies"

local minutes, first, only = tonumber(arg[1]) or 1, math.tointeger(arg[2]) or 1, arg[3]
local most_growth, most_files = 192 * 2 ^ 20, 4  -- caches of fields and fonts are filled by then

local folder = os.tmpname() .. ".soak"
assert(os.execute("mkdir -p '" .. folder .. "'"))

-- Those that take long come less often.
local shares = {equilibrium = 30, variation = 6, route = 3, preform = 3, assembly = 1, picture = 2, saved = 2, robot = 10, errors = 60, stopped = 10}
local kinds, order = {}, {}
for kind, share in pairs(shares) do order[#order + 1] = kind for _ = 1, share do kinds[#kinds + 1] = kind end end
table.sort(kinds)
table.sort(order)

local counts = {}
local function run(seed)
  local random = studies.random(seed)
  local kind = only or random.one(kinds)
  local ok, message = xpcall(studies[kind], debug.traceback, random, folder)
  if not ok then error(string.format("soak: '%s' with seed %d failed (soak.lua 0 %d %s): %s", kind, seed, seed, kind, message), 0) end
  counts[kind] = (counts[kind] or 0) + 1
end

local start, seed, begun = os.time(), first, nil
local files = process.files()
repeat
  run(seed)
  seed = seed + 1
  if seed - first == 100 then begun = process.memory() end
  if begun and (seed - first) % 500 == 0 then
    local grown = process.memory() - begun
    assert(grown < most_growth, string.format("soak: %.0f MB more than after the first hundred studies", grown / 2 ^ 20))
  end
until os.difftime(os.time(), start) >= 60 * minutes

os.execute("rm -r '" .. folder .. "'")
local left = process.files() - files
assert(left <= most_files, "soak: " .. left .. " more open files than before")
local told = {}
for _, kind in ipairs(order) do told[#told + 1] = string.format("%s %d", kind, counts[kind] or 0) end
print(string.format("%d studies with seeds from %d: %s", seed - first, first, table.concat(told, ", ")))
print(string.format("memory %.0f MB%s, open files %+d", process.memory() / 2 ^ 20,
                    begun and string.format(" (%+.1f since the first hundred studies)", (process.memory() - begun) / 2 ^ 20) or "", left))
