// Whether placed bodies touch: yes or no, nothing else. Distances and closest points are those of triangle_surface.h and
// solids.h.
//
// Meshes, boxes and cylinders against each other by FCL (Pan, Chitta, Manocha: FCL, 2012), in a module that is loaded by
// the first body; half-spaces, and spheres against meshes, by their own formulas. Solids and half-spaces are full; meshes are
// skins, and full as well when they are watertight: a body wholly within one touches it.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <variant>
#include <vector>

#include "base/frame.h"
#include "geometry/inside_test.h"
#include "geometry/solids.h"
#include "geometry/triangle_surface.h"

namespace tendril {

using CollisionShape = std::variant<std::shared_ptr<const TriangleSurface>, Solid>;

/// What the module tendril_collide.so does; made by its function `tendril_make_touch_test`.
class TouchTest {
 public:
  virtual ~TouchTest() = default;
  /// Returns the body's number, counted from 0. The solid is no half-space.
  virtual int add(const Mesh& mesh) = 0;
  virtual int add(const Solid& solid) = 0;
  virtual bool touch(int a, const Frame& at_a, int b, const Frame& at_b) const = 0;
};
using MakeTouchTest = TouchTest*();

/// Bodies in their own axes. Queries are const and safe from several threads. Copies share what was built: a mesh is prepared
/// once for all of them and kept as long as one of them lives; add to none of them while another one is asked.
class CollisionBodies {
 public:
  /// Returns the body's number, counted from 0. A mesh that was added before is not prepared again. Throws UsageError for a
  /// missing mesh, a solid without size, and when the module cannot be loaded.
  int add(const CollisionShape& shape);

  int size() const { return static_cast<int>(bodies_.size()); }
  const CollisionShape& shape(int body) const { return bodies_[body].shape; }

  /// Whether body `a` standing at one frame and body `b` at another have a point in common.
  bool touch(int a, const Frame& at_a, int b, const Frame& at_b) const;

 private:
  // A mesh as the module has it, and the test for points within it, built when first needed.
  struct Prepared {
    std::shared_ptr<const TriangleSurface> surface;
    int number = -1;
    std::once_flag once = {};
    std::unique_ptr<const InsideTest> inside = {};
  };
  struct Shared {
    std::unique_ptr<TouchTest> test;
    std::map<const TriangleSurface*, std::shared_ptr<Prepared>> meshes;
  };
  struct Body {
    CollisionShape shape;
    Eigen::AlignedBox3d box;              ///< in its own axes, m
    Vec3 point;                           ///< of the body
    int number = -1;                      ///< in the module; -1: a half-space
    std::shared_ptr<Prepared> mesh = {};  ///< null: a solid
  };
  bool touches_sphere(const Body& mesh, const Frame& at_mesh, const Vec3& middle, double radius) const;
  bool holds_point(const Body& mesh, const Vec3& p) const;
  bool within(const Body& small, const Frame& at_small, const Body& large, const Frame& at_large) const;

  TouchTest& test();
  std::shared_ptr<Prepared> prepared(const std::shared_ptr<const TriangleSurface>& surface);

  std::vector<Body> bodies_;
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
};

}  // namespace tendril
