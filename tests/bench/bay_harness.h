// The ignition harness of the engine bay: nine rods, six connectors. From the control unit at the firewall below the tower brace to
// the engine, behind the valve cover along four ignition coils, round the timing cover to the throttle's sensor.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/import_mesh.h"
#include "method/assembly/assembly.h"

namespace tendril {

struct BayHarness {
  Scene scene{Vec3(0, 0, -9.81)};
  assembly::Options options;
};

inline const std::shared_ptr<const TriangleSurface>& bay_surface() {
  static const auto surface = [] {
    const auto file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "assets" / "engine_bay.ply";
    return std::make_shared<const TriangleSurface>(load_mesh(file.string(), 1e-3).mesh);
  }();
  return surface;
}

/// A box over a rod's last part that goes `ahead` of it, m.
inline assembly::Connector plug(const std::string& name, const std::string& rod, bool at_start, const Vec3& size, double ahead) {
  assembly::Connector c;
  c.name = name;
  c.rod = rod;
  c.at_start = at_start;
  c.body.shape = Box{size};
  c.body.pose.at = Vec3(0, 0, (at_start ? 1 : -1) * (0.5 * size.z() - ahead));
  return c;
}

/// `held`: the branch points are, where they belong.
inline BayHarness bay_harness_in_place(bool held) {
  BayHarness h;
  PlacedObstacle bay;
  bay.name = "bay";
  bay.body.shape = bay_surface();
  h.scene.add(std::move(bay));
  // The other half of the lead's coupling, on its bracket.
  PlacedObstacle socket, bracket;
  socket.name = "coupling";
  socket.body.shape = Box{{0.040, 0.036, 0.030}};
  socket.body.pose.at = Vec3(0.380, 0.600, 0.500);
  h.scene.add(socket);
  bracket.name = "bracket";
  bracket.body.shape = Box{{0.024, 0.003, 0.110}};
  bracket.body.pose.at = Vec3(0.374, 0.6195, 0.460);
  h.scene.add(bracket);
  const Material bundle = Material::from_poisson(20e6, 0.4, 1500);
  const Section lead = Section::round(0.013, 0, bundle), trunk = Section::round(0.011, 0, bundle), twig = Section::round(0.007, 0, bundle);
  // Branch points, along the trunk, behind the valve cover.
  std::vector<Frame> tees;
  for (int k = 0; k < 4; ++k) tees.push_back(Frame::looking({0.620 + 0.11 * k, 0.614, 0.596}, {1, 0, 0}));
  const Frame coupling = Frame::looking({0.410, 0.600, 0.500}, {1, 0, 0});
  const Frame throttle = Frame::looking({1.030, 0.350, 0.532}, {-0.35, -1, -0.1});
  std::vector<PlacedRod*> spine;
  spine.push_back(&h.scene.add(PlacedRod("lead", Rod::uniform(0.236, lead, 20), coupling, tees[0])));
  for (int k = 1; k < 4; ++k)
    spine.push_back(&h.scene.add(PlacedRod("trunk " + std::to_string(k), Rod::uniform(0.11, trunk, 10), tees[k - 1], tees[k])));
  spine.push_back(&h.scene.add(PlacedRod("throttle cable", Rod::uniform(0.350, twig, 32), tees[3], throttle)));
  for (int k = 0; k < 4; ++k) {
    const std::string number = std::to_string(k + 1);
    const Frame root = Frame::looking(tees[k].at, {0, -1, 0});
    const Frame tip = Frame::looking({0.620 + 0.11 * k, 0.570, 0.598}, {0, -1, 0});
    PlacedRod& coil = h.scene.add(PlacedRod("coil cable " + number, Rod::uniform(0.0442, twig, 10), root, tip));
    const Frame relative{Vec3::Zero(), tees[k].rotation.conjugate() * root.rotation};
    h.scene.join("tee " + number, {{spine[k], spine[k]->rod().length, {}}, {spine[k + 1], 0, {}}, {&coil, 0, relative}}, held ? std::optional<Frame>(tees[k]) : std::nullopt);
    h.options.connectors.push_back(plug("coil plug " + number, "coil cable " + number, false, {0.018, 0.024, 0.022}, 0.006));
  }
  h.options.connectors.push_back(plug("lead plug", "lead", true, {0.030, 0.026, 0.030}, 0.011));
  h.options.connectors.push_back(plug("throttle plug", "throttle cable", false, {0.018, 0.018, 0.022}, 0.006));
  return h;
}

/// Its routed equilibrium is the one next to where the branch points belong.
inline BayHarness bay_harness() {
  BayHarness h = bay_harness_in_place(false);
  const SceneEquilibrium near = bay_harness_in_place(true).scene.solve();
  SolveOptions follow;
  follow.follow = true;
  h.options.routed = std::make_shared<const SceneEquilibrium>(h.scene.solve(follow, {}, &near));
  return h;
}

}  // namespace tendril
