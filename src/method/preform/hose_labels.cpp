#include "method/preform/hose_labels.h"

#include <cmath>
#include <cstdio>

#include "base/units.h"
#include "method/preform/passage_match.h"

namespace tendril::preform {

namespace {

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value + 0.0);
  return text;
}

/// Tenths where the whole millimetre says nothing.
std::string longer(double by) {
  const double mm = by / units::mm;
  return std::abs(mm) < 0.05 ? "as long" : formatted(std::abs(mm) < 9.95 ? "%+.1f mm" : "%+.0f mm", mm);
}

std::string bends_text(int bends) { return std::to_string(bends) + (bends == 1 ? " bend" : " bends"); }

std::string place_text(const Vec3& p) {
  std::string text = "(";
  for (int k = 0; k < 3; ++k) {
    const double rounded = std::round(100 * p[k]) / 100;
    text += formatted("%.2f", rounded) + (k < 2 ? ", " : ")");
  }
  return text;
}

/// Which way, by the world's axis that it is nearest to; z is up.
std::string direction_text(const Vec3& way) {
  Eigen::Index axis;
  way.cwiseAbs().maxCoeff(&axis);
  if (axis == 2) return way.z() > 0 ? "above" : "below";
  const char* const names[2][2] = {{"towards -x of", "towards +x of"}, {"towards -y of", "towards +y of"}};
  return names[axis][way[axis] > 0];
}

/// Where places at equal shares of the lengths are farthest apart.
std::string deviation_text(const Hose& hose, const Hose& other, int other_number) {
  constexpr int count = 97;
  const std::vector<Vec3> a = places_along(hose.points, count, 0, hose.length);
  const std::vector<Vec3> b = places_along(other.points, count, 0, other.length);
  int farthest = 0;
  for (int k = 0; k < count; ++k)
    if ((a[k] - b[k]).norm() > (a[farthest] - b[farthest]).norm() * (1 + 1e-9)) farthest = k;
  const Vec3 way = a[farthest] - b[farthest];
  return formatted("%.0f mm ", way.norm() / units::mm) + direction_text(way) + " hose " + std::to_string(other_number) + " at " +
         place_text(a[farthest]);
}

std::string sides_text(const FreeSpace& space, const std::vector<int>& blocking) {
  std::string text = "other side of ";
  for (std::size_t k = 0; k < blocking.size() && k < 2; ++k) text += (k ? " and '" : "'") + space.name(blocking[k]) + "'";
  return text;
}

}  // namespace

std::vector<std::string> labels_of(const FreeSpace& space, const std::vector<Hose>& hoses,
                                   const std::vector<std::vector<int>>& blocking) {
  const bool only_length = !space.has_preferences();
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < hoses.size(); ++i) {
    if (i == 0) {
      labels.push_back(only_length ? "shortest" : "best");
      continue;
    }
    std::string label = longer(hoses[i].length - hoses[0].length);
    if (hoses[i].points.bends() != hoses[0].points.bends()) label += ", " + bends_text(hoses[i].points.bends());
    std::size_t first = 0;  // of its passage
    while (hoses[first].passage != hoses[i].passage) ++first;
    const bool by_side = first == i && !blocking[i].empty() && space.surroundings().size() > 1;
    const std::size_t other = first == i ? 0 : first;
    label += ", ";
    label += by_side ? sides_text(space, blocking[i]) : deviation_text(hoses[i], hoses[other], static_cast<int>(other) + 1);
    labels.push_back(label);
  }
  return labels;
}

}  // namespace tendril::preform
