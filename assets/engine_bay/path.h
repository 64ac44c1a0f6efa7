// Lines that sections are swept along.
#pragma once

#include <vector>

#include "engine_bay/detail.h"
#include "engine_bay/mesh.h"

namespace tendril::engine_bay {

using Path = std::vector<Vec3>;

/// Straight lines through the corners, each corner replaced by an arc of `radius` (less where the lines are too
/// short for it), cut into pieces as `detail` asks.
Path rounded_path(const Path& corners, double radius, const Detail& detail);

/// Long pieces are divided; corners stay.
Path divided(const Path& path, const Detail& detail);

/// Arc length at every point.
std::vector<double> arc_lengths(const Path& path);

}  // namespace tendril::engine_bay
