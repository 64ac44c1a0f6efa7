#include "geometry/distance_tree.h"

#include <algorithm>

#include "geometry/closest_point.h"

namespace tendril {

namespace {

using simd::Float8;

// The boxes of children that are not there are infinitely far away.
constexpr float largest = std::numeric_limits<float>::max();

struct Vector8 {
  Float8 x, y, z;
};
Vector8 operator-(const Vector8& a, const Vector8& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Float8 dot(const Vector8& a, const Vector8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector8 cross(const Vector8& a, const Vector8& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Vector8 at(const float (&v)[3][8]) {
  const auto load = [](const float* x) { return *reinterpret_cast<const Float8*>(x); };
  return {load(v[0]), load(v[1]), load(v[2])};
}

// From the near end of a segment `along`, seen from which p is at `to`.
Float8 to_segment(const Vector8& to, const Vector8& along) {
  // The tiny addition makes 0 / 0 of a segment without length a 0.
  Float8 share = dot(to, along) / (dot(along, along) + simd::all(1e-37f));
  share = simd::larger(simd::smaller(share, simd::all(1)), simd::all(0));
  const Vector8 off{to.x - share * along.x, to.y - share * along.y, to.z - share * along.z};
  return dot(off, off);
}

}  // namespace

// Squared distances to eight triangles. Wrong by rounding only, also for slivers, because the normals are exact: where
// the foot of the perpendicular is misjudged it is so near a side that the distance to the side is right.
simd::Float8 DistanceTree::triangle_distances(const Leaf& leaf, const float* p) {
  const Vector8 side = at(leaf.side), other = at(leaf.other), normal = at(leaf.normal), corner = at(leaf.corner);
  const Vector8 to{simd::all(p[0]) - corner.x, simd::all(p[1]) - corner.y, simd::all(p[2]) - corner.z};
  const Vector8 third = other - side, to_third = to - side;
  const Float8 rim = simd::smaller(simd::smaller(to_segment(to, side), to_segment(to, other)), to_segment(to_third, third));
  const Vector8 q = cross(to, normal);
  const Float8 height = dot(normal, to), zero = simd::all(0);
  const auto inside = (dot(side, q) > zero) & (dot(other, q) < zero) & (dot(third, cross(to_third, normal)) > zero);
  return inside ? simd::smaller(height * height, rim) : rim;
}

// Triangles that may be the closest one, by their distances in single precision, and a bound on those.
struct DistanceTree::Shortlist {
  float bound;    ///< squared, m^2: what is farther is out of the question
  double margin;  ///< m
  int count = 0;
  Candidate entries[64];

  Shortlist(float bound, double margin) : bound(bound), margin(margin) {}
  bool full() const { return count > 64 - 8; }
  void add(Candidate triangle) { entries[count++] = triangle; }
  // One margin for the rounding of this distance, one for that of others.
  void narrow(float squared) {
    if (squared < bound) bound = std::min(bound, widened(std::sqrt(squared), 2 * margin));
  }
};

void DistanceTree::measure(const Vec3& p, int triangle, Nearest& best) const {
  const auto& t = mesh_.triangles[triangle];
  const TriangleFoot foot =
      closest_on_triangle(p, mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
  const double distance = std::sqrt(foot.squared);
  if (distance < best.distance) best = {distance, foot.point, triangle};
}

// Measures what is still in question, in the order it was found, and narrows the bound.
void DistanceTree::settle(const Vec3& p, Shortlist& shortlist, Nearest& best) const {
  for (int i = 0; i < shortlist.count; ++i) {
    if (shortlist.entries[i].squared > shortlist.bound) continue;
    measure(p, shortlist.entries[i].index, best);
    shortlist.bound = std::min(shortlist.bound, widened(best.distance, shortlist.margin));
  }
  shortlist.count = 0;
}

DistanceTree::Nearest DistanceTree::closest(const Vec3& p, double limit, int hint) const {
  Nearest best{limit, p, -1};
  const Vec3 local = p - middle_;
  if (!(limit > 0) || !all_finite(p)) return best;
  const double slack = margin(local);
  const float q[3] = {static_cast<float>(local.x()), static_cast<float>(local.y()), static_cast<float>(local.z())};
  // The hint only bounds the search. Were it a candidate, the answer among equally near triangles would depend on it.
  if (hint >= 0) {
    Nearest hinted = best;
    measure(p, hint, hinted);
    if (hinted.triangle >= 0) best.distance = std::nextafter(hinted.distance, std::numeric_limits<double>::infinity());
    best.distance = std::min(best.distance, limit);
  }
  Shortlist shortlist(widened(best.distance, slack), slack);
  Candidate stack[stack_size], next{0, 0};
  for (int top = 0;; next = stack[--top]) {
    while (next.index >= 0 && next.squared <= shortlist.bound) {
      const Node& node = nodes_[next.index];
      const Float8 squared = box_distances(node, q);
      unsigned near = simd::bits(squared <= simd::all(std::min(shortlist.bound, largest)));
      if (near == 0) {
        next.squared = std::numeric_limits<float>::infinity();
        break;
      }
      // Down the nearest child; the others wait.
      const float least = simd::smallest(squared);
      const int first = __builtin_ctz(simd::bits(squared == simd::all(least)));
      for (near &= ~(1u << first); near; near &= near - 1) {
        const int lane = __builtin_ctz(near);
        stack[top++] = {squared[lane], node.child[lane]};
      }
      next = {least, node.child[first]};
    }
    if (next.index < 0 && next.squared <= shortlist.bound) {
      const Leaf& leaf = leaves_[~next.index];
      const Float8 squared = triangle_distances(leaf, q);
      shortlist.narrow(simd::smallest(squared));
      for (unsigned near = simd::bits(squared <= simd::all(shortlist.bound)); near; near &= near - 1) {
        const int lane = __builtin_ctz(near);
        if (leaf.triangle[lane] >= 0) shortlist.add({squared[lane], leaf.triangle[lane]});
      }
      if (shortlist.full()) settle(p, shortlist, best);
    }
    if (top == 0) break;
  }
  settle(p, shortlist, best);
  if (best.triangle < 0) best.distance = limit;
  return best;
}

// Below `certain` single precision suffices, above `possible` too; in between the mesh itself is asked.
bool DistanceTree::any_within(const Leaf& leaf, const float* q, const Vec3& p, double range, float certain, float possible) const {
  const Float8 squared = triangle_distances(leaf, q);
  // Empty places repeat the first triangle.
  if (simd::bits(squared < simd::all(certain))) return true;
  for (unsigned near = simd::bits(squared <= simd::all(possible)); near; near &= near - 1) {
    const int triangle = leaf.triangle[__builtin_ctz(near)];
    if (triangle < 0) continue;
    Nearest nearest{range, p, -1};
    measure(p, triangle, nearest);
    if (nearest.triangle >= 0) return true;
  }
  return false;
}

bool DistanceTree::within(const Vec3& p, double range) const {
  const Vec3 local = p - middle_;
  if (!(range > 0) || !all_finite(p)) return false;
  const double slack = margin(local);
  const float q[3] = {static_cast<float>(local.x()), static_cast<float>(local.y()), static_cast<float>(local.z())};
  const float possible = std::min(widened(range, slack), largest);
  const double sure = range - slack;
  const float certain = sure > 0 ? static_cast<float>(sure * sure * (1 - 1e-6)) : 0;
  int stack[stack_size];
  int top = 0;
  for (int next = 0;;) {
    if (next < 0) {
      if (any_within(leaves_[~next], q, p, range, certain, possible)) return true;
    } else {
      const Node& node = nodes_[next];
      const Float8 squared = box_distances(node, q);
      unsigned near = simd::bits(squared <= simd::all(possible));
      if (near) {
        // Down the nearest child; the others wait.
        const int first = __builtin_ctz(simd::bits(squared == simd::all(simd::smallest(squared))));
        for (near &= ~(1u << first); near; near &= near - 1) stack[top++] = node.child[__builtin_ctz(near)];
        next = node.child[first];
        continue;
      }
    }
    if (top == 0) return false;
    next = stack[--top];
  }
}

void DistanceTree::crossing(const Vec3& a, const Vec3& b, int triangle, std::optional<Hit>& first) const {
  const auto& t = mesh_.triangles[triangle];
  const Vec3 v0 = mesh_.vertices[t[0]] - a, v1 = mesh_.vertices[t[1]] - a, v2 = mesh_.vertices[t[2]] - a;
  const Vec3 way = b - a, normal = (v1 - v0).cross(v2 - v0);
  const double length = normal.norm();
  if (!(length > 0)) return;
  const double from = -normal.dot(v0), to = from + normal.dot(way);
  if (from == 0 || (from > 0) == (to > 0 || (to == 0 && from < 0))) return;
  const double share = from / (from - to);
  if (first && share >= first->share) return;
  // Signed volumes of the way with each side. A common side gives both its triangles the same volume but for rounding;
  // the tolerance of both triangles covers the rounding, so that no path slips between them.
  const Vec3 c01 = v0.cross(v1), c12 = v1.cross(v2), c20 = v2.cross(v0);
  const double w2 = way.dot(c01), w0 = way.dot(c12), w1 = way.dot(c20);
  const double reach = std::max({v0.squaredNorm(), v1.squaredNorm(), v2.squaredNorm()});
  const double tolerance = 1e-15 * way.norm() * reach;
  const double sign = from > 0 ? -1 : 1;
  if (sign * w0 < -tolerance || sign * w1 < -tolerance || sign * w2 < -tolerance) return;
  first = Hit{share, a + share * way, normal * ((from > 0 ? 1 : -1) / length), triangle};
}

std::optional<DistanceTree::Hit> DistanceTree::ray(const Vec3& a, const Vec3& b) const {
  std::optional<Hit> first;
  if (!all_finite(a) || !all_finite(b)) return first;
  const Vec3 local = a - middle_, way = b - a;
  const float slack = static_cast<float>(margin(local) + margin(b - middle_));
  float start[3], along[3];
  for (int k = 0; k < 3; ++k) start[k] = static_cast<float>(local[k]), along[k] = static_cast<float>(way[k]);
  Candidate stack[stack_size];
  int top = 0;
  stack[top++] = {0, 0};
  while (top > 0) {
    const Candidate next = stack[--top];
    const float bound = first ? static_cast<float>(first->share) * 1.00001f : 1.00001f;
    if (next.squared > bound) continue;
    if (next.index < 0) {
      for (int triangle : leaves_[~next.index].triangle)
        if (triangle >= 0) crossing(a, b, triangle, first);
      continue;
    }
    const Node& node = nodes_[next.index];
    const Turned origin = turned(node, start), slope = turned(node, along);
    Float8 enter = simd::all(0), leave = simd::all(bound);
    for (int k = 0; k < 3; ++k) {
      // A way along a plane of the boxes: a huge inverse instead of an infinite one, which would make NaN of 0 * infinity.
      const float inverse = 1 / (std::abs(slope.at[k]) > 1e-20f ? slope.at[k] : std::copysign(1e-20f, slope.at[k]));
      const Float8 low = (load(node.low[k]) - (slack + origin.at[k])) * inverse;
      const Float8 high = (load(node.high[k]) + (slack - origin.at[k])) * inverse;
      enter = simd::larger(enter, simd::smaller(low, high));
      leave = simd::smaller(leave, simd::larger(low, high));
    }
    const int begin = top;
    // Shares are rounded at a few 1e-7 of their size.
    for (unsigned on = simd::bits(enter <= leave * simd::all(1.00001f)); on; on &= on - 1) {
      const int lane = __builtin_ctz(on);
      if (node.child[lane] == 0) continue;
      const Candidate child{enter[lane] * 0.99999f, node.child[lane]};
      int at = top++;
      for (; at > begin && stack[at - 1].squared < child.squared; --at) stack[at] = stack[at - 1];
      stack[at] = child;
    }
  }
  return first;
}

}  // namespace tendril
