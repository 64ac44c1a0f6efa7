// Which parts of the surroundings lie between the eye and the tubes.
//
// Over every point of the page stands a depth: what lies nearer to the eye is cut away. Around each point of a tube the
// cut is a cone that opens towards the eye, so that the tube and what it rests on stay in view while the surroundings
// away from it are whole (after Burns and Finkelstein, "Adaptive cutaways for comprehensible rendering of polygonal
// scenes", 2008).
#pragma once

#include <vector>

#include "view/picture.h"
#include "view/view_camera.h"

namespace tendril::render {

/// Depth won per distance from the tube: the cone's half angle is about 30 degrees.
inline constexpr double cut_slope = 1.7;

struct Cutaway {
  int columns = 1, rows = 1;
  std::vector<float> depth{
      0};  ///< row by row from the bottom; as on the depth buffer: 0 nearest, 1 farthest. 0: nothing is cut

  struct Range {
    float least, most;
  };
  /// Over a rectangle of the page in shares of its width and height from the bottom left; it may reach beyond the page.
  Range over(double left, double right, double bottom, double top) const;
};

/// For a page whose depth buffer runs from `nearest` (m towards the eye) over `range` (m).
Cutaway cutaway_of(const std::vector<PictureTube>& tubes, const ViewCamera& camera, double nearest, double range);

}  // namespace tendril::render
