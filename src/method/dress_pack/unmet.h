// Which limits of an engineer a simulated motion of a dress pack does not keep, where and when.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "method/dress_pack/pack_simulation.h"

namespace tendril::dress_pack {

/// What a dress pack may be asked to bear.
struct Limits {
  double max_tension = std::numeric_limits<double>::infinity();  ///< N, size of the force between a hold and its rod
  double max_twist = std::numeric_limits<double>::infinity();    ///< rad/m, change against the unstressed rod
  double min_bend_radius = 0;                                    ///< m
  double clearance = -1;                                         ///< m, of the rods; negative: none is demanded, they may touch
  double robot_clearance = -1;                                   ///< m, of the links from fixed bodies; negative: not looked at

  /// Throws UsageError for limits that are not numbers or that nothing can keep.
  void check() const;
};

/// A limit that is not kept: the worst time and place of it.
struct Unmet {
  enum class What { tension, twist, bend_radius, clearance, robot_clearance };
  What what = What::tension;
  double value = 0, demanded = 0;  ///< N, rad/m or m
  double t = 0;                    ///< 0 ... 1
  double from = 0, to = 0;         ///< not kept between the first and the last of these times
  std::string where;               ///< "hose.start", "hose", or a link
  bool at_end = false;             ///< the first or last configuration, which no via point changes, is as bad: then it is the one named
  std::string text;
};

/// "tension", "twist", "bend_radius", "clearance", "robot_clearance".
const char* name_of(Unmet::What what);

/// At most one for each hold or rod and each kind of limit; in the order of What, then the worst first. What is beyond its limit by
/// less than a thousandth of it is kept.
std::vector<Unmet> unmet_of(const PackProblem& pack, const PackMotion& motion, const Limits& limits);

}  // namespace tendril::dress_pack
