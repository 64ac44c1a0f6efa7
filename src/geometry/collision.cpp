#include "geometry/collision.h"

#include "base/error.h"
#include "base/load_module.h"

namespace tendril {

namespace {

template <class S>
const S* solid_as(const CollisionShape& shape) {
  const Solid* solid = std::get_if<Solid>(&shape);
  return solid ? std::get_if<S>(solid) : nullptr;
}

bool is_half_space(const CollisionShape& shape) { return solid_as<HalfSpace>(shape) != nullptr; }

// The lowest that a body gets along a direction given in its own axes.
double lowest(const CollisionShape& shape, const Vec3& up) {
  if (const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&shape)) {
    const Mesh& mesh = (*surface)->mesh();
    double low = std::numeric_limits<double>::infinity();
    for (const auto& triangle : mesh.triangles)
      for (int corner : triangle) low = std::min(low, up.dot(mesh.vertices[corner]));
    return low;
  }
  const Solid& solid = std::get<Solid>(shape);
  if (const Box* box = std::get_if<Box>(&solid)) return -0.5 * up.cwiseAbs().dot(box->size);
  if (const Sphere* sphere = std::get_if<Sphere>(&solid)) return -sphere->radius;
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&solid))
    return -cylinder->radius * std::hypot(up.x(), up.y()) - 0.5 * cylinder->length * std::abs(up.z());
  return up.z() < -1 + 1e-12
             ? 0
             : -std::numeric_limits<double>::infinity();  // a half-space: none but an opposite one can be clear of another
}

bool touches_half_space(const CollisionShape& shape, const Eigen::AlignedBox3d& box, const Frame& at, const Frame& plane) {
  const Vec3 normal = plane.d3();
  const Vec3 up = at.rotation.conjugate() * normal;
  const double height = normal.dot(at.at - plane.at);
  if (is_half_space(shape)) return height + lowest(shape, up) <= 0;
  const double lowest_of_box = height + up.dot(box.center()) - 0.5 * up.cwiseAbs().dot(box.sizes());
  return lowest_of_box <= 0 && height + lowest(shape, up) <= 0;
}

Eigen::AlignedBox3d placed(const Eigen::AlignedBox3d& box, const Frame& at) {
  const Mat3 axes = at.rotation.toRotationMatrix();
  const Vec3 middle = at.at + axes * box.center(), half = 0.5 * axes.cwiseAbs() * box.sizes();
  return {middle - half, middle + half};
}

}  // namespace

TouchTest& CollisionBodies::test() {
  static auto* const make =
      reinterpret_cast<MakeTouchTest*>(module_entry("collision", "tendril_collide.so", "tendril_make_touch_test"));
  if (!shared_->test) shared_->test.reset(make());
  return *shared_->test;
}

std::shared_ptr<CollisionBodies::Prepared> CollisionBodies::prepared(const std::shared_ptr<const TriangleSurface>& surface) {
  std::shared_ptr<Prepared>& known = shared_->meshes[surface.get()];
  if (!known) {
    auto made = std::make_shared<Prepared>();
    made->surface = surface;
    made->number = test().add(surface->mesh());
    known = std::move(made);
  }
  return known;
}

int CollisionBodies::add(const CollisionShape& shape) {
  Body body{shape, {}, Vec3::Zero()};
  if (const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&shape)) {
    if (!*surface) throw UsageError("collision: a body has no mesh");
    body.box = (*surface)->box();
    const Mesh& mesh = (*surface)->mesh();
    body.point = mesh.vertices[mesh.triangles[0][0]];
    body.mesh = prepared(*surface);
    body.number = body.mesh->number;
  } else {
    const Solid& solid = std::get<Solid>(shape);
    check(solid, "collision");
    body.box = box_of(solid);
    if (!is_half_space(shape)) body.number = test().add(solid);
  }
  bodies_.push_back(std::move(body));
  return size() - 1;
}

bool CollisionBodies::touch(int a, const Frame& at_a, int b, const Frame& at_b) const {
  const Body &first = bodies_[a], &second = bodies_[b];
  if (second.number < 0) return touches_half_space(first.shape, first.box, at_a, at_b);
  if (first.number < 0) return touches_half_space(second.shape, second.box, at_b, at_a);
  // FCL takes a sphere near a triangle without a face for touching it.
  if (const Sphere* sphere = solid_as<Sphere>(first.shape); sphere && second.mesh)
    return touches_sphere(second, at_b, at_a.at, sphere->radius);
  if (const Sphere* sphere = solid_as<Sphere>(second.shape); sphere && first.mesh)
    return touches_sphere(first, at_a, at_b.at, sphere->radius);
  if (shared_->test->touch(first.number, at_a, second.number, at_b)) return true;
  return within(first, at_a, second, at_b) || within(second, at_b, first, at_a);
}

bool CollisionBodies::touches_sphere(const Body& mesh, const Frame& at_mesh, const Vec3& middle, double radius) const {
  const Vec3 local = at_mesh.rotation.conjugate() * (middle - at_mesh.at);
  if (mesh.box.squaredExteriorDistance(local) > radius * radius) return false;
  if (mesh.mesh->surface->tree().within(local, radius)) return true;
  return holds_point(mesh, local);
}

// Without a common point of their skins a body is within the other one when any of its points is.
bool CollisionBodies::within(const Body& small, const Frame& at_small, const Body& large, const Frame& at_large) const {
  if (!large.mesh) return false;  // against a solid the module has told already
  const Frame local = at_large.inverse() * at_small;
  if (!large.box.contains(placed(small.box, local))) return false;
  return holds_point(large, local.at + local.rotation * small.point);
}

bool CollisionBodies::holds_point(const Body& mesh, const Vec3& p) const {
  Prepared& known = *mesh.mesh;
  if (!mesh.box.contains(p) || !known.surface->topology().watertight()) return false;
  std::call_once(known.once, [&] { known.inside = std::make_unique<const InsideTest>(known.surface->mesh()); });
  return known.inside->inside(p);
}

}  // namespace tendril
