// The loops of kernel.h in lanes.
#pragma once

#include "method/envelope/kernel.h"
#include "method/envelope/kernel_lanes.h"

namespace TENDRIL_LANES_NAMESPACE {

using namespace tendril::envelope;

/// The highest lane and the first point that has it; `order` holds the points' numbers.
inline void settle(Floats value, Floats order, float& best, int& index) {
  float values[Floats::width], numbers[Floats::width];
  store(values, value);
  store(numbers, order);
  int at = 0;
  for (int i = 1; i < Floats::width; ++i)
    if (values[i] > values[at] || (values[i] == values[at] && numbers[i] < numbers[at])) at = i;
  best = values[at];
  index = static_cast<int>(numbers[at]);
}

inline void extremes(const PointArrays& points, const NormalArrays& normals, Extreme* out) {
  float counted[Floats::width];
  for (int i = 0; i < Floats::width; ++i) counted[i] = static_cast<float>(i);
  const Floats step = all(Floats::width), zero = all(0);
  for (int k = 0; k < normals.count; ++k) {
    const Floats nx = all(normals.x[k]), ny = all(normals.y[k]), nz = all(normals.z[k]);
    // The lowest is the highest of the opposite direction.
    Floats high = all(-1e30f), low = high, high_at = zero, low_at = zero, order = load(counted);
    for (int i = 0; i < points.count; i += Floats::width) {
      const Floats dot = fma(nz, load(points.z + i), fma(ny, load(points.y + i), times(nx, load(points.x + i))));
      const Floats opposite = less(zero, dot);
      const auto higher = above(dot, high), lower = above(opposite, low);
      high = choose(higher, dot, high);
      high_at = choose(higher, order, high_at);
      low = choose(lower, opposite, low);
      low_at = choose(lower, order, low_at);
      order = add(order, step);
    }
    settle(high, high_at, out[k].high, out[k].high_index);
    settle(low, low_at, out[k].low, out[k].low_index);
    out[k].low = -out[k].low;
  }
}

inline void supports(const PointArrays& points, const NormalArrays& normals, float* out) {
  for (int k = 0; k < normals.count; k += Floats::width) {
    const Floats nx = load(normals.x + k), ny = load(normals.y + k), nz = load(normals.z + k);
    Floats high = all(-1e30f);
    for (int i = 0; i < points.count; ++i)
      high = larger(high, fma(nz, all(points.z[i]), fma(ny, all(points.y[i]), times(nx, all(points.x[i])))));
    store(out + k, high);
  }
}

inline void distances(const PointArrays& points, const PlaneArrays& planes, float* out) {
  for (int i = 0; i < points.count; i += Floats::width) {
    const Floats x = load(points.x + i), y = load(points.y + i), z = load(points.z + i);
    Floats high = all(-1e30f);
    for (int k = 0; k < planes.count; ++k) {
      const Floats dot = fma(all(planes.z[k]), z, fma(all(planes.y[k]), y, times(all(planes.x[k]), x)));
      high = larger(high, less(dot, all(planes.offset[k])));
    }
    store(out + i, high);
  }
}

inline Floats at_middle(const PlaneArrays& planes, const Cube& cube, int k) {
  return fma(load(planes.z + k), all(cube.middle[2]),
             fma(load(planes.y + k), all(cube.middle[1]),
                 fma(load(planes.x + k), all(cube.middle[0]), less(all(0), load(planes.offset + k)))));
}

/// How far two planes' heights can draw apart within a cube of half-width 1, or, from a plane without slope, one's.
inline Floats reach(const PlaneArrays& planes, int k, const float* from) {
  return add(add(size(less(load(planes.x + k), all(from[0]))), size(less(load(planes.y + k), all(from[1])))),
             size(less(load(planes.z + k), all(from[2]))));
}

inline Narrowed narrow(const PlaneArrays& planes, const Cube& cube, float slack, float* to, int room) {
  const Floats half = all(cube.half);
  constexpr float level[3] = {0, 0, 0};
  Floats low = all(-1e30f), high = low, highest = low, at = all(0);
  for (int k = 0; k < planes.count; k += Floats::width) {
    const Floats value = at_middle(planes, cube, k), way = times(half, reach(planes, k, level));
    low = larger(low, less(value, way));
    high = larger(high, add(value, way));
    at = choose(above(value, highest), all(static_cast<float>(k)), at);
    highest = larger(highest, value);
    store(to + k, value);  // for the second round; where the copies go later
  }
  Narrowed result{{largest(low), largest(high)}};
  if (result.bounds.low > slack || result.bounds.high < -slack) return result;
  float values[Floats::width], places[Floats::width];
  store(values, highest);
  store(places, at);
  int best = 0;
  for (int i = 1; i < Floats::width; ++i)
    if (values[i] > values[best] || (values[i] == values[best] && places[i] < places[best])) best = i;
  const int top = static_cast<int>(places[best]) + best;
  const float normal[3] = {planes.x[top], planes.y[top], planes.z[top]};
  const Floats bound = all(values[best] - slack);
  result.top = static_cast<int>(planes.number[top]);
  // Copies, whole registers included, never overtake the values that are still to be read.
  int count = 0;
  for (int k = 0; k < planes.count; k += Floats::width) {
    const Floats most = fma(half, reach(planes, k, normal), load(to + k));
    const auto kept = above(most, bound);
    const std::uint32_t found = bits(kept);
    if (!found) continue;
    pack(to + count, load(planes.x + k), kept);
    pack(to + count + room, load(planes.y + k), kept);
    pack(to + count + 2 * room, load(planes.z + k), kept);
    pack(to + count + 3 * room, load(planes.offset + k), kept);
    pack(to + count + 4 * room, load(planes.number + k), kept);
    count += __builtin_popcount(found);
  }
  for (; count % 16; ++count) {
    for (int row = 0; row < plane_rows; ++row) to[count + row * room] = 0;
    to[count + 3 * room] = 1e30f;
  }
  result.count = count;
  return result;
}

inline bool all_below(const PlaneArrays& planes, const float* plane, const Cube& cube, float slack) {
  const float* m = cube.middle;
  const float value = plane[0] * m[0] + plane[1] * m[1] + plane[2] * m[2] - plane[3];
  const Floats half = all(cube.half), bound = all(value - slack);
  for (int k = 0; k < planes.count; k += Floats::width)
    if (bits(above(fma(half, reach(planes, k, plane), at_middle(planes, cube, k)), bound))) return false;
  return true;
}

/// The registers that hold the nodes of one layer: rows of 8 nodes, one or two to a register.
struct Layer {
  static constexpr int registers = 64 / Floats::width;
  Floats x, y[registers];
  explicit Layer(const NodeGrid& nodes) {
    float lanes[Floats::width];
    for (int i = 0; i < Floats::width; ++i) lanes[i] = nodes.x[i % 8];
    x = load(lanes);
    for (int g = 0; g < registers; ++g) {
      for (int i = 0; i < Floats::width; ++i) lanes[i] = nodes.y[g * (Floats::width / 8) + i / 8];
      y[g] = load(lanes);
    }
  }
};

inline void lower_by_planes(const PlaneArrays& planes, const NodeGrid& nodes, float* field) {
  constexpr int registers = Layer::registers, layers = Floats::width == 16 ? 4 : 1;  // as many as fit into registers
  const Layer layer(nodes);
  for (int z = 0; z < 8; z += layers) {
    Floats high[layers][registers];
    for (int l = 0; l < layers; ++l)
      for (int g = 0; g < registers; ++g) high[l][g] = all(-1e30f);
    for (int k = 0; k < planes.count; ++k) {
      if (planes.offset[k] > 1e29f) break;  // what fills up the tail
      const Floats along_x = fma(all(planes.x[k]), layer.x, all(-planes.offset[k]));
      const Floats ny = all(planes.y[k]), nz = all(planes.z[k]);
      for (int g = 0; g < registers; ++g) {
        const Floats along_y = fma(ny, layer.y[g], along_x);
        for (int l = 0; l < layers; ++l) high[l][g] = larger(high[l][g], fma(nz, all(nodes.z[z + l]), along_y));
      }
    }
    for (int l = 0; l < layers; ++l)
      for (int g = 0; g < registers; ++g) {
        float* const at = field + (z + l) * 64 + g * Floats::width;
        store(at, smaller(load(at), high[l][g]));
      }
  }
}

inline void lower_by_capsule(const Capsule& c, const NodeGrid& nodes, float* field) {
  const Layer layer(nodes);
  const Floats zero = all(0), one = all(1);
  const Floats x = less(layer.x, all(c.a[0]));
  for (int z = 0; z < 8; ++z) {
    const Floats from_z = all(nodes.z[z] - c.a[2]);
    for (int g = 0; g < Layer::registers; ++g) {
      const Floats y = less(layer.y[g], all(c.a[1]));
      const Floats dot = fma(all(c.along[2]), from_z, fma(all(c.along[1]), y, times(all(c.along[0]), x)));
      const Floats back = less(zero, smaller(one, larger(zero, times(dot, all(c.inverse)))));
      const Floats dx = fma(back, all(c.along[0]), x), dy = fma(back, all(c.along[1]), y);
      const Floats dz = fma(back, all(c.along[2]), from_z);
      const Floats away = root(fma(dz, dz, fma(dy, dy, times(dx, dx))));
      float* const at = field + z * 64 + g * Floats::width;
      store(at, smaller(load(at), less(away, all(c.radius))));
    }
  }
}

inline void signs(const float* field, std::uint64_t* inside) {
  for (int z = 0; z < 8; ++z) {
    std::uint64_t word = 0;
    for (int i = 0; i < 64; i += Floats::width)
      word |= static_cast<std::uint64_t>(bits(above(all(0), load(field + z * 64 + i)))) << i;
    inside[z] = word;
  }
}

inline constexpr Kernel kernel_named(const char* name) {
  return {name, extremes, supports, distances, narrow, all_below, lower_by_planes, lower_by_capsule, signs};
}

}  // namespace TENDRIL_LANES_NAMESPACE
