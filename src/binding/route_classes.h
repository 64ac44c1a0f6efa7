// What scripts see of routes and refined designs.
#pragma once

#include <memory>

#include "binding/lua_value.h"
#include "binding/routing_options.h"
#include "method/route/objects_in_order.h"

namespace tendril::lua {

/// A set of routes; each route shares it.
struct RoutesHandle {
  std::shared_ptr<const route::Result> result;
};
struct RouteHandle {
  std::shared_ptr<const route::Result> result;
  int index = 0;  ///< counted from 0
  const route::Route& route() const { return result->routes[index]; }
};

/// Several objects and the scene they were routed in; each object shares it.
struct RoutedObjectsHandle {
  std::shared_ptr<const route::ObjectsResult> result;
  std::shared_ptr<Scene> scene;
};
struct RoutedObjectHandle {
  std::shared_ptr<const route::ObjectsResult> result;
  int index = 0;  ///< counted from 0
  const route::RoutedObject& object() const { return result->objects[index]; }
};

/// What method.refine gives, and what a route holds of its refinement.
struct RefinedHandle {
  std::shared_ptr<const routing::RefinementResult> result;
};

template <> inline constexpr const char* class_name<RoutesHandle> = "routes";
template <> inline constexpr const char* class_name<RouteHandle> = "route";
template <> inline constexpr const char* class_name<RoutedObjectsHandle> = "routed_objects";
template <> inline constexpr const char* class_name<RoutedObjectHandle> = "routed_object";
template <> inline constexpr const char* class_name<RefinedHandle> = "refined_design";
template <> inline constexpr const char* class_name<routing::Adjusted> = "adjusted_parameter";
template <> inline constexpr const char* class_name<routing::Unmet> = "unmet_demand";

/// What an object is routed by in method.route and method.route_all, and what it says. `who` asks: "method.route".
Schema route_schema();
route::Options route_options(const Options& o);
/// adjust, solver, weights of what is refined, limits: shared by method.route and method.refine.
Schema refinement_schema();
routing::RefinementOptions refinement_options(const Options& o);

}  // namespace tendril::lua
