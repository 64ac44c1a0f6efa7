// Where the centre line of an object may run: far enough from every obstacle, within the box that the user gives, outside
// the zones that he forbids. Both routing methods ask here.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "geometry/distance_field.h"
#include "scene/scene.h"

namespace tendril::routing {

/// What the object asks of its surroundings.
struct SpaceDemands {
  double radius = 0;     ///< m, of the object
  double clearance = 0;  ///< m, between the surfaces, for every obstacle; an obstacle's own larger one stands
  std::optional<Eigen::AlignedBox3d> keep_in;   ///< m: the whole object stays within
  std::vector<Eigen::AlignedBox3d> keep_out;    ///< m: no part of the object gets into
  /// What a metre costs more near obstacles to avoid, and away from those to keep near (Preference of PlacedObstacle):
  /// cost per metre = 1 + preference * (sum over avoid of f(gap) + sum over near of 1 - f(gap)),  f(g) = max(0, 1 - g/range)^2.
  double preference = 0;
  double preference_range = 0.1;  ///< m
};

/// What stands in the way at a place.
struct Gap {
  double value = 0;          ///< m, from the object's surface to where the clearance of the obstacle begins; negative: too near
  Vec3 gradient = Vec3::Zero();  ///< of the value by the place: unit, away from the obstacle
  Vec3 on = Vec3::Zero();    ///< the closest surface point
  int obstacle = -1;         ///< of names(); -1: nothing within the limit
};

/// Immutable after construction, safe from several threads.
class FreeSpace {
 public:
  /// Shares the scene's meshes and trees, and its store of fields; without obstacles there is no field. `ends`: places that a
  /// search must reach; the region holds them. Throws UsageError for demands that are not finite or negative, boxes that are
  /// empty, and ends that lie outside keep_in.
  FreeSpace(const Scene& scene, const SpaceDemands& demands, const std::vector<Vec3>& ends, double margin,
            const RunContext& context = {});

  const SpaceDemands& demands() const { return demands_; }
  bool has_obstacles() const { return surroundings_.size() > 0; }
  /// Searches need not leave it: obstacles and ends with `margin` (m) around them, within keep_in; m.
  const Eigen::AlignedBox3d& region() const { return region_; }
  double field_seconds() const { return field_seconds_; }  ///< spent on the field and the trees by the constructor

  /// The smallest gap over obstacles, zones and the walls of keep_in, exact; nothing (obstacle -1, value `limit`) beyond.
  Gap gap(const Vec3& p, double limit) const;
  /// What the field knows of gap().value; without obstacles by keep_in alone.
  DistanceField::Bounds bounds(const Vec3& p) const;
  /// gap() >= least (m), by the field where it decides and else by the trees. Ties count as free.
  bool is_free(const Vec3& p, double least = 0) const;
  /// True when is_free(p, least) holds all along the straight; judged without samples.
  bool is_free(const Vec3& a, const Vec3& b, double least = 0) const;

  bool has_preferences() const { return demands_.preference > 0 && preferred_.size() > 0; }
  /// What a metre costs here, at least 1; `gradient` (1/m) may be null.
  double cost(const Vec3& p, Vec3* gradient = nullptr) const;

  /// By obstacle number of Gap: the scene's names, "keep_out 1", "keep_in".
  const std::string& name(int obstacle) const { return names_[obstacle]; }
  /// Obstacle numbers from here on are zones: those of keep_out in order, then keep_in if there is one.
  int first_zone() const {
    return static_cast<int>(names_.size() - demands_.keep_out.size()) - (demands_.keep_in ? 1 : 0);
  }
  const Surroundings& surroundings() const { return surroundings_; }  ///< obstacles and zones, with the clearances demanded

 private:
  SpaceDemands demands_;
  Surroundings surroundings_;
  Surroundings preferred_;       ///< those to keep near or away from
  std::vector<bool> near_;       ///< by number in preferred_
  std::vector<std::string> names_;
  Eigen::AlignedBox3d region_;
  std::shared_ptr<const DistanceField> field_;
  double field_seconds_ = 0;
};

}  // namespace tendril::routing
