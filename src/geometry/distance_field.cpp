#include "geometry/distance_field.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.h"
#include "base/huge_pages.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "geometry/surface_voxels.h"

namespace tendril {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Solids are judged for blocks of this many nodes along each axis before they are for each node.
constexpr int block = 8;

/// One voxel more than the box on each side: surface on the box's sides lies within voxels of the lattice.
NodeLattice lattice_over(const Eigen::AlignedBox3d& box, double spacing) {
  if (!std::isfinite(spacing) || !(spacing > 0))
    throw UsageError("distance field: the spacing is " + number_text(spacing) + " m; a positive number expected");
  if (box.isEmpty() || !all_finite(box.min()) || !all_finite(box.max()))
    throw UsageError("distance field: the box is empty or infinite; finite corners expected");
  const Eigen::Array3d cells = (box.sizes().array() / spacing).ceil();
  const double nodes = (cells + 3).prod();
  if (!(nodes <= DistanceField::most_nodes))
    throw UsageError("distance field: " + number_text(nodes) + " nodes at a spacing of " + number_text(spacing) + " m, at most " +
                     number_text(DistanceField::most_nodes) + "; use a larger spacing or a smaller box");
  NodeLattice lattice;
  lattice.spacing = spacing;
  lattice.size = cells.cast<int>() + 3;
  lattice.origin = box.center() - 0.5 * spacing * (lattice.size - 1).cast<double>().matrix();
  return lattice;
}

/// A solid as the field sees it.
struct PlacedSolid {
  const Solid& solid;
  Mat3 to_local;
  Vec3 at;
  double clearance;
  double distance(const Vec3& p) const { return distance_to(solid, to_local * (p - at)).distance - clearance; }
};

}  // namespace

DistanceField::DistanceField(const Surroundings& surroundings, const Eigen::AlignedBox3d& box, double spacing, const RunContext& context)
    : lattice_(lattice_over(box, spacing)), box_(lattice_.box()) {
  values_.reserve(lattice_.count());
  prefer_huge_pages(values_.data(), lattice_.count() * sizeof(float));
  values_.resize(lattice_.count(), std::numeric_limits<float>::infinity());
  add(surroundings, 0, context);
}

DistanceField::DistanceField(const DistanceField& known, const Surroundings& surroundings, const RunContext& context)
    : DistanceField(known) {
  if (surroundings.size() < obstacles_)
    throw UsageError("distance field: extended from " + std::to_string(obstacles_) + " obstacles to " +
                     std::to_string(surroundings.size()) + "; those that are known and more expected");
  if (ok_) add(surroundings, obstacles_, context);
}

void DistanceField::add(const Surroundings& surroundings, int first, const RunContext& context) {
  std::vector<int> meshes, solids;
  for (int i = first; i < surroundings.size(); ++i)
    (std::holds_alternative<Solid>(surroundings.obstacle(i).shape) ? solids : meshes).push_back(i);
  obstacles_ = surroundings.size();
  rounding_ = 1e-12 * std::max(box_.min().cwiseAbs().maxCoeff(), box_.max().cwiseAbs().maxCoeff()) +
              1e-6 * surroundings.largest_clearance();
  if (!meshes.empty()) add_meshes(surroundings, meshes, context);
  if (!solids.empty() && !context.stop()) add_solids(surroundings, solids, context);
  ok_ = !context.stop();
}

void DistanceField::add_meshes(const Surroundings& surroundings, const std::vector<int>& meshes, const RunContext& context) {
  has_meshes_ = true;
  std::map<double, std::vector<int>> by_clearance;
  for (const int i : meshes) by_clearance[surroundings.obstacle(i).clearance].push_back(i);
  for (const auto& [clearance, group] : by_clearance) {
    std::vector<std::uint8_t> marks(lattice_.count(), 0);
    for (const int i : group) {
      const Obstacle& obstacle = surroundings.obstacle(i);
      const Mesh& mesh = std::get<std::shared_ptr<const TriangleSurface>>(obstacle.shape)->mesh();
      if (!box_.contains(surroundings.box_of(i))) beyond_ = std::max(beyond_, clearance);
      mark_surface(mesh, obstacle.pose.rotation.toRotationMatrix(), obstacle.pose.at, lattice_, marks, context);
    }
    const std::vector<float> squared = squared_distances(marks, lattice_.size, context);
    if (context.stop()) return;
    const float scale = static_cast<float>(lattice_.spacing), off = static_cast<float>(clearance);
    constexpr std::size_t chunk = 1 << 16;
    const int chunks = static_cast<int>((values_.size() + chunk - 1) / chunk);
    std::atomic<int> next = 0;
    run_workers(std::min(thread_count(context.threads), chunks), [&](int) {
      for (int c; (c = next++) < chunks;)
        for (std::size_t n = c * chunk, end = std::min(values_.size(), n + chunk); n < end; ++n)
          values_[n] = std::min(values_[n], scale * std::sqrt(squared[n]) - off);
    });
  }
}

/// Block after block, the solids nearest to its middle first: those that cannot be the nearest at any of its nodes are left out.
void DistanceField::add_solids(const Surroundings& surroundings, const std::vector<int>& solids, const RunContext& context) {
  std::vector<PlacedSolid> placed;
  for (const int i : solids) {
    const Obstacle& obstacle = surroundings.obstacle(i);
    placed.push_back({std::get<Solid>(obstacle.shape), obstacle.pose.rotation.conjugate().toRotationMatrix(), obstacle.pose.at,
                      obstacle.clearance});
  }
  const Eigen::Array3i blocks = (lattice_.size + block - 1) / block;
  std::atomic<int> next = 0;
  run_workers(std::min(thread_count(context.threads), blocks.z()), [&](int) {
    std::vector<std::pair<double, const PlacedSolid*>> order;
    for (int layer; (layer = next++) < blocks.z();)
      for (int column = 0; column < blocks.x() * blocks.y() && !context.stop(); ++column) {
        const Eigen::Array3i from = block * Eigen::Array3i(column % blocks.x(), column / blocks.x(), layer);
        const Eigen::Array3i to = (from + block).min(lattice_.size);
        const Vec3 middle = 0.5 * (lattice_.node(from.x(), from.y(), from.z()) + lattice_.node(to.x() - 1, to.y() - 1, to.z() - 1));
        const double reach = (middle - lattice_.node(from.x(), from.y(), from.z())).norm();
        order.clear();
        for (const PlacedSolid& solid : placed) order.push_back({solid.distance(middle), &solid});
        std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        double highest = infinity;
        for (const auto& [distance, solid] : order) {
          if (distance - reach > highest) break;
          highest = -infinity;
          for (int k = from.z(); k < to.z(); ++k)
            for (int j = from.y(); j < to.y(); ++j)
              for (int i = from.x(); i < to.x(); ++i) {
                float& value = values_[lattice_.index(i, j, k)];
                value = std::min(value, static_cast<float>(solid->distance(lattice_.node(i, j, k))));
                highest = std::max(highest, static_cast<double>(value));
              }
        }
      }
  });
}

DistanceField::Bounds DistanceField::at(const Vec3& p) const {
  const Vec3 steps = (p - lattice_.origin) / lattice_.spacing;
  const Eigen::Array3d nearest = (steps.array() + 0.5).floor();
  if (!((nearest >= 0).all() && (nearest < lattice_.size.cast<double>()).all())) return {-infinity, infinity};
  const Eigen::Array3i node = nearest.cast<int>();
  const double value = values_[lattice_.index(node.x(), node.y(), node.z())];
  const double way = lattice_.spacing * (steps - nearest.matrix()).norm();
  const double slack = way + (has_meshes_ ? voxel_reach * lattice_.spacing : 0) + rounding_ + (std::isfinite(value) ? 1e-6 * std::abs(value) : 0);
  Bounds bounds{value - slack, value + slack};
  // What sticks out of the box was not marked: it is at least as far as the nearest side.
  if (beyond_ >= 0) bounds.low = std::min(bounds.low, std::min((p - box_.min()).minCoeff(), (box_.max() - p).minCoeff()) - beyond_);
  return bounds;
}

double DistanceField::interpolated(const Vec3& p) const {
  const Vec3 steps = (p - lattice_.origin) / lattice_.spacing;
  if (!((steps.array() >= 0).all() && (steps.array() <= (lattice_.size - 1).cast<double>()).all()))
    return std::numeric_limits<double>::quiet_NaN();
  const Eigen::Array3i node = steps.array().cast<int>().min(lattice_.size - 2);
  const Vec3 share = steps - node.cast<double>().matrix();
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    for (int k = 0; k < 3; ++k) weight *= corner >> k & 1 ? share[k] : 1 - share[k];
    const float value = values_[lattice_.index(node.x() + (corner & 1), node.y() + (corner >> 1 & 1), node.z() + (corner >> 2))];
    if (std::isinf(value)) return value;  // nothing at all was marked
    sum += weight * value;
  }
  return sum;
}

}  // namespace tendril
