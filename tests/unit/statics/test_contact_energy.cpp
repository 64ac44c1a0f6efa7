#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "statics/contact_set.h"
#include "test_contact_fields.h"

using namespace tendril;
using namespace tendril::test;

namespace {

constexpr double reach = 0.02;

double energy_at(const ContactField& field, const Vec3& x, const ContactLaw& law) {
  std::vector<DistanceTerm> terms;
  field.terms(x, reach, terms);
  return contact_at(terms, reach, 0.5, law).energy;
}

/// Two rectangles that share the edge along y through the origin, opened by `angle` (rad; below pi: a groove seen from
/// above), each cut into several triangles.
TriangleSheet folded_sheet(double angle, int cuts) {
  return grid_sheet(2 * cuts, 3, [&](double u, double v) {
    const double along = 0.2 * std::abs(2 * u - 1);
    const double side = u < 0.5 ? -1 : 1;
    return Vec3(side * along * std::sin(angle / 2), 0.4 * v - 0.2, along * std::cos(angle / 2));
  });
}

}  // namespace

TEST_CASE("contact law: derivatives are those of the energy, smooth across the knee") {
  const ContactLaw law = ContactLaw::for_overlap(3.0, 0.01, 0.1);
  CHECK(law.at(0.001).slope == Approx(3.0));
  CHECK(law.knee == Approx(0.004));
  CHECK(law.at(0).slope == 0);
  CHECK(law.at(-1).energy == 0);
  const double e = 1e-8;
  for (double delta : {1e-4, 1e-3, 0.0039, 0.0041, 0.02, 1.0}) {
    const auto v = law.at(delta);
    CHECK((law.at(delta + e).energy - law.at(delta - e).energy) / (2 * e) == Approx(v.slope).epsilon(1e-6));
    CHECK((law.at(delta + e).slope - law.at(delta - e).slope) / (2 * e) == Approx(v.curvature).epsilon(1e-5));
  }
  const auto below = law.at(law.knee - 1e-12), above = law.at(law.knee + 1e-12);
  CHECK(below.energy == Approx(above.energy).epsilon(1e-8));
  CHECK(below.slope == Approx(above.slope).epsilon(1e-8));
  CHECK(below.curvature == Approx(above.curvature).epsilon(1e-8));
  // Before the knee it is the power law itself.
  CHECK(law.at(0.003).energy == Approx(law.stiffness * std::pow(0.003, 2.5)));
}

TEST_CASE("contact energy: force and Hessian agree with finite differences on folded sheets and balls") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const ContactLaw law = ContactLaw::for_overlap(3.0, 0.015, 0.3);
  const Ball ball({0.3, -0.4, 0.05}, 0.1);
  for (double angle : {0.5, 1.5, 2.5, 3.14159265, 4.0, 5.5}) {
    const TriangleSheet sheet = folded_sheet(angle, 3);
    for (const ContactField* field : {static_cast<const ContactField*>(&sheet), static_cast<const ContactField*>(&ball)}) {
      int found = 0;
      for (int k = 0; k < 4000 && found < 60; ++k) {
        const Vec3 x = field == &ball ? Vec3(Vec3(0.3, -0.4, 0.05) + 0.12 * Vec3(unit(random), unit(random), unit(random)))
                                      : Vec3(0.03 * unit(random), 0.03 * unit(random), 0.03 * unit(random));
        std::vector<DistanceTerm> terms;
        field->terms(x, reach, terms);
        // Second derivatives jump where a primitive enters the range or another part of it becomes the closest, and are
        // large near an edge: differences are taken away from there.
        const PointContact c = contact_at(terms, reach, 0.5, law);
        if (terms.empty() || c.distance < 0.2 * reach || c.distance > 0.95 * reach) continue;
        ++found;
        const double e = 1e-7;
        for (int i = 0; i < 3; ++i) {
          const Vec3 d = e * Vec3::Unit(i);
          const double slope = (energy_at(*field, x + d, law) - energy_at(*field, x - d, law)) / (2 * e);
          INFO("angle " << angle << " at " << x.transpose());
          REQUIRE(std::abs(slope - c.gradient[i]) < 1e-6 * (1 + c.gradient.norm()));
          std::vector<DistanceTerm> plus, minus;
          field->terms(x + d, reach, plus);
          field->terms(x - d, reach, minus);
          const PointContact cp = contact_at(plus, reach, 0.5, law), cm = contact_at(minus, reach, 0.5, law);
          const Mat3 jump = cp.curvature - cm.curvature;
          if (jump.norm() > 1e-3 * (c.material + c.curvature).norm()) continue;
          const Vec3 column = (cp.gradient - cm.gradient) / (2 * e);
          const double size = (c.material.norm() + c.curvature.norm());
          REQUIRE((column - (c.material + c.curvature).col(i)).norm() < 1e-4 * size);
        }
      }
      CHECK(found >= 30);
    }
  }
}

TEST_CASE("contact energy: a flat sheet acts as a plane however it is cut into triangles") {
  const ContactLaw law = ContactLaw::for_overlap(3.0, 0.015, 0.3);
  const HalfSpace plane(Vec3::UnitZ(), 0);
  const TriangleSheet coarse = folded_sheet(3.14159265358979, 1), fine = folded_sheet(3.14159265358979, 12);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-0.1, 0.1);
  for (int k = 0; k < 300; ++k) {
    const Vec3 x(unit(random), unit(random), 0.001 + 0.1 * std::abs(unit(random)));
    const double expected = energy_at(plane, x, law);
    CHECK(energy_at(coarse, x, law) == Approx(expected).epsilon(1e-9));
    CHECK(energy_at(fine, x, law) == Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("contact energy: a groove pushes with both walls, a ridge with one") {
  const ContactLaw law = ContactLaw::for_overlap(3.0, 0.015, 0.3);
  const TriangleSheet groove = folded_sheet(1.5707963, 4), ridge = folded_sheet(2 * 3.14159265 - 1.5707963, 4);
  const double wall = 0.012;  // distance from both walls of the groove
  std::vector<DistanceTerm> terms;
  groove.terms({0.001, 0, wall * std::sqrt(2.0)}, reach, terms);
  const PointContact in_groove = contact_at(terms, reach, 1, law);
  terms.clear();
  ridge.terms({0, 0.003, 0.01}, reach, terms);
  const PointContact on_ridge = contact_at(terms, reach, 1, law);
  CHECK(on_ridge.gradient.z() == Approx(-law.at(0.01).slope));
  CHECK(std::abs(on_ridge.gradient.x()) < 1e-9);
  // Two walls at 45 degrees; the edge of the groove (distance 0.017) is counted once less.
  const double left = law.at(reach - (wall + 0.001 / std::sqrt(2.0))).slope;
  const double right = law.at(reach - (wall - 0.001 / std::sqrt(2.0))).slope;
  const double edge_distance = std::hypot(0.001, wall * std::sqrt(2.0));
  const double edge = law.at(reach - edge_distance).slope;
  CHECK(in_groove.gradient.z() == Approx(-(left + right) / std::sqrt(2.0) + edge * wall * std::sqrt(2.0) / edge_distance));
  CHECK(in_groove.gradient.x() == Approx(-(left - right) / std::sqrt(2.0) + edge * 0.001 / edge_distance));
}

TEST_CASE("contact energy: value and slope stay continuous along a path over ridges, grooves and ends") {
  const ContactLaw law = ContactLaw::for_overlap(3.0, 0.015, 0.3);
  const double steepest = law.at(reach).slope, stiffest = law.at(reach).curvature;
  for (double angle : {1.0, 2.5, 4.5}) {
    const TriangleSheet sheet = folded_sheet(angle, 4);
    const double e = 1e-6;
    Vec3 last_gradient = Vec3::Zero();
    double last_energy = 0;
    bool first = true;
    for (int k = 0; k < 20000; ++k) {
      const double t = -0.02 + k * 2 * e;
      const Vec3 x(t, 0.1 * t, 0.012 + 0.3 * t);
      std::vector<DistanceTerm> terms;
      sheet.terms(x, reach, terms);
      const PointContact c = contact_at(terms, reach, 1, law);
      if (!first && c.distance > 0.002 && !terms.empty()) {
        REQUIRE(std::abs(c.energy - last_energy) < 12 * e * steepest);
        REQUIRE((c.gradient - last_gradient).norm() < 40 * e * (stiffest + steepest / 0.002));
      }
      first = false;
      last_energy = c.energy;
      last_gradient = c.gradient;
    }
  }
}

TEST_CASE("contact set: the sum of all points agrees with finite differences in the rod's unknowns") {
  std::mt19937 random(21);
  std::normal_distribution<double> normal;
  const Ball ball({0.15, 0, -0.1}, 0.1);
  const std::vector<double> s{0, 0.1, 0.2, 0.3}, radii{0.02, 0.02, 0.02};
  const std::vector<Vec3> points{{0, 0, 0.02}, {0.1, 0, 0.012}, {0.2, 0.005, 0.014}, {0.3, 0, 0.02}};
  std::vector<Quat> rotations;
  for (int i = 0; i < 4; ++i)
    rotations.push_back(Frame::looking(Vec3::Zero(), Vec3(1, 0.1 * normal(random), 0.1 * normal(random))).rotation);
  ContactSet set(ball, contact_points(s, radii, Element::se3), 1);
  set.law = ContactLaw::for_overlap(5, 0.02, 0.1);
  const VertexShape shape{points, rotations};
  std::vector<Vec6> step(4, Vec6::Zero());
  std::vector<Vec3> x;
  const auto energy_of = [&] {
    moved_positions(set.points(), shape, step, 1, x);
    return set.evaluate(x);
  };
  const auto cleared = [] {
    BlockSystem system;
    system.resize(4);
    for (auto& b : system.gradient) b.setZero();
    for (auto& b : system.diagonal) b.setZero();
    for (auto& b : system.upper) b.setZero();
    return system;
  };
  REQUIRE(energy_of() > 0);
  BlockSystem full = cleared();
  set.add_to(shape, ContactSet::Geometry::full, full);
  const double scale = full.diagonal[1].norm();
  const double e = 1e-5;
  for (int i = 0; i < 24; ++i) {
    step[i / 6][i % 6] = e;
    const double plus = energy_of();
    step[i / 6][i % 6] = -e;
    const double minus = energy_of();
    step[i / 6][i % 6] = 0;
    CHECK((plus - minus) / (2 * e) == Approx(full.gradient[i / 6][i % 6]).margin(1e-6));
    for (int j = 0; j < 24; ++j) {
      double second = 0;
      for (int a : {1, -1})
        for (int b : {1, -1}) {
          step[i / 6][i % 6] += a * e;
          step[j / 6][j % 6] += b * e;
          second += a * b * energy_of() / (4 * e * e);
          for (Vec6& v : step) v.setZero();
        }
      double expected = 0;
      if (i / 6 == j / 6) expected = full.diagonal[i / 6](i % 6, j % 6);
      if (j / 6 == i / 6 + 1) expected = full.upper[i / 6](i % 6, j % 6);
      if (i / 6 == j / 6 + 1) expected = full.upper[j / 6](j % 6, i % 6);
      CHECK(std::abs(second - expected) < 2e-4 * scale);
    }
  }
  // Without a prediction only the material part is there; a prediction that comes true gives the full Hessian.
  energy_of();
  BlockSystem material = cleared();
  set.add_to(shape, ContactSet::Geometry::predicted, material);
  CHECK((material.gradient[1] - full.gradient[1]).norm() == 0);
  CHECK((material.diagonal[1] - full.diagonal[1]).norm() > 1e-4 * scale);
  set.predict(shape, std::vector<Vec6>(4, Vec6::Zero()), 1);
  BlockSystem predicted = cleared();
  set.add_to(shape, ContactSet::Geometry::predicted, predicted);
  for (int i = 0; i < 4; ++i) CHECK((predicted.diagonal[i] - full.diagonal[i]).norm() < 1e-12 * scale);
}

TEST_CASE("contact set: skipped queries change no answer") {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const TriangleSheet sheet = folded_sheet(2.0, 4);
  std::vector<double> s(21), radii(20, 0.01);
  for (int i = 0; i < 21; ++i) s[i] = 0.02 * i;
  const auto points = contact_points(s, radii, Element::staggered);
  ContactSet lasting(sheet, points, 0.1);
  lasting.law = ContactLaw::for_overlap(5, 0.01, 0.1);
  std::vector<Vec3> x(points.size());
  long fresh_queries = 0;
  for (int round = 0; round < 200; ++round) {
    const double height = 0.03 + 0.03 * std::sin(0.2 * round), slope = 0.2 * std::sin(0.11 * round);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = Vec3(points[i].s - 0.2, 0.03 * std::sin(0.3 * round), height + slope * (points[i].s - 0.2));
    if (round % 7 == 0) {
      std::vector<double> shifts(x.size());
      for (double& shift : shifts) shift = std::abs(0.002 * normal(random));
      lasting.set_shifts(shifts);
    }
    ContactSet fresh(sheet, points, 0.1);
    fresh.law = lasting.law;
    fresh.set_shifts(lasting.shifts());
    REQUIRE(lasting.evaluate(x) == Approx(fresh.evaluate(x)).epsilon(1e-12).margin(1e-300));
    fresh_queries += fresh.queries();
    for (int i = 0; i < lasting.size(); ++i) {
      REQUIRE((lasting.at(i) == nullptr) == (fresh.at(i) == nullptr));
      // What is known is never more than the truth.
      REQUIRE(lasting.distance_bound(i, x[i]) <= sheet.closest(x[i], 1).distance + 1e-12);
    }
  }
  CHECK(lasting.queries() < fresh_queries);
}

TEST_CASE("contact set: a rod far from everything asks a few times and then never again") {
  const HalfSpace floor(Vec3::UnitZ(), 0);
  std::vector<double> s(41), radii(40, 0.005);
  for (int i = 0; i < 41; ++i) s[i] = 0.025 * i;
  const auto points = contact_points(s, radii, Element::staggered);
  ContactSet set(floor, points, 2.0);
  std::vector<Vec3> x(points.size());
  for (int round = 0; round < 50; ++round) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = Vec3(points[i].s, 0, 1 + 0.002 * round);
    CHECK(set.evaluate(x) == 0);
  }
  CHECK(floor.calls <= 30);  // of 50 rounds with 201 points
}

TEST_CASE("contact set: positions that are not finite cost an infinite energy and no query") {
  const HalfSpace floor(Vec3::UnitZ(), 0);
  ContactSet set(floor, contact_points(std::vector<double>{0, 0.1}, std::vector<double>{0.1}, Element::staggered), 1);
  CHECK(set.evaluate({Vec3(NAN, 0, 0), Vec3::Zero()}) == std::numeric_limits<double>::infinity());
  CHECK(floor.calls == 0);
}

TEST_CASE("contact set: the shift keeps the force and takes over the penetration") {
  const HalfSpace floor(Vec3::UnitZ(), 0);
  ContactSet set(floor, contact_points(std::vector<double>{0, 0.1}, std::vector<double>{0.1}, Element::staggered), 1);
  set.law = ContactLaw::for_overlap(5, 0.1, 0.1);
  set.evaluate({Vec3(0, 0, 0.09), Vec3(0.1, 0, 0.2)});
  CHECK(set.deepest() == Approx(0.01));
  const Vec3 before = set.at(0)->gradient;
  set.update_shifts({0, 0});
  CHECK(set.shifts()[0] == Approx(0.01));
  CHECK(set.shifts()[1] == 0);
  set.evaluate({Vec3(0, 0, 0.1), Vec3(0.1, 0, 0.2)});
  CHECK((set.at(0)->gradient - before).norm() < 1e-12 * before.norm());
  CHECK(set.deepest() == Approx(0).margin(1e-15));
  // Where the rod overlaps deeper beside the point, it rests that much farther off under the same force.
  set.update_shifts({0.002, 0});
  CHECK(set.shifts()[0] == Approx(0.012));
  CHECK(set.shifts()[1] == 0);
  set.evaluate({Vec3(0, 0, 0.102), Vec3(0.1, 0, 0.2)});
  CHECK((set.at(0)->gradient - before).norm() < 1e-12 * before.norm());
  // A point that lifts off loses its shift again.
  set.evaluate({Vec3(0, 0, 0.2), Vec3(0.1, 0, 0.2)});
  set.update_shifts({0, 0});
  CHECK(set.shifts()[0] == 0);
  CHECK(!set.any());
  // A point out of reach beside which the rod overlaps begins to carry a force.
  set.update_shifts({0, 0.103});
  set.evaluate({Vec3(0, 0, 0.2), Vec3(0.1, 0, 0.2)});
  REQUIRE(set.at(1));
  CHECK(set.at(1)->gradient.norm() == Approx(0.05 * set.law.at(0.003).slope));
}

TEST_CASE("contact energy: exactly above the side between two faces of one plane there is no ridge") {
  const ContactLaw law = ContactLaw::for_overlap(3.0, 0.015, 0.3);
  const TriangleSheet sheet = folded_sheet(3.14159265358979323846, 2);
  for (const Vec3& x : {Vec3(0.1, 0.02, 0.012), Vec3(0, 0.02, 0.012), Vec3(0, 0.4 / 3 - 0.2, 0.012), Vec3(0.05, -0.1, 0.012)}) {
    std::vector<DistanceTerm> terms;
    sheet.terms(x, reach, terms);
    const PointContact c = contact_at(terms, reach, 1, law);
    const Mat3 hessian = c.material + c.curvature;
    CHECK(hessian(0, 0) > -1e-9 * hessian(2, 2));
    CHECK(hessian(1, 1) > -1e-9 * hessian(2, 2));
    CHECK(c.gradient.z() == Approx(-law.at(reach - 0.012).slope));
  }
}
