#include "geometry/field_store.h"

#include <algorithm>

namespace tendril {
namespace {

/// A field of a large scene takes tens of megabytes: so many are kept in any case, more while they are small.
constexpr std::size_t least_entries = 4, most_bytes = 200'000'000;

bool same(const Solid& a, const Solid& b) {
  if (a.index() != b.index()) return false;
  if (const auto* box = std::get_if<Box>(&a)) return box->size == std::get<Box>(b).size;
  if (const auto* sphere = std::get_if<Sphere>(&a)) return sphere->radius == std::get<Sphere>(b).radius;
  if (const auto* cylinder = std::get_if<Cylinder>(&a))
    return cylinder->radius == std::get<Cylinder>(b).radius && cylinder->length == std::get<Cylinder>(b).length;
  return true;
}

bool same(const Obstacle& a, const Obstacle& b) {
  if (a.shape.index() != b.shape.index() || a.clearance != b.clearance) return false;
  if (a.pose.at != b.pose.at || a.pose.rotation.coeffs() != b.pose.rotation.coeffs()) return false;
  if (const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&a.shape))
    return *surface == std::get<std::shared_ptr<const TriangleSurface>>(b.shape);
  return same(std::get<Solid>(a.shape), std::get<Solid>(b.shape));
}

/// The surroundings begin with all that is known.
bool begins_with(const Surroundings& surroundings, const std::vector<Obstacle>& known) {
  if (static_cast<int>(known.size()) > surroundings.size()) return false;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!same(surroundings.obstacle(static_cast<int>(i)), known[i])) return false;
  return true;
}

}  // namespace

std::shared_ptr<const DistanceField> FieldStore::field(const Surroundings& surroundings, const Eigen::AlignedBox3d& box,
                                                       const Eigen::AlignedBox3d& wanted, double spacing, const RunContext& context) {
  const std::lock_guard lock(mutex_);
  int best = -1;
  for (int i = 0; i < static_cast<int>(entries_.size()); ++i) {
    const Entry& entry = entries_[i];
    if (!(entry.field->spacing() <= spacing) || !entry.field->box().contains(box) || !begins_with(surroundings, entry.obstacles)) continue;
    if (best < 0 || entry.obstacles.size() > entries_[best].obstacles.size()) best = i;
  }
  if (best >= 0) std::rotate(entries_.begin(), entries_.begin() + best, entries_.begin() + best + 1);
  if (best >= 0 && static_cast<int>(entries_.front().obstacles.size()) == surroundings.size()) return entries_.front().field;

  auto made = best >= 0 ? std::make_shared<const DistanceField>(*entries_.front().field, surroundings, context)
                        : std::make_shared<const DistanceField>(surroundings, box.merged(wanted), spacing, context);
  if (!made->ok()) return made;
  Entry entry{{}, made};
  for (int i = 0; i < surroundings.size(); ++i) entry.obstacles.push_back(surroundings.obstacle(i));
  entries_.insert(entries_.begin(), std::move(entry));
  std::size_t bytes = 0;
  for (const Entry& kept : entries_) bytes += kept.field->bytes();
  for (; entries_.size() > least_entries && bytes > most_bytes; entries_.pop_back()) bytes -= entries_.back().field->bytes();
  return made;
}

}  // namespace tendril
