// How far a settled rod lies from the line that its harness file draws.
#pragma once

#include "harness/import_harness.h"
#include "statics/equilibrium.h"

namespace tendril {

struct Departure {
  double distance = 0;      ///< m, the largest over the rod's vertices, to the drawn place of the same arc length
  double s = 0;             ///< m, where
  Vec3 drawn = Vec3::Zero(), settled = Vec3::Zero();  ///< m
};

/// `segment`: its number in the file.
Departure departure(const ImportedHarness& harness, int segment, const Equilibrium& rod);

}  // namespace tendril
