// The bounds of the distance field against exact distances, its transform against brute force, and the store of fields.
#include <catch2/catch.hpp>

#include <atomic>
#include <limits>

#include "base/error.h"
#include "geometry/field_store.h"
#include "geometry/surface_voxels.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::box_mesh;
using tendril::test::Random;
using tendril::test::triangle_soup;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::shared_ptr<const TriangleSurface> share(Mesh mesh) { return std::make_shared<const TriangleSurface>(std::move(mesh)); }

Eigen::AlignedBox3d cube(double half) { return {Vec3::Constant(-half), Vec3::Constant(half)}; }

double exact(const Surroundings& field, const Vec3& p) { return field.closest_kept(p, infinity, infinity).distance; }

/// Points in and around the box, some of them at nodes. Where no mesh sticks out of the box the bounds are narrow too.
void check_bounds(const Surroundings& surroundings, const DistanceField& field, Random& random, int count = 3000) {
  bool within = true;
  for (int i = 0; i < surroundings.size(); ++i)
    within = within && (std::holds_alternative<Solid>(surroundings.obstacle(i).shape) || field.box().contains(surroundings.box_of(i)));
  double widest = 0;
  for (int i = 0; i < count; ++i) {
    Vec3 p = random.point(1.05);
    if (i % 3 == 0)
      p = field.box().min() + field.spacing() * ((p - field.box().min()) / field.spacing()).array().round().matrix();
    const DistanceField::Bounds bounds = field.at(p);
    const double distance = exact(surroundings, p);
    CAPTURE(i, p.transpose(), distance);
    REQUIRE(bounds.low <= distance);
    REQUIRE(distance <= bounds.high);
    if (field.box().contains(p) && std::isfinite(bounds.low) && std::isfinite(bounds.high))
      widest = std::max(widest, bounds.high - bounds.low);
  }
  // Both ways half a voxel's diagonal to the marks and another to the node.
  if (within) CHECK(widest <= 2 * 2 * 0.8662 * field.spacing() + 1e-5);
}

Obstacle mesh_obstacle(Mesh mesh, const Frame& pose, double clearance = 0) { return {share(std::move(mesh)), pose, clearance}; }

Solid random_solid(Random& random) {
  switch (random.below(4)) {
    case 0: return Box{{random.in(0.1, 0.8), random.in(0.1, 0.8), random.in(0.1, 0.8)}};
    case 1: return Sphere{random.in(0.05, 0.5)};
    case 2: return Cylinder{random.in(0.05, 0.3), random.in(0.1, 0.8)};
    default: return HalfSpace{};
  }
}

}  // namespace

TEST_CASE("squared distances to marked nodes are those of brute force", "[distance_field]") {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Eigen::Array3i size(1 + random.below(37), 1 + random.below(20), 1 + random.below(20));
    std::vector<std::uint8_t> marks(size.prod(), 0);
    for (int i = random.below(30); i > 0; --i) marks[random.below(size.prod())] = 1;
    std::vector<Eigen::Array3i> at;
    for (int n = 0; n < size.prod(); ++n)
      if (marks[n]) at.push_back({n % size.x(), n / size.x() % size.y(), n / (size.x() * size.y())});
    RunContext one;
    one.threads = 1;
    const std::vector<float> squared = squared_distances(marks, size);
    CHECK(squared == squared_distances(marks, size, one));
    for (int n = 0; n < size.prod(); ++n) {
      const Eigen::Array3i node(n % size.x(), n / size.x() % size.y(), n / (size.x() * size.y()));
      float least = std::numeric_limits<float>::infinity();
      for (const Eigen::Array3i& mark : at) least = std::min(least, static_cast<float>((node - mark).square().sum()));
      REQUIRE(squared[n] == least);
    }
  }
}

TEST_CASE("exactly the nodes within reach of a surface are marked", "[distance_field]") {
  for (unsigned seed = 21; seed <= 26; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Mesh mesh = triangle_soup(60, seed % 2 ? 0.05 : 1.5, random);
    const Frame pose{random.point(0.2), random.rotation()};
    const Mesh placed = mesh.moved(pose.at, pose.rotation);
    NodeLattice lattice{Vec3::Constant(-0.9), 0.1, {19, 18, 17}};
    std::vector<std::uint8_t> marks(lattice.count(), 0);
    mark_surface(mesh, pose.rotation.toRotationMatrix(), pose.at, lattice, marks);
    const DistanceTree tree(placed);
    int marked = 0;
    for (int k = 0; k < lattice.size.z(); ++k)
      for (int j = 0; j < lattice.size.y(); ++j)
        for (int i = 0; i < lattice.size.x(); ++i) {
          const double distance = tree.closest(lattice.node(i, j, k)).distance, reach = voxel_reach * lattice.spacing;
          const bool mark = marks[lattice.index(i, j, k)] != 0;
          marked += mark;
          if (std::abs(distance - reach) > 1e-12) REQUIRE(mark == (distance < reach));
        }
    CHECK(marked > 50);
  }
}

TEST_CASE("bounds hold for meshes in any pose, also where they stick out of the box", "[distance_field]") {
  for (unsigned seed = 31; seed <= 36; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Surroundings surroundings;
    for (int i = 0; i < 3; ++i)
      surroundings.add(mesh_obstacle(triangle_soup(20, seed % 2 ? 0.4 : 0.05, random).moved(Vec3::Zero(), Quat::Identity(), seed < 35 ? 0.5 : 0.15),
                                     {random.point(seed < 35 ? 0.9 : 0.05), random.rotation()}, seed % 3 == 0 ? random.in(0, 0.2) : 0));
    check_bounds(surroundings, DistanceField(surroundings, cube(1), 0.07), random);
    check_bounds(surroundings, DistanceField(surroundings, cube(0.4), 0.05), random);
  }
}

TEST_CASE("bounds hold for solids and half-spaces, inside them as well, and for mixtures", "[distance_field]") {
  for (unsigned seed = 41; seed <= 48; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Surroundings surroundings;
    for (int i = 0; i < 5; ++i)
      surroundings.add({random_solid(random), {random.point(1), random.rotation()}, random.below(2) ? random.in(0, 0.3) : 0});
    check_bounds(surroundings, DistanceField(surroundings, cube(1), 0.06), random);
    surroundings.add(mesh_obstacle(box_mesh({0.3, 0.2, 0.1}, 3), {random.point(0.8), random.rotation()}, 0.11));
    check_bounds(surroundings, DistanceField(surroundings, cube(1), 0.06), random);
  }
}

TEST_CASE("solids alone are exact at the nodes", "[distance_field]") {
  Random random(51);
  Surroundings surroundings;
  for (int i = 0; i < 20; ++i) surroundings.add({Solid(Box{{0.2, 0.3, 0.1}}), {random.point(1), random.rotation()}, 0.01 * i});
  const DistanceField field(surroundings, cube(1), 0.05);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 steps(random.below(40), random.below(40), random.below(40)), p = field.box().min() + field.spacing() * steps;
    const DistanceField::Bounds bounds = field.at(p);
    REQUIRE(bounds.high - bounds.low < 1e-5);
    REQUIRE(0.5 * (bounds.low + bounds.high) == Approx(exact(surroundings, p)).margin(1e-6));
  }
}

TEST_CASE("a field of nothing knows that nothing is near", "[distance_field]") {
  const DistanceField field(Surroundings{}, cube(1), 0.1);
  CHECK(field.ok());
  CHECK(field.at({0.2, 0, 0}).low == infinity);
  CHECK(field.at({20, 0, 0}).low == -infinity);
  CHECK(field.at({20, 0, 0}).high == infinity);
  CHECK(field.at({std::nan(""), 0, 0}).low == -infinity);
}

TEST_CASE("the field does not depend on the number of threads", "[distance_field]") {
  Random random(61);
  Surroundings surroundings;
  surroundings.add(mesh_obstacle(triangle_soup(9000, 0.1, random), {}, 0.02));
  surroundings.add({Solid(Sphere{0.3}), {}, 0.01});
  RunContext one, five;
  one.threads = 1;
  five.threads = 5;
  const DistanceField a(surroundings, cube(1), 0.03, one), b(surroundings, cube(1), 0.03, five);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = random.point(1);
    REQUIRE(a.at(p).low == b.at(p).low);
    REQUIRE(a.at(p).high == b.at(p).high);
  }
}

TEST_CASE("an extended field is that of all obstacles", "[distance_field]") {
  Random random(71);
  Surroundings some, all;
  const auto add = [&](const Obstacle& obstacle, bool to_both) {
    if (to_both) some.add(obstacle);
    all.add(obstacle);
  };
  add(mesh_obstacle(box_mesh({0.3, 0.2, 0.1}), {{0.3, 0, 0}, random.rotation()}, 0.05), true);
  add({Solid(Sphere{0.2}), {{-0.5, 0, 0}, Quat::Identity()}, 0}, true);
  add(mesh_obstacle(box_mesh({0.1, 0.1, 0.1}), {{0, 0.5, 0}, random.rotation()}, 0), false);
  add({Solid(HalfSpace{}), {{0, 0, -0.7}, Quat::Identity()}, 0.1}, false);
  const DistanceField whole(all, cube(1), 0.04), extended(DistanceField(some, cube(1), 0.04), all);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = random.point(1);
    REQUIRE(whole.at(p).low == extended.at(p).low);
    REQUIRE(whole.at(p).high == extended.at(p).high);
  }
  CHECK_THROWS_WITH(DistanceField(extended, some),
                    "distance field: extended from 4 obstacles to 2; those that are known and more expected");
}

TEST_CASE("fields that cannot be are refused, and a stopped one says so", "[distance_field]") {
  const Surroundings none;
  CHECK_THROWS_WITH(DistanceField(none, cube(1), 0), "distance field: the spacing is 0 m; a positive number expected");
  CHECK_THROWS_WITH(DistanceField(none, cube(1), -1), "distance field: the spacing is -1 m; a positive number expected");
  CHECK_THROWS_WITH(DistanceField(none, cube(1), std::nan("")), "distance field: the spacing is nan m; a positive number expected");
  CHECK_THROWS_WITH(DistanceField(none, Eigen::AlignedBox3d(), 1), "distance field: the box is empty or infinite; finite corners expected");
  CHECK_THROWS_WITH(DistanceField(none, cube(infinity), 1), "distance field: the box is empty or infinite; finite corners expected");
  CHECK_THROWS_WITH(DistanceField(none, cube(1), 1e-3), Catch::Contains("nodes at a spacing of 0.001 m, at most 1.34218e+08; "
                                                                        "use a larger spacing or a smaller box"));
  Surroundings one;
  one.add({Solid(Sphere{0.3}), {}, 0});
  const std::atomic<bool> cancelled = true;
  RunContext context;
  context.cancel = &cancelled;
  CHECK_FALSE(DistanceField(one, cube(1), 0.1, context).ok());
  FieldStore store;
  CHECK_FALSE(store.field(one, cube(1), cube(1), 0.1, context)->ok());
  CHECK(store.field(one, cube(1), cube(1), 0.1)->ok());
}

TEST_CASE("the store gives the same field again, extends it, and makes a new one only where it must", "[distance_field]") {
  Random random(81);
  const auto bay = share(box_mesh({0.4, 0.3, 0.2}, 2));
  Surroundings first;
  first.add({bay, {}, 0});
  first.add({Solid(Box{{0.1, 0.2, 0.3}}), {{0.5, 0, 0}, Quat::Identity()}, 0.01});
  FieldStore store;
  const auto field = store.field(first, cube(1), cube(1), 0.05);
  CHECK(store.field(first, cube(1), cube(1), 0.05) == field);
  CHECK(store.field(first, cube(0.5), cube(0.5), 0.2) == field);
  Surroundings named;
  named.add({bay, {}, 0, "bay"});
  named.add({Solid(Box{{0.1, 0.2, 0.3}}), {{0.5, 0, 0}, Quat::Identity()}, 0.01, "box"});
  CHECK(store.field(named, cube(1), cube(1), 0.05) == field);

  Surroundings more = first;
  more.add({Solid(Sphere{0.1}), {{-0.6, 0, 0}, Quat::Identity()}, 0});
  const auto extended = store.field(more, cube(0.8), cube(0.8), 0.05);
  CHECK(extended != field);
  CHECK(extended->box().min() == field->box().min());  // that of the field it came from
  CHECK(store.field(more, cube(1), cube(1), 0.05) == extended);
  CHECK(store.field(first, cube(1), cube(1), 0.05) == field);
  check_bounds(more, *extended, random, 1000);

  CHECK(store.field(first, cube(0.3), cube(9), 0.05) == field);
  FieldStore other_store;
  CHECK(other_store.field(first, cube(0.3), cube(1), 0.05)->box().contains(cube(1)));

  CHECK(store.field(first, cube(1), cube(1), 0.04) != field);   // finer
  CHECK(store.field(first, cube(1.5), cube(1.5), 0.05) != field);  // larger
  const auto changed = [&](Obstacle obstacle) {
    Surroundings other;
    other.add({bay, {}, 0});
    other.add(std::move(obstacle));
    FieldStore fresh;
    const auto before = fresh.field(first, cube(1), cube(1), 0.05), after = fresh.field(other, cube(1), cube(1), 0.05);
    check_bounds(other, *after, random, 300);
    return before != after;
  };
  CHECK_FALSE(changed({Solid(Box{{0.1, 0.2, 0.3}}), {{0.5, 0, 0}, Quat::Identity()}, 0.01}));
  CHECK(changed({Solid(Box{{0.1, 0.2, 0.31}}), {{0.5, 0, 0}, Quat::Identity()}, 0.01}));
  CHECK(changed({Solid(Box{{0.1, 0.2, 0.3}}), {{0.5, 0.01, 0}, Quat::Identity()}, 0.01}));
  CHECK(changed({Solid(Box{{0.1, 0.2, 0.3}}), {{0.5, 0, 0}, random.rotation()}, 0.01}));
  CHECK(changed({Solid(Box{{0.1, 0.2, 0.3}}), {{0.5, 0, 0}, Quat::Identity()}, 0.02}));
  CHECK(changed({Solid(Sphere{0.1}), {{0.5, 0, 0}, Quat::Identity()}, 0.01}));
  CHECK(changed({share(box_mesh({0.4, 0.3, 0.2}, 2)), {{0.5, 0, 0}, Quat::Identity()}, 0.01}));

  Surroundings fewer;
  fewer.add({bay, {}, 0});
  FieldStore fresh;
  const auto both = fresh.field(first, cube(1), cube(1), 0.05);
  CHECK(fresh.field(fewer, cube(1), cube(1), 0.05) != both);
  CHECK(fresh.field(fewer, cube(1), cube(1), 0.05)->at({0.5, 0, 0}).low > 0);
}

TEST_CASE("within() answers as closest() does", "[distance_tree][distance_field]") {
  for (unsigned seed = 91; seed <= 96; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Mesh mesh = triangle_soup(400, seed % 2 ? 0.3 : 0.02, random).moved(Vec3::Constant(seed % 3 ? 0 : 300), Quat::Identity());
    const DistanceTree tree(mesh);
    const Vec3 middle = mesh.box().center();
    int yes = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = middle + random.point(1.4);
      const double distance = tree.closest(p).distance;
      for (const double range : {random.in(0, 0.5), distance * (1 - 1e-12), distance, distance * (1 + 1e-12), distance + 1e-7, distance - 1e-7}) {
        const bool expected = tree.closest(p, range).triangle >= 0;
        yes += expected;
        REQUIRE(tree.within(p, range) == expected);
      }
    }
    CHECK(yes > 2000);
    CHECK(tree.within(middle, infinity));
    CHECK_FALSE(tree.within(middle, 0));
    CHECK_FALSE(tree.within(middle, -1));
    CHECK_FALSE(tree.within(middle, std::nan("")));
    CHECK_FALSE(tree.within({std::nan(""), 0, 0}, 1));
  }
}

TEST_CASE("within_kept() answers as closest_kept() does", "[surroundings][distance_field]") {
  for (unsigned seed = 101; seed <= 104; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Surroundings field;
    for (int i = 0; i < 4; ++i) {
      field.add({random_solid(random), {random.point(1), random.rotation()}, random.in(0, 0.2)});
      field.add(mesh_obstacle(triangle_soup(30, 0.2, random).moved(Vec3::Zero(), Quat::Identity(), 0.3), {random.point(1), random.rotation()},
                              random.in(0, 0.2)));
    }
    int yes = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = random.point(1.5);
      const double limit = random.in(-0.3, 0.4), most = random.below(2) ? infinity : 0.1;
      const bool expected = field.closest_kept(p, limit, most).obstacle >= 0;
      yes += expected;
      REQUIRE(field.within_kept(p, limit, most) == expected);
    }
    CHECK(yes > 300);
    CHECK(yes < 2950);
    CHECK_FALSE(field.within_kept({std::nan(""), 0, 0}, 1, 0));
  }
}

TEST_CASE("between nodes the field is off by no more than it says", "[distance_field]") {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Surroundings surroundings;
    surroundings.add(mesh_obstacle(triangle_soup(60, 0.3, random).moved(Vec3::Zero(), Quat::Identity(), 0.5), {random.point(0.2), random.rotation()}));
    if (seed % 2) surroundings.add({Solid(Sphere{0.2}), {random.point(0.6), Quat::Identity()}, 0.05});
    const DistanceField field(surroundings, cube(1.2), 0.05);
    double farthest = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = random.point(1.2);
      const double value = field.interpolated(p);
      REQUIRE(std::isfinite(value));
      farthest = std::max(farthest, std::abs(value - exact(surroundings, p)));
      // Linear along an axis within a voxel: the mean of two places is the value between them.
      const Vec3 node = field.box().min() + field.spacing() * ((p - field.box().min()) / field.spacing()).array().floor().matrix();
      const Vec3 a = node + 0.2 * field.spacing() * Vec3(1, 2, 3), b = a + 0.4 * field.spacing() * Vec3::UnitX();
      REQUIRE(field.interpolated(0.5 * (a + b)) == Approx(0.5 * (field.interpolated(a) + field.interpolated(b))).margin(1e-9));
    }
    CHECK(farthest <= (0.8661 + 0.8661) * field.spacing() + 1e-5);
    CHECK(farthest > 0.2 * field.spacing());
    CHECK(std::isnan(field.interpolated(field.box().max() + Vec3(1e-9, 0, 0))));
    CHECK(std::isfinite(field.interpolated(field.box().max())));
    CHECK(std::isfinite(field.interpolated(field.box().min())));
    CHECK(std::isnan(field.interpolated(Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0))));
  }
  const DistanceField empty(Surroundings(), cube(1), 0.1);
  CHECK(empty.interpolated(Vec3::Zero()) == infinity);
}
