#include "shell/init_file.h"

#include <cstdlib>
#include <filesystem>

namespace tendril::shell {

std::string init_path() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config && config[0] == '/') return std::string(config) + "/tendril/init.lua";
  const char* home = std::getenv("HOME");
  return home && *home ? std::string(home) + "/.config/tendril/init.lua" : "";
}

bool run_init_file(Session& session, const std::string& path) {
  std::error_code error;
  if (path.empty() || !std::filesystem::exists(path, error)) return false;
  lua_State* L = session.state();
  bool done = false;
  if (luaL_loadfilex(L, path.c_str(), "t") != LUA_OK) session.tell_error();
  else done = session.call(0, 0);
  if (session.was_interrupted() || lua::interrupted(L)) session.resume_after_interrupt();
  return done;
}

}  // namespace tendril::shell
