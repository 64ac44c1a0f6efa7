#include "statics/contact_detour.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/units.h"

namespace tendril {

namespace {

constexpr int directions_within = 8;
constexpr double first_try = 3, growth = 1.4;   // radii aside; each try goes so much farther
constexpr double farthest = 0.5;                // of the rod's length
constexpr double further[] = {1, 1.5, 2.5};     // times the least clear way: the rest of the rod may need more

/// How much of the way aside a place takes part in, and how fast that changes along the rod (1/m).
struct Share {
  double value, slope;
};

/// One at the crossing, nothing at the held places next to it and beyond; a free end goes along.
class Bulge {
 public:
  Bulge(const CrossedShape& shape, double top) : top_(top) {
    for (const int vertex : shape.held) {
      const double s = shape.s[vertex];
      if (s <= top && (!low_ || s > *low_)) low_ = s;
      if (s > top && (!high_ || s < *high_)) high_ = s;
    }
  }

  Share at(double s) const {
    const std::optional<double>& foot = s <= top_ ? low_ : high_;
    if (!foot) return {1, 0};
    const double reach = top_ - *foot;
    if (reach == 0) return {0, 0};
    const double t = (s - *foot) / reach;
    if (t <= 0) return {0, 0};
    return {t * t * (3 - 2 * t), 6 * t * (1 - t) / reach};
  }

 private:
  double top_;
  std::optional<double> low_, high_;
};

std::vector<Frame> carried_aside(const CrossedShape& shape, const Bulge& bulge, const Vec3& way) {
  std::vector<Frame> frames = shape.frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Share share = bulge.at(shape.s[i]);
    if (share.value == 0) continue;
    const Vec3 tangent = frames[i].d3(), leaning = tangent + share.slope * way;
    frames[i].at += share.value * way;
    if (leaning.norm() > 1e-6)
      frames[i].rotation = (Quat::FromTwoVectors(tangent, leaning) * frames[i].rotation).normalized();
  }
  return frames;
}

/// The least way from the crossing in a direction where the rod touches nothing; nothing when there is none near.
std::optional<double> clear_way(const CrossedShape& shape, const CrossingPlace& crossing, const Vec3& direction,
                                const ContactField& field) {
  const double most = farthest * (shape.s.back() - shape.s.front());
  for (double way = first_try * shape.radius; way < most; way *= growth)
    if (field.closest(crossing.at + way * direction, 2 * shape.radius).obstacle < 0) return way;
  return std::nullopt;
}

}  // namespace

std::vector<std::vector<Frame>> detours(const CrossedShape& shape, const CrossingPlace& crossing, const ContactField& field) {
  std::vector<Vec3> directions;
  const Vec3 u = crossing.normal.unitOrthogonal(), v = crossing.normal.cross(u);
  for (int k = 0; k < directions_within; ++k) {
    const double angle = 2 * units::pi * k / directions_within;
    directions.push_back(std::cos(angle) * u + std::sin(angle) * v);
  }
  directions.push_back(crossing.normal);
  directions.push_back(-crossing.normal);

  std::vector<std::vector<Frame>> shapes;
  const Bulge bulge(shape, crossing.s);
  for (const Vec3& direction : directions)
    if (const auto way = clear_way(shape, crossing, direction, field))
      for (const double times : further) shapes.push_back(carried_aside(shape, bulge, times * *way * direction));
  return shapes;
}

double length_of(const std::vector<Frame>& frames) {
  double length = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) length += (frames[i].at - frames[i - 1].at).norm();
  return length;
}

}  // namespace tendril
