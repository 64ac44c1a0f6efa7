// Small scenes that several tests share.
#pragma once

#include <memory>

#include "base/units.h"
#include "scene/scene.h"

namespace tendril::testing {

inline const Vec3 earth(0, 0, -9.81);

inline Section soft_section() {
  return Section::round(0.02, 0.01, Material::from_poisson(6e6, 0.45, 1150));
}

/// Held at {0,0,1} and {0.8,0,1}, along x: it sags between.
inline PlacedRod sagging_hose(const char* name = "hose", int segments = 40) {
  return PlacedRod(name, Rod::uniform(1.2, soft_section(), segments), Frame::looking({0, 0, 1}, {1, 0, 0}),
                   Frame::looking({0.8, 0, 1}, {1, 0, 0}));
}

inline PlacedObstacle solid(const char* name, Solid shape, const Vec3& at, double clearance = 0) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = shape;
  obstacle.body.pose.at = at;
  obstacle.clearance = clearance;
  return obstacle;
}

/// A square sheet of two triangles, normal to z.
inline PlacedObstacle sheet(const char* name, const Vec3& at, double half = 1) {
  Mesh mesh;
  mesh.name = name;
  mesh.vertices = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = std::make_shared<const TriangleSurface>(mesh);
  obstacle.body.pose.at = at;
  return obstacle;
}

}  // namespace tendril::testing
