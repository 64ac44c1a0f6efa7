-- vec and frame as a script uses them.
local check = require "check"

check.case("plain tables stand for vectors, vectors never change", function()
  local v = vec(1, 2, 3)
  local w = v + {1, 1, 1}
  check.equal(v, vec(1, 2, 3))
  check.equal(w, vec(2, 3, 4))
  check.equal(-v * 2, vec(-2, -4, -6))
  check.raises(function() v.x = 5 end, "cannot be assigned to")
  check.raises(function() return v.w end, "no member 'w'")
end)

check.case("sums and products follow the rules of vectors", function()
  math.randomseed(42)
  local function random() return vec(math.random() - 0.5, math.random() - 0.5, math.random() - 0.5) end
  for _ = 1, 100 do
    local a, b, c = random(), random(), random()
    check.near(a:cross(b):dot(c), b:cross(c):dot(a), 1e-15)
    check.near(a:cross(b), -b:cross(a), 1e-16)
    check.near((a + b) + c, a + (b + c), 1e-15)
    check.near(a:unit() * a:length(), a, 1e-15)
  end
end)

check.case("a frame turned once round is the frame", function()
  local f = frame {at = {1, 2, 3}, along = {1, 1, 0}, up = {0, 0, 1}}
  local g = f
  for _ = 1, 8 do g = g:moved {turn = {{0.3, -1, 2}, 45 * units.deg}} end
  check.near(g.along, f.along, 1e-14)
  check.near(g.up, f.up, 1e-14)
  check.equal(g.at, f.at)
  check.near(f.along:dot(f.up), 0, 1e-15)
end)

check.finish()
