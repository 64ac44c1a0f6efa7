// The record of everything bound: what a call needs, and what help, completion and the editor annotations say about it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "binding/schema.h"

namespace tendril::lua {

struct Parameter {
  std::string name;
  const Kind* kind = nullptr;
};

/// One bound function or method.
struct FunctionRecord {
  enum class Call { function, method, operation };

  std::string name;   ///< as a user calls it: "vec", "rod.section", "scene:solve", "vec *"
  Call call = Call::function;
  std::string event;  ///< of an operation: "__mul"
  std::vector<Parameter> parameters;  ///< positional, without the object and without the options table
  Schema options;
  bool takes_options = false;
  std::string returns;        ///< annotation, "" for nothing
  std::string text;
  std::string example;        ///< a Lua chunk that runs
  std::function<int(lua_State*)> body;

  std::string own_name() const;   ///< "solve"
  std::string signature() const;  ///< "scene:solve{tolerance=, from=} -> equilibrium"
};

/// One property of a class, or one constant of a module.
struct PropertyRecord {
  std::string name, annotation, unit, text;
  std::function<void(lua_State*, int index)> push;  ///< of the object at `index`; empty for a constant
};

struct ClassRecord {
  std::string name, text;
  const void* key = nullptr;
  std::map<std::string, PropertyRecord, std::less<>> properties;
  std::map<std::string, const FunctionRecord*, std::less<>> methods;
  std::vector<const FunctionRecord*> operations;

  /// Members that depend on the object, such as the measures of a variation: their names, and push by name (true when
  /// there is one).
  std::function<std::vector<std::string>(lua_State*, int index)> member_names;
  std::function<bool(lua_State*, int index, const std::string& name)> push_member;
  /// List entries: push entry i (from 1) or nil.
  std::function<void(lua_State*, int index, lua_Integer i)> push_entry;

  std::vector<std::string> names() const;  ///< of all fixed members
};

struct ModuleRecord {
  std::string name, text;
  std::vector<const FunctionRecord*> functions;
  std::vector<PropertyRecord> constants;
};

struct Registry {
  std::vector<std::unique_ptr<FunctionRecord>> functions;   ///< functions and methods in the order they were bound
  std::vector<std::unique_ptr<FunctionRecord>> operations;  ///< operators, which help does not list
  std::vector<std::unique_ptr<ClassRecord>> classes;
  std::vector<std::unique_ptr<ModuleRecord>> modules;      ///< the first, without a name, holds the global functions

  const FunctionRecord* function(std::string_view name) const;
  const ClassRecord* class_named(std::string_view name) const;
  ModuleRecord* module(std::string_view name) const;
};

/// The record behind a Lua value, or null.
const FunctionRecord* function_at(lua_State* L, int index);
const ClassRecord* class_at(lua_State* L, int index);
const ModuleRecord* module_at(lua_State* L, int index);

/// The annotations for editors (LuaLS format) of everything bound.
std::string annotations(const Registry& registry);

}  // namespace tendril::lua
