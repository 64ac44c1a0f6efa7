#include "binding/lua_class.h"

#include <cstring>

#include "base/nearest_name.h"

namespace tendril::lua {
namespace {

/// The position of the nearest Lua code that led here, "file.lua:12: ", or "" when there is none.
void push_where(lua_State* L) {
  lua_Debug caller;
  for (int level = 1; lua_getstack(L, level, &caller); ++level) {
    lua_getinfo(L, "Sl", &caller);
    if (caller.currentline > 0) {
      lua_pushfstring(L, "%s:%d: ", caller.short_src, caller.currentline);
      return;
    }
  }
  lua_pushliteral(L, "");
}

void push_message(lua_State* L, const char* message) {
  luaL_checkstack(L, 3, message);
  push_where(L);
  lua_pushstring(L, message);
  lua_concat(L, 2);
}

/// Runs `body`, turning C++ exceptions into Lua errors at the caller's line. Lua's own errors, which are exceptions of
/// another type here, pass.
template <class Body>
int guarded(lua_State* L, Body body) {
  try {
    return body();
  } catch (const UsageError& error) {
    push_message(L, error.what());
  } catch (const std::bad_alloc&) {
    push_message(L, "not enough memory");
  } catch (const std::exception& error) {
    push_message(L, error.what());
  }
  return lua_error(L);  // outside the catch: the exception object is gone
}

/// Around one bound function: whether it asks for a RunContext, and the end of its progress line if it did.
class Computation {
 public:
  explicit Computation(Context& context) : context_(context), outside_(std::exchange(context.cancel_polled, false)) {}
  ~Computation() {
    if (context_.cancel_polled && context_.computation_ended) context_.computation_ended();
    context_.cancel_polled = outside_;
  }
  Computation(const Computation&) = delete;
  Computation& operator=(const Computation&) = delete;

 private:
  Context& context_;
  bool outside_;
};

int call_bound(lua_State* L) {
  const auto& record = *static_cast<const FunctionRecord*>(lua_touserdata(L, lua_upvalueindex(1)));
  return guarded(L, [&] {
    const Computation computation(context(L));
    const int results = record.body(L);
    give_grace(L);
    return results;
  });
}

std::vector<std::string> all_members(lua_State* L, const ClassRecord& record) {
  std::vector<std::string> names = record.names();
  if (record.member_names)
    for (std::string& name : record.member_names(L, 1)) names.push_back(std::move(name));
  return names;
}

/// x.name, x[i]. Upvalues: the class record, the table of methods.
int index_object(lua_State* L) {
  const auto& record = *static_cast<const ClassRecord*>(lua_touserdata(L, lua_upvalueindex(1)));
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
  return guarded(L, [&] {
    if (!object_memory(L, 1, record.key)) throw UsageError(record.name + ": got " + describe(L, 1) + " as the object");
    if (lua_isinteger(L, 2) && record.push_entry) {
      record.push_entry(L, 1, lua_tointeger(L, 2));
      return 1;
    }
    if (lua_type(L, 2) != LUA_TSTRING) throw UsageError(record.name + ": " + describe(L, 2) + " is no member");
    const std::string name = Value<std::string>::read(L, 2);
    if (const auto property = record.properties.find(name); property != record.properties.end()) {
      property->second.push(L, 1);
      return 1;
    }
    if (record.push_member && record.push_member(L, 1, name)) return 1;
    throw UsageError(record.name + ": no member " + unknown_name(name, "members", all_members(L, record)));
  });
}

int assign_object(lua_State* L) {
  const auto& record = *static_cast<const ClassRecord*>(lua_touserdata(L, lua_upvalueindex(1)));
  return guarded(L, [&]() -> int {
    const std::string name = lua_type(L, 2) == LUA_TSTRING ? "'" + Value<std::string>::read(L, 2) + "'" : describe(L, 2);
    throw UsageError(record.name + ": member " + name + " cannot be assigned to: the object is read-only");
  });
}

/// module.name when the module's table does not have it.
int index_module(lua_State* L) {
  const auto& record = *static_cast<const ModuleRecord*>(lua_touserdata(L, lua_upvalueindex(1)));
  return guarded(L, [&]() -> int {
    if (lua_type(L, 2) != LUA_TSTRING) throw UsageError(record.name + ": " + describe(L, 2) + " is no member");
    std::vector<std::string> names;
    for (const FunctionRecord* function : record.functions) names.push_back(function->own_name());
    for (const PropertyRecord& constant : record.constants) names.push_back(constant.name);
    throw UsageError(record.name + ": no member " + unknown_name(Value<std::string>::read(L, 2), "members", names));
  });
}

const char* symbol_of(const char* event) {
  static constexpr std::pair<const char*, const char*> symbols[] = {
      {"__add", "+"}, {"__sub", "-"},  {"__mul", "*"}, {"__div", "/"}, {"__unm", "unary -"}, {"__eq", "=="},
      {"__lt", "<"},  {"__le", "<="}, {"__len", "#"}, {"__concat", ".."}, {"__call", "call"}, {"__tostring", "tostring"}};
  for (const auto& [name, symbol] : symbols)
    if (std::strcmp(name, event) == 0) return symbol;
  return event;
}

}  // namespace

namespace detail {

void bad_argument(const FunctionRecord& f, int index, const std::string& expected, const std::string& got) {
  const std::string what = ": got " + got + ", expected " + expected;
  if (f.call == FunctionRecord::Call::operation)
    throw UsageError(f.name + ": " + (index == 1 ? "left" : "right") + " operand" + what);
  if (f.call == FunctionRecord::Call::method && index-- == 1)
    throw UsageError(f.name + ": got " + got + " as the object, expected " + expected + "; is it called with ':'?");
  throw UsageError(f.name + ": argument " + std::to_string(index) + " (" + f.parameters.at(index - 1).name + ")" + what);
}

void check_count(lua_State* L, const FunctionRecord& f, int most) {
  const int got = lua_gettop(L);
  if (f.call == FunctionRecord::Call::operation || got <= most) return;
  const int object = f.call == FunctionRecord::Call::method ? 1 : 0;
  throw UsageError(f.name + ": got " + std::to_string(got - object) + " arguments, expected at most " +
                   std::to_string(most - object) + ": " + f.signature());
}

FunctionRecord& new_function(lua_State* L, std::string name, FunctionRecord::Call call, Def& def) {
  auto record = std::make_unique<FunctionRecord>();
  record->name = std::move(name);
  record->call = call;
  record->options = std::move(def.options);
  record->returns = def.returns;
  record->text = def.does;
  record->example = std::move(def.example);
  auto& functions = context(L).registry->functions;
  functions.push_back(std::move(record));
  return *functions.back();
}

FunctionRecord& new_operation(lua_State* L, const std::string& class_name, const char* event) {
  auto record = std::make_unique<FunctionRecord>();
  record->name = class_name + " " + symbol_of(event);
  record->call = FunctionRecord::Call::operation;
  record->event = event;
  auto& operations = context(L).registry->operations;
  operations.push_back(std::move(record));
  return *operations.back();
}

void push_function(lua_State* L, const FunctionRecord& record) {
  lua_pushlightuserdata(L, const_cast<FunctionRecord*>(&record));
  lua_pushcclosure(L, call_bound, 1);
}

ClassBuilder::ClassBuilder(lua_State* state, const void* key, const char* name, const char* text, lua_CFunction collect)
    : L(state), record(*context(state).registry->classes.emplace_back(std::make_unique<ClassRecord>())) {
  record.name = name;
  record.text = text;
  record.key = key;
  lua_createtable(L, 0, 8);
  lua_pushstring(L, name);
  lua_setfield(L, -2, "__name");
  lua_pushstring(L, name);
  lua_setfield(L, -2, "__metatable");  // scripts cannot reach what guards the C++ object
  lua_pushcfunction(L, collect);
  lua_setfield(L, -2, "__gc");
  lua_pushlightuserdata(L, &record);
  lua_newtable(L);
  lua_pushvalue(L, -1);
  lua_setfield(L, -4, "methods");
  lua_pushcclosure(L, index_object, 2);
  lua_setfield(L, -2, "__index");
  lua_pushlightuserdata(L, &record);
  lua_pushcclosure(L, assign_object, 1);
  lua_setfield(L, -2, "__newindex");
  lua_pushlightuserdata(L, &record);
  lua_setfield(L, -2, "record");
  lua_rawsetp(L, LUA_REGISTRYINDEX, key);
}

void ClassBuilder::add_method(const char* name, const FunctionRecord& method) {
  record.methods[name] = &method;
  lua_rawgetp(L, LUA_REGISTRYINDEX, record.key);
  lua_getfield(L, -1, "methods");
  push_function(L, method);
  lua_setfield(L, -2, name);
  lua_pop(L, 2);
}

void ClassBuilder::add_meta(const char* event, const FunctionRecord& operation) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, record.key);
  push_function(L, operation);
  record.operations.push_back(&operation);
  lua_setfield(L, -2, event);
  lua_pop(L, 1);
}

void ClassBuilder::set_list_length(std::function<lua_Integer(lua_State*, int)> length) {
  FunctionRecord& operation = new_operation(L, record.name, "__len");
  operation.returns = "integer";
  operation.body = [length = std::move(length), key = record.key](lua_State* state) {
    if (!object_memory(state, 1, key)) throw UsageError("#: got " + lua::describe(state, 1));
    lua_pushinteger(state, length(state, 1));
    return 1;
  };
  add_meta("__len", operation);
}

}  // namespace detail

Module::Module(lua_State* L, const char* name, const char* text)
    : L_(L), record_([&]() -> ModuleRecord& {
        Registry& registry = *context(L).registry;
        if (ModuleRecord* known = registry.module(name)) return *known;
        return *registry.modules.emplace_back(std::make_unique<ModuleRecord>(ModuleRecord{name, text, {}, {}}));
      }()) {
  if (record_.name.empty() || !record_.functions.empty() || !record_.constants.empty()) return;
  lua_newtable(L);
  lua_newtable(L);
  lua_pushlightuserdata(L, &record_);
  lua_pushcclosure(L, index_module, 1);
  lua_setfield(L, -2, "__index");
  lua_pushlightuserdata(L, &record_);
  lua_setfield(L, -2, "module");
  lua_setmetatable(L, -2);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);  // so that tracebacks name its functions, and require finds it
  lua_pushvalue(L, -2);
  lua_setfield(L, -2, name);
  lua_pop(L, 1);
  lua_setglobal(L, name);
}

void Module::add(const char* name, const FunctionRecord& record) {
  record_.functions.push_back(&record);
  if (record_.name.empty()) {
    detail::push_function(L_, record);
    lua_setglobal(L_, name);
    return;
  }
  lua_getglobal(L_, record_.name.c_str());
  detail::push_function(L_, record);
  lua_setfield(L_, -2, name);
  lua_pop(L_, 1);
}

Module& Module::constant(const char* name, double value, const char* unit, const char* text) {
  record_.constants.push_back({name, "number", unit, text, {}});
  lua_getglobal(L_, record_.name.c_str());
  lua_pushnumber(L_, value);
  lua_setfield(L_, -2, name);
  lua_pop(L_, 1);
  return *this;
}

}  // namespace tendril::lua
