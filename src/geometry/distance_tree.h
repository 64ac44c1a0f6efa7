// A tree of boxes over the triangles of a mesh: closest point, triangles in range, first hit of a ray.
//
// Eight children a node and up to eight triangles a leaf, stored in single precision about the mesh's middle, so that
// eight boxes or eight triangles are judged at once. Single precision only rejects, with a margin above its rounding;
// what is left is measured in double precision on the mesh itself, so that every answer is exact. Boxes around few
// triangles are turned to lie flat on them: seen from above, sloping ground then fills its boxes no less than level.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/simd8.h"

namespace tendril {

class DistanceTree {
 public:
  /// `mesh` must be valid (Mesh::check) and must outlive the tree. 1 M triangles take some tenths of a second.
  explicit DistanceTree(const Mesh& mesh);

  struct Nearest {
    double distance;    ///< m; the limit when nothing is nearer
    Vec3 point;
    int triangle = -1;  ///< -1: nothing is nearer than the limit
  };
  /// The closest surface point nearer than `limit` (m, may be infinite). `hint`: a triangle likely to be near, such as
  /// the answer for a neighbouring point; it saves time and does not change the answer in any bit.
  Nearest closest(const Vec3& p, double limit = std::numeric_limits<double>::infinity(), int hint = -1) const;

  /// True when a triangle is nearer than `range` (m): the same answer as closest(p, range) in less time.
  bool within(const Vec3& p, double range) const;

  /// Calls visit(triangle) once for every triangle nearer than `range` (m), and for some that are not.
  template <class Visit>
  void visit_near(const Vec3& p, double range, Visit&& visit) const;

  struct Hit {
    double share;  ///< 0 ... 1 of the way from a to b
    Vec3 point;
    Vec3 normal;   ///< unit, facing a
    int triangle;
  };
  /// The first triangle that the path a-b crosses: a strictly on one side of its plane, b on the other or on it. A path
  /// within the plane of a triangle does not cross it; a path through a shared edge or vertex never slips between.
  std::optional<Hit> ray(const Vec3& a, const Vec3& b) const;

  /// An oriented box, flat or thin where it has to be: the columns of `axes` are unit vectors, `half` its half lengths, m.
  struct OrientedBox {
    Vec3 middle = Vec3::Zero();
    Mat3 axes = Mat3::Identity();
    Vec3 half = Vec3::Zero();
  };
  /// A child of an inner part of the tree, or a triangle of a leaf.
  struct Near {
    int part;        ///< of an inner part: another one, or a leaf below zero; of a leaf: the triangle
    float at_least;  ///< m: it is no nearer to the box
    float size;      ///< m, half the diagonal of a part's box; 0 for triangles
  };
  static constexpr int whole = 0;  ///< the part that is all of the tree
  /// For the search through two trees at once: the children of an inner part, or the triangles of a leaf, that are not
  /// found to be as far as `range` (m) from the box. `direction`: a unit vector along which to look for a gap, from this
  /// mesh to the box, or zero. Returns how many; the nearest is the last.
  int near(int part, const OrientedBox& box, const Vec3& direction, double range, Near (&out)[8]) const;

  const Mesh& mesh() const { return mesh_; }
  std::size_t bytes() const { return nodes_.size() * sizeof(Node) + leaves_.size() * sizeof(Leaf); }

 private:
  friend class TreeBuilder;
  using Float8 = simd::Float8;

  struct alignas(32) Node {
    float low[3][8], high[3][8];  ///< of the children's boxes, along the node's axes, m
    int child[8];                 ///< a node, or ~leaf
    float axes[3][4];             ///< unit vectors, the last of four places unused
  };
  struct alignas(32) Leaf {
    float corner[3][8], side[3][8], other[3][8];  ///< first corner, and the second and third from there, m
    float normal[3][8];                           ///< unit; zero for a triangle without a face
    int triangle[8];                              ///< -1: empty
  };
  // The children of one node or the triangles of one leaf within a bound, and how far they are at least.
  struct Candidate {
    float squared;
    int index;
  };
  static constexpr int stack_size = 512;  // seven a level; the builder keeps the depth below 64

  static Float8 load(const float* at) { return *reinterpret_cast<const Float8*>(at); }
  struct Turned {
    float at[3];
  };
  static Turned turned(const Node& node, const float* v);
  static Float8 box_distances(const Node& node, const float* p);
  static Float8 triangle_distances(const Leaf& leaf, const float* p);
  // Above the rounding of single precision, some 16 units in the last place of the largest coordinate; the little on
  // top covers squares that underflow.
  double margin(const Vec3& local) const { return 1.5e-6 * (scale_ + local.cwiseAbs().maxCoeff()) + 1e-15; }
  static float widened(double distance, double margin) {
    const double sum = distance + margin;
    return static_cast<float>(sum * sum * (1 + 1e-6));
  }
  struct Probe;
  static Float8 part_gaps(const Node& node, const Probe& probe);
  static Float8 leaf_gaps(const Leaf& leaf, const Probe& probe);
  struct Shortlist;
  void settle(const Vec3& p, Shortlist& shortlist, Nearest& best) const;
  void measure(const Vec3& p, int triangle, Nearest& best) const;
  bool any_within(const Leaf& leaf, const float* q, const Vec3& p, double range, float certain, float possible) const;
  void crossing(const Vec3& a, const Vec3& b, int triangle, std::optional<Hit>& first) const;

  const Mesh& mesh_;
  Vec3 middle_ = Vec3::Zero();
  double scale_ = 0;  ///< largest coordinate about the middle, m
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

inline DistanceTree::Turned DistanceTree::turned(const Node& node, const float* v) {
  Turned result;
  for (int k = 0; k < 3; ++k) result.at[k] = node.axes[k][0] * v[0] + node.axes[k][1] * v[1] + node.axes[k][2] * v[2];
  return result;
}

// Squared distances to eight boxes; infinite for children that are not there.
inline DistanceTree::Float8 DistanceTree::box_distances(const Node& node, const float* p) {
  const Turned turned_p = turned(node, p);
  Float8 sum = simd::all(0);
  for (int k = 0; k < 3; ++k) {
    const Float8 at = simd::all(turned_p.at[k]);
    const Float8 out = simd::larger(simd::larger(load(node.low[k]) - at, at - load(node.high[k])), simd::all(0));
    sum += out * out;
  }
  return sum;
}

template <class Visit>
void DistanceTree::visit_near(const Vec3& p, double range, Visit&& visit) const {
  const Vec3 local = p - middle_;
  const float q[3] = {static_cast<float>(local.x()), static_cast<float>(local.y()), static_cast<float>(local.z())};
  const float bound = widened(range, margin(local));
  if (!(range > 0) || !(bound == bound)) return;
  int stack[stack_size];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const int at = stack[--top];
    if (at < 0) {
      const Leaf& leaf = leaves_[~at];
      for (unsigned near = simd::bits(triangle_distances(leaf, q) < simd::all(bound)); near; near &= near - 1) {
        const int triangle = leaf.triangle[__builtin_ctz(near)];
        if (triangle >= 0) visit(triangle);
      }
      continue;
    }
    const Node& node = nodes_[at];
    for (unsigned near = simd::bits(box_distances(node, q) < simd::all(bound)); near; near &= near - 1)
      stack[top++] = node.child[__builtin_ctz(near)];
  }
}

}  // namespace tendril
