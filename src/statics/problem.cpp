#include "statics/problem.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril {
namespace {

void check_place(const char* what, double at, double length) {
  if (!(at >= -1e-9 * length && at <= length * (1 + 1e-9)))
    throw UsageError(std::string(what) + " at arc length " + number_text(at) + " m lies outside the rod (0 to " + number_text(length) +
                     " m)");
}

void check_holds(const RodProblem& problem) {
  const double length = problem.rod.length;
  bool position = false;
  for (std::size_t k = 0; k < problem.holds.size(); ++k) {
    const Hold& hold = problem.holds[k];
    check_place("hold", hold.at, length);
    if (!all_finite(hold.frame.at) || !all_finite(hold.frame.rotation.coeffs()) || !std::isfinite(hold.turns))
      throw UsageError("hold at " + number_text(hold.at) + " m: its frame and turns must be finite numbers");
    position |= hold.position;
    for (std::size_t j = 0; j < k; ++j) {
      const Hold& other = problem.holds[j];
      if (std::abs(other.at - hold.at) > 1e-9 * length) continue;
      if ((other.position && hold.position) || (other.orientation && hold.orientation))
        throw UsageError("two holds at arc length " + number_text(hold.at) +
                         " m contradict each other; hold a place once, or its position and orientation apart");
    }
  }
  if (!position)
    throw UsageError("the rod is not held at any place, so it would fall; give it a 'from' or a 'to' frame or a hold");
}

}  // namespace

void RodProblem::check() const {
  rod.check();
  if (!all_finite(gravity)) throw UsageError("gravity must be three finite numbers (m/s^2)");
  check_holds(*this);
  for (const PointLoad& load : loads) {
    check_place("load", load.at, rod.length);
    if (!all_finite(load.force) || !all_finite(load.moment))
      throw UsageError("load at " + number_text(load.at) + " m: force and moment must be finite numbers");
  }
  double softest = INFINITY;
  for (const RodPart& part : rod.parts) softest = std::min(softest, part.section.EA);
  const double weight = rod.mass() * gravity.norm();
  if (weight > softest)
    throw UsageError("the rod weighs " + number_text(weight) + " N but its stretch stiffness EA is only " + number_text(softest) +
                     " N: it would more than double its length; check young, EA, density and the units");
}

}  // namespace tendril
