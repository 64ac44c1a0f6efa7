#include "method/route/objects_in_order.h"

#include <algorithm>
#include <cmath>

#include "geometry/tube_surface.h"
#include "method/preform/bending_table.h"

namespace tendril::route {

namespace {

void check(const Scene& scene, const std::vector<ObjectToRoute>& objects) {
  if (objects.empty()) throw UsageError("route: there are no objects to route");
  std::vector<std::string> taken;
  for (const PlacedObstacle& obstacle : scene.bodies()) taken.push_back(obstacle.name);
  for (const auto& rod : scene.rods()) taken.push_back(rod->name());
  for (const ObjectToRoute& object : objects) {
    if (object.name.empty()) throw UsageError("route: an object needs a name");
    if (std::find(taken.begin(), taken.end(), object.name) != taken.end())
      throw UsageError("route: there is already something named '" + object.name + "'; give each object a name of its own");
    if (!(std::isfinite(object.apart) && object.apart >= 0))
      throw UsageError("route: 'apart' of '" + object.name + "' must be a length of at least 0");
    taken.push_back(object.name);
  }
}

/// Lengths along the curve so close that chords between them stay within `tolerance` of it.
std::vector<double> rings_along(const Curve& curve, double outer, double tolerance) {
  const double bend = std::max(curve.min_bend_radius(), 0.5 * outer) + 0.5 * outer;
  // Facets as long as they are wide at most: longer ones would make a bad tree.
  const double piece = std::min(std::sqrt(8 * bend * tolerance), outer);
  const int count = std::clamp(static_cast<int>(std::ceil(curve.length() / piece)), 1, 20000);
  std::vector<double> rings;
  for (int i = 0; i <= count; ++i) rings.push_back(curve.length() * i / count);
  return rings;
}

/// The objects one after the other, with a way back where one of them finds none.
class InOrder {
 public:
  InOrder(const Scene& scene, const std::vector<ObjectToRoute>& objects, const RunContext& context, int most_attempts)
      : scene_(scene), objects_(objects), context_(context), attempts_left_(most_attempts) {
    for (const ObjectToRoute& object : objects) steps_.push_back({object.name, 0, {{"attempts", 0}, {"routes", 0}}});
  }

  ObjectsResult run() {
    ObjectsResult result;
    result.ok = place(0);
    result.objects = result.ok ? std::move(placed_) : std::move(farthest_);
    result.steps = std::move(steps_);
    for (const MethodStep& step : result.steps) result.seconds += step.seconds;
    conclude(result);
    return result;
  }

 private:
  /// Object k and all after it; false where there is no way.
  bool place(std::size_t k) {
    if (k == objects_.size()) return true;
    if (attempts_left_-- <= 0 || context_.stop()) return false;
    placed_.push_back({objects_[k].name, route::run(scene_for(k), objects_[k].options, context_), 0});
    count(k);
    if (placed_.size() > farthest_.size()) farthest_ = placed_;
    const std::vector<Route> alternatives = placed_[k].result.routes;
    for (std::size_t i = 0; i < alternatives.size() && alternatives[i].ok; ++i) {
      placed_[k].chosen = static_cast<int>(i);
      surfaces_.push_back(std::make_shared<const TriangleSurface>(surface_of(alternatives[i], 2 * objects_[k].options.space.radius)));
      if (place(k + 1)) return true;
      surfaces_.pop_back();
    }
    placed_.pop_back();
    return false;
  }

  /// The obstacles of the scene and the objects before k.
  Scene scene_for(std::size_t k) const {
    Scene scene = scene_.without_rods();
    for (std::size_t i = 0; i < k; ++i) {
      PlacedObstacle obstacle;
      obstacle.name = objects_[i].name;
      obstacle.body.shape = surfaces_[i];
      obstacle.clearance = objects_[k].apart;
      obstacle.prefer = objects_[k].earlier;
      obstacle.clip = false;
      scene.add(std::move(obstacle));
    }
    return scene;
  }

  void count(std::size_t k) {
    const Result& result = placed_[k].result;
    steps_[k].seconds += result.seconds;
    steps_[k].counts[0].second += 1;
    steps_[k].counts[1].second += static_cast<long>(result.routes.size());
  }

  void conclude(ObjectsResult& result) const {
    const std::string so_far = std::to_string(result.objects.size()) + " of " + std::to_string(objects_.size()) + " objects";
    if (const auto stopped = context_.stop()) {
      result.ok = false;
      result.status = *stopped;
      result.message = std::string(*stopped == Status::timeout ? "out of time" : "cancelled") + " at " + so_far;
    } else if (result.ok) {
      result.status = Status::solved;
      result.message = so_far;
    } else {
      result.status = Status::infeasible;
      const RoutedObject& last = result.objects.back();
      result.message = "'" + last.name + "': " + last.result.message;
      if (result.objects.size() > 1) result.message += "; the objects before it are in its way or leave it too little room; try another order";
    }
  }

  const Scene& scene_;
  const std::vector<ObjectToRoute>& objects_;
  const RunContext& context_;
  int attempts_left_;
  std::vector<MethodStep> steps_;
  std::vector<RoutedObject> placed_, farthest_;
  std::vector<std::shared_ptr<const TriangleSurface>> surfaces_;  ///< of the chosen routes in placed_
};

}  // namespace

Mesh surface_of(const Route& route, double outer, double excess) {
  // Facets around and chords along lie within the tube by a tolerance each; half of one is for the spline through the vertices.
  const double tolerance = excess / 3, grown = outer + 2 * 2.5 * tolerance;
  const SceneEquilibrium* settled = route.refined.equilibrium.get();
  if (!settled || settled->rods.empty()) return preform::tube_mesh(route.nominal, grown, 0, tolerance);
  // Between its vertices the rod bends as its elements do; four places an element leave a spline nothing to add.
  const Equilibrium& shape = settled->rods.front().equilibrium;
  std::vector<Vec3> points{shape.points.front()};
  for (std::size_t i = 0; i + 1 < shape.s.size(); ++i)
    for (int k = 1; k <= 4; ++k) points.push_back(shape.frame_at(shape.s[i] + (shape.s[i + 1] - shape.s[i]) * k / 4).at);
  const Curve curve = Curve::spline(points, {route.design.from.d3(), route.design.to.d3()});
  return tube_surface(curve, rings_along(curve, grown, tolerance), grown, 0, sides_for(0.5 * grown, tolerance));
}

ObjectsResult run_in_order(const Scene& scene, const std::vector<ObjectToRoute>& objects, const RunContext& context, int most_attempts) {
  check(scene, objects);
  return InOrder(scene, objects, context, most_attempts).run();
}

Scene scene_of(const Scene& scene, const ObjectsResult& result) {
  Scene all = scene.without_rods();
  for (const RoutedObject& object : result.objects) {
    if (object.result.routes.empty()) continue;
    const routing::Design& design = object.result.routes[object.chosen].design;
    PlacedRod& rod = all.add(PlacedRod(object.name, design.rod, design.from, design.to));
    if (design.turns != 0) rod.hold({design.rod.length, design.to, true, true, design.turns});
    for (const Hold& clip : design.clips) rod.hold(clip);
  }
  return all;
}

}  // namespace tendril::route
