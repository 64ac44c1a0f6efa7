// The tables that a script gives to method.variation, as C++ options.
#pragma once

#include "binding/bind_gradient.h"
#include "binding/lua_class.h"
#include "method/variation/options.h"

namespace tendril::lua {

/// vary, together, measure, outcomes, sampling, replicates, effects, uniform and what every solve and method takes.
Schema variation_schema();

variation::Options variation_options(lua_State* L, const Scene& scene, const Options& o);

}  // namespace tendril::lua
