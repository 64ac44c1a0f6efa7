#include "method/envelope/convex_hull.h"

#include <algorithm>
#include <cmath>

namespace tendril::envelope {

bool ConvexHull::plane_of(int a, int b, int c, Plane& plane) const {
  const Vec3 u = points_[b] - points_[a], v = points_[c] - points_[a];
  const Vec3 normal = u.cross(v);
  const double area = normal.norm();
  if (!(area > 1e-12 * std::max(u.squaredNorm(), v.squaredNorm()))) return false;
  plane.normal = normal / area;
  // The middle of the three: rounding then weighs alike on all corners.
  plane.offset = plane.normal.dot(points_[a] + points_[b] + points_[c]) / 3;
  return true;
}

void ConvexHull::set(int f, const Facet& facet, const Plane& plane) {
  facets_[f] = facet;
  x_[f] = plane.normal.x();
  y_[f] = plane.normal.y();
  z_[f] = plane.normal.z();
  offset_[f] = plane.offset;
}

bool ConvexHull::begin(const std::array<Vec3, 4>& corners) {
  points_.assign(corners.begin(), corners.end());
  const Vec3 a = corners[1] - corners[0], b = corners[2] - corners[0], c = corners[3] - corners[0];
  const double sixfold = a.cross(b).dot(c);
  const double size = std::max({a.norm(), b.norm(), c.norm()});
  if (!(std::abs(sixfold) > 1e-12 * size * size * size)) return false;
  if (sixfold > 0) std::swap(points_[1], points_[2]);  // corner 3 below the facet 0 1 2
  facets_.resize(4);
  for (std::vector<double>* row : {&x_, &y_, &z_, &offset_, &height_}) row->resize(4);
  const Facet start[4] = {{{0, 1, 2}, {1, 2, 3}}, {{1, 0, 3}, {0, 3, 2}}, {{2, 1, 3}, {0, 1, 3}}, {{0, 2, 3}, {0, 2, 1}}};
  for (int f = 0; f < 4; ++f) {
    Plane plane;
    if (!plane_of(start[f].corner[0], start[f].corner[1], start[f].corner[2], plane)) return false;
    set(f, start[f], plane);
  }
  side_from_.assign(4, -1);
  return true;
}

double ConvexHull::height(const Vec3& p) const {
  double highest = -INFINITY;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const double height = x_[f] * p.x() + y_[f] * p.y() + z_[f] * p.z() - offset_[f];
    highest = height > highest ? height : highest;
  }
  return highest;
}

// The sides of the visible facets whose other facet is not visible. False unless they form one loop without a crossing.
bool ConvexHull::find_horizon() {
  horizon_.clear();
  for (const int f : visible_)
    for (int k = 0; k < 3; ++k) {
      const int beyond = facets_[f].neighbour[k];
      if (height_[beyond] > 0) continue;
      horizon_.push_back({facets_[f].corner[k], facets_[f].corner[(k + 1) % 3], beyond});
    }
  bool simple = true;
  for (std::size_t i = 0; i < horizon_.size(); ++i) {
    int& side = side_from_[horizon_[i].from];
    simple = simple && side < 0;
    side = static_cast<int>(i);
  }
  std::size_t steps = 0;
  if (simple && !horizon_.empty()) {
    int side = 0;
    do {
      side = side_from_[horizon_[side].to];
      ++steps;
    } while (side > 0 && steps <= horizon_.size());
    simple = side == 0;
  }
  const bool loop = simple && steps == horizon_.size() && steps >= 3;
  if (!loop)
    for (const Side& side : horizon_) side_from_[side.from] = -1;
  return loop;
}

// Facet f leaves; the last one takes its place.
void ConvexHull::remove(int f) {
  const int last = size() - 1;
  if (f != last) {
    set(f, facets_[last], {normal(last), offset_[last]});
    for (const int neighbour : facets_[f].neighbour)
      for (int& back : facets_[neighbour].neighbour)
        if (back == last) back = f;
  }
  facets_.pop_back();
  for (std::vector<double>* row : {&x_, &y_, &z_, &offset_, &height_}) row->pop_back();
}

// A cone from the point to the horizon takes the place of the visible facets.
void ConvexHull::replace_visible(int point) {
  const int sides = static_cast<int>(horizon_.size()), before = size();
  const int gone = static_cast<int>(visible_.size());
  slots_ = visible_;
  for (int f = before; static_cast<int>(slots_.size()) < sides; ++f) slots_.push_back(f);
  if (sides > gone) {
    facets_.resize(before + sides - gone);
    for (std::vector<double>* row : {&x_, &y_, &z_, &offset_, &height_}) row->resize(before + sides - gone);
  }
  for (int i = 0; i < sides; ++i) {
    const Side& side = horizon_[i];
    int previous = 0;
    while (horizon_[previous].to != side.from) ++previous;
    set(slots_[i], {{side.from, side.to, point}, {side.beyond, slots_[side_from_[side.to]], slots_[previous]}}, planes_[i]);
    Facet& beyond = facets_[side.beyond];
    for (int k = 0; k < 3; ++k)
      if (beyond.corner[k] == side.to && beyond.corner[(k + 1) % 3] == side.from) beyond.neighbour[k] = slots_[i];
  }
  for (const Side& side : horizon_) side_from_[side.from] = -1;
  for (int i = gone - 1; i >= sides; --i) remove(slots_[i]);  // from the highest down
}

bool ConvexHull::insert(const Vec3& p) {
  visible_.clear();
  const int count = size();
  for (int f = 0; f < count; ++f) height_[f] = x_[f] * p.x() + y_[f] * p.y() + z_[f] * p.z() - offset_[f];
  for (int f = 0; f < count; ++f)
    if (height_[f] > 0) visible_.push_back(f);
  if (visible_.empty() || !find_horizon()) return false;
  points_.push_back(p);
  side_from_.push_back(-1);
  const int point = static_cast<int>(points_.size()) - 1;
  planes_.resize(horizon_.size());
  for (std::size_t i = 0; i < horizon_.size(); ++i)
    if (!plane_of(horizon_[i].from, horizon_[i].to, point, planes_[i])) {
      for (const Side& side : horizon_) side_from_[side.from] = -1;
      points_.pop_back();
      side_from_.pop_back();
      return false;
    }
  replace_visible(point);
  return true;
}

std::vector<char> ConvexHull::corners() const {
  std::vector<char> used(points_.size(), 0);
  for (const Facet& facet : facets_)
    for (const int corner : facet.corner) used[corner] = 1;
  return used;
}

}  // namespace tendril::envelope
