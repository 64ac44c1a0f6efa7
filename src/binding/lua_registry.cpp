#include "binding/lua_registry.h"

namespace tendril::lua {
namespace {

/// The pointer kept under `field` in the metatable of the value at `index`, or null.
const void* marked(lua_State* L, int index, const char* field) {
  if (!lua_getmetatable(L, index)) return nullptr;
  lua_pushstring(L, field);
  lua_rawget(L, -2);
  const void* pointer = lua_islightuserdata(L, -1) ? lua_touserdata(L, -1) : nullptr;
  lua_pop(L, 2);
  return pointer;
}

template <class List>
auto find_named(const List& list, std::string_view name) -> decltype(list.front().get()) {
  for (const auto& entry : list)
    if (entry->name == name) return entry.get();
  return nullptr;
}

}  // namespace

std::string FunctionRecord::own_name() const {
  const auto mark = name.find_last_of(".:");
  return mark == std::string::npos ? name : name.substr(mark + 1);
}

std::string FunctionRecord::signature() const {
  std::string table;
  if (takes_options) {
    if (options.list()) table = options.list()->name + ", ...";
    for (const Option& option : options.entries()) {
      const std::string preset = option.preset_text();
      const std::string text = option.name + "=" + preset;
      table += (table.empty() ? "" : ", ") + (option.needed || !preset.empty() ? text : "[" + text + "]");
    }
    table = "{" + table + "}";
  }
  std::string inside;
  for (const Parameter& parameter : parameters) inside += (inside.empty() ? "" : ", ") + parameter.name;
  std::string text = name;
  if (inside.empty() && takes_options) text += table;
  else text += "(" + inside + (takes_options ? ", " + table : "") + ")";
  return returns.empty() ? text : text + " -> " + returns;
}

std::vector<std::string> ClassRecord::names() const {
  std::vector<std::string> names;
  for (const auto& [name, property] : properties) names.push_back(name);
  for (const auto& [name, method] : methods) names.push_back(name);
  return names;
}

const FunctionRecord* Registry::function(std::string_view name) const { return find_named(functions, name); }
const ClassRecord* Registry::class_named(std::string_view name) const { return find_named(classes, name); }
ModuleRecord* Registry::module(std::string_view name) const { return find_named(modules, name); }

const FunctionRecord* function_at(lua_State* L, int index) {
  if (!lua_iscfunction(L, index) || !lua_getupvalue(L, index, 1)) return nullptr;
  const void* pointer = lua_islightuserdata(L, -1) ? lua_touserdata(L, -1) : nullptr;
  lua_pop(L, 1);
  return static_cast<const FunctionRecord*>(pointer);
}

const ClassRecord* class_at(lua_State* L, int index) {
  if (lua_type(L, index) != LUA_TUSERDATA) return nullptr;
  return static_cast<const ClassRecord*>(marked(L, index, "record"));
}

const ModuleRecord* module_at(lua_State* L, int index) {
  if (lua_type(L, index) != LUA_TTABLE) return nullptr;
  return static_cast<const ModuleRecord*>(marked(L, index, "module"));
}

}  // namespace tendril::lua
