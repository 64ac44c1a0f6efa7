// A manipulation as text, for robots, jigs and other programs.
#pragma once

#include <string>

#include "method/assembly/manipulation.h"

namespace tendril::assembly {

/// A row for each grip and time: t in s from 0 to `duration`, places in mm, orientations as unit quaternions.
std::string manipulation_csv(const Manipulation& manipulation, double duration);

/// The same as JSON: {"duration": s, "grips": [{"name", "connection", "at": m, "t": [s], "place": [[mm]], "quaternion": [[w, x, y, z]]}]};
/// no "at" for a branch point.
std::string manipulation_json(const Manipulation& manipulation, double duration);

}  // namespace tendril::assembly
