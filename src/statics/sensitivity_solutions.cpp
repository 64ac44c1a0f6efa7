// The two ways through the factorised matrix: forward by parameter, backward by measure.
#include <algorithm>
#include <cmath>
#include <limits>

#include "statics/contact_slopes.h"
#include "statics/se3_packs.h"
#include "statics/sensitivity.h"

namespace tendril {
namespace {

Vec6 both(const Vec3& a, const Vec3& b) { return (Vec6() << a, b).finished(); }

/// Calls f(vertex, share) for the vertices that follow break `k`: all of its way at the break, less towards its neighbours.
template <class F>
void for_followers(const std::vector<int>& breaks, int k, const std::vector<double>& s, F f) {
  const int at = breaks[k];
  f(at, 1.0);
  if (k > 0)
    for (int v = breaks[k - 1] + 1; v < at; ++v) f(v, (s[v] - s[breaks[k - 1]]) / (s[at] - s[breaks[k - 1]]));
  if (k + 1 < static_cast<int>(breaks.size()))
    for (int v = at + 1; v < breaks[k + 1]; ++v) f(v, (s[breaks[k + 1]] - s[v]) / (s[breaks[k + 1]] - s[at]));
}

int break_at(const std::vector<int>& breaks, int vertex) {
  return static_cast<int>(std::lower_bound(breaks.begin(), breaks.end(), vertex) - breaks.begin());
}

/// Changes of all vertices' arc lengths, m per unit of the parameter.
std::vector<double> place_changes(const ParameterEffect& effect, const std::vector<int>& breaks, const std::vector<double>& s) {
  std::vector<double> places(s.size(), 0.0);
  for (const ParameterEffect::PlaceMove& move : effect.places)
    for_followers(breaks, break_at(breaks, move.vertex), s, [&](int v, double share) { places[v] += share * move.by; });
  return places;
}

/// How fast the reference rates of a piece of a preformed rod change as its ends move along the shape: the shape is any
/// function, so by central differences.
Vec6 rate_along_shape(const Rod& rod, double a, double b, double move_a, double move_b) {
  const double fastest = std::max(std::abs(move_a), std::abs(move_b));
  if (fastest == 0) return Vec6::Zero();
  const double step = 1e-5 * (b - a) / fastest;
  auto rates = [&](double t) {
    const double from = std::clamp(a + t * move_a, 0.0, rod.length), to = std::clamp(b + t * move_b, 0.0, rod.length);
    const ReferenceRates r = reference_rates(rod.shape(from).inverse() * rod.shape(to), to - from);
    return both(r.v, r.phi);
  };
  return (rates(step) - rates(-step)) / (2 * step);
}

/// The motion of a joined section against its branch point.
Vec6 motion_against(const ParameterEffect::AtJoint& joint, const RodState& state) {
  return both(state.q[joint.branch] * Vec3(joint.change.head<3>()), joint.change.tail<3>());
}

std::vector<double> nothing_known(std::size_t count) {
  return std::vector<double>(count, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

/// What one adjoint solution gives: every derivative that a parameter may ask for.
struct Sensitivity::Adjoint {
  MeasureSlopes slopes;         ///< by_rod: total derivatives; by_state: not joined
  std::vector<Vec6> state;      ///< lambda less the reaction's weights, all nodes
  std::vector<Vec6> by_motion;  ///< by node; of meaning at held unknowns
  std::vector<std::vector<SegmentChange>> by_part;  ///< by rod and part
  std::vector<std::vector<double>> by_break;        ///< by rod and break
};

/// Adds g_p, not joined.
void Sensitivity::add_change(const ParameterEffect& effect, std::vector<Vec6>& gradient) const {
  for (int k = 0; k < network_.rods(); ++k) {
    Vec6* own = gradient.data() + network_.first_node(k);
    if (!effect.gravity.isZero(0)) rods_[k].add_gradient_change(effect.gravity, own);
    if (effect.rod != k) continue;
    const std::vector<double>& s = network_.rod(k).mesh().s;
    const Rod& rod = network_.rod(k).problem().rod;
    const std::vector<double> places = place_changes(effect, breaks_[k], s);
    std::vector<double> radii(s.size() - 1, 0.0);
    std::vector<SegmentChange> changes(s.size() - 1);
    for (int i = 0; i < rods_[k].segments(); ++i) {
      SegmentChange& change = changes[i];
      change.length = places[i + 1] - places[i];
      if (rod.shape && effect.shape_stays) change.rate = rate_along_shape(rod, s[i], s[i + 1], places[i], places[i + 1]);
      for (const ParameterEffect::PartChange& part : effect.parts)
        if (part.part == parts_[k][i]) change += part.change;
      radii[i] = change.radius;
    }
    rods_[k].add_gradient_change(changes, own);
    if (const ContactTerms* contacts = contacts_ ? contacts_->of_rod(k) : nullptr)
      add_contact_change(*contacts, s, shape_of(k), places, radii, {own, s.size()});
  }
  for (const ParameterEffect::AtNode& load : effect.loads) {
    gradient[load.node].head<3>() -= load.change.head<3>();
    gradient[load.node].tail<3>() -= state_.q[load.node].conjugate() * Vec3(load.change.tail<3>());
  }
}

/// dq/dp. `change`: g_p, not joined; on return joined, with what sections that move against their branch points add.
std::vector<Vec6> Sensitivity::motion_of(const ParameterEffect& effect, std::vector<Vec6>& change) const {
  const int n = network_.nodes();
  std::vector<Vec6> lever(n, Vec6::Zero());
  for (const ParameterEffect::AtJoint& joint : effect.joints) {
    // The section's motion by itself, and the force on it at a lever that has changed.
    std::vector<Vec6> moved(n, Vec6::Zero());
    moved[joint.section] = motion_against(joint, state_);
    for (int i = joint.section - 1; i <= joint.section + 1; ++i)
      if (in_same_rod(i, joint.section)) change[i] += section_row_times(i, moved);
    const Vec3 turn = joint.change.tail<3>(), force = gradient_[joint.section].head<3>();
    const Vec3 couple = gradient_[joint.section].tail<3>();
    change[joint.section].tail<3>() += 0.5 * couple.cross(turn) - 0.5 * moment_on(joint.section).cross(turn);
    lever[joint.branch].tail<3>() += Vec3(joint.change.head<3>()).cross(state_.q[joint.branch].conjugate() * force) +
                                     joint.relative.rotation * turn.cross(couple);
  }
  network_.join_gradient(state_, change);
  for (int i = 0; i < n; ++i) change[i] += lever[i];
  std::vector<Vec6> x(n), held(n, Vec6::Zero());
  for (int i = 0; i < n; ++i) x[i] = -change[i];
  for (const ParameterEffect::AtNode& motion : effect.motions) held[motion.node] += motion.change;
  for (const HeldRow& row : held_rows_) x[row.other] -= row.block.transpose() * held[row.node];
  clear_held(x);
  solve(x, false);
  for (int i = 0; i < n; ++i) x[i] += held[i];
  network_.complete(state_, x);
  for (const ParameterEffect::AtJoint& joint : effect.joints) x[joint.section] += motion_against(joint, state_);
  return x;
}

std::vector<Vec6> Sensitivity::motion(const Parameter& parameter) const {
  if (!ok_) return std::vector<Vec6>(network_.nodes(), Vec6::Constant(std::numeric_limits<double>::quiet_NaN()));
  const ParameterEffect effect = effect_of(parameter, network_);
  std::vector<Vec6> change(network_.nodes(), Vec6::Zero());
  add_change(effect, change);
  return motion_of(effect, change);
}

std::vector<double> Sensitivity::forward(std::span<const Measure> measures, const Parameter& parameter) const {
  if (!ok_) return nothing_known(measures.size());
  const ParameterEffect effect = effect_of(parameter, network_);
  std::vector<Vec6> change(network_.nodes(), Vec6::Zero());
  add_change(effect, change);
  const std::vector<Vec6> moved = motion_of(effect, change);
  const std::vector<Vec6> pulled = rows_times(moved);
  std::vector<double> out;
  for (const Measure& m : measures) {
    Adjoint partial;
    partial.slopes = measure(m);
    partial.state.assign(network_.nodes(), Vec6::Zero());
    partial.by_motion.assign(network_.nodes(), Vec6::Zero());
    for (const MeasureSlopes::AtNode& by : partial.slopes.by_motion) partial.by_motion[by.node] += by.weight;
    sum_up(partial);
    double sum = 0;
    ParameterEffect of_parameters = effect;
    of_parameters.joints.clear();  // they act by the motion alone
    sum += along(partial, of_parameters);
    for (int i = 0; i < network_.nodes(); ++i) sum += partial.slopes.by_state[i].dot(moved[i]);
    for (const MeasureSlopes::AtNode& r : partial.slopes.reaction) sum += r.weight.dot(pulled[r.node] + change[r.node]);
    out.push_back(sum);
  }
  return out;
}

/// Sums the derivatives by segments and vertices to those by parts and breaks.
void Sensitivity::sum_up(Adjoint& adjoint) const {
  for (int k = 0; k < network_.rods(); ++k) {
    const RodSlopes& slopes = adjoint.slopes.by_rod[k];
    std::vector<SegmentChange> parts(network_.rod(k).problem().rod.parts.size());
    std::vector<double> by_vertex = slopes.places;
    for (int i = 0; i < rods_[k].segments(); ++i) {
      parts[parts_[k][i]] += slopes.segments[i];
      by_vertex[i] -= slopes.segments[i].length;
      by_vertex[i + 1] += slopes.segments[i].length;
    }
    std::vector<double> breaks(breaks_[k].size(), 0.0);
    for (int b = 0; b < static_cast<int>(breaks.size()); ++b)
      for_followers(breaks_[k], b, network_.rod(k).mesh().s, [&](int v, double share) { breaks[b] += share * by_vertex[v]; });
    adjoint.by_part.push_back(std::move(parts));
    adjoint.by_break.push_back(std::move(breaks));
  }
}

Sensitivity::Adjoint Sensitivity::adjoint_of(MeasureSlopes slopes) const {
  Adjoint out;
  std::vector<Vec6> joined = slopes.by_state;
  network_.join_gradient(state_, joined);
  std::vector<Vec6> x = joined, weights(network_.nodes(), Vec6::Zero());
  for (const MeasureSlopes::AtNode& r : slopes.reaction) weights[r.node] += r.weight;
  for (const HeldRow& row : held_rows_) x[row.other] += row.block.transpose() * weights[row.node];
  clear_held(x);
  solve(x, true);
  for (int i = 0; i < network_.nodes(); ++i) x[i] -= weights[i];
  network_.complete(state_, x);
  out.by_motion = rows_times(x);
  for (int i = 0; i < network_.nodes(); ++i) out.by_motion[i] = joined[i] - out.by_motion[i];
  for (const MeasureSlopes::AtNode& m : slopes.by_motion) out.by_motion[m.node] += m.weight;
  // m_p - mu . g_p for all that the rods are made of.
  std::vector<Vec6> minus(network_.nodes());
  for (int i = 0; i < network_.nodes(); ++i) minus[i] = -x[i];
  for (int k = 0; k < network_.rods(); ++k) {
    const int first = network_.first_node(k);
    rods_[k].add_work(minus.data() + first, slopes.by_rod[k]);
    const std::vector<double>& s = network_.rod(k).mesh().s;
    if (const ContactTerms* contacts = contacts_ ? contacts_->of_rod(k) : nullptr)
      add_contact_work(*contacts, s, shape_of(k), std::span(minus).subspan(first, s.size()), slopes.by_rod[k]);
  }
  out.slopes = std::move(slopes);
  out.state = std::move(x);
  sum_up(out);
  return out;
}

double Sensitivity::along(const Adjoint& adjoint, const ParameterEffect& effect) const {
  double sum = 0;
  for (const ParameterEffect::PartChange& part : effect.parts) sum += adjoint.by_part[effect.rod][part.part].dot(part.change);
  for (const ParameterEffect::PlaceMove& move : effect.places)
    sum += move.by * adjoint.by_break[effect.rod][break_at(breaks_[effect.rod], move.vertex)];
  if (effect.shape_stays && network_.rod(effect.rod).problem().rod.shape) {
    const std::vector<double>& s = network_.rod(effect.rod).mesh().s;
    const std::vector<double> places = place_changes(effect, breaks_[effect.rod], s);
    for (std::size_t i = 0; i + 1 < s.size(); ++i)
      sum += adjoint.slopes.by_rod[effect.rod].segments[i].rate.dot(
          rate_along_shape(network_.rod(effect.rod).problem().rod, s[i], s[i + 1], places[i], places[i + 1]));
  }
  for (const RodSlopes& slopes : adjoint.slopes.by_rod) sum += slopes.gravity.dot(effect.gravity);
  for (const ParameterEffect::AtNode& load : effect.loads) {
    const Vec6& mu = adjoint.state[load.node];
    sum += mu.head<3>().dot(load.change.head<3>()) +
           Vec3(mu.tail<3>()).dot(state_.q[load.node].conjugate() * Vec3(load.change.tail<3>()));
    for (const MeasureSlopes::AtNode& by : adjoint.slopes.by_load)
      if (by.node == load.node) sum += by.weight.dot(load.change);
  }
  for (const ParameterEffect::AtNode& motion : effect.motions) sum += adjoint.by_motion[motion.node].dot(motion.change);
  for (const ParameterEffect::AtJoint& joint : effect.joints) sum += along_joint(adjoint, joint);
  return sum;
}

/// A section that moves against its branch point: m_q . eps - mu . (K eps) - mu_branch . (change of T)^T g.
double Sensitivity::along_joint(const Adjoint& adjoint, const ParameterEffect::AtJoint& joint) const {
  const std::vector<Vec6>& mu = adjoint.state;
  const Vec6 moved = motion_against(joint, state_);
  const Vec3 turn = joint.change.tail<3>(), own = mu[joint.section].tail<3>(), at_branch = mu[joint.branch].tail<3>();
  const Vec3 force = gradient_[joint.section].head<3>(), couple = gradient_[joint.section].tail<3>();
  double sum = (adjoint.slopes.by_state[joint.section] - section_row_times(joint.section, mu)).dot(moved);
  sum -= own.dot(0.5 * couple.cross(turn) - 0.5 * moment_on(joint.section).cross(turn));
  sum -= at_branch.dot(Vec3(joint.change.head<3>()).cross(state_.q[joint.branch].conjugate() * force));
  sum -= own.dot(turn.cross(couple));
  return sum;
}

std::vector<double> Sensitivity::gradient(const Measure& of, std::span<const Parameter> parameters) const {
  if (!ok_) return nothing_known(parameters.size());
  const Adjoint adjoint = adjoint_of(measure(of));
  std::vector<double> out;
  out.reserve(parameters.size());
  for (const Parameter& parameter : parameters) out.push_back(along(adjoint, effect_of(parameter, network_)));
  return out;
}

}  // namespace tendril
