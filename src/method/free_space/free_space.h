// Where the centre line of an object may run: far enough from every obstacle, within the box that the user gives, outside
// the zones that he forbids. Both routing methods ask here.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "geometry/distance_field.h"
#include "method/free_space/cost_grid.h"
#include "method/free_space/space_demands.h"
#include "scene/scene.h"

namespace tendril::routing {

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
  bool has_preferences() const { return cost_ != nullptr; }
  /// What a metre costs here, at least 1, by exact distances; `gradient` (1/m) may be null.
  double cost(const Vec3& p, Vec3* gradient = nullptr) const;
  /// The same for searches, by fields: see PlaceCost::by_field.
  double cost_by_field(const Vec3& p) const { return cost_ ? cost_->by_field(p) : 1; }
  /// The same for descents, smooth and with the gradient that belongs to it, on a coarser or finer grid: see CostGrid.
  double cost_interpolated(const Vec3& p, Vec3* gradient = nullptr, bool fine = false) const;

  /// By obstacle number of Gap: the scene's names, "keep_out 1", "keep_in".
  const std::string& name(int obstacle) const { return names_[obstacle]; }
  /// Obstacle numbers from here on are zones: those of keep_out in order, then keep_in.
  int first_zone() const { return surroundings_.size() - static_cast<int>(demands_.keep_out.size()); }
  const Surroundings& surroundings() const { return surroundings_; }  ///< obstacles and zones, with the clearances demanded

 private:
  void check(const std::vector<Vec3>& ends, double margin) const;
  void take_obstacles(const Scene& scene);
  void make_costs(const Scene& scene, const Eigen::AlignedBox3d& inner, const RunContext& context);
  Eigen::AlignedBox3d set_region(const std::vector<Vec3>& ends, double margin);
  void make_field(const Scene& scene, const Eigen::AlignedBox3d& inner, const RunContext& context);
  void limit_by_walls(const Vec3& p, Gap& gap) const;
  double gap_to_zones_and_walls(const Vec3& p) const;
  bool is_free_between(const Vec3& a, const Vec3& b, double least) const;

  SpaceDemands demands_;
  Surroundings surroundings_;    ///< obstacles first, then zones
  std::vector<std::string> names_;
  Eigen::AlignedBox3d region_;
  std::shared_ptr<const DistanceField> field_;  ///< of the obstacles with what they ask beyond the clearance demanded
  std::shared_ptr<const PlaceCost> cost_;       ///< null where every place costs the same
  std::shared_ptr<const CostGrid> cost_grid_, fine_cost_grid_;
  double field_seconds_ = 0;
};

}  // namespace tendril::routing
