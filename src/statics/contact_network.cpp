#include "statics/contact_network.h"

#include <algorithm>

namespace tendril {

namespace {

/// Arc lengths (m) of a rod's sections that held branch points hold.
std::vector<double> held_by_branches(const RodNetwork& network, int rod) {
  std::vector<double> held;
  for (const BranchPoint& branch : network.problem().branches)
    for (const JoinedSection& section : branch.sections)
      if (branch.position && section.rod == rod) held.push_back(section.at);
  return held;
}

}  // namespace

ContactNetwork::ContactNetwork(const RodNetwork& network, Element element, ClearanceRule clearance) : network_(&network) {
  for (int k = 0; k < network.rods(); ++k) {
    const RodSystem& system = network.rod(k);
    const RodProblem& problem = system.problem();
    if (!problem.surroundings) continue;
    double radius = problem.rod.largest_radius();
    for (const RodPart& part : problem.rod.parts) radius = std::min(radius, part.section.radius());
    double load = problem.rod.mass() * problem.gravity.norm();
    for (const PointLoad& point : problem.loads) load += point.force.norm();
    const double reference = std::max(load / system.length(), 50 * system.bending_scale() / radius);
    auto terms = std::make_unique<ContactTerms>(system, element, network.first_node(k), clearance, held_by_branches(network, k));
    rods_.push_back({k, radius, reference, std::move(terms)});
  }
}

ContactTerms* ContactNetwork::of_rod(int index) {
  const auto found = std::find_if(rods_.begin(), rods_.end(), [&](const Rod& rod) { return rod.index == index; });
  return found == rods_.end() ? nullptr : found->terms.get();
}

double ContactNetwork::assemble(const RodState& state, Stress stress, BlockSystem& system) {
  double energy = 0;
  for (Rod& rod : rods_) energy += rod.terms->assemble(state, stress, system);
  return energy;
}

double ContactNetwork::energy(const RodState& state) {
  double energy = 0;
  for (Rod& rod : rods_) energy += rod.terms->energy(state);
  return energy;
}

double ContactNetwork::allowed(const RodState& state, const std::vector<Vec6>& step, double share) {
  // A share that one rod has made smaller has to suit the others too: paths are curved where sections turn.
  for (bool again = true; again;) {
    again = false;
    for (Rod& rod : rods_) {
      const double own = rod.terms->allowed(state, step, share);
      again = again || (own < share && rods_.size() > 1);
      share = std::min(share, own);
      if (share == 0) return 0;
    }
  }
  return share;
}

bool ContactNetwork::stiffen(const RodState& state, const std::vector<Vec6>& step, double share) {
  bool any = false;
  for (Rod& rod : rods_) any = rod.terms->stiffen(state, step, share) || any;
  return any;
}

void ContactNetwork::stepped(const RodState& before, const std::vector<Vec6>& step, double share) {
  for (Rod& rod : rods_) rod.terms->stepped(before, step, share);
}

void ContactNetwork::set_softness(double softness) {
  for (Rod& rod : rods_) rod.terms->set().law = ContactLaw::for_overlap(rod.reference, rod.radius, softness);
}

void ContactNetwork::begin(const RodState& state) {
  for (Rod& rod : rods_) rod.terms->begin(state);
}

void ContactNetwork::set_exact(bool on) {
  for (Rod& rod : rods_) rod.terms->set_exact(on);
}

void ContactNetwork::set_early_end(bool on) {
  for (Rod& rod : rods_) rod.terms->set_early_end(on);
}

void ContactNetwork::stand_at(const RodState& state) {
  for (Rod& rod : rods_) rod.terms->stand_at(state);
}

void ContactNetwork::update_shifts(const RodState& state, double most) {
  for (Rod& rod : rods_) rod.terms->update_shifts(state, most);
}

void ContactNetwork::harden(double factor) {
  for (Rod& rod : rods_) rod.terms->harden(factor);
}

void ContactNetwork::forget_forces() {
  for (Rod& rod : rods_) rod.terms->forget_forces();
}

ContactNetwork::Deepest ContactNetwork::deepest_at(const RodState& state) {
  Deepest deepest;
  for (Rod& rod : rods_) {
    const ContactTerms::Deepest place = rod.terms->deepest_at(state);
    if (place.penetration / rod.radius > deepest.radii) deepest = {place.penetration / rod.radius, &rod, place};
  }
  return deepest;
}

double ContactNetwork::widest_gap(const RodState& state) {
  double widest = 0;
  for (Rod& rod : rods_) widest = std::max(widest, rod.terms->widest_gap(state) / rod.radius);
  return widest;
}

std::optional<ContactNetwork::Crossing> ContactNetwork::first_crossing(const RodState& state) {
  for (Rod& rod : rods_) {
    rod.terms->stand_at(state);
    const std::vector<int> crossings = rod.terms->guard().crossings();
    if (crossings.empty()) continue;
    const ContactSet& set = rod.terms->set();
    const int i = crossings.front();
    const double a = set.points()[i].s, b = set.points()[i + 1].s;
    if (const auto hit = set.field_after(i).ray(set.positions()[i], set.positions()[i + 1]))
      return Crossing{&rod, a + hit->share * (b - a), hit->point, hit->obstacle};
  }
  return std::nullopt;
}

double ContactNetwork::smallest_share(double radii) const {
  double share = radii;
  for (const Rod& rod : rods_) share = std::min(share, radii * rod.radius / network_->rod(rod.index).length());
  return share;
}

}  // namespace tendril
