#include "method/route/gap_cache.h"

#include <cmath>

namespace tendril::routing {

GapCache::GapCache(const FreeSpace& space, double spacing) : space_(space), spacing_(spacing), reach_(2 * spacing) {
  corner_ = space.region().min();
  std::size_t count = 1;
  for (int k = 0; k < 3; ++k) {
    blocks_[k] = static_cast<int>(space.region().sizes()[k] / (spacing * side)) + 1;
    count *= blocks_[k];
  }
  block_.resize(count);
}

// Beyond the reach it is enough to know that the gap is beyond it: no place between the nodes is that far from one.
void GapCache::measure(const Vec3& node, Entry& entry) {
  entry.known = true;
  const DistanceField::Bounds bounds = space_.bounds(node);
  if (bounds.low >= reach_) {
    entry.gap = static_cast<float>(reach_);
    return;
  }
  if (bounds.high <= -reach_) {
    entry.gap = static_cast<float>(-reach_);
    return;
  }
  ++queries_;
  const Gap gap = space_.gap(node, reach_);
  entry.gap = static_cast<float>(gap.value);
  if (gap.obstacle < 0) return;
  for (int k = 0; k < 3; ++k) entry.gradient[k] = static_cast<float>(gap.gradient[k]);
}

bool GapCache::is_free(const Vec3& p, double least) {
  std::array<int, 3> cell;
  for (int k = 0; k < 3; ++k) {
    cell[k] = static_cast<int>(std::lround((p[k] - corner_[k]) / spacing_));
    if (cell[k] < 0 || cell[k] >= blocks_[k] * side) return false;
  }
  std::unique_ptr<Block>& block = block_[cell[0] / side + blocks_[0] * (cell[1] / side + std::size_t(blocks_[1]) * (cell[2] / side))];
  if (!block) block = std::make_unique<Block>();
  Entry& entry = (*block)[cell[0] % side + side * (cell[1] % side + side * (cell[2] % side))];
  const Vec3 node = corner_ + spacing_ * Vec3(cell[0], cell[1], cell[2]);
  if (!entry.known) measure(node, entry);
  double gap = entry.gap;
  for (int k = 0; k < 3; ++k) gap += entry.gradient[k] * (p[k] - node[k]);
  return gap >= least - 1e-9;
}

}  // namespace tendril::routing
