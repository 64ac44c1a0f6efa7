// Where nothing passes: how thick an object would have to be at most, and what stands in its way.
#pragma once

#include <string>

#include "base/run_context.h"
#include "method/free_space/free_space.h"

namespace tendril::routing {

/// The narrowest place of the widest way found.
struct Bottleneck {
  enum class Kind {
    narrow,           ///< a way, but too narrow
    passable,         ///< a way wide enough, that the nodes of the grid miss
    start_enclosed,   ///< no way was found out of the space around the start
    finish_enclosed,
    stopped
  };
  Kind kind = Kind::narrow;
  Vec3 at = Vec3::Zero();      ///< m
  double lets_through = 0;     ///< m, radius plus clearance; of an enclosed end: nothing wider than about that gets out
  std::string between;         ///< "between 'a' and 'b'", "at 'a'"; what encloses an end: "'a'"
};
/// On nodes `step` (m) apart, finer where no way is found at all, then on ever finer ones about the narrowest places: to about a
/// hundredth of the step. Several passages are compared, as the nodes of a grid may lie well in one and badly in another.
Bottleneck bottleneck_between(const FreeSpace& space, const Vec3& start, const Vec3& finish, double step, const RunContext& context = {});

/// "no passage for a radius + clearance of 20 mm: the widest one found, at (...) m between 'a' and 'b', lets 14.3 mm through".
/// `step`: of the grid on which no way was found, m.
std::string text_of(const Bottleneck& bottleneck, const FreeSpace& space, double step);

}  // namespace tendril::routing
