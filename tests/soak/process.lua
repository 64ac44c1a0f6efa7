-- What this process takes of the machine.
local process = {}

local function content(path)
  local file = assert(io.open(path))
  local text = file:read("a")
  file:close()
  return text
end

--- Bytes of memory that are in use (resident), after a full collection.
function process.memory()
  collectgarbage()
  collectgarbage()
  local pages = content("/proc/self/statm"):match("^%d+ (%d+)")
  return tonumber(pages) * 4096
end

--- Open file descriptors.
function process.files()
  local own = content("/proc/self/stat"):match("^%d+")
  local list = assert(io.popen("ls /proc/" .. own .. "/fd | wc -l"))
  local count = tonumber(list:read("a"))
  list:close()
  return count - 1  -- without the pipe that tells
end

return process
