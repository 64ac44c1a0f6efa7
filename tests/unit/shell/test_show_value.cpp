#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>

#include "shell/module_path.h"
#include "shell/show_value.h"
#include "unit/binding/script.h"

namespace {

/// What the interactive session prints for the values that `code` returns.
std::string shown(Script& lua, const std::string& code) {
  lua_settop(lua.L, 0);
  lua_pushcfunction(lua.L, tendril::shell::show_values);
  REQUIRE(luaL_loadstring(lua.L, code.c_str()) == LUA_OK);
  REQUIRE(lua_pcall(lua.L, 0, LUA_MULTRET, 0) == LUA_OK);
  std::fflush(stdout);
  char path[] = "/tmp/tendril_shown_XXXXXX";
  const int file = ::mkstemp(path), kept = ::dup(1);
  ::dup2(file, 1);
  const int status = lua_pcall(lua.L, lua_gettop(lua.L) - 1, 0, 0);
  ::dup2(kept, 1);
  ::close(kept);
  std::string text(4096, '\0');
  const ssize_t size = ::pread(file, text.data(), text.size(), 0);
  ::close(file);
  ::unlink(path);
  if (status != LUA_OK) return std::string("error: ") + lua_tostring(lua.L, -1);
  text.resize(static_cast<std::size_t>(size));
  return text;
}

}  // namespace

TEST_CASE("results print as print does, tables by their first entries") {
  Script lua;
  CHECK(shown(lua, "return 1, 'a', nil, vec(1, 2, 3)") == "1\ta\tnil\tvec(1, 2, 3)\n");
  CHECK(shown(lua, "return {}") == "{}\n");
  CHECK(shown(lua, "return {1, 'a', {}, b = true, [10] = 2, a = vec(1, 2, 3)}") ==
        "{1, \"a\", {...}, [10] = 2, a = vec(1, 2, 3), b = true}\n");
  CHECK(shown(lua, "local t = {} for i = 1, 100 do t[i] = i end return t") ==
        "{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, ... 100 entries}\n");
  CHECK(shown(lua, "return {vec(1/3, 1/3, 1/3), vec(1/3, 1/3, 1/3)}") ==
        "{\n  vec(0.3333333333, 0.3333333333, 0.3333333333),\n  vec(0.3333333333, 0.3333333333, 0.3333333333)\n}\n");
  CHECK(shown(lua, "return setmetatable({}, {__tostring = function() return 'mine' end})") == "mine\n");
  CHECK(shown(lua, "return {setmetatable({}, {__tostring = function() return 'mine' end})}") == "{mine}\n");
  CHECK(shown(lua, "return setmetatable({}, {__tostring = function() error('no') end})").find("no") != std::string::npos);
  CHECK(shown(lua, "return setmetatable({}, {__tostring = function() return {} end})") == "error: '__tostring' must return a string");
}

TEST_CASE("where modules are looked for") {
  using namespace tendril::shell;
  CHECK(folder_of("studies/hose.lua") == "studies/");
  CHECK(folder_of("hose.lua") == "./");
  CHECK(folder_of("/hose.lua") == "/");
  ::setenv("TENDRIL_LUA", "/a:/b::/odd;name", 1);
  const std::string path = module_path("studies/", true);
  CHECK(path.find("studies/?.lua;studies/?/init.lua;/a/?.lua;/a/?/init.lua;/b/?.lua;/b/?/init.lua") == 0);
  CHECK(path.find("odd") == std::string::npos);
  CHECK(module_path("studies/", false).find("/a/") == std::string::npos);
  ::unsetenv("TENDRIL_LUA");
}
