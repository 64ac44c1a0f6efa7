// eq:gradient: what a script may ask for and what it gets.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "binding/lua_value.h"
#include "binding/scene_classes.h"
#include "scene/scene_gradient.h"

namespace tendril::lua {

/// {rod = "hose", at = 0.3, what = "position", along = {0, 0, 1}}: a measure that has no name of its own.
struct MeasureTable {
  std::string rod, what;
  std::variant<std::string, double> at;
  Vec3 along = Vec3::UnitZ();
  std::string to;  ///< obstacle of a clearance; empty: any
};

template <>
struct Value<MeasureTable> {
  static const Kind& kind();
  static MeasureTable read(lua_State* L, int index);
};

/// The measure that the table describes. Throws UsageError for a rod, place or obstacle that does not exist.
SceneMeasure scene_measure(const SceneEquilibrium& equilibrium, const MeasureTable& table);

using MeasureArgument = std::variant<std::string, Function, MeasureTable>;

/// The body of eq:gradient(measure, parameters).
SceneGradient gradient_of(lua_State* L, const std::shared_ptr<SceneEquilibrium>& equilibrium, const MeasureArgument& measure,
                          const std::vector<std::string>& parameters);

}  // namespace tendril::lua
