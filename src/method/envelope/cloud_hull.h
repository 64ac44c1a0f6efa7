// The convex hull of the places that one or two nodes of a rod take in all outcomes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "method/envelope/convex_hull.h"
#include "method/envelope/kernel.h"

namespace tendril::envelope {

/// The places of one node: `points` is filled up to a multiple of 16, `count` of them count. `extremes`: by direction.
struct Cloud {
  PointArrays points;
  int count;
  const Extreme* extremes;
  int settled = 0;  ///< the first so many become corners wherever they lie outside, however little
};

/// Greedy: from the extreme points of the directions, the farthest point is inserted until all lie within the tolerance.
/// Memory is kept from hull to hull.
class CloudHull {
 public:
  /// Clouds: one or two. `tolerance`: m.
  void build(const Kernel& kernel, std::span<const Cloud> clouds, double tolerance);

  /// All points lie near one straight line: there are no facets. The points lie within `deviation` of the segment
  /// from `start` to `finish`.
  bool thin() const { return thin_; }
  Vec3 start() const { return start_; }
  Vec3 finish() const { return finish_; }
  double deviation() const { return deviation_; }

  const ConvexHull& hull() const { return hull_; }

  /// The points that are corners of the hull or lie on or above a facet. No other point reaches farther in any direction.
  PointArrays outermost() const;

  /// Which points of cloud `c` must be kept so that all lie within the tolerance of their hull, in increasing order. Not
  /// for thin ones.
  void corners_of(int c, double tolerance, std::vector<int>& out) const;

 private:
  struct Point {
    int cloud = 0, index = 0;
    bool operator==(const Point&) const = default;
    auto operator<=>(const Point&) const = default;
  };
  static constexpr int auxiliary = -1;  ///< the cloud of points that only give the hull thickness

  Vec3 place(const Point& p) const;
  void find_candidates();
  bool find_line();
  void measure_line();
  bool begin_solid();
  bool insert(const Point& p);
  void insert_farthest();
  void collect_outermost();

  const Kernel* kernel_ = nullptr;
  std::span<const Cloud> clouds_;
  double tolerance_ = 0;
  bool thin_ = false;
  Vec3 start_, finish_;
  double deviation_ = 0;
  ConvexHull hull_;
  std::vector<Point> inserted_;  ///< as hull_.points()
  std::vector<Point> candidates_;
  Point ends_[2];
  struct Outside {
    float height;
    Point point;
  };
  std::vector<Outside> outside_;  ///< on or above a facet of the hull of the candidates
  std::vector<float> planes_, heights_, outermost_;
  int outermost_count_ = 0;
};

}  // namespace tendril::envelope
