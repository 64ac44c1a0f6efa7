// The steps of a method as scripts see them.
#pragma once

#include <string>
#include <vector>

#include "binding/lua_value.h"
#include "method/step.h"

namespace tendril::lua {

template <> inline constexpr const char* class_name<MethodStep> = "step";

void bind_steps(lua_State* L);

/// Name, time and counts of each.
std::string steps_table(const std::vector<MethodStep>& steps);

}  // namespace tendril::lua
