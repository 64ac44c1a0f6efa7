#include "method/dress_pack/pack_report.h"

#include <algorithm>
#include <cmath>

namespace tendril::dress_pack {
namespace {

constexpr double clearance_reach = 0.5;  // m: what is farther away is not looked for

RodReport report_of(const Equilibrium& rod) {
  RodReport out;
  out.tension = rod.largest_tension();
  for (const Vec3& change : rod.curvature_changes) out.twist = std::max(out.twist, std::abs(change.z()));
  out.bend_radius = rod.smallest_bend_radius();
  return out;
}

}  // namespace

void PackReporter::report(PackStatics& statics, PackStep& step) {
  RodNetwork& network = statics.network();
  rods_.resize(network.rods());
  network.gradient(step.state, gradient_);
  step.residual = 0;
  for (int i = 0; i < network.nodes(); ++i)
    for (int c = 0; c < 6; ++c)
      if (!(network.held()[i] >> c & 1)) step.residual = std::max(step.residual, std::abs(gradient_[i][c]) / (c < 3 ? 1 : network.size()));
  step.ends.resize(statics.attachments());
  for (int k = 0; k < statics.attachments(); ++k) {
    const int node = statics.node_of(k);
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
    step.rods.push_back(report_of(rod));
  }
  if (bodies_.size() == 0) return;
  if (!gaps_) gaps_.emplace(bodies_, network, Compared::clearance);
  add_clearances(*gaps_, step);
}

void PackReporter::report(const SystemEquilibrium& equilibrium, PackStep& step) {
  const PackProblem& pack = bodies_.pack();
  step.ends.resize(pack.attachments.size());
  for (std::size_t k = 0; k < pack.attachments.size(); ++k) {
    const Reaction& reaction = equilibrium.rods[pack.attachments[k].rod].reactions[pack.attachments[k].hold];
    step.ends[k] = {reaction.force, reaction.moment};
  }
  step.rods.clear();
  step.residual = 0;
  for (const Equilibrium& rod : equilibrium.rods) {
    step.rods.push_back(report_of(rod));
    step.rods.back().contacts = rod.contacts;
    step.residual = std::max(step.residual, rod.residual);
  }
  if (bodies_.size() == 0) return;
  if (!gaps_ || pack.slides()) {
    gaps_.emplace(bodies_, equilibrium, Compared::clearance);
    memory_ = {};
  }
  add_clearances(*gaps_, step);
}

void PackReporter::add_clearances(const PackGaps& gaps, PackStep& step) {
  gaps.place(step.state, step.q, places_);
  for (std::size_t k = 0; k < step.rods.size(); ++k) {
    const PackGaps::Nearest near = gaps.smallest(static_cast<int>(k), step.state, places_, clearance_reach, memory_);
    step.rods[k].clearance = near.gap;
    step.rods[k].body = near.body;
  }
  if (!links_) return;
  const LinkGap near = links_->smallest(step.q, clearance_reach, link_memory_);
  if (near.body >= 0) step.robot = {near.gap, bodies_.pack().bodies[near.body].link, near.other};
}

}  // namespace tendril::dress_pack
