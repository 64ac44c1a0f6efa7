-- Benchmark: outcomes and envelope of one connected harness. A trunk of 15 pieces with a twig at every joint and two at the last:
-- 30 rods of 40 segments, held at all free ends; lengths and directions of the twigs vary.
--
--   build/tendril tests/bench/harness_envelope.lua
local mm, deg = units.mm, units.deg
local m = rod.material{young=2e7, poisson=0.4, density=1300}
local sec = rod.section{outer=12*mm, material=m}
local s = scene.new{gravity={0,0,-9.81}}
local J, step = 14, 0.1
for k=0,J do
  s:rod("trunk"..k, rod.new{length=step, section=sec, segments=40}, {
    from = k==0 and frame{at={0,0,0}, along={1,0,0}} or nil,
    to = k==J and frame{at={step*(J+1),0,0}, along={1,0,0}} or nil})
end
local vary = {}
for k=0,J do
  local x, side = step*math.min(k+1,J), k%2==1 and -1 or 1
  s:rod("twig"..k, rod.new{length=1.02*0.15, section=sec, segments=40}, {to=frame{at={x+0.05, side*0.12, 0}, along={0,side,0}}})
  vary["twig"..k..".length"] = 0.003; vary["twig"..k..".to"] = {cone=5*deg}
end
for k=0,J-1 do
  local p = {{"trunk"..k,"finish"},{"trunk"..(k+1),"start"},{"twig"..k,"start"}}
  if k==J-1 then p[4]={"twig"..J,"start"} end
  s:branch("joint"..k, p)
end
local v = method.variation(s, {vary=vary, outcomes=1000, measure={"trunk0.min_bend_radius"}})
assert(v.ok, v.message)
for _ = 1, 5 do
  local _, about = v:envelope{resolution=2*mm, uniform=false}
  print(("outcomes %.3f s, envelope %.3f s, together %.3f s"):format(about.seconds_for_outcomes, about.seconds, about.seconds_for_outcomes + about.seconds))
end
for line in io.lines("/proc/self/status") do if line:find("VmHWM") then print(line) end end
