// A shape to start Newton's method from: through all holds, of the right length, sagging along gravity.
#pragma once

#include <vector>

#include "statics/rod_mesh.h"

namespace tendril {

/// One frame per vertex. Between two held places: a cubic curve along the held tangents plus a bump along gravity that
/// makes up the length, sampled evenly in arc length; frames transported without twist, then the twist that is left and
/// the extra turns spread evenly. Preformed rods: the reference shape with the misfit at the far hold spread along it.
/// Free ends: the reference shape carried on from the nearest hold.
std::vector<Frame> first_guess(const RodProblem& problem, const RodMesh& mesh);

}  // namespace tendril
