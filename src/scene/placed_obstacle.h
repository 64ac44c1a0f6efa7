// Something solid in the world: its shape and place, and what the rods owe it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "geometry/surroundings.h"

namespace tendril {

/// Whether a route should keep near an obstacle, keep away from it, or does not care.
enum class Preference { neutral, near, avoid };

/// A mesh file as it was read. `unit`: metres in one unit of the file.
struct MeshFile {
  std::string path;
  double unit = 1;
};

struct PlacedObstacle {
  std::string name;
  Obstacle body;                 ///< its name and clearance are set by Scene
  double clearance = 0;          ///< m, required: judged in reports and pictures, kept by contact where SolveOptions say so
  Preference prefer = Preference::neutral;
  bool clip = true;              ///< rods may be fastened to it
  bool of_robot = false;         ///< a robot's link
  std::optional<MeshFile> file = std::nullopt;  ///< that its mesh was read from
  std::function<std::shared_ptr<const Mesh>()> drawn = {};  ///< what pictures show instead, in the body's axes; empty: the body

  /// Throws UsageError for an empty name, a missing mesh, or a clearance that is negative or not finite.
  void check() const;

  std::size_t triangles() const;  ///< 0 for a solid
  bool has_tree() const;          ///< a mesh whose distance tree has been built
};

/// The obstacle as triangles in its own axes, for drawing: what it says itself, else a mesh as it is, a solid with round parts in 48 sides, a
/// half-space as a square of its plane around what `around` (m, world axes) lets one see. The pointer shares the mesh.
std::shared_ptr<const Mesh> drawn_mesh(const PlacedObstacle& obstacle, const Eigen::AlignedBox3d& around);

}  // namespace tendril
