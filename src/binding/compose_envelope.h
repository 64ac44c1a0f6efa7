// The envelope of a picture: a transparent shell, coloured by how near its obstacles are.
#pragma once

#include <memory>
#include <vector>

#include "scene/placed_obstacle.h"
#include "view/picture.h"

namespace tendril {

/// How a shell lies to obstacles.
struct ShellClearance {
  /// By vertex, mm: the smallest distance to an obstacle, or, where obstacles require different clearances, the smallest
  /// margin to what they require. Negative inside a solid and inside a watertight mesh. NaN: nothing within 1 m.
  std::vector<double> values;
  double least = 0;          ///< m: smallest distance, 0 or below where they overlap; infinite when nothing is near
  int nearest = -1;          ///< the obstacle that it belongs to
  std::vector<int> overlaps; ///< obstacles that the shell cuts or holds
};
ShellClearance shell_clearance(const Mesh& shell, const std::vector<PlacedObstacle>& obstacles);

/// Adds the shell to the picture, a line about it to its card and, when `coloured`, the scale of its colours. The
/// picture's clearance scale is replaced then.
void add_envelope(const std::shared_ptr<const TriangleSurface>& envelope, const std::vector<PlacedObstacle>& obstacles,
                  bool coloured, Picture& picture);

}  // namespace tendril
