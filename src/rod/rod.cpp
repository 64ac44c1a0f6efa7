#include "rod/rod.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace tendril {

const Section& Rod::section_at(double arc_length) const {
  for (const RodPart& part : parts)
    if (arc_length < part.upto) return part.section;
  return parts.back().section;
}

double Rod::largest_radius() const {
  double radius = 0;
  for (const RodPart& part : parts) radius = std::max(radius, part.section.radius());
  return radius;
}

double Rod::mass() const {
  double total = 0, from = 0;
  for (const RodPart& part : parts) {
    total += part.section.mass * (part.upto - from);
    from = part.upto;
  }
  return total;
}

void Rod::check() const {
  if (!std::isfinite(length) || length <= 0)
    throw UsageError("rod.new: 'length' is " + std::to_string(length) + ", expected a finite number of metres above 0");
  if (segments < 1 || segments > max_segments)
    throw UsageError("rod.new: 'segments' is " + std::to_string(segments) + ", expected 1 to " +
                     std::to_string(max_segments));
  if (parts.empty()) throw UsageError("rod.new: 'section' is missing");
  double from = 0;
  for (const RodPart& part : parts) {
    if (!std::isfinite(part.upto) || part.upto <= from)
      throw UsageError("rod.new: 'section': each part's 'upto' must lie beyond the part before");
    part.section.check();
    from = part.upto;
  }
  if (std::abs(from - length) > 1e-9 * length)
    throw UsageError("rod.new: 'section': the last part ends at " + std::to_string(from) + " m, but the rod is " +
                     std::to_string(length) + " m long");
}

Rod Rod::uniform(double length, const Section& section, int segments) {
  Rod rod;
  rod.length = length;
  rod.segments = segments;
  rod.parts = {{length, section}};
  rod.check();
  return rod;
}

}  // namespace tendril
