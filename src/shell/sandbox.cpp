#include "shell/sandbox.h"

#include <filesystem>
#include <lua.hpp>

#include "base/file_access.h"
#include "base/installation.h"
#include "binding/lua_sandbox.h"
#include "shell/module_path.h"

namespace fs = std::filesystem;

namespace tendril::shell {
namespace {

void set_module_path(lua_State* L, const std::string& folder) {
  const std::string path = folder.empty() ? "" : folder + "/?.lua;" + folder + "/?/init.lua";
  lua_getglobal(L, "package");
  lua_pushlstring(L, path.data(), path.size());
  lua_setfield(L, -2, "path");
  lua_pop(L, 1);
}

}  // namespace

std::string enter_sandbox(lua_State* L, std::string folder, const std::string& script) {
  const std::string opened = script.empty() ? "" : fs::absolute(script).lexically_normal().string();
  if (folder.empty()) folder = script.empty() ? "." : folder_of(opened);
  // What comes with the program and is read as files: robots, modules in Lua.
  const std::string assets = part_folder(Part::assets), modules = part_folder(Part::lua);
  set_module_path(L, modules);
  lua::restrict_to_sandbox(L);
  confine_files(folder, {assets, modules});
  fs::current_path(folder);
  return opened;
}

}  // namespace tendril::shell
