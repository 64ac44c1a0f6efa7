// The mixed form of a rod: against the element that it must agree with, and its derivatives against finite differences.
#include <catch2/catch.hpp>

#include "method/dress_pack/direct_rods.h"
#include "method/dress_pack/pack_follower.h"
#include "unit/method/dress_pack_cases.h"

using namespace tendril;
using namespace tendril::test;
using namespace tendril::dress_pack;

namespace {

Vec3 random_vec(Random& random, double size) { return size * Vec3(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)); }

struct Ends {
  Vec3 ra, rb;
  Quat qa, qb;
  SegmentMotion motion() const { return {ra, qa, rb, qb}; }
  Ends moved(const Vec12& by) const {
    return {ra + by.segment<3>(0), rb + by.segment<3>(6), qa * exp_rotation(by.segment<3>(3)), qb * exp_rotation(by.segment<3>(9))};
  }
};

Ends random_ends(Random& random, double turn) {
  const Quat qa = exp_rotation(random_vec(random, 2));
  const Vec3 ra = random_vec(random, 1);
  return {ra, ra + qa * Vec3(Vec3(0, 0, 0.1) + random_vec(random, 0.01)), qa, qa * exp_rotation(random_vec(random, turn))};
}

Se3Segment<double> random_segment(Random& random, bool varies) {
  Se3Segment<double> s{0.1, 0.01 / 12, {1e-4, 2e-4, 5e-5}, {0.5, 0.4, 0.7}, {0, 0, 1}, {0.3, -0.2, 0.1}};
  s.varies = varies;
  if (varies) s.slope_phi = {random.in(-5, 5), random.in(-5, 5), random.in(-5, 5)};
  return s;
}

PackDemands shape_demands() {
  PackDemands demands;
  demands.force = {20, 10};
  demands.twist = {0.5, 0.5};
  demands.curvature = {2, 1};
  return demands;
}

RodState bent_state(const PackStatics& statics, Random& random) {
  RodState state;
  for (int i = 0; i < statics.network().nodes(); ++i) {
    state.r.push_back(Vec3(0.1 * i, 0, 0) + random_vec(random, 0.01));
    state.q.push_back(Frame::looking({}, {1, 0, 0}, {0, 0, 1}).rotation * exp_rotation(random_vec(random, 0.2)));
  }
  return state;
}

}  // namespace

TEST_CASE("mixed segment: at its largest over wrenches it is the element", "[dress_pack]") {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Se3Segment<double> s = random_segment(random, seed % 2 == 0);
    const Ends ends = random_ends(random, 0.5);
    const MixedSegment mixed(s);
    const SegmentMotion motion = ends.motion();
    const auto lanes = [](const Vec3& v) { return V3<double>{v.x(), v.y(), v.z()}; };
    const auto quat = [&](const Quat& q) { return Q4<double>{q.w(), lanes(q.vec())}; };
    const SegmentGradient<double> g = se3_gradient(s, Se3Ends<double>{quat(ends.qa), quat(ends.qb), lanes(ends.ra), lanes(ends.rb)});
    MixedTerms terms;
    mixed.terms(motion, mixed.wrench(motion), true, terms);
    CHECK(terms.value == Approx(g.energy));
    CHECK(terms.by_wrench.norm() < 1e-12);
    const auto vector = [](const V3<double>& v) { return Vec3(v.x, v.y, v.z); };
    const double size = 1e-9 * (1 + terms.by_ends.norm());
    CHECK((terms.by_ends.segment<3>(0) + vector(g.force)).norm() < size);
    CHECK((terms.by_ends.segment<3>(6) - vector(g.force)).norm() < size);
    CHECK((terms.by_ends.segment<3>(3) - vector(g.theta_a)).norm() < size);
    CHECK((terms.by_ends.segment<3>(9) - vector(g.theta_b)).norm() < size);
  }
}

TEST_CASE("mixed segment: derivatives against finite differences", "[dress_pack]") {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const MixedSegment mixed(random_segment(random, seed % 2 == 0));
    const Ends ends = random_ends(random, seed % 3 == 0 ? 2 : 0.4);
    Vec6 wrench;
    wrench << random_vec(random, 50), random_vec(random, 3);
    MixedTerms at, ahead, behind;
    mixed.terms(ends.motion(), wrench, true, at);
    const double e = 1e-5, size = 1e-7 * (at.ends_ends.norm() + at.by_ends.norm());
    CHECK((at.ends_ends - at.ends_ends.transpose()).norm() < 1e-12 * at.ends_ends.norm());
    for (int j = 0; j < 12; ++j) {
      const Vec12 by = e * Vec12::Unit(j);
      mixed.terms(ends.moved(by).motion(), wrench, false, ahead);
      mixed.terms(ends.moved(-by).motion(), wrench, false, behind);
      CHECK((ahead.value - behind.value) / (2 * e) == Approx(at.by_ends[j]).epsilon(1e-6).margin(1e-6));
      Vec12 rate = (ahead.by_ends - behind.by_ends) / (2 * e);
      // The gradient is one in the section's own axes, which turn.
      const int own = j / 3;
      if (own % 2 == 1) rate.segment<3>(3 * own) -= 0.5 * Vec3(at.by_ends.segment<3>(3 * own)).cross(Vec3::Unit(j % 3));
      CHECK((rate - at.ends_ends.col(j)).norm() < size);
      CHECK(((ahead.by_wrench - behind.by_wrench) / (2 * e) - at.ends_wrench.row(j).transpose()).norm() < 1e-8);
    }
    for (int j = 0; j < 6; ++j) {
      const Vec6 by = 1e-3 * Vec6::Unit(j);
      mixed.terms(ends.motion(), wrench + by, false, ahead);
      mixed.terms(ends.motion(), wrench - by, false, behind);
      CHECK((ahead.value - behind.value) / 2e-3 == Approx(at.by_wrench[j]).epsilon(1e-6).margin(1e-9));
      CHECK(((ahead.by_wrench - behind.by_wrench) / 2e-3 - at.wrench_wrench.col(j)).norm() < 1e-9);
      CHECK(((ahead.by_ends - behind.by_ends) / 2e-3 - at.ends_wrench.col(j)).norm() < 1e-7);
    }
  }
}

TEST_CASE("rotation vectors: how fast they turn the section, from none to nearly a full turn", "[dress_pack]") {
  Random random(5);
  for (const double angle : {0.0, 1e-9, 1e-5, 1e-2, 0.0999, 0.1001, 1.0, 3.2, 5.9}) {
    CAPTURE(angle);
    const Vec3 e = angle * random_vec(random, 1).normalized();
    const Mat3 rate = rotation_rate(e);
    const double h = 1e-6;
    for (int j = 0; j < 3; ++j) {
      const Vec3 by = h * Vec3::Unit(j);
      const Vec3 turn = log_rotation(exp_rotation(e - by).conjugate() * exp_rotation(e + by)) / (2 * h);
      CHECK((rate.col(j) - turn).norm() < 1e-8);
    }
    CHECK((rate * inverse_rotation_rate(e) - Mat3::Identity()).norm() < 1e-12);
  }
}

TEST_CASE("mixed rods: derivatives by the numbers of a step against finite differences", "[dress_pack]") {
  PackProblem pack = six_axis_pack(6);
  pack.rods[0].loads = {{0.53, {3, -2, 5}}};                       // unequal segments: the gravity rule has end terms there
  pack.rods[0].springs = {{0.53, {{0.3, 0.1, 0}, Quat::Identity()}, 40, 2}};
  PackStatics statics(pack);
  MixedRods rods(statics, shape_demands());
  for (unsigned seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const RodState state = bent_state(statics, random);
    Eigen::VectorXd x = rods.numbers_of(state);
    for (int i = 0; i < rods.nodes(); ++i) x.segment<3>(6 * i + 3) = random_vec(random, i % 3 == 0 ? 0 : 0.6);
    for (const auto part : {MixedRods::Part::functional, MixedRods::Part::shape}) {
      StepTerms at, ahead, behind;
      REQUIRE(rods.terms(state, x, part, true, at));
      Eigen::MatrixXd full = Eigen::MatrixXd::Zero(rods.size(), rods.size());
      rods.each_pair(&at, [&](int i, int j, double value) {
        CHECK(full(i, j) == 0);
        full(i, j) = full(j, i) = value;
      });
      for (int j = 0; j < rods.size(); ++j) {
        const double e = 1e-5;
        const Eigen::VectorXd by = e * Eigen::VectorXd::Unit(rods.size(), j);
        REQUIRE(rods.terms(state, x + by, part, false, ahead));
        REQUIRE(rods.terms(state, x - by, part, false, behind));
        CHECK((ahead.value - behind.value) / (2 * e) == Approx(at.gradient[j]).epsilon(1e-5).margin(1e-5 * (1 + std::abs(at.value))));
        CHECK(((ahead.gradient - behind.gradient) / (2 * e) - full.col(j)).norm() < 1e-6 * (1 + full.col(j).norm()));
      }
    }
  }
}

TEST_CASE("mixed rods: at an equilibrium the gradient is that of the pack's statics", "[dress_pack]") {
  for (const PackProblem& pack : {six_axis_pack(10), planar_pack(10)}) {
    PackStatics statics(pack);
    PackFollower follower(statics, {});
    RodState state;
    REQUIRE(follower.start(state, pack.robot->size() == 6 ? degrees({0, 0, 0, 0, 30, 0}) : degrees({10, 60}), {}).ok());
    statics.load_at(state);
    MixedRods rods(statics, shape_demands());
    StepTerms terms;
    REQUIRE(rods.terms(state, rods.numbers_of(state), MixedRods::Part::functional, false, terms));
    for (int i = 0; i < rods.nodes(); ++i) CHECK((terms.gradient.segment<6>(6 * i) - statics.gradient()[i]).norm() < 1e-8);
    CHECK(terms.gradient.tail(6 * rods.segments()).norm() < 1e-12);
    // What PackCost says of the shape, once the forces are taken out.
    PackDemands shape = shape_demands();
    shape.force = {};
    MixedRods bent(statics, shape);
    REQUIRE(bent.terms(state, bent.numbers_of(state), MixedRods::Part::shape, false, terms));
    CHECK(terms.value == Approx(PackCost(statics, shape).value(statics, state)).epsilon(1e-12));
  }
}

TEST_CASE("mixed rods: a rotation vector of a full turn has no value", "[dress_pack]") {
  const PackProblem pack = planar_pack(4);
  PackStatics statics(pack);
  MixedRods rods(statics, {});
  Random random(1);
  const RodState state = bent_state(statics, random);
  Eigen::VectorXd x = rods.numbers_of(state);
  StepTerms terms;
  x[9] = 6.1;
  CHECK(!rods.terms(state, x, MixedRods::Part::functional, false, terms));
  x[9] = NAN;
  CHECK(!rods.terms(state, x, MixedRods::Part::functional, false, terms));
}
