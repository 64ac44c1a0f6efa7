#include "method/free_space/roadmap.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/number_text.h"
#include "base/parallel.h"
#include "base/units.h"

namespace tendril::routing {

namespace {

constexpr double most_nodes = 30e6;

struct Waiting {
  float cost;
  int node;
};

}  // namespace

const std::array<Roadmap::Neighbour, 26>& Roadmap::neighbours() {
  static const std::array<Neighbour, 26> all = [] {
    std::array<Neighbour, 26> list;
    int count = 0;
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
          if (x || y || z) list[count++] = {{x, y, z}, std::sqrt(float(x * x + y * y + z * z))};
    return list;
  }();
  return all;
}

Roadmap::Roadmap(const FreeSpace& space, double step, const RunContext& context) : space_(space), step_(step) {
  if (!(step > 0) || !std::isfinite(step)) throw UsageError("grid: its step is " + number_text(step) + " m; a length above 0 expected");
  const Eigen::AlignedBox3d& region = space.region();
  corner_ = region.min();
  double count = 1;  // a region of whole steps has a node on either side, whatever rounding says
  for (int k = 0; k < 3; ++k) count *= std::floor(region.sizes()[k] / step + 1e-9) + 1;
  if (!(count <= most_nodes))
    throw UsageError("grid: a step of " + number_text(step / units::mm) + " mm makes " + number_text(std::round(count / 1e6)) +
                     " million nodes, at most 30 million expected; take a larger 'grid' or a box to 'keep_in'");
  for (int k = 0; k < 3; ++k) size_[k] = static_cast<int>(std::floor(region.sizes()[k] / step + 1e-9)) + 1;
  for (int n = 0; n < 26; ++n) strides_[n] = node(neighbours()[n].offset);
  // Nodes that are free by D are joined by edges whose middles are at least D - step sqrt(3) / 2 from everything: above 0, so that
  // no surface lies between, up to step = 1.15 D. Of zones only the radius is kept clear.
  const double kept_clear = space.demands().radius + (space.demands().keep_out.empty() ? space.demands().clearance : 0);
  edges_are_free_ = !space.has_obstacles() || step <= 1.15 * kept_clear;
  free_.assign(static_cast<std::size_t>(count), 0);
  classify(context);
  if (!edges_are_free_) test_edges(context);
}

void Roadmap::classify(const RunContext& context) {
  const bool preferences = space_.has_preferences();
  const SpaceDemands& asked = space_.demands();
  if (preferences) costs_.assign(free_.size(), static_cast<float>(1 + asked.clearance_weight + asked.preference));
  const int workers = std::min(thread_count(context.threads), size_[2]);
  const int layer = size_[0] * size_[1];
  std::vector<long> found(workers, 0);
  run_workers(workers, [&](int worker) {
    for (int z = worker; z < size_[2] && !context.stop(); z += workers)
      for (int i = z * layer; i < (z + 1) * layer; ++i) {
        const Vec3 p = place(i);
        free_[i] = space_.is_free(p);
        found[worker] += free_[i];
        if (preferences && free_[i]) costs_[i] = static_cast<float>(space_.cost_by_field(p));
      }
  });
  for (const long n : found) free_nodes_ += n;
}

/// Each edge once: from the node with the lower number.
void Roadmap::test_edges(const RunContext& context) {
  open_.assign(free_.size(), 0);
  const int workers = std::min(thread_count(context.threads), size_[2]);
  const int layer = size_[0] * size_[1];
  run_workers(workers, [&](int worker) {
    for (int z = worker; z < size_[2] && !context.stop(); z += workers)
      for (int i = z * layer; i < (z + 1) * layer; ++i) {
        if (!free_[i]) continue;
        const std::array<int, 3> here = cell(i);
        for (int n = 13; n < 26; ++n) {
          const std::array<int, 3>& by = neighbours()[n].offset;
          const std::array<int, 3> there{here[0] + by[0], here[1] + by[1], here[2] + by[2]};
          if (holds(there) && free_[node(there)] && space_.is_free(place(i), place(node(there))))
            open_[i] = static_cast<std::uint16_t>(open_[i] | 1u << (n - 13));
        }
      }
  });
}

std::array<int, 3> Roadmap::cell(int node) const {
  return {node % size_[0], node / size_[0] % size_[1], node / (size_[0] * size_[1])};
}

Vec3 Roadmap::place(int node) const {
  const std::array<int, 3> c = cell(node);
  return corner_ + step_ * Vec3(c[0], c[1], c[2]);
}

bool Roadmap::holds(const std::array<int, 3>& c) const {
  return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < size_[0] && c[1] < size_[1] && c[2] < size_[2];
}

std::array<int, 3> Roadmap::nearest(const Vec3& p) const {
  std::array<int, 3> c;
  for (int k = 0; k < 3; ++k) c[k] = std::clamp(static_cast<int>(std::lround((p[k] - corner_[k]) / step_)), 0, size_[k] - 1);
  return c;
}

bool Roadmap::passes(int from, int to) const {
  if (!free_[from] || !free_[to]) return false;
  if (edges_are_free_) return true;
  if (from > to) std::swap(from, to);
  const std::array<int, 3> a = cell(from), b = cell(to);
  const int n = b[0] - a[0] + 1 + 3 * (b[1] - a[1] + 1 + 3 * (b[2] - a[2] + 1));
  return open_[from] >> (n - 14) & 1;  // by offset 27 places, the node itself in the middle
}

float Roadmap::cost_between(int from, int to, float steps) const {
  const float length = steps * static_cast<float>(step_);
  return costs_.empty() ? length : 0.5f * (costs_[from] + costs_[to]) * length;
}

/// Dijkstra's algorithm with buckets (Dial): as no edge costs less than a bucket is wide, the nodes within one do not improve each
/// other and need no order. Where rounding lets them, they wait once more.
std::vector<float> Roadmap::costs_to(const std::vector<Goal>& goals) const {
  std::vector<float> cost(free_.size(), unreachable);
  std::map<long, std::vector<Waiting>> buckets;
  long current = 0;
  const auto wait = [&](float through, int at) {
    cost[at] = through;
    buckets[std::max(current, static_cast<long>(std::min(through / step_, 1e15)))].push_back({through, at});
  };
  for (const Goal& goal : goals)
    if (goal.cost < cost[goal.node]) wait(static_cast<float>(goal.cost), goal.node);
  while (!buckets.empty()) {
    current = buckets.begin()->first;
    const std::vector<Waiting> bucket = std::move(buckets.begin()->second);
    buckets.erase(buckets.begin());
    for (const Waiting& next : bucket) {
      if (next.cost > cost[next.node]) continue;
      visit_free_neighbours(next.node, [&](int other, float steps) {
        const float through = next.cost + cost_between(other, next.node, steps);
        if (through < cost[other] && passes(other, next.node)) wait(through, other);
      });
    }
  }
  return cost;
}

}  // namespace tendril::routing
