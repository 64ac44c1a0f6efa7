// A hold of a rod that a robot's link carries.
#pragma once

#include <string>

#include "base/frame.h"

namespace tendril {

struct Attachment {
  std::string rod;
  double at = 0;              ///< arc length, m; of one that slides: where the search begins
  std::string robot;
  int link = 0;
  Frame in_link;              ///< the section's frame in the link's axes
  bool position = true, orientation = true;
  double turns = 0;           ///< see Hold
  bool slide = false;         ///< see Hold
};

/// Over so many of its radii (of arc length, to both sides) a rod is not compared with what it is fastened to.
inline constexpr double fastened_radii = 4;

}  // namespace tendril
