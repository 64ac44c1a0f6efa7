#include "scene/quantities.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"
#include "scene/clearance.h"

namespace tendril {
namespace {

void check(const QuantityOptions& o) {
  const auto require = [](bool good, const char* what, double got, const char* expected) {
    if (!good) throw UsageError(std::string("equilibrium:quantities: '") + what + "' is " + number_text(got) + ", expected " + expected);
  };
  const char* not_negative = "a finite number of at least 0";
  require(std::isfinite(o.clearance) && o.clearance >= 0, "clearance", o.clearance, not_negative);
  require(std::isfinite(o.preference) && o.preference >= 0, "preference", o.preference, not_negative);
  require(std::isfinite(o.free_ends) && o.free_ends >= 0, "free_ends", o.free_ends, not_negative);
  require(std::isfinite(o.range) && o.range > 0, "range", o.range, "a finite number above 0");
}

/// What a metre costs more at places of one rod.
class RunCost {
 public:
  RunCost(const SceneEquilibrium& eq, const SolvedRod& rod, const QuantityOptions& options) : eq_(eq), rod_(rod), o_(options) {}

  double at(double s, const Vec3& p, double radius) const {
    if (!eq_.surroundings || (o_.clearance == 0 && o_.preference == 0)) return 0;
    double nearest = std::numeric_limits<double>::infinity(), cost = 0;
    for (int k = 0; k < static_cast<int>(eq_.obstacles.size()); ++k) {
      const Preference prefer = eq_.obstacles[k].prefer;
      if (prefer == Preference::neutral && o_.clearance == 0) continue;
      const ClosestPoint found = eq_.closest(rod_, s, p, k);
      const double gap = found.obstacle < 0 ? std::numeric_limits<double>::infinity() : found.distance - radius;
      if (prefer != Preference::near) nearest = std::min(nearest, gap);
      if (prefer == Preference::avoid) cost += o_.preference * nearness(gap);
      if (prefer == Preference::near) cost += o_.preference * std::max(0.0, 1 - nearness(gap));
    }
    return cost + o_.clearance * nearness(nearest);
  }

 private:
  double nearness(double gap) const {
    const double x = std::max(0.0, 1 - gap / o_.range);
    return x * x;
  }

  const SceneEquilibrium& eq_;
  const SolvedRod& rod_;
  const QuantityOptions& o_;
};

/// Pieces of a rod by their middles.
void measure_run(const SceneEquilibrium& eq, const SolvedRod& rod, const QuantityOptions& options, RodQuantities& q) {
  const double length = rod.problem.rod.length;
  const int count = std::clamp(static_cast<int>(std::ceil(length / (0.5 * rod.problem.rod.largest_radius()))), 8, 100'000);
  const double piece = length / count, stretch = q.length / length;
  const RunCost cost(eq, rod, options);
  for (int i = 0; i < count; ++i) {
    const double s = (i + 0.5) * piece;
    const Vec3 p = rod.equilibrium.frame_at(s).at;
    const double radius = rod.problem.rod.section_at(s).radius();
    q.cost += piece * stretch * cost.at(s, p, radius);
    if (!eq.surroundings || s < options.free_ends || s > length - options.free_ends) continue;
    const ClosestPoint closest = eq.closest(rod, s, p);
    if (closest.obstacle >= 0 && too_close(closest.distance - radius, 0, radius)) q.length_in_collision += piece;
  }
}

RodQuantities quantities_of_rod(const SceneEquilibrium& eq, const SolvedRod& solved, const QuantityOptions& options) {
  const Rod& rod = solved.problem.rod;
  RodQuantities q;
  q.rod = solved.name;
  q.unstressed_length = rod.length;
  q.mass = rod.mass();
  double from = 0;
  for (const RodPart& part : rod.parts) {
    q.volume += units::pi / 4 * part.section.outer * part.section.outer * (part.upto - from);
    from = part.upto;
  }
  for (const Hold& hold : solved.problem.holds) {
    const bool at_end = hold.at <= 1e-9 * rod.length || hold.at >= (1 - 1e-9) * rod.length;
    (at_end ? q.held_ends : q.clips) += 1;
  }
  if (solved.equilibrium.s.empty()) return q;  // stopped before there was any shape
  q.length = solved.equilibrium.settled_length();
  q.cost = q.length;
  measure_run(eq, solved, options, q);
  return q;
}

void add(RodQuantities& sum, const RodQuantities& q) {
  sum.length += q.length;
  sum.unstressed_length += q.unstressed_length;
  sum.volume += q.volume;
  sum.mass += q.mass;
  sum.clips += q.clips;
  sum.held_ends += q.held_ends;
  sum.length_in_collision += q.length_in_collision;
  sum.cost += q.cost;
}

}  // namespace

Quantities quantities_of(const SceneEquilibrium& equilibrium, const QuantityOptions& options) {
  check(options);
  Quantities all;
  all.branches = static_cast<int>(equilibrium.branches.size());
  for (const SolvedRod& rod : equilibrium.rods) {
    all.rods.push_back(quantities_of_rod(equilibrium, rod, options));
    add(all.total, all.rods.back());
  }
  for (const auto& [wire, rods] : options.wires) {
    double length = 0;
    for (auto name = rods.begin(); name != rods.end(); ++name) {
      if (std::find(rods.begin(), name, *name) != name)
        throw UsageError("equilibrium:quantities: wire '" + wire + "' runs through '" + *name + "' twice");
      const SolvedRod& rod = equilibrium.rod(*name);  // tells an unknown name
      length += all.rods[static_cast<std::size_t>(&rod - equilibrium.rods.data())].length;
    }
    all.wire_lengths[wire] = length;
    all.cable_length += length;
  }
  return all;
}

}  // namespace tendril
