// How a hose leaves what it is plugged to: the straight at its end, and what is wrong where that does not keep clear.
#pragma once

#include <string>

#include "method/free_space/free_space.h"
#include "method/pcc/pcc_demands.h"

namespace tendril::preform {

/// The straight from an end to where the search begins.
struct EndLead {
  Vec3 tip = Vec3::Zero();  ///< m
  double length = 0;        ///< m
  std::string obstruction;  ///< empty, or why no straight of the length demanded leaves the end
};

/// The straight that is demanded and the share of the bend radius that keeps clear behind it: a bend's vertex lies there. Where
/// the direction may turn within a cone and its axis is blocked, others within the cone are tried. `outward`: unit, from the end
/// into space; `who`: "start" or "finish", for the message.
EndLead end_lead(const routing::FreeSpace& space, const routing::PccDemands& demands, const Vec3& end, const Vec3& outward, double cone,
                 const std::string& who);

}  // namespace tendril::preform
