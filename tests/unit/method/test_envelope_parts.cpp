// The steps of an envelope, each by itself.
#include <catch2/catch.hpp>

#include <map>
#include <random>

#include "base/frame.h"
#include "base/units.h"
#include "method/envelope/arc_points.h"
#include "method/envelope/cube_table.h"
#include "method/envelope/directions.h"
#include "method/envelope/hulls.h"
#include "method/envelope/share.h"
#include "unit/method/envelope_cases.h"

using namespace tendril;
using namespace tendril::envelope;

namespace {

int end_corner(int edge) { return edge_corner(edge) + (1 << edge / 4); }

bool in_one_face(int a, int b) {
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      bool all = true;
      for (const int corner : {edge_corner(a), end_corner(a), edge_corner(b), end_corner(b)}) all = all && (corner >> axis & 1) == side;
      if (all) return true;
    }
  return false;
}

Vec3 corner_place(int corner) { return {double(corner & 1), double(corner >> 1 & 1), double(corner >> 2)}; }
Vec3 middle(int edge) { return 0.5 * (corner_place(edge_corner(edge)) + corner_place(end_corner(edge))); }

/// A cloud of points as the steps take it.
struct TestCloud {
  std::vector<float> rows;
  int count = 0, padded = 0;
  std::vector<Extreme> extremes = std::vector<Extreme>(direction_pairs);

  explicit TestCloud(const std::vector<Vec3>& points) : count(static_cast<int>(points.size())), padded((count + 15) / 16 * 16) {
    rows.resize(3 * padded);
    for (int i = 0; i < padded; ++i)
      for (int k = 0; k < 3; ++k) rows[k * padded + i] = static_cast<float>(points[i < count ? i : 0][k]);
    best_kernel().extremes(arrays(), directions(), extremes.data());
  }
  PointArrays arrays() const { return {rows.data(), rows.data() + padded, rows.data() + 2 * padded, padded}; }
  Cloud cloud() const { return {arrays(), count, extremes.data()}; }
  Vec3 point(int i) const { return {rows[i], rows[padded + i], rows[2 * padded + i]}; }
};

/// The field of a swept hull, in double precision.
double field_at(const SweptHull& hull, const Vec3& p) {
  if (hull.is_capsule()) {
    const Capsule& c = hull.capsule();
    const Vec3 from = p - Vec3(c.a[0], c.a[1], c.a[2]), along(c.along[0], c.along[1], c.along[2]);
    return (from - std::clamp(along.dot(from) * c.inverse, 0.0, 1.0) * along).norm() - c.radius;
  }
  const PlaneArrays planes = hull.planes();
  double highest = -INFINITY;
  for (int i = 0; i < hull.plane_count(); ++i)
    highest = std::max(highest, planes.x[i] * p.x() + planes.y[i] * p.y() + planes.z[i] * p.z() - planes.offset[i]);
  return highest;
}

}  // namespace

TEST_CASE("marching cubes: every case separates its corners by a closed set of loops", "[envelope]") {
  for (int inside = 0; inside < 256; ++inside) {
    const CubeCase& found = cube_table()[inside];
    CAPTURE(inside);
    std::map<std::pair<int, int>, int> sides;
    std::map<int, int> used;
    for (int t = 0; t < found.triangles; ++t)
      for (int k = 0; k < 3; ++k) {
        const int a = found.edges[3 * t + k], b = found.edges[3 * t + (k + 1) % 3];
        ++sides[{a, b}];
        ++used[a];
      }
    int crossed = 0;
    for (int edge = 0; edge < 12; ++edge) {
      const bool mixed = (inside >> edge_corner(edge) & 1) != (inside >> end_corner(edge) & 1);
      crossed += mixed;
      CHECK(used.count(edge) == mixed);
    }
    int open = 0;
    for (const auto& [side, times] : sides) {
      CHECK(times == 1);
      const bool both = sides.count({side.second, side.first}) > 0;
      open += !both;
      // A side within a face is the border to the next cell, a side across the cell belongs to two triangles.
      CHECK(in_one_face(side.first, side.second) == !both);
    }
    CHECK(open == crossed);  // each crossed edge starts one border side
    // Outward: the volume between the triangles and the centre of an inside corner's edges has the right sign.
    if (__builtin_popcount(inside) == 1) {
      const Vec3 in = corner_place(__builtin_ctz(inside));
      const Vec3 a = middle(found.edges[0]), b = middle(found.edges[1]), c = middle(found.edges[2]);
      CHECK((b - a).cross(c - a).dot(a - in) > 0);
    }
  }
}

TEST_CASE("the hull of a cloud: its field is never above the distance to any point", "[envelope]") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 200; ++round) {
    const int kind = round % 5, count = 1 + static_cast<int>(random() % 400);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      Vec3 p(0.1 * normal(random), 0.05 * normal(random), 0.02 * normal(random));
      if (kind == 1) p.z() = 0;                             // flat
      if (kind == 2) p = Vec3(p.x(), 0, 0);                 // straight
      if (kind == 3) p = 0.05 * p.normalized();             // a ball's surface: every point a corner
      if (kind == 4) p = Vec3(std::round(20 * p.x()) / 20, std::round(20 * p.y()) / 20, std::round(20 * p.z()) / 20);  // many in one place
      points.push_back(exp_rotation({1, 2, 3}) * p + Vec3(0.3, -0.2, 0.1));
    }
    const TestCloud first(points);
    for (Vec3& p : points) p += Vec3(0.012, 0.004, 0);
    const TestCloud second(points);
    const Cloud clouds[2] = {first.cloud(), second.cloud()};
    CloudHull cloud_hull;
    cloud_hull.build(best_kernel(), clouds, 5e-5);
    SweptHull hull;
    hull.build(cloud_hull, clouds, best_kernel(), 0.01);
    CAPTURE(round, kind, count, hull.is_capsule(), hull.plane_count());
    double highest = -INFINITY;
    for (int i = 0; i < count; ++i) highest = std::max({highest, field_at(hull, first.point(i)), field_at(hull, second.point(i))});
    CHECK(highest <= -0.01 + 2e-7);
    CHECK(highest > -0.01 - 1e-3);  // and it is tight
    // Bounds over a cube hold at points of it.
    const Cube cube{{0.3f, -0.2f, 0.12f}, 0.02f};
    std::vector<float> rows(plane_rows * 1024);
    const FieldBounds bounds = hull.is_capsule() ? hull.capsule_bounds(cube)
                                                 : best_kernel().narrow(hull.planes(), cube, 1e-6f, rows.data(), 1024).bounds;
    for (int i = 0; i < 50; ++i) {
      std::uniform_real_distribution<double> within(-0.02, 0.02);
      const double value = field_at(hull, Vec3(0.3 + within(random), -0.2 + within(random), 0.12 + within(random)));
      CHECK(value >= bounds.low - 1e-6);
      CHECK(value <= bounds.high + 1e-6);
    }
  }
}

TEST_CASE("the hull of points on a sphere is within its tolerance", "[envelope]") {
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) points.push_back(0.1 * Vec3(normal(random), normal(random), normal(random)).normalized());
  const TestCloud cloud(points);
  const Cloud clouds[1] = {cloud.cloud()};
  CloudHull hull;
  hull.build(best_kernel(), clouds, 2e-4);
  REQUIRE(!hull.thin());
  double highest = 0;
  for (int i = 0; i < cloud.count; ++i) highest = std::max(highest, hull.hull().height(cloud.point(i)));
  CHECK(highest <= 2e-4 * 1.5);
  // Closed: every facet's neighbour has it as neighbour across the same side.
  const ConvexHull& facets = hull.hull();
  for (int f = 0; f < facets.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const ConvexHull::Facet& other = facets.facet(facets.facet(f).neighbour[k]);
      int found = 0;
      for (int j = 0; j < 3; ++j)
        found += other.neighbour[j] == f && other.corner[j] == facets.facet(f).corner[(k + 1) % 3] &&
                 other.corner[(j + 1) % 3] == facets.facet(f).corner[k];
      CHECK(found == 1);
    }
}

TEST_CASE("the arc between two frames", "[envelope]") {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (const double angle : {0.0, 1e-9, 1e-5, 1e-2, 1.0, 3.0}) {
    // A screw motion: frame times exp of a constant twist, by many small steps.
    const Vec3 velocity(0.01 * normal(random), 0.01 * normal(random), 0.1), rate = angle * Vec3(normal(random), normal(random), normal(random)).normalized();
    const Frame start{{1, 2, 3}, exp_rotation({0.3, -0.5, 0.9})};
    constexpr int steps = 20000;
    const Frame step{velocity / steps, exp_rotation(rate / steps)};
    Frame middle_step = step;
    middle_step.at = exp_rotation(0.5 * rate / steps) * (velocity / steps);  // second order
    Frame frame = start;
    std::vector<Vec3> along{frame.at};
    for (int i = 0; i < steps; ++i) {
      frame = frame * middle_step;
      along.push_back(frame.at);
    }
    const auto numbers = [](const Frame& f) {
      return std::array<double, 7>{f.at.x(), f.at.y(), f.at.z(), f.rotation.w(), f.rotation.x(), f.rotation.y(), f.rotation.z()};
    };
    const auto a = numbers(start), b = numbers(frame);
    const ElementArc arc(a.data(), b.data());
    CAPTURE(angle);
    double off = 0, bulge = 0;
    for (int i = 0; i <= steps; i += 100) {
      const double share = static_cast<double>(i) / steps;
      off = std::max(off, (arc.at(share) - along[i]).norm());
      const Vec3 chord = (along[steps] - along[0]).normalized();
      bulge = std::max(bulge, chord.cross(along[i] - along[0]).norm());
    }
    CHECK(off < 1e-9);
    CHECK(bulge <= arc.sagitta(1) * (1 + 1e-9) + 1e-12);
    // The opposite quaternion is the same rotation.
    std::array<double, 7> opposite = b;
    for (int k = 3; k < 7; ++k) opposite[k] = -opposite[k];
    CHECK((ElementArc(a.data(), opposite.data()).at(0.3) - arc.at(0.3)).norm() < 1e-12);
  }
}

TEST_CASE("kernels agree in every bit", "[envelope]") {
  std::mt19937 random(10);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (int i = 0; i < 333; ++i) points.push_back(0.1 * Vec3(normal(random), normal(random), normal(random)));
  points.insert(points.end(), points.begin(), points.begin() + 40);  // ties
  const TestCloud cloud(points);
  for (const InstructionSet set : {InstructionSet::common, InstructionSet::avx2, InstructionSet::avx512}) {
    const Kernel* kernel = kernel_for(set);
    if (!kernel) continue;
    CAPTURE(kernel->name);
    std::vector<Extreme> extremes(direction_pairs);
    kernel->extremes(cloud.arrays(), directions(), extremes.data());
    for (int k = 0; k < direction_pairs; ++k) {
      const NormalArrays& d = directions();
      int high = 0, low = 0;
      std::vector<float> dots;
      for (int i = 0; i < cloud.count; ++i) {
        const Vec3 p = cloud.point(i);
        dots.push_back(std::fma(d.z[k], float(p.z()), std::fma(d.y[k], float(p.y()), d.x[k] * float(p.x()))));
        if (dots[i] > dots[high]) high = i;
        if (dots[i] < dots[low]) low = i;
      }
      CHECK(extremes[k].high_index == high);
      CHECK(extremes[k].low_index == low);
      CHECK(extremes[k].high == dots[high]);
      CHECK(extremes[k].low == dots[low]);
    }
  }
}

TEST_CASE("the most usual outcomes", "[envelope]") {
  CHECK(most_usual({3, 1, 2, 1, 5}, 0.6) == std::vector<int>{1, 2, 3});
  CHECK(most_usual({1, 1, 1, 1}, 0.5) == std::vector<int>{0, 1});
  CHECK(most_usual({3, 1, 2}, 1e-9) == std::vector<int>{1});
  CHECK(most_usual(std::vector<float>(1000, 1.0f), 0.95).size() == 950);
  CHECK(most_usual(std::vector<float>(7, 1.0f), 0.5).size() == 4);

  // One outcome of many is moved by far more than the others, at one end alone.
  test::Places places = test::random_places(12, 1, 6, 200, 0.01, 0.01);
  std::mt19937 random(13);
  std::normal_distribution<double> normal;
  for (auto& rod : places.numbers) rod[0] += 0.001 * normal(random);
  places.numbers[77][0] += 0.02;
  const std::vector<float> scores =
      outcome_scores(test::collected(places, EnvelopeOutcomes::Keep::all), {});
  CHECK(std::max_element(scores.begin(), scores.end()) - scores.begin() == 77);
}
