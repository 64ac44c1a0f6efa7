#include "binding/lua_value.h"

#include <cstdio>
#include <limits>

#include "binding/lua_context.h"

namespace tendril::lua {
namespace {

std::string short_text(const char* text, std::size_t size) {
  constexpr std::size_t longest = 40;
  std::string shown = "'";
  for (std::size_t i = 0; i < std::min(size, longest); ++i) {
    const bool printable = static_cast<unsigned char>(text[i]) >= 32 && text[i] != 127;
    shown += printable ? text[i] : '?';
  }
  return shown + (size > longest ? "...'" : "'");
}

std::string number_text(lua_State* L, int index) {
  char text[64];
  if (std::isnan(lua_tonumber(L, index))) return "nan";
  if (lua_isinteger(L, index)) std::snprintf(text, sizeof text, "%lld", static_cast<long long>(lua_tointeger(L, index)));
  else std::snprintf(text, sizeof text, "%.10g", static_cast<double>(lua_tonumber(L, index)));
  return text;
}

/// The registered or given name of what a userdata or table is, or "".
std::string named_type(lua_State* L, int index) {
  std::string name;
  if (lua_getmetatable(L, index)) {
    lua_pushliteral(L, "__name");
    if (lua_rawget(L, -2) == LUA_TSTRING) name = lua_tostring(L, -1);
    lua_pop(L, 2);
  }
  return name;
}

}  // namespace

std::string describe(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNONE: return "nothing";
    case LUA_TNIL: return "nil";
    case LUA_TBOOLEAN: return lua_toboolean(L, index) ? "true" : "false";
    case LUA_TNUMBER: return "a number (" + number_text(L, index) + ")";
    case LUA_TSTRING: {
      std::size_t size = 0;
      const char* text = lua_tolstring(L, index, &size);
      return "a string (" + short_text(text, size) + ")";
    }
    case LUA_TLIGHTUSERDATA: return "a pointer";
    default: break;
  }
  std::string name = named_type(L, index);
  if (name.empty()) name = lua_typename(L, lua_type(L, index));
  const bool vowel = std::string("aeiou").find(name[0]) != std::string::npos;
  return (vowel ? "an " : "a ") + name;
}

void* object_memory(lua_State* L, int index, const void* key) {
  if (lua_type(L, index) != LUA_TUSERDATA || !lua_getmetatable(L, index)) return nullptr;
  lua_rawgetp(L, LUA_REGISTRYINDEX, key);
  const bool same = lua_rawequal(L, -1, -2);
  lua_pop(L, 2);
  return same ? lua_touserdata(L, index) : nullptr;
}

void* new_object(lua_State* L, std::size_t size) {
  luaL_checkstack(L, 3, "too many values");
  return lua_newuserdatauv(L, size, 0);
}

void with_class(lua_State* L, const void* key, const char* name) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, key) != LUA_TTABLE)
    throw std::logic_error(std::string(name) + ": the class is declared but not registered");
  lua_setmetatable(L, -2);
}

const Kind& Value<double>::kind() {
  static const Kind kind{"a finite number", "number", [](lua_State* L, int index) -> std::string {
    if (lua_type(L, index) != LUA_TNUMBER) return describe(L, index);
    return std::isfinite(lua_tonumber(L, index)) ? std::string() : number_text(L, index);
  }};
  return kind;
}

const Kind& Value<int>::kind() {
  static const Kind kind{"a whole number", "integer", [](lua_State* L, int index) -> std::string {
    if (lua_type(L, index) != LUA_TNUMBER) return describe(L, index);
    int exact = 0;
    const lua_Integer value = lua_tointegerx(L, index, &exact);
    const bool fits = value >= std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max();
    return exact && fits ? std::string() : number_text(L, index);
  }};
  return kind;
}

const Kind& Value<bool>::kind() {
  static const Kind kind{"true or false", "boolean", [](lua_State* L, int index) {
    return lua_type(L, index) == LUA_TBOOLEAN ? std::string() : describe(L, index);
  }};
  return kind;
}

const Kind& Value<std::string>::kind() {
  static const Kind kind{"a string", "string", [](lua_State* L, int index) {
    return lua_type(L, index) == LUA_TSTRING ? std::string() : describe(L, index);
  }};
  return kind;
}

std::string Value<std::string>::read(lua_State* L, int index) {
  std::size_t size = 0;
  const char* text = lua_tolstring(L, index, &size);
  return {text, size};
}

const Kind& Value<Vec3>::kind() {
  static const Kind kind{"a vec or {x, y, z} of finite numbers", "vec|number[]", [](lua_State* L, int index) -> std::string {
    if (const Vec3* v = object<Vec3>(L, index)) return all_finite(*v) ? std::string() : "a vec with an entry that is not finite";
    if (lua_type(L, index) != LUA_TTABLE) return describe(L, index);
    return wrong_list(L, index, Value<double>::kind(), 3);
  }, "vec"};
  return kind;
}

Vec3 Value<Vec3>::read(lua_State* L, int index) {
  if (const Vec3* v = object<Vec3>(L, index)) return *v;
  const std::array<double, 3> entries = Value<std::array<double, 3>>::read(L, index);
  return {entries[0], entries[1], entries[2]};
}

void Value<Vec3>::push(lua_State* L, const Vec3& value) {
  new (new_object(L, sizeof(Vec3))) Vec3(value);
  with_class(L, &class_key<Vec3>, class_name<Vec3>);
}

const Kind& Value<Any>::kind() {
  static const Kind kind{"any value", "any", [](lua_State* L, int index) -> std::string {
    return lua_isnone(L, index) ? "nothing" : "";
  }};
  return kind;
}

std::string wrong_list(lua_State* L, int index, const Kind& entry, int exact_length) {
  if (lua_type(L, index) != LUA_TTABLE) return describe(L, index);
  luaL_checkstack(L, 6, "lists nested too deeply");
  index = lua_absindex(L, index);
  const auto size = static_cast<lua_Integer>(lua_rawlen(L, index));
  if (exact_length >= 0 && size != exact_length) return "a table with " + std::to_string(size) + " list entries";
  for (lua_Integer i = 1; i <= size; ++i) {
    lua_rawgeti(L, index, i);
    const std::string wrong = entry.wrong(L, -1);
    lua_pop(L, 1);
    if (!wrong.empty()) return "a table whose entry " + std::to_string(i) + " is " + wrong;
  }
  return {};
}

std::string wrong_map(lua_State* L, int index, const Kind& entry) {
  if (lua_type(L, index) != LUA_TTABLE) return describe(L, index);
  luaL_checkstack(L, 6, "tables nested too deeply");
  index = lua_absindex(L, index);
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING) {
      const std::string key = describe(L, -2);
      lua_pop(L, 2);
      return "a table with " + key + " in place of a name";
    }
    if (const std::string wrong = entry.wrong(L, -1); !wrong.empty()) {
      const std::string name = Value<std::string>::read(L, -2);
      lua_pop(L, 2);
      return "a table whose entry '" + name + "' is " + wrong;
    }
  }
  return {};
}

struct Function::Kept {
  lua_State* main;
  int reference;
  ~Kept() { luaL_unref(main, LUA_REGISTRYINDEX, reference); }
};

Function::Function(lua_State* L, int index) {
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_MAINTHREAD);
  lua_State* main = lua_tothread(L, -1);
  lua_pop(L, 1);
  lua_pushvalue(L, index);
  kept_.reset(new Kept{main, luaL_ref(L, LUA_REGISTRYINDEX)});
}

void Function::push(lua_State* L) const { lua_rawgeti(L, LUA_REGISTRYINDEX, kept_->reference); }

const Kind& Value<Function>::kind() {
  static const Kind kind{"a function", "function", [](lua_State* L, int index) {
    return lua_type(L, index) == LUA_TFUNCTION ? std::string() : describe(L, index);
  }};
  return kind;
}

}  // namespace tendril::lua
