#include "statics/contact_set.h"

#include <algorithm>
#include <cmath>

namespace tendril {

ContactSet::ContactSet(const FieldAlong& field, std::vector<ContactPoint> points, double horizon)
    : field_(field),
      points_(std::move(points)),
      horizon_(horizon),
      x_(points_.size(), Vec3::Zero()),
      known_(points_.size()),
      shift_(points_.size(), 0.0),
      excluded_(points_.size(), 0),
      first_cover_(points_.size() + 1, 0),
      was_active_(points_.size(), 0),
      active_(points_.size(), -1),
      predicted_(points_.size(), Vec3::Zero()) {
  for (const ContactPoint& p : points_) own_field_.push_back(&field_.at(p.s));
}

/// Looks up the distance when what is known does not settle the matter.
bool ContactSet::out_of_reach(int i, const Vec3& x) {
  const double needed = reach(i);
  if (distance_bound(i, x) >= needed) return true;
  if (was_active_[i]) return false;  // most likely still in contact: its terms will tell the distance
  double limit = needed + horizon_;
  if (i > 0 && own_field_[i] == own_field_[i - 1]) {
    // A neighbour in the open vouches for this point, and otherwise bounds the search.
    const double apart = (x - x_[i - 1]).norm() + std::abs(points_[i].keep - points_[i - 1].keep);
    const double neighbour = distance_bound(i - 1, x_[i - 1]);
    if (neighbour - apart >= needed + 2 * points_[i].radius) {
      known_[i] = {x, neighbour - apart};
      return true;
    }
    if (known_[i - 1].at == x_[i - 1] && neighbour > 0) limit = std::min(limit, 1.0001 * (neighbour + apart) + needed);
  }
  ++queries_;
  known_[i] = {x, own_field_[i]->closest_kept(x, limit, points_[i].keep).distance};
  return known_[i].distance >= needed;
}

double ContactSet::evaluate(const std::vector<Vec3>& x) {
  contacts_.clear();
  double energy = 0;
  const int n = size();
  for (int i = 0; i < n; ++i) {
    active_[i] = -1;
    x_[i] = x[i];
    if (excluded_[i]) continue;
    if (!all_finite(x[i])) return std::numeric_limits<double>::infinity();
    if (out_of_reach(i, x[i])) {
      was_active_[i] = 0;
      continue;
    }
    terms_.clear();
    ++queries_;
    own_field_[i]->terms_kept(x[i], reach(i), points_[i].keep, terms_);
    double nearest = std::numeric_limits<double>::infinity();
    for (const DistanceTerm& t : terms_) nearest = std::min(nearest, t.distance);
    if (covered(i)) leave_out_covered(i);
    const PointContact c = contact_at(terms_, reach(i), points_[i].weight, law);
    was_active_[i] = nearest < reach(i);
    if (was_active_[i]) {
      known_[i] = {x[i], nearest};
    } else if (known_[i].at != x[i]) {
      ++queries_;
      known_[i] = {x[i], own_field_[i]->closest_kept(x[i], reach(i) + horizon_, points_[i].keep).distance};
    }
    if (!(c.distance < reach(i))) continue;
    active_[i] = static_cast<int>(contacts_.size());
    contacts_.push_back(c);
    energy += c.energy;
  }
  return energy;
}

void ContactSet::cover(const std::vector<Cover>& covers) {
  covers_ = covers;
  std::size_t next = 0;
  for (int i = 0; i < size(); ++i) {
    first_cover_[i] = static_cast<int>(next);
    while (next < covers_.size() && covers_[next].point == i) ++next;
  }
  first_cover_[size()] = static_cast<int>(next);
}

void ContactSet::leave_out_covered(int i) {
  std::erase_if(terms_, [&](const DistanceTerm& t) {
    for (int k = first_cover_[i]; k < first_cover_[i + 1]; ++k)
      if (faces(t, covers_[k].direction)) return true;
    return false;
  });
}

void ContactSet::add_to(const VertexShape& shape, Geometry geometry, BlockView system) const {
  for (int i = 0; i < size(); ++i) {
    const PointContact* c = at(i);
    if (!c) continue;
    double share = 1;
    if (geometry == Geometry::predicted) {
      const double size2 = c->gradient.squaredNorm();
      share = size2 > 0 ? std::clamp(predicted_[i].dot(c->gradient) / size2, 0.0, 1.0) : 0.0;
    }
    const Mat3 hessian = c->material + share * c->curvature;
    add_point_energy(points_[i], shape, c->gradient, hessian, share * c->gradient, system);
  }
}

void ContactSet::predict(const VertexShape& shape, std::span<const Vec6> step, double share) {
  for (int i = 0; i < size(); ++i) {
    const PointContact* c = at(i);
    if (!c) {
      predicted_[i].setZero();
      continue;
    }
    const Vec3 dx = share * displacement_of(points_[i], shape, step);
    predicted_[i] = c->gradient + c->material * dx;
  }
}

void ContactSet::predict_standing() {
  for (int i = 0; i < size(); ++i) predicted_[i] = at(i) ? at(i)->gradient : Vec3::Zero();
}

void ContactSet::forget_prediction() { std::fill(predicted_.begin(), predicted_.end(), Vec3::Zero()); }

void ContactSet::update_shifts(const std::vector<double>& beside) {
  for (int i = 0; i < size(); ++i) {
    if (excluded_[i]) continue;
    // Out of reach means distance >= radius + shift, for which the rule gives zero, but for what lies beside.
    const PointContact* c = at(i);
    shift_[i] = c ? std::max(0.0, reach(i) - c->distance + beside[i]) : beside[i];
  }
}

ContactSet::Nearest ContactSet::nearest(int i, double range) {
  if (const PointContact* c = at(i)) return {c->distance, c->normal, c->obstacle};
  Nearest nearest;
  if (distance_bound(i, x_[i]) >= range) return nearest;
  ++queries_;
  if (!covered(i)) {
    // One closest point is far cheaper than all that lies within the range.
    const ClosestPoint c = own_field_[i]->closest_kept(x_[i], range, points_[i].keep);
    const double from_surface = c.obstacle < 0 ? 0 : c.distance + thickness(i, c.obstacle);
    if (from_surface != 0) nearest = {c.distance, (x_[i] - c.point) / from_surface, c.obstacle};
    return nearest;
  }
  terms_.clear();
  own_field_[i]->terms_kept(x_[i], range, points_[i].keep, terms_);
  leave_out_covered(i);
  for (const DistanceTerm& t : terms_)
    if (t.distance < nearest.distance) nearest = {t.distance, t.normal, t.obstacle};
  return nearest;
}

double ContactSet::deepest() const {
  double deepest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < size(); ++i)
    if (const PointContact* c = at(i)) deepest = std::max(deepest, points_[i].radius - c->distance);
  return deepest;
}

}  // namespace tendril
