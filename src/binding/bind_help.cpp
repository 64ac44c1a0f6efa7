#include <algorithm>

#include "base/nearest_name.h"
#include "binding/help_text.h"
#include "binding/lua_class.h"
#include "binding/open.h"

namespace tendril::lua {
namespace {

std::vector<std::string> all_names(const Registry& registry) {
  std::vector<std::string> names;
  for (const auto& module : registry.modules)
    if (!module->name.empty()) names.push_back(module->name);
  for (const auto& record : registry.classes) names.push_back(record->name);
  for (const auto& function : registry.functions) names.push_back(function->name);
  return names;
}

/// The value of a global path such as "bay" or "parts.bay", pushed; false when there is none. Runs no code.
bool push_global(lua_State* L, const std::string& path) {
  const int top = lua_gettop(L);
  lua_pushglobaltable(L);
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t to = std::min(path.find('.', from), path.size());
    if (!lua_istable(L, -1)) break;
    lua_pushlstring(L, path.data() + from, to - from);
    lua_rawget(L, -2);
    from = to + 1;
    if (from > path.size() && !lua_isnil(L, -1)) return true;
  }
  lua_settop(L, top);
  return false;
}

std::string help_of_value(lua_State* L, int index) {
  const Registry& registry = *context(L).registry;
  if (const FunctionRecord* function = function_at(L, index)) return help_named(registry, function->name);
  if (const ClassRecord* record = class_at(L, index)) return help_text(*record);
  if (const ModuleRecord* module = module_at(L, index)) return help_text(*module);
  return {};
}

void help(lua_State* L, std::optional<Any> subject) {
  const Registry& registry = *context(L).registry;
  const int top = lua_gettop(L);
  std::string text;
  if (!subject) {
    text = help_overview(registry);
  } else if (lua_type(L, subject->index) == LUA_TSTRING) {
    const std::string name = Value<std::string>::read(L, subject->index);
    text = help_named(registry, name);
    if (text.empty() && push_global(L, name)) {
      text = help_of_value(L, -1);
      if (text.empty()) text = name + " is " + describe(L, -1) + "; there is no help about it";
      lua_settop(L, top);
    }
    if (text.empty()) text = help_search_text(registry, name);
    if (text.empty()) {
      const std::string near = nearest_name(name, all_names(registry));
      throw UsageError("help: nothing is called '" + name + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
  } else {
    text = help_of_value(L, subject->index);
    if (text.empty()) text = "no help about " + describe(L, subject->index);
  }
  lua_getglobal(L, "print");
  Value<std::string>::push(L, text);
  lua_call(L, 1, 0);
}

}  // namespace

void bind_help(lua_State* L) {
  Module(L, "", "").function("help", {.takes = {"subject"}, .does = "Says what a function, object, module or name is; for other words, what is called or does something like it.",
                                      .example = "help(vec)\nhelp \"scene:solve\"\nhelp \"bend radius\""},
                             help);
}

}  // namespace tendril::lua
