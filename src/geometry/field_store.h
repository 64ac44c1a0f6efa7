// Distance fields that were made, for whoever asks again.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "geometry/distance_field.h"

namespace tendril {

/// The same surroundings get the same field, more obstacles get it extended, fewer or moved ones a new one. Obstacles are the
/// same when they share the mesh, or are equal solids, in the same place with the same clearance, in the same order; names do
/// not count. Safe from several threads; one field is made at a time.
class FieldStore {
 public:
  /// A field of these surroundings that covers `box` (m) with a spacing of at most `spacing` (m); one that has to be made covers
  /// `wanted` as well. See DistanceField for errors. One that `context` stopped is not ok() and is not kept.
  std::shared_ptr<const DistanceField> field(const Surroundings& surroundings, const Eigen::AlignedBox3d& box,
                                             const Eigen::AlignedBox3d& wanted, double spacing, const RunContext& context = {});

 private:
  struct Entry {
    std::vector<Obstacle> obstacles;
    std::shared_ptr<const DistanceField> field;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;  ///< the latest first, few
};

}  // namespace tendril
