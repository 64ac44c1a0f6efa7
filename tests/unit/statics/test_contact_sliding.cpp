#include <catch2/catch.hpp>

#include <cmath>

#include "statics/contact_network.h"
#include "statics/contact_reach.h"
#include "statics/contact_sliding.h"
#include "test_contact_fields.h"

using namespace tendril;
using namespace tendril::test;

namespace {

/// A straight rod of radius 10 mm along x with vertices 40 mm apart, over the edge of an upright sheet at x = `edge`, whose
/// top is `depth` below the rod's underside (negative: above it).
struct OverEdge {
  std::vector<double> s{0, 0.04, 0.08, 0.12}, radii{0.01, 0.01, 0.01};
  std::vector<Vec3> points;
  std::vector<Quat> rotations;
  TriangleSheet sheet;

  OverEdge(double edge, double depth)
      : sheet(grid_sheet(1, 1, [=](double u, double v) { return Vec3(edge, 2 * u - 1, -0.01 - depth - v); })) {
    for (double at : s) {
      points.push_back({at, 0, 0});
      rotations.push_back(Frame::looking(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ()).rotation);
    }
  }
  VertexShape shape() const { return {points, rotations}; }
  void advance(const std::vector<Vec6>& step, double share) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] += share * step[i].head<3>();
      rotations[i] = rotations[i] * exp_rotation(share * step[i].tail<3>());
    }
  }
};

const ContactLaw law = ContactLaw::for_overlap(20, 0.01, 0.05);

SlidingContacts one_point(const OverEdge& rod, Element element = Element::se3) {
  SlidingContacts sliding(rod.sheet, rod.s, rod.radii, element);
  sliding.add(0.055, 0.01, 0, Vec3::UnitZ());
  return sliding;
}

}  // namespace

TEST_CASE("sliding contact: the point goes to where the rod is nearest to an edge, from both sides and across a vertex") {
  // From 0.0425: across the vertex at 0.04 too.
  for (double edge : {0.0392, 0.0405, 0.0425, 0.0441}) {
    for (Element element : {Element::se3, Element::staggered}) {
      const OverEdge rod(edge, -0.001);
      SlidingContacts sliding(rod.sheet, rod.s, rod.radii, element);
      sliding.add(0.0425, 0.01, 0, Vec3::UnitZ());
      const double energy = sliding.evaluate(rod.shape(), law);
      REQUIRE(sliding.points().size() == 1);
      const SlidingContacts::Point& p = sliding.points()[0];
      CHECK(p.active);
      CHECK(p.at.s == Approx(edge).margin(1e-9));
      CHECK(p.contact.distance == Approx(0.009));
      CHECK(energy == Approx(0.01 * law.at(0.001).energy));
    }
  }
}

TEST_CASE("sliding contact: without overlap there is no force") {
  const OverEdge rod(0.055, 0.001);
  SlidingContacts sliding = one_point(rod);
  CHECK(sliding.evaluate(rod.shape(), law) == 0);
  CHECK(!sliding.points()[0].active);
  CHECK(sliding.deepest() == -std::numeric_limits<double>::infinity());
  sliding.tidy();
  CHECK(sliding.empty());
}

TEST_CASE("sliding contact: gradient and second derivative are those of the energy that slides along") {
  for (Element element : {Element::se3, Element::staggered}) {
    OverEdge rod(0.057, -0.0015);
    // Bent and turned, so that no term vanishes.
    std::vector<Vec6> shaped(4, Vec6::Zero());
    for (int i = 0; i < 4; ++i) shaped[i] << 0.0004 * i, 0.0003 * i * i, 0.0002 * i, 0.02 * i, -0.03, 0.01 * i;
    rod.advance(shaped, 1);
    SlidingContacts sliding = one_point(rod, element);
    sliding.evaluate(rod.shape(), law);
    REQUIRE(sliding.points()[0].active);
    BlockSystem system;
    system.resize(4);
    const auto clear = [&](BlockSystem& all) {
      for (auto& g : all.gradient) g.setZero();
      for (auto& d : all.diagonal) d.setZero();
      for (auto& u : all.upper) u.setZero();
    };
    clear(system);
    sliding.add_to(rod.shape(), true, system);
    for (double h : {1e-5, 1e-6}) {
      for (int vertex : {1, 2})
        for (int entry = 0; entry < 6; ++entry) {
          if (element == Element::staggered && entry > 2) continue;
          std::vector<Vec6> step(4, Vec6::Zero());
          step[vertex][entry] = 1;
          double energy[2];
          BlockSystem beside[2];
          for (int side = 0; side < 2; ++side) {
            OverEdge moved = rod;
            moved.advance(step, side == 0 ? -h : h);
            SlidingContacts there = one_point(moved, element);
            energy[side] = there.evaluate(moved.shape(), law);
            beside[side].resize(4);
            clear(beside[side]);
            there.add_to(moved.shape(), true, beside[side]);
          }
          INFO("vertex " << vertex << ", entry " << entry << ", step " << h);
          const double slope = (energy[1] - energy[0]) / (2 * h);
          CHECK(slope == Approx(system.gradient[vertex][entry]).margin(1e-4 * law.at(0.0015).slope * 0.01));
          // Along positions no rotation of axes enters: the change of the gradient is the matrix's column.
          if (entry > 2) continue;
          for (int other : {1, 2}) {
            const Vec6 change = (beside[1].gradient[other] - beside[0].gradient[other]) / (2 * h);
            const Vec6 column = other == vertex ? Vec6(system.diagonal[vertex].col(entry))
                                : other < vertex ? Vec6(system.upper[1].col(entry))
                                                 : Vec6(system.upper[1].row(entry).transpose());
            CHECK((change - column).norm() < 1e-3 * system.diagonal[1].norm());
          }
        }
    }
  }
}

TEST_CASE("sliding contact: moving a straight rod along itself over an edge costs nothing") {
  const OverEdge rod(0.057, -0.0015);
  SlidingContacts sliding = one_point(rod);
  sliding.evaluate(rod.shape(), law);
  BlockSystem system;
  system.resize(4);
  for (auto& g : system.gradient) g.setZero();
  for (auto& d : system.diagonal) d.setZero();
  for (auto& u : system.upper) u.setZero();
  sliding.add_to(rod.shape(), true, system);
  double stiffness = 0;
  for (int i = 0; i < 4; ++i) stiffness += system.diagonal[i](0, 0);
  for (int i = 0; i < 3; ++i) stiffness += 2 * system.upper[i](0, 0);
  CHECK(std::abs(stiffness) < 1e-9 * system.diagonal[1].norm());
}

TEST_CASE("contact out of reach: a rod too short to come near an obstacle solves without contact") {
  RodProblem problem;
  problem.rod = Rod::uniform(1, Section::round(0.02, 0, Material::from_poisson(5e6, 0.49, 1100)), 20);
  problem.gravity = {0, 0, -9.81};
  Hold from, to;
  from.frame = Frame::looking({-0.4, 0, 0}, Vec3::UnitX());
  to.at = 1;
  to.frame = Frame::looking({0.4, 0, 0}, Vec3::UnitX());
  problem.holds = {from, to};
  // Half the length, 5 percent more and what the weight stretches: 0.53 m below the middle of the two holds.
  struct Case {
    double floor;
    bool touches;
  };
  for (const Case& one : {Case{-0.3, true}, Case{-0.52, true}, Case{-0.6, false}}) {
    const HalfSpace floor(Vec3::UnitZ(), one.floor);
    problem.surroundings = &floor;
    const RodNetwork clamped({{problem}, {}}, {}, {20});
    CHECK(can_touch(clamped) == one.touches);
    CHECK(floor.calls == 1);
  }
  // With one end free it reaches twice as far.
  problem.holds.pop_back();
  problem.holds[0].frame.at = {0, 0, 0};
  for (const Case& one : {Case{-0.99, true}, Case{-1.2, false}}) {
    const HalfSpace floor(Vec3::UnitZ(), one.floor);
    problem.surroundings = &floor;
    CHECK(can_touch(RodNetwork({{problem}, {}}, {}, {20})) == one.touches);
  }
}
