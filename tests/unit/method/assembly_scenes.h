// Families of scenes for assembly verification, each a hose of 16 mm and what it has to be installed in; a seed varies lengths,
// places and directions. Some cannot be installed, by construction.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/units.h"
#include "method/assembly/assembly.h"

namespace tendril::assembly_scenes {

inline constexpr double radius = 0.008;  // m, of every hose

struct Case {
  Scene scene{Vec3(0, 0, -9.81)};
  assembly::Options options;
};

/// Numbers from -1 to 1, the same for the same seed.
class Chance {
 public:
  explicit Chance(int seed) : engine_(static_cast<unsigned>(seed) * 7919u + 17u) {}
  double operator()() { return 2 * (static_cast<double>(engine_()) / static_cast<double>(std::mt19937::max())) - 1; }

 private:
  std::mt19937 engine_;
};

inline PlacedObstacle obstacle(const std::string& name, const Solid& shape, const Frame& pose = {}) {
  PlacedObstacle placed;
  placed.name = name;
  placed.body.shape = shape;
  placed.body.pose = pose;
  return placed;
}

inline PlacedObstacle obstacle(const std::string& name, Mesh mesh, const Frame& pose = {}) {
  PlacedObstacle placed;
  placed.name = name;
  placed.body.shape = std::make_shared<const TriangleSurface>(std::move(mesh));
  placed.body.pose = pose;
  return placed;
}

inline void add_box(Scene& scene, const std::string& name, const Vec3& size, const Vec3& at) {
  scene.add(obstacle(name, Box{size}, {at, Quat::Identity()}));
}

inline void add_hose(Scene& scene, double length, const Frame& from, const Frame& to) {
  const Section section = Section::round(2 * radius, 0.010, Material::from_poisson(6e6, 0.49, 1150));
  scene.add(PlacedRod("hose", Rod::uniform(length, section, 40), from, to));
}

/// A torus about x: `hole` is the radius of what passes through it.
inline Mesh torus(double hole, double wire, int around = 60, int across = 16) {
  Mesh mesh;
  mesh.name = "ring";
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2 * units::pi * i / around, b = 2 * units::pi * j / across;
      const double out = hole + wire + wire * std::cos(b);
      mesh.vertices.emplace_back(wire * std::sin(b), out * std::cos(a), out * std::sin(a));
    }
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const int next = (i + 1) % around, above = (j + 1) % across;
      mesh.triangles.push_back({i * across + j, next * across + j, next * across + above});
      mesh.triangles.push_back({i * across + j, next * across + above, i * across + above});
    }
  return mesh;
}

/// Hills of up to 60 mm over 1.2 x 0.8 m.
inline Mesh hills(int triangles) {
  Mesh mesh;
  mesh.name = "hills";
  const int side = static_cast<int>(std::sqrt(triangles / 2.0));
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i) {
      const double x = 1.2 * i / side - 0.6, y = 0.8 * j / side - 0.4;
      const double z = 0.03 * std::sin(9 * x + 1) * std::cos(7 * y) + 0.012 * std::sin(23 * x) * std::sin(19 * y + 2) - 0.042;
      mesh.vertices.emplace_back(x, y, z);
    }
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int a = j * (side + 1) + i, b = a + side + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  return mesh;
}

inline Case two_posts(int seed) {
  Chance u(seed);
  Case c;
  c.scene.add(obstacle("floor", HalfSpace{}));
  c.scene.add(obstacle("post 1", Cylinder{0.03, 0.6}, {{-0.1 + 0.02 * u(), 0.05, 0.3}, Quat::Identity()}));
  c.scene.add(obstacle("post 2", Cylinder{0.03, 0.6}, {{0.12 + 0.02 * u(), -0.06 + 0.01 * u(), 0.3}, Quat::Identity()}));
  add_hose(c.scene, 0.75 + 0.03 * u(), Frame::looking({-0.32, 0.05 * u(), 0.2}, {1, -0.6, 0}),
           Frame::looking({0.34, 0.05 * u(), 0.2}, {1, -0.2, 0}));
  return c;
}

inline Case terrain(int seed, std::shared_ptr<const TriangleSurface> surface) {
  Chance u(seed);
  Case c;
  PlacedObstacle ground;
  ground.name = "ground";
  ground.body.shape = std::move(surface);
  c.scene.add(ground);
  add_hose(c.scene, 0.76 + 0.04 * u(), Frame::looking({-0.33, 0.2 * u(), 0.05 + 0.01 * u()}, {1, 0.3 * u(), 0}),
           Frame::looking({0.33, 0.2 * u(), 0.05 + 0.01 * u()}, {1, 0.3 * u(), 0}));
  return c;
}

/// Around the corner of an open channel of 50 mm.
inline Case l_channel(int seed) {
  Chance u(seed);
  Case c;
  const double half = 0.025 + 0.002 * u(), wall = 0.02, high = 0.1;
  add_box(c.scene, "floor", {0.9, 0.9, 0.02}, {0, 0, -0.02});
  add_box(c.scene, "outer wall along x", {0.35 + half + wall, wall, high}, {-0.125 + 0.5 * (half + wall), -half - 0.5 * wall, 0.04});
  add_box(c.scene, "outer wall along y", {wall, 0.35 + half, high}, {0.05 + half + 0.5 * wall, 0.175 - 0.5 * half, 0.04});
  add_box(c.scene, "inner wall along x", {0.35 - half, wall, high}, {-0.125 - 0.5 * half, half + 0.5 * wall, 0.04});
  add_box(c.scene, "inner wall along y", {wall, 0.35 - half - wall, high}, {0.05 - half - 0.5 * wall, 0.175 + 0.5 * (half + wall), 0.04});
  add_hose(c.scene, 0.76 + 0.01 * u(), Frame::looking({-0.33, 0.005 * u(), 0.025}, {1, 0, 0.05 * u()}),
           Frame::looking({0.05 + 0.005 * u(), 0.38, 0.025}, {0, 1, 0.05 * u()}));
  return c;
}

/// A channel whose lips leave a slot of 2.6 radii.
inline Case c_channel(int seed) {
  Chance u(seed);
  Case c;
  const double half = 0.018 + 0.001 * u(), slot = 1.3 * radius, wall = 0.02;
  add_box(c.scene, "floor", {0.5, 0.3, 0.02}, {0, 0, -0.02});
  for (const double side : {-1.0, 1.0}) {
    const std::string name = side < 0 ? "right" : "left";
    add_box(c.scene, name + " wall", {0.5, wall, 0.06}, {0, side * (half + 0.5 * wall), 0.02});
    add_box(c.scene, name + " lip", {0.5, half + wall - slot, 0.006}, {0, side * 0.5 * (half + wall + slot), 0.053});
  }
  add_hose(c.scene, 0.75 + 0.015 * u(), Frame::looking({-0.34, 0.004 * u(), 0.02 + 0.004 * u()}, {1, 0, 0.05 * u()}),
           Frame::looking({0.35, 0.004 * u(), 0.02 + 0.004 * u()}, {1, 0, 0.05 * u()}));
  return c;
}

/// A channel of one lip that covers a third of it.
inline Case lipped_channel(int seed) {
  Chance u(seed);
  Case c;
  add_box(c.scene, "floor", {0.5, 0.3, 0.02}, {0, 0, -0.02});
  add_box(c.scene, "left wall", {0.5, 0.02, 0.1}, {0, 0.03 + 0.002 * u(), 0.04});
  add_box(c.scene, "right wall", {0.5, 0.02, 0.1}, {0, -0.03, 0.04});
  add_box(c.scene, "lip", {0.5, 0.02, 0.004}, {0, 0.02, 0.09});
  add_hose(c.scene, 0.75 + 0.02 * u(), Frame::looking({-0.34, 0, 0.03 + 0.01 * u()}, {1, 0, 0.1}),
           Frame::looking({0.36, 0, 0.03}, {1, 0, 0.1 * u()}));
  return c;
}

/// A box of these edges over the rod's last part, along its section normal.
inline assembly::Connector connector(const std::string& name, bool at_start, const Vec3& size) {
  assembly::Connector c;
  c.name = name;
  c.rod = "hose";
  c.at_start = at_start;
  c.body.shape = Box{size};
  c.body.pose.at = Vec3(0, 0, (at_start ? 0.5 : -0.5) * size.z());
  return c;
}

/// A ring where the hose lies: `hole` is its inner radius, m.
inline void add_ring(Case& c, const std::string& name, double share, double hole) {
  const SceneEquilibrium routed = c.scene.solve();
  const Frame f = routed.rods[0].equilibrium.frame_at(share * c.scene.rods()[0]->rod().length);
  Mat3 axes;
  axes << f.d3(), f.d1(), f.d2();
  c.scene.add(obstacle(name, torus(hole, 0.006), {f.at, Quat(axes)}));
}

inline void add_hanging_hose(Case& c, Chance& u) {
  add_hose(c.scene, 0.75 + 0.03 * u(), Frame::looking({-0.32, 0.03 * u(), 0.03}, {1, 0, -0.6}),
           Frame::looking({0.34, 0.03 * u(), 0.02}, {1, 0.2 * u(), 0.6}));
}

inline Case ring(int seed) {
  Chance u(seed);
  Case c;
  add_hanging_hose(c, u);
  add_ring(c, "ring", 0.4 + 0.1 * u(), 0.034);
  return c;
}

/// Connectors whose corners are `share` of the ring's inner radius from its axis.
inline Case ring_with_connectors(int seed, double share) {
  Chance u(seed);
  Case c;
  add_hanging_hose(c, u);
  const double hole = 0.034;
  add_ring(c, "ring", 0.4 + 0.1 * u(), hole);
  const double edge = std::sqrt(2.0) * share * hole;
  c.options.connectors = {connector("plug", true, {edge, edge, 0.03}), connector("socket", false, {edge, edge, 0.03})};
  return c;
}
inline Case ring_with_small_connectors(int seed) { return ring_with_connectors(seed, 0.55); }

/// Impossible: neither connector passes the ring between them. Even their faces, not only corners, are wider than it.
inline Case ring_with_large_connectors(int seed) { return ring_with_connectors(seed, 1.7); }

/// A connector that does not pass the ring at one end only: the other end has to be led through it, by the side of the large one.
inline Case ring_with_one_large_connector(int seed) {
  Case c = ring_with_connectors(seed, 0.55);
  assembly::Connector& large = c.options.connectors[seed % 2];
  const double edge = std::sqrt(2.0) * 1.7 * 0.034;
  large = connector(large.name, large.at_start, {edge, edge, 0.03});
  return c;
}

/// Impossible: both ends lie behind rings that they do not pass.
inline Case ends_behind_rings(int seed) {
  Chance u(seed);
  Case c;
  add_hanging_hose(c, u);
  add_ring(c, "ring 1", 0.22 + 0.04 * u(), 0.03);
  add_ring(c, "ring 2", 0.78 + 0.04 * u(), 0.03);
  const double edge = 0.066 + 0.004 * u();
  c.options.connectors = {connector("plug", true, {edge, edge, 0.03}), connector("socket", false, {edge, edge, 0.03})};
  return c;
}

/// Impossible: a box closed on all sides.
inline Case closed_box(int seed) {
  Chance u(seed);
  Case c;
  const Vec3 half(0.42 + 0.02 * u(), 0.2, 0.18 + 0.02 * u());
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 size = 2 * half + Vec3::Constant(0.04), at = Vec3::Zero();
      size[axis] = 0.02;
      at[axis] = side * (half[axis] + 0.01);
      add_box(c.scene, std::string(side < 0 ? "low" : "high") + " side " + "xyz"[axis], size, at);
    }
  add_hose(c.scene, 0.75 + 0.03 * u(), Frame::looking({-0.32, 0.03 * u(), 0.03}, {1, 0, -0.6}),
           Frame::looking({0.34, 0.03 * u(), 0.02}, {1, 0.2 * u(), 0.6}));
  return c;
}

}  // namespace tendril::assembly_scenes
