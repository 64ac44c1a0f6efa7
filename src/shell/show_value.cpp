#include "shell/show_value.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace tendril::shell {
namespace {

constexpr int most_entries = 12;

/// The value's text as an entry of a table: strings quoted, tables within only counted.
std::string entry_text(lua_State* L, int index) {
  if (lua_type(L, index) == LUA_TTABLE) {
    if (!luaL_getmetafield(L, index, "__tostring")) return "{...}";
    lua_pop(L, 1);
  }
  const bool quoted = lua_type(L, index) == LUA_TSTRING;
  std::size_t size = 0;
  const char* text = luaL_tolstring(L, index, &size);
  std::string result(text, std::min<std::size_t>(size, 200));
  lua_pop(L, 1);
  if (const auto line = result.find('\n'); line != std::string::npos) result = result.substr(0, line) + " ...";
  return quoted ? '"' + result + '"' : result;
}

std::vector<std::string> named_entries(lua_State* L, int table) {
  std::vector<std::string> entries;
  const auto listed = static_cast<lua_Integer>(lua_rawlen(L, table));
  for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1)) {
    if (lua_isinteger(L, -2) && lua_tointeger(L, -2) >= 1 && lua_tointeger(L, -2) <= listed) continue;
    lua_pushvalue(L, -2);
    std::string key = entry_text(L, -1);
    if (lua_type(L, -1) == LUA_TSTRING) key = key.substr(1, key.size() - 2);
    else key = "[" + key + "]";
    lua_pop(L, 1);
    entries.push_back(key + " = " + entry_text(L, -1));
  }
  std::sort(entries.begin(), entries.end());  // the table's own order differs from run to run
  return entries;
}

std::string table_text(lua_State* L, int table) {
  std::vector<std::string> entries;
  const auto listed = static_cast<lua_Integer>(lua_rawlen(L, table));
  for (lua_Integer i = 1; i <= std::min<lua_Integer>(listed, most_entries); ++i) {
    lua_rawgeti(L, table, i);
    entries.push_back(entry_text(L, -1));
    lua_pop(L, 1);
  }
  if (listed > most_entries) entries.push_back("... " + std::to_string(listed) + " entries");
  std::vector<std::string> named = named_entries(L, table);
  const std::size_t total = named.size();
  if (total > most_entries) named.resize(most_entries);
  entries.insert(entries.end(), named.begin(), named.end());
  if (total > most_entries) entries.push_back("... " + std::to_string(total) + " names");
  std::string text;
  std::size_t longest = 0;
  for (const std::string& entry : entries) longest += entry.size() + 2;
  const bool one_line = longest <= 76;
  for (const std::string& entry : entries)
    text += (text.empty() ? "" : one_line ? ", " : ",\n  ") + entry;
  return one_line ? "{" + text + "}" : "{\n  " + text + "\n}";
}

}  // namespace

int show_values(lua_State* L) {
  const int count = lua_gettop(L);
  luaL_checkstack(L, 10, "too many results");
  std::string line;
  for (int i = 1; i <= count; ++i) {
    if (i > 1) line += '\t';
    const bool plain_table = lua_type(L, i) == LUA_TTABLE && !lua_getmetatable(L, i);
    if (lua_type(L, i) == LUA_TTABLE && !plain_table) lua_pop(L, 1);
    if (plain_table) {
      line += table_text(L, i);
      continue;
    }
    std::size_t size = 0;
    const char* text = luaL_tolstring(L, i, &size);
    line.append(text, size);
    lua_pop(L, 1);
  }
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stdout);
  std::fflush(stdout);
  return 0;
}

}  // namespace tendril::shell
