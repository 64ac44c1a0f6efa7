// Rods whose shape without load has a curvature and twist that vary along them.
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "statics/solve.h"

using namespace tendril;

namespace {

/// The curve with curvature and twist first + s slope in its own axes, d3 the tangent, by fine steps of the fourth order.
class VaryingShape {
 public:
  VaryingShape(double length, const Vec3& first, const Vec3& slope) : length_(length), first_(first), slope_(slope) {
    frames_.push_back({});
    for (int i = 0; i < steps; ++i) frames_.push_back(onward(frames_.back(), i * step(), step()));
  }
  Frame operator()(double s) const {
    const int i = std::min(static_cast<int>(s / step()), steps - 1);
    return onward(frames_[i], i * step(), s - i * step());
  }

 private:
  static constexpr int steps = 2000;
  double step() const { return length_ / steps; }
  Vec3 curvature(double s) const { return first_ + s * slope_; }

  Frame onward(const Frame& from, double s, double h) const {
    // Gauss points; the commutator of their rates makes the turn exact to the fourth order.
    const double gauss = h * std::sqrt(3.0) / 6;
    const Vec3 a = curvature(s + 0.5 * h - gauss), b = curvature(s + 0.5 * h + gauss);
    auto turned = [&](double part) {
      const Vec3 c = curvature(s + 0.5 * part), d = slope_;
      return Quat(from.rotation * exp_rotation(part * c - part * part * part / 12 * d.cross(c)));
    };
    const Vec3 way = 0.5 * h * (turned(0.5 * h - gauss) * Vec3::UnitZ() + turned(0.5 * h + gauss) * Vec3::UnitZ());
    return {from.at + way, (from.rotation * exp_rotation(0.5 * h * (a + b) - std::sqrt(3.0) / 12 * h * h * b.cross(a))).normalized()};
  }

  double length_;
  Vec3 first_, slope_;
  std::vector<Frame> frames_;
};

RodProblem loaded(int segments, bool clamped) {
  Section section = Section::round(0.02, 0, Material::from_poisson(5e6, 0.4, 1100));
  section.EI2 *= 2;
  RodProblem problem;
  problem.rod = Rod::uniform(1, section, segments);
  const VaryingShape shape(1, {2, -1, 3}, {3, 4, -5});
  problem.rod.shape = shape;
  problem.holds.push_back({0, shape(0)});
  problem.gravity = {0, 0, -9.81};
  if (clamped) {
    problem.holds.push_back({1, shape(1).moved({0.05, -0.08, 0.04}, {1, 0, 0}, 0.4)});
  } else {
    problem.loads.push_back({1, 0.6 * section.EI1 * Vec3(1, 2, -1), Vec3::Zero()});
  }
  return problem;
}

double largest_distance(const Equilibrium& coarse, const Equilibrium& fine) {
  double largest = 0;
  const std::size_t ratio = (fine.points.size() - 1) / (coarse.points.size() - 1);
  for (std::size_t i = 0; i < coarse.points.size(); ++i)
    largest = std::max(largest, (coarse.points[i] - fine.points[ratio * i]).norm());
  return largest;
}

}  // namespace

TEST_CASE("a rod preformed with varying curvature and twist: orders 4 and 2 under load") {
  for (const bool clamped : {false, true})
    for (const Element element : {Element::se3, Element::staggered}) {
      SolveOptions options;
      options.element = element;
      options.tolerance = 1e-12;
      SolveOptions best = options;
      best.element = Element::se3;
      const Equilibrium exact = solve(loaded(640, clamped), best);
      REQUIRE(exact.ok());
      std::vector<double> errors;
      for (const int segments : {20, 40, 80}) {
        const Equilibrium e = solve(loaded(segments, clamped), options);
        REQUIRE(e.ok());
        errors.push_back(largest_distance(e, exact));
      }
      CAPTURE(clamped, static_cast<int>(element), errors[0], errors[1], errors[2]);
      const double order = element == Element::se3 ? 4 : 2;
      CHECK(std::log2(errors[0] / errors[1]) == Approx(order).margin(0.4));
      CHECK(std::log2(errors[1] / errors[2]) == Approx(order).margin(0.4));
    }
}

TEST_CASE("a rod preformed with varying curvature: its energies and moments are those of the strains") {
  const Equilibrium e = solve(loaded(80, false)), fine = solve(loaded(640, false));
  REQUIRE(e.ok());
  CHECK(e.energy.bend == Approx(fine.energy.bend).epsilon(1e-4));
  CHECK(e.energy.twist == Approx(fine.energy.twist).epsilon(1e-4));
  const Section section = loaded(80, false).rod.parts[0].section;
  double bend = 0;
  for (std::size_t i = 0; i < e.moments.size(); ++i) {
    const double h = e.s[i + 1] - e.s[i];
    bend += 0.5 * h * (e.moments[i].x() * e.moments[i].x() / section.EI1 + e.moments[i].y() * e.moments[i].y() / section.EI2);
    CHECK((e.moments[i] - fine.moments[8 * i + 4]).norm() < 0.02 * fine.moments[0].norm());
  }
  CHECK(bend == Approx(e.energy.bend).epsilon(2e-3));
}

TEST_CASE("a rod preformed with varying curvature rests in its own shape without load") {
  for (const Element element : {Element::se3, Element::staggered}) {
    RodProblem problem = loaded(20, false);
    problem.gravity = Vec3::Zero();
    problem.loads.clear();
    SolveOptions options;
    options.element = element;
    const Equilibrium e = solve(problem, options);
    REQUIRE(e.ok());
    CHECK(e.energy.total() < 1e-15);
    if (element == Element::se3)
      for (std::size_t i = 0; i < e.s.size(); ++i) CHECK((e.points[i] - problem.rod.shape(e.s[i]).at).norm() < 1e-9);
  }
}
