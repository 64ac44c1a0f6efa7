-- The planar elastica in closed form: Jacobi's elliptic functions by the arithmetic-geometric mean.
--
-- phi is the tangent's angle to the direction in which the rod is compressed with the force P. It swings as a pendulum,
-- EI phi'' = -P sin phi, so sin(phi/2) = k sn(u), u = u0 + lambda s, lambda^2 = P/EI, and both integrals of the tangent are
-- elliptic functions. The force is the same all along the rod. With GA = EA the strain is force over EA in any direction:
-- every place moves on by s force/EA, and nothing else changes, since force x force = 0.
local elastica = {}

-- sn, cn, dn and E(am(u)) at u for the modulus k, then the complete integrals K and E.
function elastica.functions(u, k)
  local a, b, c = {[0] = 1}, {[0] = math.sqrt(1 - k * k)}, {[0] = k}
  local n, power, sum = 0, 1, k * k
  while math.abs(c[n]) > 1e-16 and n < 12 do
    a[n + 1], b[n + 1], c[n + 1] = (a[n] + b[n]) / 2, math.sqrt(a[n] * b[n]), (a[n] - b[n]) / 2
    n, power = n + 1, power * 2
    sum = sum + power * c[n] * c[n]
  end
  local K = math.pi / (2 * a[n])
  local E = K * (1 - sum / 2)
  local phi, e = power * a[n] * u, u * E / K
  for i = n, 1, -1 do
    e = e + c[i] * math.sin(phi)
    phi = (phi + math.asin(c[i] / a[i] * math.sin(phi))) / 2
  end
  local sn, cn = math.sin(phi), math.cos(phi)
  return {sn = sn, cn = cn, dn = math.sqrt(1 - k * k * sn * sn), e = e, K = K, E = E}
end

-- The root of a function that rises through zero between low and high.
local function root(f, low, high)
  for _ = 1, 200 do
    local middle = (low + high) / 2
    if f(middle) < 0 then low = middle else high = middle end
  end
  return (low + high) / 2
end

-- The way s of an elastica from its start: along the direction of compression, and across it.
local function way(s, lambda, u0, k)
  local from, to = elastica.functions(u0, k), elastica.functions(u0 + lambda * s, k)
  return 2 / lambda * (to.e - from.e) - s, -2 * k / lambda * (to.cn - from.cn)
end

-- A rod of length L clamped at the origin along +x, with the dead force -P z at its end.
function elastica.cantilever(L, EI, EA, P)
  local lambda = math.sqrt(P / EI)
  local function start(k) return elastica.functions(0, k).K - lambda * L end  -- the end is free of moment: u = K there
  local k = root(function(k) return k * elastica.functions(start(k), k).sn - math.sqrt(0.5) end, math.sqrt(0.5), 1 - 1e-9)
  local u0 = start(k)
  return function(s)
    local up, out = way(s, lambda, u0, k)
    return vec(out, 0, up - P * s / EA)
  end
end

-- A rod of length L clamped along x at the origin and at (chord, 0, 0), buckled in its first mode towards `side`, a unit
-- vector across x.
function elastica.column(L, EI, EA, chord, side)
  local function force(k) return EI * (4 * elastica.functions(0, k).K / L) ^ 2 end
  local k = root(function(k)
    local f = elastica.functions(0, k)
    return chord - (L * (2 * f.E / f.K - 1) - force(k) * L / EA)
  end, 1e-6, 0.99)
  local P = force(k)
  local lambda = math.sqrt(P / EI)
  return function(s)
    local along, across = way(s, lambda, 0, k)
    return vec(along - P * s / EA, 0, 0) + across * side
  end
end

return elastica
