// The rods of a picture: smooth centre lines, and along them the values that colours show.
#pragma once

#include <string>

#include "binding/compose_picture.h"

namespace tendril {

/// One tube a rod, with values by `wish.colour`.
std::vector<PictureTube> compose_tubes(const SceneEquilibrium& equilibrium, const PictureWish& wish);

/// What the values mean: name, unit, limit.
ColourScale compose_scale(const SceneEquilibrium& equilibrium, RodColour colour);

/// The clearance that all obstacles require alike, m; nothing when they differ: then colours show the margin to what
/// each requires.
std::optional<double> common_clearance(const std::vector<PlacedObstacle>& obstacles);

/// What gaps in mm mean: the clearance, where all ask for the same (m), else the margin to what each asks for.
ColourScale scale_of_gaps(std::optional<double> required);

/// The meaning of clearance to such obstacles.
ColourScale clearance_scale(const std::vector<PlacedObstacle>& obstacles);

}  // namespace tendril
