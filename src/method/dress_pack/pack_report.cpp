#include "method/dress_pack/pack_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tendril::dress_pack {
namespace {

constexpr double clearance_reach = 0.5;  // m: what is farther away is not looked for

/// At vertices and halfway between them, on the straight line; m.
double clearance_of(const RodProblem& problem, const Equilibrium& rod) {
  double least = std::numeric_limits<double>::infinity(), limit = clearance_reach;
  auto look = [&](const Vec3& p, double radius) {
    const ClosestPoint near = problem.surroundings->closest(p, limit + radius);
    if (near.obstacle < 0 || near.distance - radius >= least) return;
    least = near.distance - radius;
    limit = std::max(least, 0.0);
  };
  for (std::size_t i = 0; i < rod.points.size(); ++i) {
    look(rod.points[i], rod.radii[std::min(i, rod.radii.size() - 1)]);
    if (i + 1 < rod.points.size()) look(0.5 * (rod.points[i] + rod.points[i + 1]), rod.radii[i]);
  }
  return least;
}

RodReport report_of(const RodProblem& problem, const Equilibrium& rod) {
  RodReport out;
  out.tension = rod.largest_tension();
  for (const Vec3& change : rod.curvature_changes) out.twist = std::max(out.twist, std::abs(change.z()));
  out.bend_radius = rod.smallest_bend_radius();
  out.clearance = problem.surroundings ? clearance_of(problem, rod) : std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace

void PackReporter::report(PackStep& step) {
  RodNetwork& network = statics_.network();
  network.gradient(step.state, gradient_);
  step.residual = 0;
  for (int i = 0; i < network.nodes(); ++i)
    for (int c = 0; c < 6; ++c)
      if (!(network.held()[i] >> c & 1)) step.residual = std::max(step.residual, std::abs(gradient_[i][c]) / (c < 3 ? 1 : network.size()));
  step.ends.resize(statics_.attachments());
  for (int k = 0; k < statics_.attachments(); ++k) {
    const int node = statics_.node_of(k);
    const HeldMask held = network.held()[node];
    if (held & held_position) step.ends[k].force = gradient_[node].head<3>();
    if (held & held_rotation) step.ends[k].moment = step.state.q[node] * Vec3(gradient_[node].tail<3>());
  }
  step.rods.clear();
  for (int k = 0; k < network.rods(); ++k) {
    RodSystem& system = network.rod(k);
    Equilibrium& rod = rods_[k];
    rod.energy = {};
    const int first = network.first_node(k);
    rod.s = system.mesh().s;
    rod.points.assign(step.state.r.begin() + first, step.state.r.begin() + first + system.nodes());
    rod.rotations.assign(step.state.q.begin() + first, step.state.q.begin() + first + system.nodes());
    rod.radii.clear();
    for (const MeshSegment& segment : system.mesh().segments) rod.radii.push_back(segment.section.radius());
    system.describe(network.of_rod(k, step.state), rod);
    step.rods.push_back(report_of(system.problem(), rod));
  }
}

void PackReporter::report(const SystemEquilibrium& equilibrium, PackStep& step) const {
  const PackProblem& pack = statics_.pack();
  step.ends.resize(pack.attachments.size());
  for (std::size_t k = 0; k < pack.attachments.size(); ++k) {
    const Reaction& reaction = equilibrium.rods[pack.attachments[k].rod].reactions[pack.attachments[k].hold];
    step.ends[k] = {reaction.force, reaction.moment};
  }
  step.rods.clear();
  step.residual = 0;
  for (std::size_t k = 0; k < pack.rods.size(); ++k) {
    step.rods.push_back(report_of(pack.rods[k], equilibrium.rods[k]));
    step.residual = std::max(step.residual, equilibrium.rods[k].residual);
  }
}

}  // namespace tendril::dress_pack
