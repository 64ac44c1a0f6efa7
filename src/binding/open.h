// Everything that tendril adds to a Lua state.
#pragma once

struct lua_State;

namespace tendril::lua {

/// Registers all modules, classes and global functions.
void open_tendril(lua_State* L);

// One for each bind_<name>.cpp.
void bind_units(lua_State* L);
void bind_vec(lua_State* L);
void bind_frame(lua_State* L);
void bind_rod(lua_State* L);
void bind_robot(lua_State* L);
void bind_curve(lua_State* L);
void bind_scene(lua_State* L);
void bind_branch(lua_State* L);
void bind_placed_robot(lua_State* L);
void bind_equilibrium(lua_State* L);
void bind_gradient(lua_State* L);
void bind_method(lua_State* L);
void bind_view(lua_State* L);
void bind_study(lua_State* L);
void bind_session(lua_State* L);
void bind_help(lua_State* L);
void bind_time(lua_State* L);

}  // namespace tendril::lua
