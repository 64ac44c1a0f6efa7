#include "statics/contact_terms.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tendril {

namespace {

constexpr int most_stiffenings = 4;     // springs against blockades within one Newton step
constexpr double nearly_through = 0.35; // radii
constexpr double cut = 0.7;             // a guarded share below this counts towards the early end
constexpr int finer = 4;                // looks between two contact points when the overlap is judged
constexpr double sharp_enough = 0.6;    // curvature of the distance along the rod times the radius: an edge has 1
constexpr double covered_side = 0.75;   // radii to both sides of a sliding point that it stands for: at an edge a fixed
                                        // point there is at least a quarter of the radius off
constexpr double flat_enough = 0.3;     // below this a sliding point gives its force back to the fixed ones

std::vector<double> held_places(const RodSystem& system, const std::vector<double>& also_held) {
  std::vector<double> held = also_held;
  const RodProblem& problem = system.problem();
  for (std::size_t i = 0; i < problem.holds.size(); ++i)
    if (problem.holds[i].position) held.push_back(system.mesh().s[system.mesh().hold_vertex[i]]);
  return held;
}

std::vector<SparedStretch> spared_stretches(const RodSystem& system) {
  std::vector<SparedStretch> spared;
  for (const Fastening& one : system.problem().fastenings) {
    const double s = system.mesh().s[system.mesh().hold_vertex[one.hold]];
    spared.push_back({one.obstacle, s - one.reach, s + one.reach});
  }
  return spared;
}

std::vector<double> radii_of(const RodMesh& mesh) {
  std::vector<double> radii;
  for (const MeshSegment& segment : mesh.segments) radii.push_back(segment.section.radius());
  return radii;
}

/// The lowest place of the cubic with given values and slopes at the ends of an interval of length h.
struct Dip {
  double share = 0;                                            ///< 0 ... 1
  double distance = std::numeric_limits<double>::infinity();   ///< m; infinite when the lowest place is an end
  double curvature = 0;                                        ///< of the parabola from there to the ends, 1/m
};

Dip dip_between(double da, double slope_a, double db, double slope_b, double h) {
  if (slope_a >= 0 || slope_b <= 0) return {};
  const auto at = [&](double x) {
    const double y = 1 - x;
    return (1 + 2 * x) * y * y * da + x * x * (3 - 2 * x) * db + h * x * y * (y * slope_a - x * slope_b);
  };
  // The slope changes its sign once from minus to plus: halving finds where.
  const auto slope = [&](double x) {
    return 6 * x * (1 - x) * (db - da) / h + (1 - x) * (1 - 3 * x) * slope_a + x * (3 * x - 2) * slope_b;
  };
  double low = 0, high = 1;
  for (int k = 0; k < 12; ++k) (slope(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
  const double x = 0.5 * (low + high), d = at(x);
  return {x, d, 2 * (da + db - 2 * d) / (h * h * (x * x + (1 - x) * (1 - x)))};
}

/// Overlap whose force per length is `force`: the inverse of the law's slope.
double overlap_under(const ContactLaw& law, double force) {
  const ContactLaw::Value knee = law.at(law.knee);
  if (force <= knee.slope) return std::pow(force / (2.5 * law.stiffness), 2.0 / 3.0);
  return law.knee + (force - knee.slope) / knee.curvature;
}

}  // namespace

ContactTerms::ContactTerms(const RodSystem& system, Element element, int first_node, ClearanceRule clearance,
                           const std::vector<double>& also_held)
    : system_(&system),
      element_(element),
      first_(first_node),
      radii_(radii_of(system.mesh())),
      held_s_(held_places(system, also_held)),
      keep_(clearance == ClearanceRule::push ? system.problem().surroundings->largest_clearance() : 0),
      field_(*system.problem().surroundings, spared_stretches(system)),
      set_(field_, placed_points(), 0.25 * system.length()),
      sliding_(field_, system.mesh().s, radii_, element, keep_),
      guard_(set_) {
  for (int i = 0; i < set_.size(); ++i)
    if (way_to_hold(set_.points()[i].s) <= set_.points()[i].radius * (1 + 1e-9)) set_.exclude(i);
}

std::vector<ContactPoint> ContactTerms::placed_points() const {
  std::vector<ContactPoint> points = contact_points(system_->mesh().s, radii_, element_);
  for (ContactPoint& p : points) p.keep = kept(p.s, p.radius);
  return points;
}

double ContactTerms::kept(double s, double radius) const {
  return keep_ == 0 ? 0.0 : std::min(keep_, kept_at(way_to_hold(s), radius));
}

/// Where the clearance still grows a point that slides would have to climb: fixed ones alone make up contact there.
bool ContactTerms::grows(int i, int obstacle) const {
  return obstacle >= 0 && set_.points()[i].keep < set_.field().clearance(obstacle) && keep_ > 0;
}

bool ContactTerms::pressed_near_hold() const {
  for (int i = 0; i < set_.size(); ++i)
    if (const PointContact* c = set_.at(i); c && !c->gradient.isZero(0) && grows(i, c->obstacle)) return true;
  return false;
}

VertexShape ContactTerms::shape_of(const RodState& state) const {
  const std::size_t n = system_->nodes();
  return {{state.r.data() + first_, n}, {state.q.data() + first_, n}};
}

std::span<const Vec6> ContactTerms::own(const std::vector<Vec6>& step) const {
  return {step.data() + first_, static_cast<std::size_t>(system_->nodes())};
}

double ContactTerms::way_to_hold(double s) const {
  double way = std::numeric_limits<double>::infinity();
  for (const double held : held_s_) way = std::min(way, std::abs(s - held));
  return way;
}

double ContactTerms::stand_at(const RodState& state) {
  positions_of(set_.points(), shape_of(state), x_);
  if (standing_ && x_ == set_.positions()) return energy_;
  energy_ = std::all_of(x_.begin(), x_.end(), [](const Vec3& x) { return all_finite(x); }) ? evaluate(shape_of(state)) : INFINITY;
  standing_ = true;
  return energy_;
}

/// Sliding points first: where one of them presses it stands for the fixed points beside it.
double ContactTerms::evaluate(const VertexShape& shape) {
  const double sliding = sliding_.evaluate(shape, set_.law);
  covers_.clear();
  for (const SlidingContacts::Point& p : sliding_.points()) {
    if (!p.active) continue;
    const double side = covered_side * p.at.radius;
    const int before = point_before(p.at.s);
    for (int i = before; i >= 0 && p.at.s - set_.points()[i].s < side; --i) covers_.push_back({i, p.direction});
    for (int i = before + 1; i < set_.size() && set_.points()[i].s - p.at.s < side; ++i) covers_.push_back({i, p.direction});
  }
  std::stable_sort(covers_.begin(), covers_.end(),
                   [](const ContactSet::Cover& a, const ContactSet::Cover& b) { return a.point < b.point; });
  set_.cover(covers_);
  return sliding + set_.evaluate(x_);
}

void ContactTerms::begin(const RodState& state) {
  stand_at(state);
  guard_.start();
  set_.predict_standing();
  sliding_.predict_standing();
  standing_ = false;  // the law may have changed
  cut_short_ = stiffened_ = 0;
  springs_.clear();
  blockades_.clear();
}

double ContactTerms::assemble(const RodState& state, Stress stress, BlockSystem& system) {
  track_edges(state);
  stand_at(state);
  guard_.accept();
  if (stress == Stress::zero) {
    set_.forget_prediction();
    sliding_.forget_prediction();
  }
  add_to(state, exact_, system);
  const VertexShape shape = shape_of(state);
  for (const Blockade& b : springs_) {
    const MeshSegment& segment = system_->mesh().segments[set_.points()[b.point].segment];
    add_blockade_springs(set_, shape, {b}, 10 * segment.section.EA / segment.length, BlockView(system, first_));
  }
  return energy_;
}

void ContactTerms::add_to(const RodState& state, bool exact, BlockSystem& system) {
  stand_at(state);
  const VertexShape shape = shape_of(state);
  set_.add_to(shape, exact ? ContactSet::Geometry::full : ContactSet::Geometry::predicted, BlockView(system, first_));
  sliding_.add_to(shape, exact, BlockView(system, first_));
}

double ContactTerms::energy(const RodState& state) { return stand_at(state); }

double ContactTerms::allowed(const RodState& state, const std::vector<Vec6>& step, double share) {
  stand_at(state);
  GuardedStep guarded = guard_.admit(shape_of(state), own(step), share);
  blockades_ = std::move(guarded.blockades);
  if (early_end_) {
    double nearest = 1;
    for (int i = 0; i < set_.size(); ++i)
      if (set_.at(i)) nearest = std::min(nearest, set_.surface_distance(i) / set_.points()[i].radius);
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
  set_.predict(shape_of(before), own(step), share);
  sliding_.predict(shape_of(before), own(step), share);
}

/// The fixed points and the sliding ones between them, in the order of the rod.
void ContactTerms::list_stations() {
  stations_.clear();
  auto sliding = sliding_.points().begin();
  const auto end = sliding_.points().end();
  for (int i = 0; i < set_.size(); ++i) {
    const ContactPoint& p = set_.points()[i];
    for (; sliding != end && sliding->at.s < p.s; ++sliding)
      if (sliding->active && i > 0)
        stations_.push_back({sliding->at.s, i - 1, true, sliding->at.radius - sliding->contact.distance, sliding->contact.obstacle});
    const PointContact* c = set_.at(i);
    stations_.push_back({p.s, i, set_.covered(i), c ? p.radius - c->distance : -INFINITY, c ? c->obstacle : -1});
  }
}

/// The deepest overlap between two neighbouring stations, themselves left out unless they are covered.
ContactTerms::Deepest ContactTerms::deepest_between(const Station& low, const Station& high, const VertexShape& shape) const {
  const int i = low.point;
  Deepest deepest;
  if (i + 1 >= set_.size() || set_.excluded(i) || set_.excluded(i + 1)) return deepest;
  const double reach = set_.points()[i].radius;
  const Vec3 &xa = set_.positions()[i], &xb = set_.positions()[i + 1];
  // No place between the two points is nearer than this.
  const double apart = (xb - xa).norm();
  if (set_.distance_bound(i, xa) > reach + apart || set_.distance_bound(i + 1, xb) > reach + apart) return deepest;
  const RodMesh& mesh = system_->mesh();
  const int segment = set_.points()[i].segment;
  const auto overlap_at = [&](double s) {
    ContactPoint p = contact_point_at(mesh.s, radii_, element_, segment, (s - mesh.s[segment]) / mesh.segments[segment].length);
    p.radius = reach;
    p.keep = kept(s, reach);
    const Vec3 position = position_of(p, shape);
    const ClosestPoint c = field_.at(s).closest_kept(position, 2 * reach + apart, p.keep);
    if (reach - c.distance > deepest.penetration) deepest = {reach - c.distance, c.obstacle, p, (position - c.point).normalized()};
    return reach - c.distance;
  };
  const double part = (high.s - low.s) / finer;
  std::array<double, finer + 1> looks;
  looks.front() = std::isfinite(low.overlap) ? low.overlap : overlap_at(low.s);
  looks.back() = std::isfinite(high.overlap) ? high.overlap : overlap_at(high.s);
  for (int k = 1; k < finer; ++k) looks[k] = overlap_at(low.s + k * part);
  // An edge midway between two looks pokes (part / 2)^2 / (2 reach) deeper than they tell.
  const int best = static_cast<int>(std::max_element(looks.begin(), looks.end()) - looks.begin());
  if (looks[best] <= -part * part / (4 * reach) || best == 0 || best == finer) return deepest;
  // The vertex of the parabola through the best look and its neighbours.
  const double fall = 2 * looks[best] - looks[best - 1] - looks[best + 1];
  const double aside = fall > 0 ? std::clamp(0.5 * (looks[best + 1] - looks[best - 1]) / fall, -1.0, 1.0) : 0.0;
  if (std::abs(aside) > 1e-3) overlap_at(low.s + (best + aside) * part);
  return deepest;
}

Vec3 ContactTerms::position_at(double s, const RodState& state) const {
  const std::vector<double>& at = system_->mesh().s;
  const auto after = std::upper_bound(at.begin(), at.end(), s);
  const int segment = std::clamp(static_cast<int>(after - at.begin()) - 1, 0, static_cast<int>(at.size()) - 2);
  const double share = std::clamp((s - at[segment]) / (at[segment + 1] - at[segment]), 0.0, 1.0);
  return position_of(contact_point_at(at, radii_, element_, segment, share), shape_of(state));
}

ContactTerms::Deepest ContactTerms::deepest_at(const RodState& state) {
  stand_at(state);
  const VertexShape shape = shape_of(state);
  list_stations();
  Deepest deepest;
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    const Station& here = stations_[k];
    if (here.overlap > deepest.penetration) {
      deepest.penetration = here.overlap;
      deepest.obstacle = here.obstacle;
      deepest.point = set_.points()[here.point];
      deepest.point.s = here.s;
    }
    if (k + 1 == stations_.size()) break;
    const Deepest between = deepest_between(here, stations_[k + 1], shape);
    if (between.penetration > deepest.penetration) deepest = between;
  }
  return deepest;
}

/// Where an edge pokes between two points a sliding point follows it from now on, and takes over what they have of shift.
void ContactTerms::track_edges(const RodState& state) {
  stand_at(state);
  const VertexShape shape = shape_of(state);
  bool changed = sliding_.tidy();
  std::vector<double> shifts = set_.shifts();
  const auto give_back = [&](const std::vector<SlidingContacts::Point>& taken) {
    for (const SlidingContacts::Point& p : taken) {
      const int i = point_before(p.at.s);
      for (int k : {i, i + 1}) shifts[k] = std::max(shifts[k], 0.5 * p.shift);
      changed = true;
    }
  };
  give_back(sliding_.take_flat(flat_enough, shape));
  if (keep_ > 0) give_back(sliding_.take_near_holds([&](double s) { return kept(s, set_.points()[point_before(s)].radius); }));
  ContactSet::Nearest at_a, at_b;
  Vec3 tangent_b = Vec3::Zero();
  bool known = false;  // of point i, from the interval before
  for (int i = 0; i + 1 < set_.size(); ++i) {
    const ContactPoint &a = set_.points()[i], &b = set_.points()[i + 1];
    const double h = b.s - a.s, range = a.radius + 0.5 * h;
    if (set_.excluded(i) || set_.excluded(i + 1) ||
        (set_.distance_bound(i, set_.positions()[i]) >= range && set_.distance_bound(i + 1, set_.positions()[i + 1]) >= range)) {
      known = false;
      continue;
    }
    at_a = known ? at_b : set_.nearest(i, 2 * range);
    const Vec3 tangent_a = position_of(slope_of(a, system_->mesh().s, element_), shape);
    at_b = set_.nearest(i + 1, 2 * range);
    tangent_b = position_of(slope_of(b, system_->mesh().s, element_), shape);
    known = true;
    if (!std::isfinite(at_a.distance) || !std::isfinite(at_b.distance)) continue;
    if (grows(i, at_a.obstacle) || grows(i + 1, at_b.obstacle)) continue;
    const Dip dip = dip_between(at_a.distance, at_a.normal.dot(tangent_a), at_b.distance, at_b.normal.dot(tangent_b), h);
    if (dip.distance >= a.radius || a.radius * dip.curvature < sharp_enough) continue;
    const Vec3 direction = (at_a.normal + at_b.normal).normalized();
    if (!all_finite(direction)) continue;
    sliding_.add(a.s + dip.share * h, h, std::max(shifts[i], shifts[i + 1]), direction);
    shifts[i] = shifts[i + 1] = 0;
    changed = true;
  }
  if (!changed) return;
  set_.set_shifts(shifts);
  energy_ = evaluate(shape);
  sliding_.predict_standing();
}

void ContactTerms::update_shifts(const RodState& state, double most) {
  stand_at(state);
  const VertexShape shape = shape_of(state);
  list_stations();
  std::vector<double>& beside = beside_;
  beside.assign(set_.size(), 0.0);
  std::vector<Deepest> further_edges;
  for (std::size_t k = 0; k + 1 < stations_.size(); ++k) {
    const Station &low = stations_[k], &high = stations_[k + 1];
    const Deepest between = deepest_between(low, high, shape);
    if (between.penetration <= std::max(low.overlap, high.overlap)) continue;
    if (low.covered || high.covered) {
      if (between.penetration > most * between.point.radius && !grows(low.point, between.obstacle)) further_edges.push_back(between);
      continue;
    }
    if (!set_.at(low.point) && !set_.at(high.point) && between.penetration > 0) {
      // An obtuse edge or a bump between two points that both stand clear of it: nothing would hold the rod there.
      for (const int i : {low.point, high.point}) {
        const double radius = set_.points()[i].radius, distance = set_.nearest(i, 3 * radius).distance;
        if (std::isfinite(distance)) beside[i] = std::max(beside[i], between.penetration + std::max(0.0, distance - radius));
      }
      continue;
    }
    if (set_.at(low.point)) beside[low.point] = std::max(beside[low.point], between.penetration - low.overlap);
    if (set_.at(high.point)) beside[high.point] = std::max(beside[high.point], between.penetration - high.overlap);
  }
  sliding_.update_shifts();
  set_.update_shifts(beside);
  for (const Deepest& edge : further_edges) sliding_.add(edge.point.s, edge.point.radius, edge.penetration, edge.normal);
  standing_ = false;
}

/// The last point before an arc length that has one after it.
int ContactTerms::point_before(double s) const {
  const std::vector<ContactPoint>& points = set_.points();
  const auto after = std::upper_bound(points.begin(), points.end(), s, [](double at, const ContactPoint& p) { return at < p.s; });
  return std::clamp(static_cast<int>(after - points.begin()) - 1, 0, set_.size() - 2);
}

double ContactTerms::widest_gap(const RodState& state) {
  stand_at(state);
  double widest = 0;
  for (int i = 0; i < set_.size(); ++i)
    if (const PointContact* c = set_.at(i)) widest = std::max(widest, c->distance - set_.points()[i].radius - beside_[i]);
  for (const SlidingContacts::Point& p : sliding_.points())
    if (p.active) widest = std::max(widest, p.contact.distance - p.at.radius);
  return widest;
}

void ContactTerms::harden(double factor) {
  const ContactLaw before = set_.law;
  set_.law.stiffness *= factor;
  const auto same_force = [&](double shift) { return overlap_under(set_.law, before.at(shift).slope); };
  std::vector<double> shifts = set_.shifts();
  for (int i = 0; i < set_.size(); ++i)
    if (shifts[i] > beside_[i]) shifts[i] = beside_[i] + same_force(shifts[i] - beside_[i]);
  set_.set_shifts(shifts);
  sliding_.change_shifts(same_force);
  standing_ = false;
}

void ContactTerms::forget_forces() {
  set_.set_shifts(std::vector<double>(set_.size(), 0.0));
  sliding_.clear();
  beside_.assign(set_.size(), 0.0);
  standing_ = false;
}

void ContactTerms::take_forces(const std::vector<ContactForce>& forces) {
  forget_forces();
  const std::vector<ContactPoint>& points = set_.points();
  const double length = points.back().s;
  std::vector<double> shifts(points.size(), 0.0);
  for (const ContactForce& contact : forces) {
    const auto after = std::lower_bound(points.begin(), points.end(), contact.s - 1e-9 * length,
                                        [](const ContactPoint& p, double s) { return p.s < s; });
    if (after == points.end()) continue;
    const double force = contact.force.norm();
    if (after == points.begin() || after->s <= contact.s + 1e-9 * length) {
      shifts[after - points.begin()] = overlap_under(set_.law, force / after->weight);
    } else {
      const double apart = after->s - (after - 1)->s;
      if (force > 0) sliding_.add(contact.s, apart, overlap_under(set_.law, force / apart), contact.force / force);
    }
  }
  set_.set_shifts(shifts);
}

}  // namespace tendril
