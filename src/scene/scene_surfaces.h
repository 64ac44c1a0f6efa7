// A scene as surfaces for files: rods as tubes in an equilibrium, obstacles, robots' links; at rest and in motion.
#pragma once

#include <memory>
#include <vector>

#include "geometry/glb_scene.h"
#include "geometry/surface_parts.h"
#include "scene/scene.h"

namespace tendril {

struct SurfaceOptions {
  bool rods = true;
  bool obstacles = true;
  bool robots = true;    ///< their links
  double tolerance = 0;  ///< m, of the tubes' facets from the round, bent rod; 0: 2 % of each rod's radius
};

/// Rods, in the order of the equilibrium and named as in it, then obstacles and links as they were when it was solved. Rods are
/// closed tubes with flat ends, without their holes, in opaque colours that are told apart by colour-blind eyes too; obstacles are
/// half transparent and seen from both sides; a half-space is a square around the rods. Throws UsageError for a rod that has no
/// shape, since its solve never began.
std::vector<SurfacePart> surfaces_of(const SceneEquilibrium& equilibrium, const SurfaceOptions& options = {});

/// Obstacles and links alone, where they are now.
std::vector<SurfacePart> surfaces_of(const Scene& scene, const SurfaceOptions& options = {});

/// The same in one equilibrium after the other, two at least: rods bend, links and whatever else changes its place move rigidly.
/// Throws UsageError for states that do not hold the same rods and bodies.
std::vector<MovingPart> moving_surfaces_of(const std::vector<std::shared_ptr<const SceneEquilibrium>>& states,
                                           const SurfaceOptions& options = {});

/// A rod's body that moves with one of its sections, as a connector does.
struct CarriedBody {
  std::string name, rod;
  double at = 0;      ///< arc length, m
  Obstacle body;      ///< its pose is in the section's axes
};
std::vector<MovingPart> moving_bodies_of(const std::vector<CarriedBody>& bodies, const std::vector<std::shared_ptr<const SceneEquilibrium>>& states);

/// The rods of an equilibrium as comma-separated text: a line a vertex with the rod's name, its arc length s, place, tangent, bend
/// radius ("inf" where straight) and the tension of the segment that begins there (at the last vertex: that ends there). SI units,
/// named in the first line.
std::string rods_csv(const SceneEquilibrium& equilibrium);

}  // namespace tendril
