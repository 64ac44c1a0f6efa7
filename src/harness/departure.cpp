#include "harness/departure.h"

namespace tendril {

Departure departure(const ImportedHarness& harness, int segment, const Equilibrium& rod) {
  const CentreLine line(harness.file, harness.file.segments[segment]);
  const double share = rod.s.empty() ? 0 : line.length() / rod.s.back();
  Departure found;
  for (std::size_t i = 0; i < rod.s.size(); ++i) {
    const Vec3 drawn = line.at(rod.s[i] * share);
    const double distance = (rod.points[i] - drawn).norm();
    if (i == 0 || distance > found.distance) found = {distance, rod.s[i], drawn, rod.points[i]};
  }
  return found;
}

}  // namespace tendril
