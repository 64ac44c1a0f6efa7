// What method.dress_pack found, as scripts see it: handles on parts of one result.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "binding/schema.h"
#include "method/dress_pack/dress_pack.h"
#include "method/dress_pack/pack_scene.h"
#include "method/dress_pack/parameters.h"

namespace tendril::lua {

struct DressPackHandle {
  std::shared_ptr<const dress_pack::Result> result;
  std::shared_ptr<const dress_pack::ScenePack> pack;
  std::shared_ptr<Scene> scene;
};

/// A motion along a path, and what it belongs to.
struct PackMotionHandle {
  std::shared_ptr<const dress_pack::PackMotion> motion;  ///< shares the result that it is part of
  dress_pack::JointPath path;
  std::shared_ptr<const dress_pack::ScenePack> pack;
  std::shared_ptr<Scene> scene;
  const char* title;
};

/// What method.dress_pack_design found.
struct PackDesignHandle {
  std::shared_ptr<const dress_pack::ParameterResult> result;
  std::vector<std::string> names;                        ///< of the adjusted numbers
  std::vector<double> before;                            ///< their values as given
  std::vector<dress_pack::JointPath> paths;
  std::shared_ptr<const dress_pack::ScenePack> given, found;
  std::shared_ptr<Scene> scene;
};

/// What the methods for dress packs have in common.
std::string robot_of(const Scene& scene, const Options& o, const char* who);
dress_pack::JointPath path_of(const std::vector<std::vector<double>>& rows, const Robot& robot, const std::string& who);
/// max_tension, max_twist, min_bend_radius.
Schema pack_limit_options();
dress_pack::Limits pack_limits(const Options& o);

template <> inline constexpr const char* class_name<DressPackHandle> = "dress_pack";
template <> inline constexpr const char* class_name<PackMotionHandle> = "pack_motion";
template <> inline constexpr const char* class_name<PackDesignHandle> = "pack_design";
template <> inline constexpr const char* class_name<dress_pack::PackSnap> = "pack_snap";
template <> inline constexpr const char* class_name<dress_pack::Unmet> = "unmet_limit";
template <> inline constexpr const char* class_name<dress_pack::ReducedIteration> = "search_step";

}  // namespace tendril::lua
