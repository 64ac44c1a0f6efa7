// Designs and surroundings that tests of local refinement share.
#pragma once

#include "method/route/local_refinement.h"
#include "scene/formed_rod.h"

namespace tendril::routing {

inline Section soft_hose() { return Section::round(0.020, 0.012, Material::from_poisson(6e6, 0.49, 1150)); }

/// A hose that hangs in a U between two connections that look down, 0.3 m apart, without twist.
inline Design u_design(double length, double height = 0.4) {
  Design design;
  design.rod = Rod::uniform(length, soft_hose(), 40);
  design.from = Frame::looking({0, 0, height}, {0, 0, -1}, {0, 1, 0});
  design.to = Frame::looking({0.3, 0, height}, {0, 0, 1}, {0, 1, 0});
  return design;
}

/// Between connections 0.8 m apart, carried by two clips.
inline Design clipped_design() {
  Design design;
  design.rod = Rod::uniform(1.0, soft_hose(), 50);
  design.from = Frame::looking({0, 0, 0.25}, {1, 0, 0.2});
  design.to = Frame::looking({0.8, 0.1, 0.3}, {1, 0.2, 0});
  design.clips = {Hold{0.3, Frame::looking({0.26, 0.05, 0.28}, {1, 0, 0})}, Hold{0.62, Frame::looking({0.52, 0, 0.3}, {1, 0.1, 0})}};
  design.clips[1].orientation = false;
  return design;
}

/// A preformed hose with two bends, held as it was formed.
inline Design preformed_design() {
  const Curve curve = Curve::pcc({{0, 0, 0.4}, {0.3, 0, 0.3}, {0.4, 0.3, 0.3}, {0.7, 0.3, 0.35}}, {0.09, 0.1});
  Design design;
  design.rod = Rod::uniform(curve.length(), soft_hose(), 40);
  form(design.rod, curve);
  design.from = curve.at(0);
  design.to = curve.at(curve.length());
  return design;
}

inline PlacedObstacle solid(const char* name, const Solid& shape, const Vec3& at, double clearance = 0) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.shape = shape;
  obstacle.body.pose.at = at;
  obstacle.clearance = clearance;
  return obstacle;
}

/// Gravity, a floor, a ball to avoid and a post to keep near.
inline Scene hall(double clearance = 0.02) {
  Scene scene(Vec3(0, 0, -9.81));
  scene.add(solid("floor", HalfSpace{}, Vec3::Zero(), clearance));
  PlacedObstacle ball = solid("ball", Sphere{0.05}, {0.15, 0.2, 0.2}, 0.01);
  ball.prefer = Preference::avoid;
  scene.add(ball);
  PlacedObstacle post = solid("post", Cylinder{0.03, 0.6}, {0.45, 0.25, 0.3}, 0.01);
  post.prefer = Preference::near;
  scene.add(post);
  return scene;
}

inline RefinementOptions everything() {
  RefinementOptions options;
  options.adjust = {true, true, true, true, true, true};
  return options;
}

}  // namespace tendril::routing
