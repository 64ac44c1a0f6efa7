// Ways around the rim of a sheet that a guess of a rod's shape passes through.
//
// The rod is carried aside where it crosses: by so much that it clears the rim there, and smoothly less towards the held
// places on both sides. Directions: eight within the sheet, and off it to both sides for a rod that dips through and back.
#pragma once

#include <vector>

#include "base/frame.h"
#include "statics/contact_field.h"

namespace tendril {

/// A guess of a rod's shape that crosses a surface.
struct CrossedShape {
  const std::vector<Frame>& frames;     ///< at the vertices
  const std::vector<double>& s;         ///< their arc lengths, m
  const std::vector<int>& held;         ///< vertices that stay where they are
  double radius;                        ///< m
};

/// Where the centre line passes through.
struct CrossingPlace {
  double s;     ///< m
  Vec3 at;      ///< m
  Vec3 normal;  ///< of the surface, either way
};

/// Shapes whose place at the crossing is carried aside to where it touches nothing: in each direction the least way there
/// and some beyond, none where half the rod's length is not enough. Elsewhere they may cross still, or anew. Held
/// vertices keep their frames.
std::vector<std::vector<Frame>> detours(const CrossedShape& shape, const CrossingPlace& crossing, const ContactField& field);

/// Length of the polyline through the frames (m).
double length_of(const std::vector<Frame>& frames);

}  // namespace tendril
