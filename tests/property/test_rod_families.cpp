// Random rods of every family are solved, and what is solved is an equilibrium.
#include <catch2/catch.hpp>

#include <cstdio>

#include "rod_families.h"
#include "statics/solve.h"

using namespace tendril;

namespace {

constexpr int members = 100;

/// Forces and moments on the whole rod: holds, weight, loads. Both must vanish, the moment about any point.
void check_balance(const RodProblem& problem, const Equilibrium& e) {
  const Vec3 about(0.3, -0.2, 0.7);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double scale = 0;
  for (std::size_t k = 0; k < e.reactions.size(); ++k) {
    const Vec3 arm = problem.holds[k].frame.at - about;
    force += e.reactions[k].force;
    moment += e.reactions[k].moment + arm.cross(e.reactions[k].force);
    scale = std::max({scale, e.reactions[k].force.norm(), e.reactions[k].moment.norm()});
  }
  const double per_length = problem.rod.parts[0].section.mass;
  const Vec3 weight = per_length * problem.rod.length * problem.gravity;
  force += weight;
  // An energy that is invariant under rigid motion balances its forces up to the residual that Newton leaves: its
  // tolerance times the stiffness.
  const double rounding = 1e-11 * problem.rod.parts[0].section.EA + 1e-7 * (scale + weight.norm());
  CHECK(force.norm() < rounding);
  if (weight.isZero(0)) CHECK(moment.norm() < rounding);
}

}  // namespace

TEST_CASE("random rods: every family is solved") {
  const auto families = test::rod_families();
  for (const Element element : {Element::se3, Element::staggered})
    for (std::size_t family = 0; family < families.size(); ++family) {
      SolveOptions options;
      options.element = element;
      int solved = 0;
      for (int member = 0; member < members; ++member) {
        auto random = test::stream_of(static_cast<int>(family), member);
        const RodProblem problem = families[family].make(random);
        const Equilibrium e = solve(problem, options);
        if (!e.ok()) {
          std::printf("not solved: family %zu (%s), member %d, element %d: %s\n", family, families[family].name.c_str(),
                      member, static_cast<int>(element), e.message.c_str());
          continue;
        }
        ++solved;
        CAPTURE(families[family].name, family, member, static_cast<int>(element), e.iterations);
        CHECK(e.stable);
        CHECK(e.fallbacks <= 3);
        check_balance(problem, e);
      }
      CAPTURE(families[family].name, family, static_cast<int>(element));
      CHECK(solved == members);
    }
}
