// What a harness is measured by: lengths, volume, mass, clips, length in collision, what its run costs; and lengths by wire.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/scene_equilibrium.h"

namespace tendril {

struct QuantityOptions {
  /// What a metre costs more, as in routing (Hermansson, Bohlin, Carlson, Soderberg): by clearance f(gap) to the nearest obstacle
  /// that rods need not keep near, and by preference f(gap) for each obstacle to avoid, preference (1 - f(gap)) for each to keep
  /// near, with f(gap) = max(0, 1 - gap / range)^2.
  double clearance = 0, preference = 0;
  double range = 0.1;     ///< m
  double free_ends = 0;   ///< m at the rods' ends that are not judged for collision
  /// The rods that each wire runs through, by the wire's name: what a harness file knows.
  std::map<std::string, std::vector<std::string>> wires = {};
};

struct RodQuantities {
  std::string rod;
  double length = 0;               ///< m, of the centre line at rest
  double unstressed_length = 0;    ///< m
  double volume = 0;               ///< m^3, of the space it takes: hollow rods count as full
  double mass = 0;                 ///< kg
  int clips = 0;                   ///< holds between its ends
  int held_ends = 0;               ///< 0, 1 or 2; ends at branch points do not count
  double length_in_collision = 0;  ///< m of unstressed length; see too_close() with no clearance required
  double cost = 0;                 ///< m: its length and what its run costs more
};

struct Quantities {
  std::vector<RodQuantities> rods;  ///< in the equilibrium's order
  RodQuantities total;              ///< their sums; without a name
  int branches = 0;
  std::map<std::string, double> wire_lengths;  ///< m, at rest
  double cable_length = 0;                     ///< m, of all wires
};

/// Collision and cost are summed over pieces of half a radius (8 to 100,000 a rod), by their middles. Throws UsageError for options
/// that are negative or not finite, a range that is not above 0, rods that are not there, and wires that run through one twice.
Quantities quantities_of(const SceneEquilibrium& equilibrium, const QuantityOptions& options = {});

}  // namespace tendril
