// A number that describes a system of rods, and what its growing by one unit does to the discrete problem.
//
// Arc lengths. The places of holds, loads and joined sections are absolute (m from the start), those at the finish move
// with it. When the length grows, sections keep their share of it (as in a changed copy of a design) and the vertices
// between two breaks keep theirs. A preformed rod keeps the reference rates of every segment when its length grows; when a
// place moves along it, the shape stays where it is in the material.
#pragma once

#include <string>
#include <vector>

#include "statics/rod_network.h"
#include "statics/rod_slopes.h"

namespace tendril {

struct Parameter {
  enum class Kind {
    length,                            ///< m, reference length
    EA, GA1, GA2, GA, EI1, EI2, EI, GJ,///< N, N m^2; GA and EI: both directions at once
    stiffness,                         ///< a factor on all six, per unit of the factor
    mass,                              ///< kg/m
    density,                           ///< a factor on the mass, per unit of the factor
    outer, inner, young,               ///< m, m, Pa; of a round section of one material
    gravity,                           ///< m/s^2
    hold_position, hold_orientation,   ///< m, rad about world axes through the hold's place
    hold_place,                        ///< m, arc length of a hold inside the rod
    load_force, load_moment, load_place,         ///< N, N m, m
    branch_position, branch_orientation,         ///< of a held branch point, as of a hold
    joint_position, joint_orientation,           ///< m, rad: a joined section, in the branch point's axes; about its own ones
    joint_place,                       ///< m, arc length of a joined section inside its rod
  };
  Kind kind = Kind::length;
  int rod = 0;        ///< of the system; not for gravity and branch points
  int index = 0;      ///< which hold, load or branch point
  int section = 0;    ///< which of a branch point's sections
  int component = 0;  ///< x, y, z
  int part = -1;      ///< of the rod's parts, for section parameters; -1: all of them
};

/// Unit of the parameter: "m", "N m^2", "" for a factor.
const char* unit_of(Parameter::Kind kind);

/// First-order changes of the discrete problem per unit of the parameter.
struct ParameterEffect {
  int rod = -1;                        ///< whose parts and places change; -1: of no rod
  struct PartChange {
    int part;
    SegmentChange change;              ///< of every segment of the part
  };
  std::vector<PartChange> parts;
  struct PlaceMove {
    int vertex;                        ///< a break of the mesh
    double by;                         ///< m
  };
  std::vector<PlaceMove> places;
  bool shape_stays = false;            ///< a preformed rod's shape stays in the material while places move along it
  Vec3 gravity = Vec3::Zero();
  struct AtNode {
    int node;                          ///< of the network
    Vec6 change;
  };
  std::vector<AtNode> loads;           ///< dead force and moment in world axes
  std::vector<AtNode> motions;         ///< of held unknowns: world translation, rotation in the node's own axes
  struct AtJoint {
    int section, branch;               ///< nodes of the network
    Frame relative;                    ///< the section's frame seen from the branch point
    Vec6 change;                       ///< of the relative frame: translation in the branch point's axes, rotation in its own
  };
  std::vector<AtJoint> joints;
};

/// Throws UsageError for an index or component that does not exist, for the place of an end, and for the diameters or the
/// modulus of a section that is not round and of one material.
ParameterEffect effect_of(const Parameter& parameter, const RodNetwork& network);

/// The problem with the parameter grown by `by` (in its unit): what effect_of() is the first order of. Throws as that does.
SystemProblem changed(const SystemProblem& problem, const Parameter& parameter, double by);
/// The same in place.
void change(SystemProblem& problem, const Parameter& parameter, double by);

/// True when the stiffnesses are those of the diameters and one material.
bool is_round(const Section& section);

/// Young's modulus (Pa) of a round section. Throws UsageError naming `wanted` for one whose stiffnesses are not those of its
/// diameters.
double young_of(const Section& section, const char* wanted);

/// A step of the parameter that changes the problem little, but well above rounding.
double small_step(const SystemProblem& problem, const Parameter& parameter);

/// The vertices of a rod's mesh that a change of arc lengths moves as a whole, rising; the vertices between two of them
/// keep their share of the way.
std::vector<int> break_vertices(const RodSystem& system);

/// Index of the rod's part that every segment belongs to.
std::vector<int> segment_parts(const RodSystem& system);

}  // namespace tendril
