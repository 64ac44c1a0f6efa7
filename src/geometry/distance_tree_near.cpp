// Parts of a tree that may be near a box: by gaps along the axes of both, the normals of triangles and a given direction.
#include <algorithm>

#include "geometry/distance_tree.h"

namespace tendril {
namespace {

using simd::Float8;

Float8 absolute(Float8 x) { return simd::larger(x, -x); }
Float8 positive(Float8 x) { return simd::larger(x, simd::all(0)); }

}  // namespace

// The box in single precision about the mesh's middle, and the direction as a fourth axis without a length.
struct DistanceTree::Probe {
  float middle[3], axes[4][3], half[3], along;  // `along`: half the box's length in the direction

  /// Half its length along a unit vector that has these parts along its axes.
  float reach(float x, float y, float z) const { return std::abs(x) * half[0] + std::abs(y) * half[1] + std::abs(z) * half[2]; }
};

// Boxes are apart by the length of the gaps along the axes of either one, and by the gap along any direction.
DistanceTree::Float8 DistanceTree::part_gaps(const Node& node, const Probe& probe) {
  const Turned middle = turned(node, probe.middle);
  Turned axes[4];
  for (int i = 0; i < 4; ++i) axes[i] = turned(node, probe.axes[i]);
  Float8 to[3], half[3], own = simd::all(0), other = simd::all(0);
  for (int k = 0; k < 3; ++k) {
    const Float8 low = load(node.low[k]), high = load(node.high[k]);
    to[k] = simd::all(middle.at[k]) - simd::all(0.5f) * (low + high);
    half[k] = simd::all(0.5f) * (high - low);
    const float reach = probe.reach(axes[0].at[k], axes[1].at[k], axes[2].at[k]);
    const Float8 gap = positive(absolute(to[k]) - half[k] - simd::all(reach));
    own += gap * gap;
  }
  Float8 along;
  for (int i = 0; i < 4; ++i) {
    const Float8 apart = to[0] * axes[i].at[0] + to[1] * axes[i].at[1] + to[2] * axes[i].at[2];
    const Float8 reach = half[0] * std::abs(axes[i].at[0]) + half[1] * std::abs(axes[i].at[1]) + half[2] * std::abs(axes[i].at[2]);
    if (i == 3) along = positive(apart - reach - simd::all(probe.along));
    else {
      const Float8 gap = positive(absolute(apart) - reach - simd::all(probe.half[i]));
      other += gap * gap;
    }
  }
  return simd::larger(simd::larger(own, other), along * along);
}

DistanceTree::Float8 DistanceTree::leaf_gaps(const Leaf& leaf, const Probe& probe) {
  Float8 to[3], own = simd::all(0), other = simd::all(0), along;
  for (int k = 0; k < 3; ++k) {
    to[k] = simd::all(probe.middle[k]) - load(leaf.corner[k]);
    const Float8 side = load(leaf.side[k]), second = load(leaf.other[k]), zero = simd::all(0);
    const float reach = probe.reach(probe.axes[0][k], probe.axes[1][k], probe.axes[2][k]);
    const Float8 above = to[k] - simd::larger(simd::larger(side, second), zero);
    const Float8 below = simd::smaller(simd::smaller(side, second), zero) - to[k];
    const Float8 gap = positive(simd::larger(above, below) - simd::all(reach));
    own += gap * gap;
  }
  const auto share = [](const float (&v)[3][8], const float* axis) {
    return load(v[0]) * axis[0] + load(v[1]) * axis[1] + load(v[2]) * axis[2];
  };
  for (int i = 0; i < 4; ++i) {
    const float* axis = probe.axes[i];
    const Float8 apart = to[0] * axis[0] + to[1] * axis[1] + to[2] * axis[2], zero = simd::all(0);
    const Float8 side = share(leaf.side, axis), second = share(leaf.other, axis);
    const Float8 above = apart - simd::larger(simd::larger(side, second), zero);
    if (i == 3) {
      along = positive(above - simd::all(probe.along));
      continue;
    }
    const Float8 below = simd::smaller(simd::smaller(side, second), zero) - apart;
    const Float8 gap = positive(simd::larger(above, below) - simd::all(probe.half[i]));
    other += gap * gap;
  }
  Float8 height = simd::all(0), reach = simd::all(0);
  for (int k = 0; k < 3; ++k) height += to[k] * load(leaf.normal[k]);
  for (int i = 0; i < 3; ++i) reach += absolute(share(leaf.normal, probe.axes[i])) * probe.half[i];
  const Float8 off = positive(absolute(height) - reach);
  return simd::larger(simd::larger(own, other), simd::larger(along * along, off * off));
}

int DistanceTree::near(int part, const OrientedBox& box, const Vec3& direction, double range, Near (&out)[8]) const {
  const Vec3 local = box.middle - middle_;
  if (!(range > 0) || !all_finite(local) || !all_finite(box.half)) return 0;
  Probe probe;
  for (int k = 0; k < 3; ++k) {
    probe.middle[k] = static_cast<float>(local[k]);
    probe.half[k] = static_cast<float>(box.half[k]);
    for (int i = 0; i < 3; ++i) probe.axes[i][k] = static_cast<float>(box.axes(k, i));
    probe.axes[3][k] = static_cast<float>(direction[k]);
  }
  probe.along = static_cast<float>((box.axes.transpose() * direction).cwiseAbs().dot(box.half));
  // A gap is a sum of up to three products for each of the mesh's, the box's and the part's lengths.
  const double slack = 2 * margin(local) + 3e-6 * box.half.sum();
  const float bound = std::min(widened(range, slack), std::numeric_limits<float>::max());
  const Float8 squared = part < 0 ? leaf_gaps(leaves_[~part], probe) : part_gaps(nodes_[part], probe);
  int count = 0;
  for (unsigned near = simd::bits(squared < simd::all(bound)); near; near &= near - 1) {
    const int lane = __builtin_ctz(near);
    Near found{0, std::max(0.0f, std::sqrt(squared[lane]) * (1 - 1e-6f) - static_cast<float>(slack)), 0};
    if (part < 0) {
      found.part = leaves_[~part].triangle[lane];
      if (found.part < 0) continue;
    } else {
      const Node& node = nodes_[part];
      found.part = node.child[lane];
      if (found.part == 0) continue;
      for (int k = 0; k < 3; ++k) found.size += (node.high[k][lane] - node.low[k][lane]) * (node.high[k][lane] - node.low[k][lane]);
      found.size = 0.5f * std::sqrt(found.size);
    }
    int at = count++;
    for (; at > 0 && out[at - 1].at_least < found.at_least; --at) out[at] = out[at - 1];
    out[at] = found;
  }
  return count;
}

}  // namespace tendril
