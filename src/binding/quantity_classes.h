// What a harness is measured by, as scripts see it.
#pragma once

#include "binding/lua_value.h"
#include "scene/quantities.h"

namespace tendril::lua {

template <> inline constexpr const char* class_name<Quantities> = "quantities";
template <> inline constexpr const char* class_name<RodQuantities> = "rod_quantities";

}  // namespace tendril::lua
