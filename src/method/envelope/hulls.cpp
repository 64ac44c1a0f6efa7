#include "method/envelope/hulls.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "method/envelope/directions.h"

namespace tendril::envelope {
namespace {

/// Planes that may be spent on cutting the mitres of sharp edges.
constexpr int edge_planes = 64;

int filled_up(int count) { return (count + 15) / 16 * 16; }

/// The angle between unit vectors, by the chord between them: the series is good to 1e-4 where it is used.
double angle_between(const Vec3& a, const Vec3& b) {
  const double squared = (a - b).squaredNorm();
  return squared < 0.25 ? std::sqrt(squared) * (1 + squared / 24) : std::acos(std::clamp(1 - 0.5 * squared, -1.0, 1.0));
}

int steps_between(double angle, double step) { return std::max(0, static_cast<int>(std::ceil(angle / step)) - 1); }

}  // namespace

PlaneArrays SweptHull::planes() const {
  const float* rows = rows_.data();
  return {rows, rows + room_, rows + 2 * room_, rows + 3 * room_, rows + 4 * room_, room_};
}

// The rounding of an edge by the radius is an arc between the two facets' normals: tangent planes cut off what the facets
// alone would leave, in the finest equal steps that the number of planes allows.
void SweptHull::add_edge_normals(const ConvexHull& hull) {
  struct Edge {
    double angle;
    int first, second;
  };
  std::vector<Edge> edges;
  for (int f = 0; f < hull.size(); ++f)
    for (const int other : hull.facet(f).neighbour)
      if (other > f) edges.push_back({angle_between(hull.normal(f), hull.normal(other)), f, other});
  double step = 0.08;
  for (;; step *= 1.25) {
    int planes = 0;
    for (const Edge& edge : edges) planes += steps_between(edge.angle, step);
    if (planes <= edge_planes) break;
  }
  for (const Edge& edge : edges) {
    const int steps = steps_between(edge.angle, step);
    if (steps == 0) continue;
    const Vec3 first = hull.normal(edge.first), axis = first.cross(hull.normal(edge.second)).normalized();
    for (int i = 1; i <= steps; ++i) {
      const double angle = edge.angle * i / (steps + 1);
      normals_.push_back(std::cos(angle) * first + std::sin(angle) * axis.cross(first));
    }
  }
}

void SweptHull::collect_normals(const ConvexHull& hull) {
  normals_.clear();
  for (int f = 0; f < hull.size(); ++f) normals_.push_back(hull.normal(f));
  add_edge_normals(hull);
  const int found = static_cast<int>(normals_.size());
  count_ = found + 2 * direction_pairs;
  room_ = filled_up(count_);
  rows_.assign(plane_rows * room_, 0.0f);
  for (int i = 0; i < found; ++i)
    for (int k = 0; k < 3; ++k) rows_[k * room_ + i] = static_cast<float>(normals_[i][k]);
}

// Their supports are those of the extremes; the first three pairs are the axes.
void SweptHull::add_directions(std::span<const Cloud> clouds, double radius) {
  const NormalArrays& d = directions();
  const int first = count_ - 2 * direction_pairs;
  for (int k = 0; k < direction_pairs; ++k) {
    float low = clouds[0].extremes[k].low, high = clouds[0].extremes[k].high;
    for (const Cloud& cloud : clouds) {
      low = std::min(low, cloud.extremes[k].low);
      high = std::max(high, cloud.extremes[k].high);
    }
    const float sides[2] = {high, -low};
    for (int side = 0; side < 2; ++side) {
      const int i = first + 2 * k + side;
      const float sign = side == 0 ? 1.0f : -1.0f;
      rows_[i] = sign * d.x[k];
      rows_[room_ + i] = sign * d.y[k];
      rows_[2 * room_ + i] = sign * d.z[k];
      rows_[3 * room_ + i] = sides[side];
    }
    if (k < 3) {
      low_[k] = static_cast<float>(low - radius);
      high_[k] = static_cast<float>(high + radius);
    }
  }
}

void SweptHull::build(const CloudHull& cloud, std::span<const Cloud> clouds, const Kernel& kernel, double radius) {
  is_capsule_ = cloud.thin();
  if (is_capsule_) {
    const Vec3 along = cloud.finish() - cloud.start();
    const double length = along.norm(), around = radius + cloud.deviation();
    capsule_.inverse = length > 1e-9 ? static_cast<float>(1 / (length * length)) : 0;
    capsule_.radius = static_cast<float>(around);
    for (int k = 0; k < 3; ++k) {
      capsule_.a[k] = static_cast<float>(cloud.start()[k]);
      capsule_.along[k] = capsule_.inverse > 0 ? static_cast<float>(along[k]) : 0;
      low_[k] = static_cast<float>(std::min(cloud.start()[k], cloud.finish()[k]) - around);
      high_[k] = static_cast<float>(std::max(cloud.start()[k], cloud.finish()[k]) + around);
    }
    count_ = room_ = 0;
    return;
  }
  collect_normals(cloud.hull());
  add_directions(clouds, radius);
  const int found = count_ - 2 * direction_pairs;
  // Rows have room for whole registers beyond `found`; what is written there is set anew below.
  const std::array<float, 16> spared = [&] {
    std::array<float, 16> values;
    std::copy_n(&rows_[3 * room_ + found], 16, values.begin());
    return values;
  }();
  kernel.supports(cloud.outermost(), {&rows_[0], &rows_[room_], &rows_[2 * room_], found}, &rows_[3 * room_]);
  std::copy_n(spared.begin(), 16, &rows_[3 * room_ + found]);
  for (int i = 0; i < room_; ++i) {
    float& offset = rows_[3 * room_ + i];
    offset = i < count_ ? offset + static_cast<float>(radius) : 1e30f;
    rows_[4 * room_ + i] = static_cast<float>(i);
  }
}

// A distance changes by no more than one goes.
FieldBounds SweptHull::capsule_bounds(const Cube& cube) const {
  const Vec3 a(capsule_.a[0], capsule_.a[1], capsule_.a[2]);
  const Vec3 along(capsule_.along[0], capsule_.along[1], capsule_.along[2]);
  const Vec3 from = Vec3(cube.middle[0], cube.middle[1], cube.middle[2]) - a;
  const double share = std::clamp(along.dot(from) * capsule_.inverse, 0.0, 1.0);
  const double middle = (from - share * along).norm() - capsule_.radius, corner = std::sqrt(3.0) * cube.half;
  return {static_cast<float>(middle - corner), static_cast<float>(middle + corner)};
}

}  // namespace tendril::envelope
