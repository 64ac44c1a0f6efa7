// The graph of nominal routing (thesis 3.1): places on a uniform grid with a direction each, joined by pairs of arcs that keep the
// smallest bend radius. What joins two states depends on their offset and directions alone, so it is worked out once.
#pragma once

#include <array>
#include <vector>

#include "method/route/biarc.h"

namespace tendril::routing {

/// The corners of an icosahedron divided `times` times: 12, 42, 162, ... unit vectors. Opposite ones come in pairs.
std::vector<Vec3> geodesic_directions(int times);

/// One way on from a state, the same for every place of the grid.
struct Primitive {
  std::array<int, 3> offset;     ///< in steps of the grid
  int to = 0;                    ///< direction at its end
  double length = 0;             ///< m
  std::vector<Vec3> samples;     ///< places along it from the start, m, without the start itself
};

class StateLattice {
 public:
  /// `step` (m) of the grid; no arc bends more sharply than `radius` (m). Samples at most `spacing` (m) apart. `longest` (m): of a
  /// primitive; 0: long enough to turn from each direction to its neighbours.
  StateLattice(double step, double radius, double spacing, int divisions = 1, double longest = 0);

  const std::vector<Vec3>& directions() const { return directions_; }
  const std::vector<Primitive>& from(int direction) const { return primitives_[direction]; }
  double step() const { return step_; }
  double radius() const { return radius_; }
  double longest() const { return longest_; }
  std::size_t primitives() const;

 private:
  void add_primitives(int from, int to, double spacing);
  double step_, radius_, longest_;
  std::vector<Vec3> directions_;
  std::vector<std::vector<Primitive>> primitives_;
};

}  // namespace tendril::routing
