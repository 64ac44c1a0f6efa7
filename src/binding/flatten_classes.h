// What method.flatten found, as scripts see it.
#pragma once

#include <memory>

#include "binding/lua_value.h"
#include "method/assembly/flatten.h"

namespace tendril::lua {

struct FlattenHandle {
  std::shared_ptr<const assembly::FlattenResult> result;
};

template <> inline constexpr const char* class_name<FlattenHandle> = "board";
template <> inline constexpr const char* class_name<assembly::BoardPoint> = "board_point";
template <> inline constexpr const char* class_name<assembly::BoardLine> = "board_line";

}  // namespace tendril::lua
