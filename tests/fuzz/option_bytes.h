// Bytes turned into a call of a bound function: which one, on what object, with what arguments and options.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "binding/lua_registry.h"

namespace tendril::fuzz {

class OptionBytes {
 public:
  /// `samples`: stack index of a table of objects by class name.
  OptionBytes(lua_State* L, const std::uint8_t* data, std::size_t size, int samples) : L_(L), at_(data), end_(data + size), samples_(samples) {}

  std::size_t below(std::size_t n) { return n == 0 ? 0 : next() % n; }

  /// Pushes one positional argument: mostly what the parameter asks for.
  void argument(const lua::Parameter& parameter) { value_for(parameter.kind->annotation, {}); }

  /// Pushes a table of options: mostly those that the schema has, mostly with values of their kind.
  void options(const lua::Schema& schema) {
    luaL_checkstack(L_, 8, "options");
    lua_newtable(L_);
    const std::vector<lua::Option>& entries = schema.entries();
    for (const lua::Option& entry : entries)
      if (entry.needed && below(16) != 0) set(entry);
    if (schema.list())
      for (std::size_t k = below(4); k > 0; --k) {
        value_for(schema.list()->kind->annotation, {});
        lua_rawseti(L_, -2, static_cast<lua_Integer>(lua_rawlen(L_, -2)) + 1);
      }
    for (std::size_t k = below(6); k > 0 && !entries.empty(); --k) set(entries[below(entries.size())]);
    if (below(16) == 0) {  // a name of no option, or no name
      any(2);
      if (lua_isnil(L_, -1) || (lua_type(L_, -1) == LUA_TNUMBER && std::isnan(lua_tonumber(L_, -1)))) lua_pop(L_, 1), lua_pushliteral(L_, "x");
      any(2);
      lua_rawset(L_, -3);
    }
  }

 private:
  std::uint8_t next() { return at_ < end_ ? *at_++ : 0; }

  void set(const lua::Option& entry) {
    lua_pushlstring(L_, entry.name.data(), entry.name.size());
    value_for(entry.kind->annotation, entry.choices);
    lua_rawset(L_, -3);
  }

  double number() {
    static constexpr double odd[] = {0, -0.0, -1, 1e-3, 0.5, 1, 2, 3, 7, 1e3, 1e9, -1e9, 1e300, -1e300, 5e-324, 1e-12,
                                     std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                                     std::numeric_limits<double>::quiet_NaN(), 9007199254740993.0, 2147483648.0};
    const std::size_t kind = below(4);
    if (kind == 0) return odd[below(std::size(odd))];
    if (kind == 1) return static_cast<double>(static_cast<std::int8_t>(next()));
    return static_cast<double>(next()) / 64;
  }

  /// What an annotation such as "number", "(vec)[]" or "frame?" asks for, or now and then something else.
  void value_for(std::string wanted, const std::vector<std::string>& choices) {
    luaL_checkstack(L_, 8, "value");
    if (below(12) == 0) return any(2);
    if (const auto bar = wanted.find('|'); bar != wanted.npos && below(2)) wanted = wanted.substr(bar + 1);
    else wanted = wanted.substr(0, bar);
    if (wanted.ends_with('?')) wanted.pop_back();
    if (!choices.empty()) {
      const std::string& choice = choices[below(choices.size())];
      lua_pushlstring(L_, choice.data(), choice.size());
    } else if (wanted == "number") {
      lua_pushnumber(L_, number());
    } else if (wanted == "integer") {
      lua_pushinteger(L_, below(4) == 0 ? static_cast<lua_Integer>(number() > 0) : static_cast<lua_Integer>(below(24)));
    } else if (wanted == "boolean") {
      lua_pushboolean(L_, below(2) == 1);
    } else if (wanted == "string") {
      word();
    } else if (wanted.starts_with('(') && wanted.ends_with(")[]")) {
      list(wanted.substr(1, wanted.size() - 4));
    } else {
      lua_pushlstring(L_, wanted.data(), wanted.size());
      if (lua_rawget(L_, samples_) == LUA_TNIL) lua_pop(L_, 1), any(3);
    }
  }

  void list(const std::string& entry) {
    lua_newtable(L_);
    const std::size_t count = below(8);
    for (std::size_t k = 1; k <= count; ++k) {
      value_for(entry, {});
      lua_rawseti(L_, -2, static_cast<lua_Integer>(k));
    }
  }

  void word() {
    static constexpr const char* words[] = {"hose", "start", "finish", "hose.length", "hose.to", "hose.from", "hose.min_bend_radius", "box",
                                            "link_6", "arm", "", "x", "\x1b[31m", "../x", "file.stl", "file.obj", "mm", "iso", "gravity", "joint"};
    if (below(8) != 0) {
      lua_pushstring(L_, words[below(std::size(words))]);
      return;
    }
    std::string text;
    for (std::size_t k = below(24); k > 0; --k) text += static_cast<char>(next());
    lua_pushlstring(L_, text.data(), text.size());
  }

  /// Any value; tables `depth` deep.
  void any(int depth) {
    luaL_checkstack(L_, 8, "value");
    switch (below(8)) {
      case 0: return lua_pushnil(L_);
      case 1: return lua_pushboolean(L_, below(2) == 1);
      case 2: return lua_pushnumber(L_, number());
      case 3: return word();
      case 4: {  // an object
        static constexpr const char* names[] = {"vec", "frame", "material", "section", "rod", "scene", "placed_rod", "equilibrium", "mesh", "curve",
                                                "robot", "solid", "function"};
        lua_pushstring(L_, names[below(std::size(names))]);
        lua_rawget(L_, samples_);
        return;
      }
      default: {
        lua_newtable(L_);
        for (std::size_t k = depth > 0 ? below(5) : 0, i = 1; i <= k; ++i) {
          any(depth - 1);
          if (below(3) == 0 && !lua_isnil(L_, -1)) {
            word();
            lua_insert(L_, -2);
            lua_rawset(L_, -3);
          } else {
            lua_rawseti(L_, -2, static_cast<lua_Integer>(i));
          }
        }
      }
    }
  }

  lua_State* L_;
  const std::uint8_t *at_, *end_;
  int samples_;
};

}  // namespace tendril::fuzz
