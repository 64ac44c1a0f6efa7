#include "method/free_space/cost_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tendril::routing {
namespace {

/// m: what descents in scenes of metres need, and the finest that thin objects get.
constexpr double coarsest = 10e-3, finest = 4e-3;
/// Of the range: a finer grid for short ranges; coarser than the last one a grid says nothing.
constexpr double share_of_range = 0.1, most_of_range = 0.25;
constexpr double most_nodes = 1 << 26;

double nodes_of(const Eigen::AlignedBox3d& box, double spacing) { return ((box.sizes().array() / spacing).ceil() + 3).prod(); }

/// Shares of three nodes in a row, and their slopes, at u in -0.5 ... 0.5 from the middle one.
struct Shares {
  std::array<double, 3> weight, slope;
  explicit Shares(double u)
      : weight{0.5 * (0.5 - u) * (0.5 - u), 0.75 - u * u, 0.5 * (0.5 + u) * (0.5 + u)}, slope{u - 0.5, -2 * u, u + 0.5} {}
};

}  // namespace

CostGrid::CostGrid(std::shared_ptr<const PlaceCost> cost, const Eigen::AlignedBox3d& region, double fineness) : cost_(std::move(cost)) {
  const SpaceDemands& demands = cost_->demands();
  const double range = demands.preference_range;
  double spacing = fineness * std::min(std::clamp(0.5 * (demands.radius + demands.clearance), finest, coarsest), share_of_range * range);
  Eigen::AlignedBox3d box = region;
  box.min().array() -= cost_->reach() + 2 * spacing;
  box.max().array() += cost_->reach() + 2 * spacing;
  while (nodes_of(box, spacing) > most_nodes && spacing < range) spacing *= 1.25;
  if (!(nodes_of(box, spacing) <= most_nodes) || spacing > most_of_range * range) return;
  lattice_.spacing = spacing;
  lattice_.origin = box.min();
  lattice_.size = (box.sizes().array() / spacing).ceil().cast<int>() + 1;
  values_.reset(static_cast<float*>(std::calloc(lattice_.count(), sizeof(float))));
}

/// Costs are at least 1, so that 0 tells that a node is not known. Two threads may find the same value at once.
float CostGrid::asked_for(const Eigen::Array3i& node) const {
  const float value = static_cast<float>(cost_->exact(lattice_.node(node.x(), node.y(), node.z())));
  std::atomic_ref<float>(values_[lattice_.index(node.x(), node.y(), node.z())]).store(value, std::memory_order_relaxed);
  asked_.fetch_add(1, std::memory_order_relaxed);
  return value;
}

double CostGrid::at(const Vec3& p, Vec3* gradient) const {
  if (!values_) return cost_->exact(p, gradient);
  const Vec3 steps = (p - lattice_.origin) / lattice_.spacing;
  const Eigen::Array3d nearest = (steps.array() + 0.5).floor();
  if (!((nearest >= 1).all() && (nearest < (lattice_.size - 1).cast<double>()).all())) return cost_->exact(p, gradient);
  const Eigen::Array3i node = nearest.cast<int>();
  const Shares x(steps.x() - nearest.x()), y(steps.y() - nearest.y()), z(steps.z() - nearest.z());
  double sum = 0;
  Vec3 slope = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) {
      const std::size_t first = lattice_.index(node.x() - 1, node.y() + j - 1, node.z() + k - 1);
      double row = 0, row_slope = 0;
      for (int i = 0; i < 3; ++i) {
        double here = std::atomic_ref<float>(values_[first + i]).load(std::memory_order_relaxed);
        if (!(here > 0)) here = asked_for(node + Eigen::Array3i(i - 1, j - 1, k - 1));
        row += x.weight[i] * here;
        row_slope += x.slope[i] * here;
      }
      sum += y.weight[j] * z.weight[k] * row;
      slope += Vec3(y.weight[j] * z.weight[k] * row_slope, y.slope[j] * z.weight[k] * row, y.weight[j] * z.slope[k] * row);
    }
  if (gradient) *gradient = slope / lattice_.spacing;
  return std::max(sum, 1.0);  // of ones the shares make 1 but for rounding
}

}  // namespace tendril::routing
