#include "statics/contact_guards.h"

#include <algorithm>

namespace tendril {

namespace {

constexpr int most_trials = 12;       // shares tried before a step is given up
constexpr double smallest_cut = 0.05; // a single trial does not cut more: the next one looks again

}  // namespace

bool ContactGuard::crosses(int i, const std::vector<Vec3>& x) {
  const double half = 0.5 * (x[i + 1] - x[i]).norm();
  if (set_->distance_bound(i, x[i]) > half && set_->distance_bound(i + 1, x[i + 1]) > half) return false;
  ++rays_;
  return set_->field_after(i).ray(x[i], x[i + 1]).has_value();
}

void ContactGuard::start() {
  crossed_.assign(std::max(set_->size() - 1, 0), 0);
  for (int i : crossings()) crossed_[i] = 1;
}

std::vector<int> ContactGuard::crossings() {
  std::vector<int> found;
  for (int i = 0; i + 1 < set_->size(); ++i)
    if (pair_counts(i) && crosses(i, set_->positions())) found.push_back(i);
  return found;
}

void ContactGuard::accept() {
  for (std::size_t i = 0; i < crossed_.size(); ++i)
    if (crossed_[i]) crossed_[i] = crosses(static_cast<int>(i), set_->positions());
}

/// Share of the motion from the set's positions to `moved` that keeps every point on its side.
double ContactGuard::limit_by_points(const std::vector<Vec3>& moved, std::vector<Blockade>& blockades) {
  double limit = 1;
  for (int i = 0; i < set_->size(); ++i) {
    if (set_->excluded(i)) continue;
    const Vec3& x = set_->positions()[i];
    const Vec3 motion = moved[i] - x;
    const double length = motion.norm();
    const double bound = set_->distance_bound(i, x);
    const double margin = 0.5 * set_->points()[i].radius;
    if (length + margin <= bound || length == 0) continue;
    if (bound < 0 && set_->at(i) && set_->surface_distance(i) < 0) continue;  // inside a closed solid: the way out is free
    ++rays_;
    const auto hit = set_->field_at(i).ray(x, moved[i] + motion * (margin / length));
    if (!hit) continue;
    const double plane = hit->normal.dot(hit->point);
    const double before = hit->normal.dot(x) - plane;
    const double after = hit->normal.dot(moved[i]) - plane;
    const double keep = std::min(margin, 0.5 * before);
    if (after >= keep) continue;
    limit = std::min(limit, std::max(0.0, (before - keep) / (before - after)));
    blockades.push_back({i, hit->normal, plane});
  }
  return limit;
}

bool ContactGuard::slips_between(const std::vector<Vec3>& moved) {
  for (int i = 0; i + 1 < set_->size(); ++i)
    if (pair_counts(i) && !crossed_[i] && crosses(i, moved)) return true;
  return false;
}

GuardedStep ContactGuard::admit(const VertexShape& shape, std::span<const Vec6> step, double most) {
  GuardedStep guarded{most, {}};
  for (int trial = 0; trial < most_trials; ++trial) {
    moved_positions(set_->points(), shape, step, guarded.share, moved_);
    std::vector<Blockade> blockades;
    const double limit = limit_by_points(moved_, blockades);
    if (blockades.empty() && !slips_between(moved_)) return guarded;
    if (trial == 0) guarded.blockades = blockades;
    // Rotations make the motion of a point curved: the share is tried again, from the second time on with reserve.
    double cut = blockades.empty() ? 0.5 : std::max(smallest_cut, limit);
    if (trial > 0) cut = std::min(cut, 0.7);
    guarded.share *= cut;
  }
  guarded.share = 0;
  return guarded;
}

void add_blockade_springs(const ContactSet& set, const VertexShape& shape, const std::vector<Blockade>& blockades,
                          double stiffness, BlockView system) {
  for (const Blockade& b : blockades) {
    const ContactPoint& p = set.points()[b.point];
    const double missing = b.normal.dot(set.positions()[b.point]) - (b.plane + 0.5 * p.radius);
    add_point_energy(p, shape, (stiffness * missing) * b.normal, stiffness * b.normal * b.normal.transpose(),
                     Vec3::Zero(), system);
  }
}

}  // namespace tendril
