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
  std::optional<Eigen::AlignedBox3d> keep_in;   ///< m: the whole object stays within; sides may be infinitely far
  std::vector<Eigen::AlignedBox3d> keep_out;    ///< m: no part of the object gets into; no clearance is kept there
  /// What a metre costs: 1 + clearance_weight * f(gap to the nearest obstacle that is not to be kept near)
  ///                        + preference * (sum over avoid of f(gap) + sum over near of max(0, 1 - f(gap))),
  /// f(gap) = max(0, 1 - gap / preference_range)^2, gaps between the surfaces (m; no clearance is taken off).
  double clearance_weight = 0;
  double preference = 0;
  double preference_range = 0.1;  ///< m
};

/// What stands in the way at a place.
struct Gap {
  double value = 0;          ///< m, from the object's surface to where the clearance of the obstacle begins; negative: too near
  Vec3 gradient = Vec3::Zero();  ///< of the value by the place: unit, away from the obstacle; zero exactly on a mesh, and beyond the limit
  Vec3 on = Vec3::Zero();    ///< the closest surface point
  int obstacle = -1;         ///< for name(); -1: nothing within the limit
};

/// Immutable after construction, safe from several threads. Distances to meshes are unsigned: the inside of a closed mesh is
/// space as well, from which nothing leads out. The scene's rods are no obstacles here.
class FreeSpace {
 public:
  /// Ties count as free up to this, m: walls on grid planes are at exactly the distance that is demanded.
  static constexpr double tie = 1e-9;
  /// What a straight may lack in its certificate, m.
  static constexpr double straight_tolerance = 1e-5;

  /// Shares the scene's meshes and trees, and its store of fields; without obstacles there is no field. `ends`: places that a
  /// search must reach; the region holds them. Throws UsageError for demands that are not finite or negative, boxes that are
  /// empty, ends that are not finite or lie outside keep_in, and a margin that is negative or not finite. Where `context` stops the
  /// making of the field, everything is asked of the trees.
  FreeSpace(const Scene& scene, const SpaceDemands& demands, const std::vector<Vec3>& ends, double margin,
            const RunContext& context = {});

  const SpaceDemands& demands() const { return demands_; }
  bool has_obstacles() const { return surroundings_.size() > 0; }
  /// Searches need not leave it: obstacles, zones and ends with `margin` (m) around them, within keep_in; m.
  const Eigen::AlignedBox3d& region() const { return region_; }
  double field_seconds() const { return field_seconds_; }  ///< spent on the field and the trees by the constructor

  /// The smallest gap over obstacles, zones and the walls of keep_in, exact; nothing (obstacle -1, value `limit`) beyond.
  Gap gap(const Vec3& p, double limit) const;
  /// What the field knows of gap().value: it lies between these.
  DistanceField::Bounds bounds(const Vec3& p) const;
  /// gap() >= least (m), by the field where it decides and else by the trees. Ties count as free.
  bool is_free(const Vec3& p, double least = 0) const;
  /// True when gap() >= least - straight_tolerance all along the straight, and at its ends with ties only; judged without
  /// samples, by what the distance can change on the way.
  bool is_free(const Vec3& a, const Vec3& b, double least = 0) const;

  /// True when places differ in what they cost.
  bool has_preferences() const { return nearest_.size() > 0 || preferred_.size() > 0; }
  /// What a metre costs here, at least 1; `gradient` (1/m) may be null.
  double cost(const Vec3& p, Vec3* gradient = nullptr) const;

  /// By obstacle number of Gap: the scene's names, "keep_out 1", "keep_in".
  const std::string& name(int obstacle) const { return names_[obstacle]; }
  /// Obstacle numbers from here on are zones: those of keep_out in order, then keep_in.
  int first_zone() const { return surroundings_.size() - static_cast<int>(demands_.keep_out.size()); }
  const Surroundings& surroundings() const { return surroundings_; }  ///< obstacles and zones, with the clearances demanded

 private:
  void check(const std::vector<Vec3>& ends, double margin) const;
  void take_obstacles(const Scene& scene);
  Eigen::AlignedBox3d set_region(const std::vector<Vec3>& ends, double margin);
  void make_field(const Scene& scene, const Eigen::AlignedBox3d& inner, const RunContext& context);
  void limit_by_walls(const Vec3& p, Gap& gap) const;
  double gap_to_zones_and_walls(const Vec3& p) const;
  bool is_free_between(const Vec3& a, const Vec3& b, double least) const;

  SpaceDemands demands_;
  Surroundings surroundings_;    ///< obstacles first, then zones
  Surroundings nearest_;         ///< those that cost by the nearest; empty where that has no weight
  Surroundings preferred_;       ///< those to keep near or away from; empty where that has no weight
  std::vector<bool> near_;       ///< by number in preferred_
  std::vector<std::string> names_;
  Eigen::AlignedBox3d region_;
  std::shared_ptr<const DistanceField> field_;  ///< of the obstacles with what they ask beyond the clearance demanded
  double field_seconds_ = 0;
};

}  // namespace tendril::routing
