// The module tendril_collide.so: whether bodies touch, by FCL. Nothing else of the project includes FCL. Only yes or no is
// asked of it: its distances, nearest points and depths are not to be relied on.
#include <fcl/config.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include "geometry/collision.h"

namespace {

using namespace tendril;

static_assert(sizeof(Frame) == 64 && sizeof(Vec3) == 24, "the program and this module share these by reference");

fcl::Transform3d transform(const Frame& at) {
  fcl::Transform3d out = fcl::Transform3d::Identity();
  out.linear() = at.rotation.toRotationMatrix();
  out.translation() = at.at;
  return out;
}

class FclTouchTest final : public TouchTest {
 public:
  int add(const Mesh& mesh) override {
    auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    model->beginModel(static_cast<int>(mesh.triangles.size()), static_cast<int>(mesh.vertices.size()));
    std::vector<fcl::Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    model->addSubModel(mesh.vertices, triangles);
    model->endModel();
    return keep(std::move(model));
  }

  int add(const Solid& solid) override {
    if (const Box* box = std::get_if<Box>(&solid)) return keep(std::make_shared<fcl::Boxd>(box->size));
    if (const Sphere* sphere = std::get_if<Sphere>(&solid)) return keep(std::make_shared<fcl::Sphered>(sphere->radius));
    const Cylinder& cylinder = std::get<Cylinder>(solid);
    return keep(std::make_shared<fcl::Cylinderd>(cylinder.radius, cylinder.length));
  }

  bool touch(int a, const Frame& at_a, int b, const Frame& at_b) const override {
    const fcl::CollisionRequestd request(1, false);
    fcl::CollisionResultd result;
    return fcl::collide(bodies_[a].get(), transform(at_a), bodies_[b].get(), transform(at_b), request, result) > 0;
  }

 private:
  int keep(std::shared_ptr<fcl::CollisionGeometryd> body) {
    bodies_.push_back(std::move(body));
    return static_cast<int>(bodies_.size()) - 1;
  }
  std::vector<std::shared_ptr<fcl::CollisionGeometryd>> bodies_;
};

}  // namespace

extern "C" tendril::TouchTest* tendril_make_touch_test() { return new FclTouchTest; }

extern "C" const char* tendril_module_about() { return "FCL " FCL_VERSION; }
