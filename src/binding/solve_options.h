// The options that every static solve takes from a script.
#pragma once

#include "binding/lua_class.h"
#include "statics/problem.h"

namespace tendril::lua {

/// element, clamp, tolerance, clearance, error.
Schema solve_schema();

/// Reads what solve_schema() describes.
SolveOptions solve_options(const Options& o);

/// timeout.
Schema timeout_schema();

/// The shell's cancel flag and progress, and the deadline that `timeout` sets from now.
RunContext run_context(lua_State* L, const Options& o);

}  // namespace tendril::lua
