#include "statics/measure.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "statics/measure_terms.h"

namespace tendril {
namespace {

using What = Measure::What;

[[noreturn]] void refuse(const std::string& what) { throw UsageError("sensitivity: " + what); }

int checked(int index, std::size_t size, const char* what) {
  if (index < 0 || index >= static_cast<int>(size))
    refuse("got " + std::string(what) + " " + std::to_string(index) + ", expected one of " + std::to_string(size));
  return index;
}

/// The node that moves a section: itself, or the branch point that it is joined to.
int carrier_of(const RodNetwork& network, int rod, int vertex) {
  const auto& branches = network.problem().branches;
  std::vector<int> seen(network.rods(), 0);
  for (int b = 0; b < static_cast<int>(branches.size()); ++b)
    for (const JoinedSection& section : branches[b].sections)
      if (network.rod(section.rod).mesh().joint_vertex[seen[section.rod]++] == vertex && section.rod == rod)
        return network.branch_node(b);
  return network.first_node(rod) + vertex;
}

/// The dead moments on a node, sections joined to it included, in its own axes.
Vec3 dead_moment_at(const RodNetwork& network, int node, const RodState& state) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < network.rods(); ++k) {
    const RodSystem& system = network.rod(k);
    const std::vector<PointLoad>& loads = system.problem().loads;
    for (std::size_t i = 0; i < loads.size(); ++i)
      if (carrier_of(network, k, system.mesh().load_vertex[i]) == node) sum += loads[i].moment;
  }
  return state.q[node].conjugate() * sum;
}

/// Support at a target of the network: force or moment along a world axis.
void add_reaction(const RodNetwork& network, int target, bool moment, const Vec3& along, const RodState& state,
                  const std::vector<Vec6>& gradient, MeasureSlopes& out) {
  const RodSystem::Target& held = network.targets()[target];
  if (!(held.mask & (moment ? held_rotation : held_position)))
    refuse(std::string("there is no reaction ") + (moment ? "moment" : "force") + ": the hold lets that free");
  Vec6 weight = Vec6::Zero();
  if (!moment) {
    weight.head<3>() = along;
  } else {
    const Vec3 body = state.q[held.node].conjugate() * along;
    weight.tail<3>() = body;
    // The section's axes turn with the hold, and the gradient in them is only the symmetric half of the story.
    Vec3 elastic = gradient[held.node].tail<3>();
    elastic += dead_moment_at(network, held.node, state);
    out.by_motion.push_back({held.node, (Vec6() << Vec3::Zero(), 0.5 * elastic.cross(body)).finished()});
  }
  out.value = weight.dot(gradient[held.node]);
  out.reaction.push_back({held.node, weight});
}

int target_of_hold(const Measure& m, const RodNetwork& network) {
  int target = 0;
  for (int k = 0; k < m.rod; ++k) target += static_cast<int>(network.rod(k).targets().size());
  return target + checked(m.index, network.rod(m.rod).problem().holds.size(), "hold");
}

int target_of_branch(const Measure& m, const RodNetwork& network) {
  const int node = network.branch_node(checked(m.index, network.problem().branches.size(), "branch point"));
  for (std::size_t k = 0; k < network.targets().size(); ++k)
    if (network.targets()[k].node == node) return static_cast<int>(k);
  refuse("branch point " + std::to_string(m.index) + " is not held, so nothing supports it");
}

/// Measures of the network; false for those of one rod.
bool of_network(const Measure& m, const RodNetwork& network, const RodState& state, const std::vector<Vec6>& gradient,
                MeasureSlopes& out) {
  switch (m.what) {
    case What::reaction_force: case What::reaction_moment:
      checked(m.rod, network.rods(), "rod");
      add_reaction(network, target_of_hold(m, network), m.what == What::reaction_moment, m.along, state, gradient, out);
      return true;
    case What::branch_force: case What::branch_moment:
      add_reaction(network, target_of_branch(m, network), m.what == What::branch_moment, m.along, state, gradient, out);
      return true;
    case What::branch_position: {
      const int node = network.branch_node(checked(m.index, network.problem().branches.size(), "branch point"));
      out.value = m.along.dot(state.r[node]);
      out.by_state[node].head<3>() += m.along;
      return true;
    }
    case What::functional:
      if (static_cast<int>(m.weights.size()) != network.nodes())
        refuse("a functional has " + std::to_string(m.weights.size()) + " weights, expected one for each of " +
               std::to_string(network.nodes()) + " nodes");
      for (int i = 0; i < network.nodes(); ++i) out.by_state[i] += m.weights[i];
      return true;
    default: return false;
  }
}

void of_rod(const Measure& m, RodMeasureTerms& terms) {
  switch (m.what) {
    case What::position: terms.add_position(m.at, m.along); break;
    case What::rotation: terms.add_rotation(m.at, m.along); break;
    case What::tangent: terms.add_tangent(m.at, m.along); break;
    case What::force: terms.add_force(terms.segment_at(m.at), m.along); break;
    case What::moment: terms.add_moment(terms.segment_at(m.at), m.along); break;
    case What::tension: terms.add_tension(terms.segment_at(m.at)); break;
    case What::twist: terms.add_twist(terms.segment_at(m.at)); break;
    case What::bend_radius: terms.add_bend_radius(terms.vertex_at(m.at)); break;
    case What::min_bend_radius: terms.add_bend_radius(terms.sharpest_vertex()); break;
    case What::max_tension: terms.add_tension(terms.tightest_segment()); break;
    case What::max_strain: terms.add_strain(terms.most_strained_segment()); break;
    case What::length: terms.add_length(); break;
    case What::gap: terms.add_gap(m.at, m.origin, m.along); break;
    case What::bend: terms.add_elastic({3, 4}); break;
    case What::twist_energy: terms.add_elastic({5}); break;
    case What::stretch: terms.add_elastic({2}); break;
    case What::shear: terms.add_elastic({0, 1}); break;
    case What::gravity: terms.add_gravity(); break;
    case What::load: terms.add_loads(); break;
    case What::energy:
      terms.add_elastic({0, 1, 2, 3, 4, 5});
      terms.add_gravity();
      terms.add_loads();
      break;
    default: break;
  }
}

}  // namespace

const char* unit_of(What what) {
  switch (what) {
    case What::rotation: return "rad";
    case What::tangent: case What::max_strain: case What::functional: return "";
    case What::force: case What::tension: case What::reaction_force: case What::branch_force: case What::max_tension: return "N";
    case What::moment: case What::reaction_moment: case What::branch_moment: return "N m";
    case What::twist: return "rad/m";
    case What::bend: case What::twist_energy: case What::stretch: case What::shear: case What::gravity: case What::load:
    case What::energy: return "J";
    default: return "m";
  }
}

MeasureSlopes slopes_of(const Measure& m, const RodNetwork& network, const std::vector<RodDerivatives>& rods,
                        const RodState& state, const std::vector<Vec6>& gradient) {
  MeasureSlopes out;
  out.by_state.assign(network.nodes(), Vec6::Zero());
  for (const RodDerivatives& rod : rods) out.by_rod.emplace_back(rod.segments());
  if (of_network(m, network, state, gradient, out)) return out;
  const int k = checked(m.rod, network.rods(), "rod");
  const double length = network.rod(k).length();
  if (!(m.at >= -1e-9 * length && m.at <= length * (1 + 1e-9)))
    refuse("a measure at arc length " + std::to_string(m.at) + " m lies outside the rod (0 to " + std::to_string(length) + " m)");
  RodMeasureTerms terms(rods[k], k, network.first_node(k), out);
  of_rod(m, terms);
  terms.finish();
  return out;
}

}  // namespace tendril
