// Scenes of everything that a scene file holds, drawn at random.
#pragma once

#include "scene/formed_rod.h"
#include "unit/robot/robots.h"
#include "unit/scene/fixtures.h"

namespace tendril::test {

inline Frame random_frame(Random& random) { return {random.point(2), random.rotation()}; }

inline Section random_section(Random& random) {
  const double outer = random.in(0.004, 0.03);
  const Material material = Material::from_poisson(random.in(1e6, 1e9), random.in(0.1, 0.5), random.in(500, 2000));
  Section section = Section::round(outer, random.below(2) ? 0 : outer * random.in(0.1, 0.9), material);
  if (random.below(2)) {
    section.EI1 *= random.in(0.5, 2);
    section.GA2 *= random.in(0.5, 2);
    section.material = std::nullopt;
  }
  return section;
}

inline Curve random_curve(Random& random) {
  std::vector<Vec3> points{Vec3::Zero()};
  for (int k = random.below(3) + 2; k > 0; --k) points.push_back(points.back() + Vec3(0.4, random.in(-0.1, 0.1), random.in(-0.1, 0.1)));
  switch (random.below(4)) {
    case 0: return Curve::polyline({points.front(), points.back()});
    case 1: {
      std::vector<double> radii;
      for (std::size_t k = 2; k < points.size(); ++k) radii.push_back(random.in(0.05, 0.1));
      return Curve::pcc(points, radii);
    }
    case 2: {
      Curve::SplineEnds ends;
      if (random.below(2)) ends.start = Vec3(1, 0, random.in(-0.1, 0.1));
      if (random.below(2)) ends.finish = Vec3(1, random.in(-0.1, 0.1), 0);
      return Curve::spline(points, ends);
    }
    default: return Curve::helix(random.in(0.1, 0.2), random.in(-0.1, 0.1), random.in(0.5, 3), random.below(2) == 1);
  }
}

inline Rod random_rod(Random& random) {
  Rod rod;
  rod.length = random.in(0.3, 2);
  if (random.below(2)) form(rod, random_curve(random));
  rod.segments = 5 + random.below(60);
  for (int k = random.below(3); k > 0; --k) rod.parts.push_back({rod.length * (0.8 - 0.25 * k), random_section(random)});
  rod.parts.push_back({rod.length, random_section(random)});
  return rod;
}

inline PlacedObstacle random_obstacle(Random& random, const std::string& name) {
  PlacedObstacle obstacle;
  obstacle.name = name;
  obstacle.body.pose = random_frame(random);
  switch (random.below(5)) {
    case 0: obstacle.body.shape = Solid(Box{Vec3(random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1))}); break;
    case 1: obstacle.body.shape = Solid(Sphere{random.in(0.1, 1)}); break;
    case 2: obstacle.body.shape = Solid(Cylinder{random.in(0.1, 1), random.in(0.1, 1)}); break;
    case 3: obstacle.body.shape = Solid(HalfSpace{}); break;
    default: {
      Mesh mesh;
      for (int k = 0; k < 12; ++k) mesh.vertices.push_back(random.point(1));
      for (int k = 0; k < 8; ++k) {
        const int a = random.below(4), b = 4 + random.below(4), c = 8 + random.below(4);
        mesh.triangles.push_back({a, b, c});
      }
      obstacle.body.shape = std::make_shared<const TriangleSurface>(mesh);
    }
  }
  obstacle.clearance = random.below(2) ? 0 : random.in(0, 0.02);
  obstacle.prefer = Preference(random.below(3));
  obstacle.clip = random.below(2) == 1;
  return obstacle;
}

/// Holds at distinct places, most of them inside, some of them by the robot's links.
inline void hold_somehow(Random& random, Scene& scene, PlacedRod& rod) {
  const double length = rod.rod().length;
  for (int k = 0; k < 4; ++k) {
    const double at = k == 3 ? length : length * (0.05 + 0.3 * k + 0.1 * random.in(0, 1));
    Hold hold{at, random_frame(random), random.below(4) > 0, random.below(3) > 0, double(random.below(3)), false};
    hold.position = hold.position || !hold.orientation;
    hold.slide = k < 3 && hold.position && hold.orientation && random.below(3) == 0;
    if (!scene.robots().empty() && random.below(3) == 0) {
      const PlacedRobot& robot = scene.robots()[random.below(int(scene.robots().size()))];
      scene.attach({rod.name(), at, robot.name, random.below(int(robot.robot->links().size())), hold.frame, hold.position,
                    hold.orientation, hold.turns, hold.slide});
    } else {
      rod.hold(hold);
    }
  }
  for (int k = random.below(3); k > 0; --k) rod.load({length * random.in(0, 1), random.point(5), random.point(1)});
}

/// `robot`: placed once or twice where given.
inline Scene random_scene(unsigned seed, const std::shared_ptr<const Robot>& robot) {
  Random random(seed);
  Scene scene(random.below(2) ? testing::earth : random.point(10));
  for (int k = random.below(4); k > 0; --k) scene.add(random_obstacle(random, "obstacle \"" + std::to_string(k) + "\""));
  for (int k = robot ? random.below(3) : 0; k > 0; --k) {
    PlacedRobot placed{"arm_" + std::to_string(k), robot, random_frame(random)};
    for (int j = 0; j < robot->size(); ++j) placed.joints.push_back(random.in(robot->lower()[j], robot->upper()[j]));
    placed.clearance = random.in(0, 0.01);
    scene.add(placed);
  }
  const int rods = random.below(4);
  for (int k = 0; k < rods; ++k) scene.add(PlacedRod("rod " + std::to_string(k), random_rod(random), std::nullopt, std::nullopt));
  if (rods > 1) {
    std::vector<BranchPlace> places{{scene.rods()[0].get(), 0, std::nullopt}, {scene.rods()[1].get(), 0, random_frame(random)}};
    PlacedBranch& branch = scene.join("fork", places, random.below(2) ? std::optional(random_frame(random)) : std::nullopt);
    branch.orientation = random.below(2) == 1;
  }
  for (const auto& rod : scene.rods()) hold_somehow(random, scene, *rod);
  return scene;
}

}  // namespace tendril::test
