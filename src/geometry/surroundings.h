// The obstacles around a rod: meshes and solids, each placed, with the distances, contact terms and rays of statics.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "base/frame.h"
#include "geometry/solids.h"
#include "geometry/triangle_surface.h"
#include "statics/contact_field.h"

namespace tendril {

/// One obstacle. A frame's d1, d2, d3 are the x, y, z axes of the mesh or solid.
struct Obstacle {
  std::variant<std::shared_ptr<const TriangleSurface>, Solid> shape;
  Frame pose;
  double clearance = 0;  ///< m, required: see ContactField
  std::string name = {};      ///< for messages; may be empty
};

/// Obstacles as statics sees them. Distances to meshes are unsigned (open and thin sheets are walls from both sides), to
/// solids signed. Every query is const, safe from several threads and allocates nothing of its own. A mesh's tree is
/// built by the first query that comes near it, its topology by the first call of terms() that does.
///
/// terms(): for a mesh the inclusion-exclusion sum of mesh_topology.h with the terms that cancel within one triangle left
/// out. ray(): a path out of a solid does not count, so that a rod that starts inside can leave.
class Surroundings final : public ContactField {
 public:
  /// Returns the obstacle's number, counted from 0. Throws UsageError for a clearance that is negative or not
  /// finite, a pose that is not finite, a solid without positive size, and a missing mesh.
  int add(Obstacle obstacle);

  int size() const { return static_cast<int>(entries_.size()); }
  const Obstacle& obstacle(int index) const { return entries_[index].obstacle; }

  /// Puts an obstacle somewhere else. Not while another thread asks. Throws UsageError for a pose that is not a frame.
  void move(int index, const Frame& pose);

  ClosestPoint closest(const Vec3& p, double limit) const override;
  void terms(const Vec3& p, double range, std::vector<DistanceTerm>& out) const override;
  std::optional<RayHit> ray(const Vec3& a, const Vec3& b) const override;
  double clearance(int obstacle) const override { return entries_[obstacle].obstacle.clearance; }
  double largest_clearance() const override { return largest_clearance_; }
  ClosestPoint closest_kept(const Vec3& p, double limit, double most) const override;
  void terms_kept(const Vec3& p, double range, double most, std::vector<DistanceTerm>& out) const override;
  std::string name(int obstacle) const override;
  std::shared_ptr<const ContactField> without(const std::vector<int>& obstacles) const override;  ///< shares the meshes

  /// True when closest_kept(p, limit, most) finds anything: cheaper, as it stops at the first surface that is near enough.
  bool within_kept(const Vec3& p, double limit, double most) const;

  /// The closest point of one obstacle.
  ClosestPoint closest_on(int obstacle, const Vec3& p, double limit) const { return closest_on(obstacle, p, limit, 0); }

  Eigen::AlignedBox3d box() const;  ///< of all obstacles but half-spaces, m
  /// Of one obstacle in world axes, m; infinite for a half-space.
  const Eigen::AlignedBox3d& box_of(int obstacle) const { return entries_[obstacle].box; }

 private:
  struct Entry {
    Obstacle obstacle;
    Eigen::AlignedBox3d box;  ///< in world axes, m
    Mat3 axes;                ///< the pose's rotation: columns are the obstacle's axes
    const TriangleSurface* surface;  ///< null for a solid
    void place();  ///< box and axes from the obstacle's pose
    Vec3 to_local(const Vec3& p) const { return axes.transpose() * (p - obstacle.pose.at); }
    Vec3 to_world(const Vec3& p) const { return axes * p + obstacle.pose.at; }
    double thickness(double most) const { return std::min(obstacle.clearance, most); }
  };
  ClosestPoint closest_on(int index, const Vec3& p, double limit, double most) const;
  void add_solid_term(int index, const Vec3& p, double range, double thickness, std::vector<DistanceTerm>& out) const;
  void add_mesh_terms(int index, const Vec3& p, double range, double thickness, std::vector<DistanceTerm>& out) const;

  std::vector<Entry> entries_;
  double largest_clearance_ = 0;
};

/// Where a polyline first passes through a surface: after `segment` whole segments, at `hit`.
struct Crossing {
  int segment;
  RayHit hit;
};

/// The first crossing of a polyline with the surroundings; nothing when it is free of crossings. A polyline that starts
/// inside a solid crosses it at its first point.
std::optional<Crossing> first_crossing(const ContactField& surroundings, const std::vector<Vec3>& points);

}  // namespace tendril
