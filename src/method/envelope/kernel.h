// The inner loops of envelopes as functions over plain arrays of floats, so that they can be compiled for several
// instruction sets without touching what the rest of the program is made of.
//
// All are in single precision about a local origin, with fused multiply-add in a fixed order: a value does not depend on
// how many lanes a register has.
#pragma once

#include <cstdint>

#include "statics/batch_kernel.h"

namespace tendril::envelope {

/// Points side by side; `count` is a multiple of 16 (the tail repeats a point).
struct PointArrays {
  const float *x, *y, *z;
  int count;
};

/// Unit vectors side by side; the rows are readable up to a multiple of 16.
struct NormalArrays {
  const float *x, *y, *z;
  int count;
};

/// Half-spaces n . p <= offset, each with a number. `count` is a multiple of 16 (the tail holds planes that are never
/// reached).
struct PlaneArrays {
  const float *x, *y, *z, *offset, *number;
  int count;
};
constexpr int plane_rows = 5;

/// All points nearer than `radius` to a segment from `a` along `along`.
struct Capsule {
  float a[3], along[3];
  float inverse;  ///< 1 / |along|^2, 0 for a ball
  float radius;
};

/// The lowest and the highest dot product of one direction, and the first points that have them.
struct Extreme {
  float low, high;
  int low_index, high_index;
};

/// What a convex field is within a cube: nowhere less than `low`, nowhere more than `high`.
struct FieldBounds {
  float low, high;
};

/// The field of planes within a cube, and the planes that can be the highest somewhere in it.
struct Narrowed {
  FieldBounds bounds;
  int top = 0;    ///< the number of the plane that is the highest at the cube's middle
  int count = 0;  ///< planes left, filled up to a multiple of 16; 0 where the field is all above or all below 0
};

/// A cube's middle and half its width, m.
struct Cube {
  float middle[3];
  float half;
};

/// The coordinates of a block's 8 x 8 x 8 nodes, m. Node (i, j, k) is number (k * 8 + j) * 8 + i.
struct NodeGrid {
  float x[8], y[8], z[8];
};

struct Kernel {
  const char* name;

  /// Dot products of all points with each of the normals.
  void (*extremes)(const PointArrays& points, const NormalArrays& normals, Extreme* out);
  /// out[k] = max over points of n_k . p. `out` has room up to a multiple of 16.
  void (*supports)(const PointArrays& points, const NormalArrays& normals, float* out);
  /// out[i] = max over planes of n . p_i - offset.
  void (*distances)(const PointArrays& points, const PlaneArrays& planes, float* out);

  /// Bounds of max over planes of n . p - offset within a cube. Where they leave 0 between them (by `slack`), the planes
  /// that are not everywhere in the cube below the one that is the highest at its middle are copied to rows of `room`
  /// floats at `to`: x, y, z, offset, number.
  Narrowed (*narrow)(const PlaneArrays& planes, const Cube& cube, float slack, float* to, int room);
  /// All planes lie below one plane (x, y, z, offset) everywhere in the cube, by `slack` at least.
  bool (*all_below)(const PlaneArrays& planes, const float* plane, const Cube& cube, float slack);

  /// field[i] = min(field[i], max over planes of n . p_i - offset) at 512 nodes; `field` is 64-byte aligned.
  void (*lower_by_planes)(const PlaneArrays& planes, const NodeGrid& nodes, float* field);
  /// field[i] = min(field[i], distance to the segment - radius).
  void (*lower_by_capsule)(const Capsule& capsule, const NodeGrid& nodes, float* field);
  /// Bit j * 8 + i of inside[k]: the field at node (i, j, k) is below 0.
  void (*signs)(const float* field, std::uint64_t* inside);
};

/// Null where this processor, or this program, does not have it. `common`: always there.
const Kernel* kernel_for(InstructionSet set);

/// The fastest that this processor has.
const Kernel& best_kernel();

}  // namespace tendril::envelope
