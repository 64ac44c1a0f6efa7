#include "statics/contact_terms.h"

#include <algorithm>
#include <cmath>

namespace tendril {

namespace {

constexpr int most_stiffenings = 4;     // springs against blockades within one Newton step
constexpr double nearly_through = 0.35; // radii
constexpr double cut = 0.7;             // a guarded share below this counts towards the early end
constexpr int refinement = 4;           // parts of an interval that is refined
constexpr int finer = 4;                // looks between two contact points when the overlap is judged

VertexShape shape_of(const RodState& state) { return {state.r, state.q}; }

}  // namespace

ContactTerms::ContactTerms(const RodSystem& system, Element element) : system_(&system), element_(element) {
  const RodMesh& mesh = system.mesh();
  for (const MeshSegment& segment : mesh.segments) radii_.push_back(segment.section.radius());
  const RodProblem& problem = system.problem();
  for (std::size_t i = 0; i < problem.holds.size(); ++i)
    if (problem.holds[i].position) held_s_.push_back(mesh.s[mesh.hold_vertex[i]]);
  std::vector<ContactPoint> points = contact_points(mesh.s, radii_, element_);
  const std::vector<double> shifts(points.size(), 0.0);
  replace_set(std::move(points), shifts);
}

bool ContactTerms::near_hold(double s, double radius) const {
  return std::any_of(held_s_.begin(), held_s_.end(),
                     [&](double held) { return std::abs(s - held) <= radius * (1 + 1e-9); });
}

void ContactTerms::replace_set(std::vector<ContactPoint> points, const std::vector<double>& shifts) {
  const ContactLaw law = set_ ? set_->law : ContactLaw{};
  set_ = std::make_unique<ContactSet>(*system_->problem().surroundings, std::move(points), 0.25 * system_->length());
  set_->law = law;
  set_->set_shifts(shifts);
  for (int i = 0; i < set_->size(); ++i)
    if (near_hold(set_->points()[i].s, set_->points()[i].radius)) set_->exclude(i);
  guard_ = std::make_unique<ContactGuard>(*set_);
  standing_ = false;
}

double ContactTerms::stand_at(const RodState& state) {
  positions_of(set_->points(), shape_of(state), x_);
  if (standing_ && x_ == set_->positions()) return energy_;
  energy_ = set_->evaluate(x_);
  standing_ = true;
  return energy_;
}

void ContactTerms::begin(const RodState& state) {
  stand_at(state);
  guard_->start();
  set_->predict_standing();
  standing_ = false;  // the law may have changed
  cut_short_ = stiffened_ = 0;
  springs_.clear();
  blockades_.clear();
}

double ContactTerms::assemble(const RodState& state, Stress stress, BlockSystem& system) {
  const double energy = stand_at(state);
  guard_->accept();
  if (stress == Stress::zero) set_->forget_prediction();
  const VertexShape shape = shape_of(state);
  set_->add_to(shape, exact_ ? ContactSet::Geometry::full : ContactSet::Geometry::predicted, system);
  for (const Blockade& b : springs_) {
    const MeshSegment& segment = system_->mesh().segments[set_->points()[b.point].segment];
    add_blockade_springs(*set_, shape, {b}, 10 * segment.section.EA / segment.length, system);
  }
  return energy;
}

double ContactTerms::energy(const RodState& state) { return stand_at(state); }

double ContactTerms::allowed(const RodState& state, const std::vector<Vec6>& step, double share) {
  stand_at(state);
  GuardedStep guarded = guard_->admit(shape_of(state), step, share);
  blockades_ = std::move(guarded.blockades);
  if (early_end_) {
    double nearest = 1;
    for (int i = 0; i < set_->size(); ++i)
      if (const PointContact* c = set_->at(i)) nearest = std::min(nearest, c->distance / set_->points()[i].radius);
    cut_short_ = nearest < nearly_through && guarded.share < cut * share ? cut_short_ + 1 : 0;
    if (cut_short_ >= 3) return 0;
  }
  return guarded.share;
}

bool ContactTerms::stiffen(const RodState&, const std::vector<Vec6>&, double) {
  // Descent measures its steps by the slope of the energy, which the springs would falsify.
  if (exact_ || blockades_.empty() || stiffened_ >= most_stiffenings) return false;
  ++stiffened_;
  for (const Blockade& b : blockades_) {
    const auto same = std::find_if(springs_.begin(), springs_.end(), [&](const Blockade& s) { return s.point == b.point; });
    if (same == springs_.end())
      springs_.push_back(b);
    else
      *same = b;
  }
  return true;
}

void ContactTerms::stepped(const RodState& before, const std::vector<Vec6>& step, double share) {
  springs_.clear();
  stiffened_ = 0;
  if (exact_) return;
  stand_at(before);
  set_->predict(shape_of(before), step, share);
}

ContactTerms::Deepest ContactTerms::deepest_between(int i, const VertexShape& shape) const {
  const ContactPoint &a = set_->points()[i], &b = set_->points()[i + 1];
  const double reach = a.radius;
  Deepest deepest;
  const Vec3 &xa = set_->positions()[i], &xb = set_->positions()[i + 1];
  // No place between the two is nearer than this.
  const double apart = (xb - xa).norm();
  if (set_->distance_bound(i, xa) > reach + apart || set_->distance_bound(i + 1, xb) > reach + apart) return deepest;
  const RodMesh& mesh = system_->mesh();
  const double start = mesh.s[a.segment], h = mesh.segments[a.segment].length;
  const auto overlap_at = [&](double s) {
    ContactPoint p = contact_point_at(mesh.s, radii_, element_, a.segment, (s - start) / h);
    p.radius = reach;
    const ClosestPoint c = set_->field().closest(position_of(p, shape), 2 * reach + apart);
    if (reach - c.distance > deepest.penetration) deepest = {reach - c.distance, c.obstacle, p};
    return reach - c.distance;
  };
  const double part = (b.s - a.s) / finer;
  for (int k = 1; k < finer; ++k) overlap_at(a.s + k * part);
  if (deepest.penetration <= 0) return deepest;
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double low = std::max(a.s, deepest.point.s - part), high = std::min(b.s, deepest.point.s + part);
  for (int k = 0; k < 5; ++k) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    if (overlap_at(left) > overlap_at(right))
      high = right;
    else
      low = left;
  }
  return deepest;
}

ContactTerms::Deepest ContactTerms::deepest_at(const RodState& state) {
  stand_at(state);
  const VertexShape shape = shape_of(state);
  Deepest deepest;
  for (int i = 0; i < set_->size(); ++i) {
    const PointContact* c = set_->at(i);
    if (c && set_->points()[i].radius - c->distance > deepest.penetration)
      deepest = {set_->points()[i].radius - c->distance, c->obstacle, set_->points()[i]};
  }
  for (int i = 0; i + 1 < set_->size(); ++i) {
    if (set_->excluded(i) || set_->excluded(i + 1)) continue;
    const Deepest between = deepest_between(i, shape);
    if (between.penetration > deepest.penetration) deepest = between;
  }
  return deepest;
}

int ContactTerms::refine(const RodState& state, double most, double window) {
  stand_at(state);
  const VertexShape shape = shape_of(state);
  std::vector<int> intervals;
  for (int i = 0; i + 1 < set_->size(); ++i)
    if (!set_->excluded(i) && !set_->excluded(i + 1) &&
        deepest_between(i, shape).penetration > most * set_->points()[i].radius)
      intervals.push_back(i);
  const int added = refine_intervals(intervals, window);
  if (added > 0) stand_at(state);
  return added;
}

int ContactTerms::refine_around(const std::vector<double>& arc_lengths) {
  std::vector<int> intervals;
  const std::vector<ContactPoint>& points = set_->points();
  const double length = points.back().s;
  for (double s : arc_lengths) {
    const auto after = std::lower_bound(points.begin(), points.end(), s,
                                        [](const ContactPoint& p, double at) { return p.s < at; });
    if (after == points.begin() || after == points.end()) continue;
    if (after->s - s < 1e-9 * length || s - (after - 1)->s < 1e-9 * length) continue;
    intervals.push_back(static_cast<int>(after - points.begin()) - 1);
  }
  return refine_intervals(intervals, 1.5);
}

void ContactTerms::group_deep_points(const RodState& state, double most) {
  stand_at(state);
  const std::vector<ContactPoint>& points = set_->points();
  std::vector<char> grouped = set_->grouped();
  for (int i = 0; i < set_->size(); ++i) {
    const PointContact* c = set_->at(i);
    if (!c || points[i].radius - c->distance <= most * points[i].radius) continue;
    for (int j = i; j >= 0 && points[i].s - points[j].s <= 1.5 * points[i].radius; --j) grouped[j] = 1;
    for (int j = i; j < set_->size() && points[j].s - points[i].s <= 1.5 * points[i].radius; ++j) grouped[j] = 1;
  }
  set_->set_grouped(grouped);
  standing_ = false;
}

int ContactTerms::refine_intervals(const std::vector<int>& intervals, double radii) {
  if (intervals.empty()) return 0;
  const std::vector<ContactPoint>& old = set_->points();
  const int n = set_->size();
  std::vector<int> parts(n - 1, 1);
  for (int i : intervals) {
    // The neighbourhood as well: the rod may slide on before it rests.
    const double window = radii * old[i].radius, apart = old[i + 1].s - old[i].s;
    for (int j = i; j >= 0 && old[i].s - old[j + 1].s < window; --j)
      if (old[j + 1].s - old[j].s > 0.7 * apart) parts[j] = refinement;
    for (int j = i; j + 1 < n && old[j].s - old[i + 1].s < window; ++j)
      if (old[j + 1].s - old[j].s > 0.7 * apart) parts[j] = refinement;
  }
  std::vector<ContactPoint> points;
  std::vector<double> shifts;
  std::vector<char> grouped;
  const RodMesh& mesh = system_->mesh();
  for (int i = 0; i < n; ++i) {
    points.push_back(old[i]);
    shifts.push_back(set_->shifts()[i]);
    grouped.push_back(set_->grouped()[i] || (i > 0 && parts[i - 1] > 1) || (i + 1 < n && parts[i] > 1));
    if (i + 1 == n) break;
    const double start = mesh.s[old[i].segment], h = mesh.segments[old[i].segment].length;
    for (int k = 1; k < parts[i]; ++k) {
      const double share = double(k) / parts[i];
      const double s = old[i].s + share * (old[i + 1].s - old[i].s);
      points.push_back(contact_point_at(mesh.s, radii_, element_, old[i].segment, (s - start) / h));
      shifts.push_back((1 - share) * set_->shifts()[i] + share * set_->shifts()[i + 1]);
      grouped.push_back(1);
    }
  }
  const int added = static_cast<int>(points.size()) - n;
  set_trapezoid_weights(points);
  replace_set(std::move(points), shifts);
  set_->set_grouped(grouped);
  return added;
}

}  // namespace tendril
