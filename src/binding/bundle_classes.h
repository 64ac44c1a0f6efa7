// Wires and bundles as scripts see them.
#pragma once

#include "binding/lua_value.h"
#include "rod/bundle.h"

namespace tendril::lua {

template <> inline constexpr const char* class_name<BundleWire> = "wire";
template <> inline constexpr const char* class_name<Bundle> = "bundle";

}  // namespace tendril::lua
