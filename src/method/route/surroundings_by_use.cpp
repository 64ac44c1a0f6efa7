#include "method/route/surroundings_by_use.h"

#include <algorithm>

namespace tendril::routing {
namespace {

/// The obstacles that `chosen` says yes to; null when there is none.
template <class Chosen>
std::shared_ptr<const Surroundings> some_of(const std::vector<PlacedObstacle>& obstacles, bool thick, Chosen chosen) {
  auto some = std::make_shared<Surroundings>();
  for (const PlacedObstacle& obstacle : obstacles) {
    if (!chosen(obstacle)) continue;
    Obstacle body = obstacle.body;
    body.clearance = thick ? obstacle.clearance : 0;
    body.name = obstacle.name;
    some->add(std::move(body));
  }
  return some->size() > 0 ? some : nullptr;
}

std::vector<PlacedObstacle> with_clearance(std::vector<PlacedObstacle> obstacles, double clearance) {
  for (PlacedObstacle& obstacle : obstacles) obstacle.clearance = std::max(obstacle.clearance, clearance);
  return obstacles;
}

bool demands(const PlacedObstacle& obstacle) { return obstacle.clearance > 0; }

}  // namespace

SurroundingsByUse::SurroundingsByUse(const Scene& scene, const RefinementOptions& options)
    : obstacles(with_clearance(scene.bodies(), options.clearance)),
      all(some_of(obstacles, true, [](const PlacedObstacle&) { return true; })),
      touchable(some_of(obstacles, true, [](const PlacedObstacle& o) { return !demands(o); })),
      nearest(options.clearance_weight > 0
                  ? some_of(obstacles, false, [](const PlacedObstacle& o) { return o.prefer != Preference::near; })
                  : nullptr),
      demanded(some_of(obstacles, true, demands)) {
  for (int k = 0; k < static_cast<int>(obstacles.size()); ++k) {
    const PlacedObstacle& obstacle = obstacles[k];
    if (demands(obstacle)) demanded_numbers.push_back(k);
    if (obstacle.prefer == Preference::neutral || options.preference_weight == 0) continue;
    auto& list = obstacle.prefer == Preference::avoid ? avoided : kept_near;
    list.emplace_back(some_of({obstacle}, false, [](const PlacedObstacle&) { return true; }));
  }
  has_costs = nearest.field() || !avoided.empty() || !kept_near.empty();
}

}  // namespace tendril::routing
