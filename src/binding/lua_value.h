// Values between C++ and Lua: for every C++ type what it is called, what fits, how it is read and pushed.
//
//   Value<T>::kind()            what a user may give (messages, help, annotations) and what is wrong with a misfit
//   Value<T>::read(L, index)    after kind().wrong(L, index) was empty
//   Value<T>::push(L, value)
//
// Known: double (finite), int, bool, std::string, Vec3 (a vec or {x, y, z}), every class listed in classes.h (by
// reference, or as std::shared_ptr), std::vector and std::array (a list), std::map (a table by name), std::optional (or
// nil), std::variant (the first that fits), Function, Any.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <lua.hpp>

#include "base/error.h"
#include "binding/classes.h"

namespace tendril::lua {

/// What a Lua value may be.
struct Kind {
  std::string expected;    ///< for messages: "a list of numbers"
  std::string annotation;  ///< for editors: "number[]"
  std::string (*wrong)(lua_State*, int index) = nullptr;  ///< "" when the value fits, else what was got
  std::string pushed = {};  ///< annotation of a result, where it is narrower than what may be given

  const std::string& result() const { return pushed.empty() ? annotation : pushed; }
};

/// "nil", "a number (5)", "a string ('abc')", "a table", "a vec": for "got ..., expected ...".
std::string describe(lua_State* L, int index);

/// The one address that marks the class of T in Lua's registry.
template <class T>
inline char class_key = 0;

/// The memory of a userdata of the class marked by `key`, or null.
void* object_memory(lua_State* L, int index, const void* key);

/// Pushes a userdata of `size` bytes; `with_class` then gives it its metatable.
void* new_object(lua_State* L, std::size_t size);
void with_class(lua_State* L, const void* key, const char* name);

/// Small values live inside the userdata, everything else behind a shared pointer. An inline value may need no more
/// than the alignment of a double.
template <class T>
using Stored = std::conditional_t<is_inline<T>, T, std::shared_ptr<T>>;

/// The object at `index`, or null when it is something else.
template <class T>
T* object(lua_State* L, int index) {
  void* memory = object_memory(L, index, &class_key<T>);
  if (!memory) return nullptr;
  if constexpr (is_inline<T>) return static_cast<T*>(memory);
  else return static_cast<std::shared_ptr<T>*>(memory)->get();
}

/// A class of classes.h.
template <class T, class = void>
struct Value {
  static_assert(class_name<T> != nullptr, "name the class in binding/classes.h");

  static const Kind& kind() {
    static const Kind kind{article() + class_name<T>, class_name<T>, [](lua_State* L, int index) {
      return object<T>(L, index) ? std::string() : describe(L, index);
    }};
    return kind;
  }
  static T& read(lua_State* L, int index) { return *object<T>(L, index); }
  static void push(lua_State* L, T value) {
    void* memory = new_object(L, sizeof(Stored<T>));
    if constexpr (is_inline<T>) new (memory) T(std::move(value));
    else new (memory) std::shared_ptr<T>(std::make_shared<T>(std::move(value)));
    with_class(L, &class_key<T>, class_name<T>);
  }

 private:
  static std::string article() { return std::string("aeiou").find(class_name<T>[0]) == std::string::npos ? "a " : "an "; }
};

/// A shared object: what other objects also hold on to. Null is nil.
template <class T>
struct Value<std::shared_ptr<T>> {
  static const Kind& kind() { return Value<T>::kind(); }
  static std::shared_ptr<T> read(lua_State* L, int index) {
    return *static_cast<std::shared_ptr<T>*>(object_memory(L, index, &class_key<T>));
  }
  static void push(lua_State* L, std::shared_ptr<T> value) {
    if (!value) return lua_pushnil(L);
    void* memory = new_object(L, sizeof(std::shared_ptr<T>));
    new (memory) std::shared_ptr<T>(std::move(value));
    with_class(L, &class_key<T>, class_name<T>);
  }
};

/// A finite number. Pushing takes any number.
template <>
struct Value<double> {
  static const Kind& kind();
  static double read(lua_State* L, int index) { return lua_tonumber(L, index); }
  static void push(lua_State* L, double value) { lua_pushnumber(L, value); }
};

template <>
struct Value<int> {
  static const Kind& kind();
  static int read(lua_State* L, int index) { return static_cast<int>(lua_tointeger(L, index)); }
  static void push(lua_State* L, int value) { lua_pushinteger(L, value); }
};

template <>
struct Value<std::size_t> {
  static void push(lua_State* L, std::size_t value) { lua_pushinteger(L, static_cast<lua_Integer>(value)); }
  static const Kind& kind() { return Value<int>::kind(); }
};

template <>
struct Value<bool> {
  static const Kind& kind();
  static bool read(lua_State* L, int index) { return lua_toboolean(L, index); }
  static void push(lua_State* L, bool value) { lua_pushboolean(L, value); }
};

template <>
struct Value<std::string> {
  static const Kind& kind();
  static std::string read(lua_State* L, int index);
  static void push(lua_State* L, const std::string& value) { lua_pushlstring(L, value.data(), value.size()); }
};

template <>
struct Value<const char*> {
  static const Kind& kind() { return Value<std::string>::kind(); }
  static void push(lua_State* L, const char* value) { lua_pushstring(L, value); }
};

template <>
struct Value<Vec3> {
  static const Kind& kind();
  static Vec3 read(lua_State* L, int index);
  static void push(lua_State* L, const Vec3& value);
};

/// Whatever was given, where it stands on the stack (index 0: nothing).
struct Any {
  int index = 0;
};

template <>
struct Value<Any> {
  static const Kind& kind();
  static Any read(lua_State* L, int index) { return {lua_absindex(L, index)}; }
};

/// How many values a function has pushed itself.
struct Pushed {
  int count = 0;
};

/// What is wrong with a list of this kind, or "": the table's length is checked and every entry.
std::string wrong_list(lua_State* L, int index, const Kind& entry, int exact_length);
std::string wrong_map(lua_State* L, int index, const Kind& entry);

template <class T>
struct Value<std::vector<T>> {
  static const Kind& kind() {
    static const Kind kind{"a list, each entry " + Value<T>::kind().expected, "(" + Value<T>::kind().annotation + ")[]",
                           [](lua_State* L, int index) { return wrong_list(L, index, Value<T>::kind(), -1); },
                           "(" + Value<T>::kind().result() + ")[]"};
    return kind;
  }
  static std::vector<T> read(lua_State* L, int index) {
    index = lua_absindex(L, index);
    const auto size = static_cast<lua_Integer>(lua_rawlen(L, index));
    std::vector<T> list;
    list.reserve(static_cast<std::size_t>(size));
    for (lua_Integer i = 1; i <= size; ++i) {
      lua_rawgeti(L, index, i);  // raw: what was checked is what is read
      list.push_back(Value<T>::read(L, -1));
      lua_pop(L, 1);
    }
    return list;
  }
  static void push(lua_State* L, const std::vector<T>& list) {
    luaL_checkstack(L, 4, "too many nested lists");
    lua_createtable(L, static_cast<int>(list.size()), 0);
    lua_Integer i = 0;
    for (const auto& entry : list) {
      Value<T>::push(L, entry);
      lua_rawseti(L, -2, ++i);
    }
  }
};

template <class T, std::size_t N>
struct Value<std::array<T, N>> {
  static const Kind& kind() {
    static const Kind kind{"a list of " + std::to_string(N) + ", each entry " + Value<T>::kind().expected,
                           "(" + Value<T>::kind().annotation + ")[]",
                           [](lua_State* L, int index) { return wrong_list(L, index, Value<T>::kind(), int(N)); },
                           "(" + Value<T>::kind().result() + ")[]"};
    return kind;
  }
  static std::array<T, N> read(lua_State* L, int index) {
    const std::vector<T> list = Value<std::vector<T>>::read(L, index);
    std::array<T, N> result;
    for (std::size_t i = 0; i < N; ++i) result[i] = list.at(i);
    return result;
  }
  static void push(lua_State* L, const std::array<T, N>& list) {
    Value<std::vector<T>>::push(L, std::vector<T>(list.begin(), list.end()));
  }
};

template <class T>
struct Value<std::map<std::string, T>> {
  static const Kind& kind() {
    static const Kind kind{"a table of names, each entry " + Value<T>::kind().expected,
                           "table<string, " + Value<T>::kind().annotation + ">",
                           [](lua_State* L, int index) { return wrong_map(L, index, Value<T>::kind()); },
                           "table<string, " + Value<T>::kind().result() + ">"};
    return kind;
  }
  static std::map<std::string, T> read(lua_State* L, int index) {
    std::map<std::string, T> map;
    index = lua_absindex(L, index);
    for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1))
      map.emplace(Value<std::string>::read(L, -2), Value<T>::read(L, -1));
    return map;
  }
  static void push(lua_State* L, const std::map<std::string, T>& map) {
    lua_createtable(L, 0, static_cast<int>(map.size()));
    for (const auto& [name, entry] : map) {
      Value<T>::push(L, entry);
      lua_setfield(L, -2, name.c_str());
    }
  }
};

template <class T>
struct Value<std::optional<T>> {
  static const Kind& kind() {
    static const Kind kind{Value<T>::kind().expected + " or nil", Value<T>::kind().annotation + "?",
                           [](lua_State* L, int index) {
                             return lua_isnoneornil(L, index) ? std::string() : Value<T>::kind().wrong(L, index);
                           },
                           Value<T>::kind().result() + "?"};
    return kind;
  }
  static std::optional<T> read(lua_State* L, int index) {
    if (lua_isnoneornil(L, index)) return std::nullopt;
    return Value<T>::read(L, index);
  }
  static void push(lua_State* L, const std::optional<T>& value) {
    if (value) Value<T>::push(L, *value);
    else lua_pushnil(L);
  }
};

/// A list whose entries each have a type of their own: {axis, angle}.
template <class... T>
struct Value<std::tuple<T...>> {
  static const Kind& kind() {
    static const Kind kind{"{" + joined({Value<T>::kind().expected...}) + "}",
                           "[" + joined({Value<T>::kind().annotation...}) + "]", &wrong};
    return kind;
  }
  static std::tuple<T...> read(lua_State* L, int index) {
    return read_entries(L, lua_absindex(L, index), std::index_sequence_for<T...>());
  }

 private:
  static std::string joined(std::initializer_list<std::string> parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
    return text;
  }
  static std::string wrong(lua_State* L, int index) {
    using Wrong = std::string (*)(lua_State*, int);
    static const Wrong checks[] = {Value<T>::kind().wrong...};
    if (std::string text = wrong_list(L, index, Value<Any>::kind(), sizeof...(T)); !text.empty()) return text;
    index = lua_absindex(L, index);
    for (std::size_t i = 0; i < sizeof...(T); ++i) {
      lua_rawgeti(L, index, static_cast<lua_Integer>(i + 1));
      const std::string text = checks[i](L, -1);
      lua_pop(L, 1);
      if (!text.empty()) return "a table whose entry " + std::to_string(i + 1) + " is " + text;
    }
    return {};
  }
  template <std::size_t... I>
  static std::tuple<T...> read_entries(lua_State* L, int index, std::index_sequence<I...>) {
    return std::tuple<T...>{entry<T>(L, index, I + 1)...};
  }
  template <class E>
  static E entry(lua_State* L, int index, lua_Integer i) {
    lua_rawgeti(L, index, i);
    E value = Value<E>::read(L, -1);
    lua_pop(L, 1);
    return value;
  }
};

template <class First, class... Rest>
struct Value<std::variant<First, Rest...>> {
  using Either = std::variant<First, Rest...>;
  static const Kind& kind() {
    static const Kind kind{(Value<First>::kind().expected + ... + (" or " + Value<Rest>::kind().expected)),
                           (Value<First>::kind().annotation + ... + ("|" + Value<Rest>::kind().annotation)),
                           [](lua_State* L, int index) {
                             const bool fits = Value<First>::kind().wrong(L, index).empty() ||
                                               (Value<Rest>::kind().wrong(L, index).empty() || ...);
                             return fits ? std::string() : describe(L, index);
                           }};
    return kind;
  }
  static Either read(lua_State* L, int index) {
    std::optional<Either> result;
    const auto attempt = [&]<class T>(std::type_identity<T>) {
      if (!result && Value<T>::kind().wrong(L, index).empty()) result.emplace(std::in_place_type<T>, Value<T>::read(L, index));
    };
    attempt(std::type_identity<First>());
    (attempt(std::type_identity<Rest>()), ...);
    return std::move(*result);
  }
  static void push(lua_State* L, const Either& value) {
    std::visit([L](const auto& held) { Value<std::decay_t<decltype(held)>>::push(L, held); }, value);
  }
};

/// A Lua function kept by C++. It must not outlive its state.
class Function {
 public:
  Function() = default;
  Function(lua_State* L, int index);

  explicit operator bool() const { return static_cast<bool>(kept_); }
  void push(lua_State* L) const;

  /// Calls it with `arguments` and reads one result as R (void: none). `L` is the state of the bound function that runs
  /// now. A Lua error passes straight through the C++ code in between to the pcall outside, with its whole traceback: so
  /// call from the thread that runs Lua, with nothing in between that swallows every exception. A result that is no R
  /// throws UsageError in the name of `who`.
  template <class R, class... A>
  R call(lua_State* L, const char* who, const A&... arguments) const {
    luaL_checkstack(L, int(sizeof...(A)) + 2, who);
    push(L);
    (Value<A>::push(L, arguments), ...);
    if constexpr (std::is_void_v<R>) {
      lua_call(L, sizeof...(A), 0);
    } else {
      lua_call(L, sizeof...(A), 1);
      const std::string got = Value<R>::kind().wrong(L, -1);
      if (!got.empty())
        throw UsageError(std::string(who) + ": the function returned " + got + ", expected " + Value<R>::kind().expected);
      R result = Value<R>::read(L, -1);
      lua_pop(L, 1);
      return result;
    }
  }

 private:
  struct Kept;
  std::shared_ptr<Kept> kept_;
};

template <>
struct Value<Function> {
  static const Kind& kind();
  static Function read(lua_State* L, int index) { return Function(L, index); }
  static void push(lua_State* L, const Function& value) { value ? value.push(L) : lua_pushnil(L); }
};

}  // namespace tendril::lua
