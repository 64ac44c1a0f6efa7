// The C++ classes that scripts see, by the names they have in messages, help and annotations. To bind a class: declare
// it here, then register its members with Class<T> (lua_class.h) in a bind_<name>.cpp.
#pragma once

#include "base/frame.h"
#include "base/vectors.h"

namespace tendril::lua {

template <class T>
inline constexpr const char* class_name = nullptr;

/// True: the value lives inside the Lua object itself. For small values without special alignment.
template <class T>
inline constexpr bool is_inline = false;

template <> inline constexpr const char* class_name<Vec3> = "vec";
template <> inline constexpr bool is_inline<Vec3> = true;
template <> inline constexpr const char* class_name<Frame> = "frame";

}  // namespace tendril::lua
