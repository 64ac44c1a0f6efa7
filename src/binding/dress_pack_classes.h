// What method.dress_pack found, as scripts see it: handles on parts of one result.
#pragma once

#include <memory>

#include "binding/lua_value.h"
#include "method/dress_pack/dress_pack.h"
#include "method/dress_pack/pack_scene.h"

namespace tendril::lua {

struct DressPackHandle {
  std::shared_ptr<const dress_pack::Result> result;
  std::shared_ptr<const dress_pack::ScenePack> pack;
  std::shared_ptr<Scene> scene;
};

/// The motion along the given path, or along the optimised one.
struct PackMotionHandle {
  DressPackHandle of;
  bool optimised = false;
  const dress_pack::PackMotion& motion() const { return optimised ? of.result->after : of.result->before; }
  const dress_pack::JointPath& path() const { return optimised ? of.result->path : of.result->given; }
};

template <> inline constexpr const char* class_name<DressPackHandle> = "dress_pack";
template <> inline constexpr const char* class_name<PackMotionHandle> = "pack_motion";
template <> inline constexpr const char* class_name<dress_pack::PackSnap> = "pack_snap";
template <> inline constexpr const char* class_name<dress_pack::Unmet> = "unmet_limit";
template <> inline constexpr const char* class_name<dress_pack::ReducedIteration> = "search_step";

}  // namespace tendril::lua
