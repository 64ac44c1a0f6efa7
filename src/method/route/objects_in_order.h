// Several flexible objects in one scene, one after the other: each is an obstacle for those that follow.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "method/route/route.h"

namespace tendril::route {

/// One of several.
struct ObjectToRoute {
  std::string name;
  Options options;
  /// How it likes to run beside those before it; counts with options.space.preference.
  Preference earlier = Preference::neutral;
  double apart = 0;  ///< m, from those before it; its own clearance where that is more
};

struct RoutedObject {
  std::string name;
  Result result;   ///< its alternatives
  int chosen = 0;  ///< of result.routes: the one that the objects after it keep clear of
};

struct ObjectsResult {
  bool ok = false;                    ///< each object keeps all that is demanded
  /// solved. infeasible: an object has no route beside those before it, whichever of their alternatives they take. cancelled, timeout.
  Status status = Status::stalled;
  std::string message;
  double seconds = 0;
  std::vector<MethodStep> steps;      ///< one for each object, over all attempts
  std::vector<RoutedObject> objects;  ///< as far as it came, in order
};

/// Routes the objects in order. Where one of them has no way, the object before it takes its next alternative (those of its
/// weights), and so on back; at most `most_attempts` calls of run(). Throws UsageError for names that are empty, taken or twice
/// there, and for what run() refuses.
ObjectsResult run_in_order(const Scene& scene, const std::vector<ObjectToRoute>& objects, const RunContext& context = {},
                           int most_attempts = 30);

/// The surface of a design in equilibrium (as routed where there is none), as the objects after it see it: it contains the true
/// one and is nowhere more than `excess` (m) outside.
Mesh surface_of(const Route& route, double outer, double excess = 4e-5);

/// The scene's obstacles with every object as a rod, held at its ends and clips.
Scene scene_of(const Scene& scene, const ObjectsResult& result);

}  // namespace tendril::route
