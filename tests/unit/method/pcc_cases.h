// Curves of straights and arcs that several tests use.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "method/pcc/pcc_descent.h"

namespace tendril::routing {

inline FreeSpace empty_space() { return FreeSpace(Scene(), {}, {Vec3::Zero()}, 1); }

inline Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

inline double positive_angle(double angle) {
  angle = std::fmod(angle, 2 * M_PI);
  return angle < 0 ? angle + 2 * M_PI : angle;
}

/// A word of Dubins in the plane z = 0: three parts, 'L', 'R' or 'S', each by its length over the radius.
struct DubinsPath {
  std::string word;
  double parts[3];
  double length() const { return parts[0] + parts[1] + parts[2]; }  ///< over the radius
};

/// Chooses the parts of a word of the types CSC or CCC from the circles' centres; false where the word does not reach. From
/// the origin along x to (x, y) with heading h, radius 1.
inline bool dubins(const std::string& word, double x, double y, double heading, DubinsPath& path) {
  const auto side = [](char turn) { return turn == 'L' ? 1.0 : -1.0; };
  const double first = side(word[0]), last = side(word[2]);
  const double cx = x - last * std::sin(heading), cy = y + last * std::cos(heading);  // of the last circle
  const double dx = cx, dy = cy - first, apart = std::hypot(dx, dy), towards = std::atan2(dy, dx);
  path.word = word;
  double straight, middle_heading;
  if (word[1] == 'S') {
    // The tangent from circle to circle: its heading differs from the centres' line where it crosses between them.
    if (first == last) {
      straight = apart;
      middle_heading = towards;
    } else {
      if (apart < 2) return false;
      straight = std::sqrt(apart * apart - 4);
      middle_heading = towards + first * std::atan2(2, straight);
    }
    path.parts[0] = positive_angle(first * middle_heading);
    path.parts[1] = straight;
    path.parts[2] = positive_angle(last * (heading - middle_heading));
    return true;
  }
  if (apart > 4) return false;
  // The middle circle touches both, on the side that makes its arc the longer one.
  const double corner = std::acos(apart / 4);
  double best = std::numeric_limits<double>::infinity();
  for (const double sign : {1.0, -1.0}) {
    const double to_middle = towards + sign * corner;
    const double mx = 2 * std::cos(to_middle), my = first + 2 * std::sin(to_middle);
    const double from_middle = std::atan2(cy - my, cx - mx);
    // Headings where the circles touch: at right angles to the lines of the centres.
    const double leave = to_middle + first * M_PI / 2, enter = from_middle - first * M_PI / 2;
    const double parts[3] = {positive_angle(first * leave), positive_angle(-first * (enter - leave)), positive_angle(last * (heading - enter))};
    if (parts[1] <= M_PI || parts[0] + parts[1] + parts[2] >= best) continue;
    best = parts[0] + parts[1] + parts[2];
    std::copy(parts, parts + 3, path.parts);
  }
  return std::isfinite(best);
}

/// The vertices of a word; arcs over `most` (rad) as two or three.
inline PccPoints vertices_of(const DubinsPath& path, double radius, double most = 2.6) {
  PccPoints curve;
  double x = 0, y = 0, heading = 0;
  curve.points.push_back(Vec3::Zero());
  for (int part = 0; part < 3; ++part) {
    if (path.word[part] == 'S') {
      x += radius * path.parts[part] * std::cos(heading);
      y += radius * path.parts[part] * std::sin(heading);
      continue;
    }
    const int count = static_cast<int>(path.parts[part] / most) + 1;
    const double side = path.word[part] == 'L' ? 1 : -1, turn = side * path.parts[part] / count, tangent = radius * std::tan(std::abs(turn) / 2);
    for (int i = 0; i < count; ++i) {
      x += tangent * std::cos(heading);
      y += tangent * std::sin(heading);
      curve.points.push_back(Vec3(x, y, 0));
      curve.radii.push_back(radius);
      heading += turn;
      x += tangent * std::cos(heading);
      y += tangent * std::sin(heading);
    }
  }
  curve.points.push_back(Vec3(x, y, 0));
  return curve;
}

}  // namespace tendril::routing
