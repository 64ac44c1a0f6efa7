// What can be read off an equilibrium, with its derivatives by the state and by what the rods are made of.
//
// The place of a measure is an arc length of the rod; where the mesh moves under a change of lengths it stays at that arc
// length, but the finish stays the finish. Measures that belong to a segment or a vertex (forces, bend radii) stay with it,
// as do the smallest and largest ones with the place where they are reached: their derivatives are those of that place.
#pragma once

#include <optional>
#include <vector>

#include "statics/rod_network.h"
#include "statics/rod_slopes.h"

namespace tendril {

struct Measure {
  enum class What {
    position,         ///< m, of the centre line along `along`
    rotation,         ///< rad, of the section about `along`, counted from this equilibrium: zero, its derivatives are not
    tangent,          ///< the section normal's component along `along`
    force,            ///< N, internal force (by the part behind on the part before) along `along`, of the segment at `at`
    moment,           ///< N m, internal moment at the segment's middle; `along` in the section's axes (d1, d2, d3)
    tension,          ///< N, of the segment: force along the section normal at its middle
    twist,            ///< rad/m, of the segment
    bend_radius,      ///< m, at the vertex nearest to `at`
    reaction_force,   ///< N, of hold `index` on the rod, along `along`
    reaction_moment,  ///< N m, about the hold's place
    branch_force,     ///< N, N m: the same of what holds branch point `index`
    branch_moment,
    branch_position,  ///< m, of branch point `index`
    min_bend_radius,  ///< m
    max_tension,      ///< N
    max_strain,       ///< largest |stretch| + radius |curvature change|
    length,           ///< m, of the deformed centre line
    gap,              ///< m: along `along` (the obstacle's unit normal) from `origin` to the centre line, less the radius
    bend, twist_energy, stretch, shear, gravity, load,  ///< J, of the rod, by term
    energy,           ///< J: the sum of these
    functional,       ///< sum of `weights` . increments of the network's nodes; zero at the equilibrium itself
  };
  What what = What::position;
  int rod = 0;
  double at = 0;                    ///< m
  Vec3 along = Vec3::UnitZ();
  int index = 0;                    ///< which hold or branch point
  Vec3 origin = Vec3::Zero();       ///< m, of a gap
  std::vector<Vec6> weights = {};   ///< of a functional, by node of the network
};

/// Unit of the measure: "m", "N m", "" for a number.
const char* unit_of(Measure::What what);

/// A measure's value, and its derivatives as they stand side by side: by the nodes' increments with all parameters fixed,
/// and by the parameters with all nodes fixed.
struct MeasureSlopes {
  double value = 0;
  std::vector<Vec6> by_state;        ///< by node of the network (world translation, rotation in the node's own axes)
  std::vector<RodSlopes> by_rod;     ///< by rod
  struct AtNode {
    int node;
    Vec6 weight;
  };
  std::vector<AtNode> by_load;       ///< by a dead force and moment at a node, world axes
  std::vector<AtNode> by_motion;     ///< by a prescribed motion of held unknowns
  /// A reaction: the value is weight . gradient of all terms at held nodes, which the derivatives above do not hold.
  std::vector<AtNode> reaction;
};

/// `gradient`: of all terms, by node, sections at branch points joined. Throws UsageError for a rod, hold, branch point or
/// place that does not exist and for a reaction where nothing is held.
MeasureSlopes slopes_of(const Measure& measure, const RodNetwork& network, const std::vector<RodDerivatives>& rods,
                        const RodState& state, const std::vector<Vec6>& gradient);

}  // namespace tendril
