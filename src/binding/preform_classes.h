// What scripts see of preformed hoses.
#pragma once

#include <memory>
#include <optional>

#include "binding/bind_mesh.h"
#include "binding/lua_value.h"
#include "method/preform/bending_table.h"
#include "method/preform/preform.h"
#include "scene/scene.h"

namespace tendril::lua {

/// A set of hoses; each hose shares it.
struct PreformHandle {
  std::shared_ptr<const preform::Result> result;
  std::shared_ptr<Scene> scene;
  std::optional<Section> section;  ///< where one was given
};

struct HoseHandle {
  PreformHandle set;
  int index = 0;  ///< counted from 0
  const preform::Hose& hose() const { return set.result->hoses[index]; }
  double outer() const { return 2 * set.result->options.space.radius; }
};

/// A gravity check: the equilibrium, and how far it is from the shape as formed.
struct SettledHandle {
  std::shared_ptr<SceneEquilibrium> equilibrium;
  double moved = 0, at = 0;
  double value() const { return moved; }
};

template <> inline constexpr const char* class_name<PreformHandle> = "preform_result";
template <> inline constexpr const char* class_name<HoseHandle> = "hose";
template <> inline constexpr const char* class_name<preform::Bend> = "bend";
template <> inline constexpr const char* class_name<SettledHandle> = "settled_hose";

}  // namespace tendril::lua
