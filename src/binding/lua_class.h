// Binding C++ to Lua. The whole of a bind_<name>.cpp:
//
//   void bind_rod(lua_State* L) {
//     Class<Material>(L, "An isotropic linear-elastic material")
//         .property("young", "Pa", "Young's modulus", [](const Material& m) { return m.young; })
//         .method("scaled", {.takes = {"factor"}, .does = "A stiffer copy.", .example = "print(...)"},
//                 [](const Material& m, double factor) { ... return copy; })
//         .tostring([](const Material& m) { return ...; });
//
//     Module(L, "rod", "What a cable or hose is")
//         .function("section", {.options = section_options(), .does = "A round section.", .example = "..."},
//                   [](const Options& o) { return Section::round(o.get<double>("outer"), ...); });
//   }
//
// Declare the class in classes.h, bind_rod in open.h, and add it to the list in open.cpp.
//
// The types of the C++ function are the signature: each parameter is checked and read by Value<T> (lua_value.h), `const
// Options&` takes the options table checked by the schema, `lua_State*` is the state and takes nothing. Results are pushed
// by Value<T>; `Pushed{n}` says that n values are on the stack already. `.example` is a chunk of Lua that the tests run.
// A UsageError becomes a Lua error at the caller's line, as do std::bad_alloc and every other std::exception. A long
// computation takes `run_context(L)` (lua_context.h).
#pragma once

#include <tuple>
#include <utility>

#include "binding/lua_context.h"
#include "binding/lua_registry.h"

namespace tendril::lua {

/// How a function is presented.
struct Def {
  std::vector<const char*> takes = {};  ///< names of the positional parameters, without the object
  Schema options = {};
  const char* returns = "";  ///< annotation, where the C++ type does not say it
  const char* does = "";     ///< one line
  std::string example = {};  ///< a chunk of Lua that runs; after "--> " what it prints
};

namespace detail {

/// `index`: on the Lua stack, where a method's object is the first.
[[noreturn]] void bad_argument(const FunctionRecord& f, int index, const std::string& expected, const std::string& got);
void check_count(lua_State* L, const FunctionRecord& f, int most);

/// Where the next argument stands on the Lua stack.
struct Cursor {
  lua_State* L;
  const FunctionRecord& record;
  int index = 1;
};

template <class T>
struct Argument {
  static decltype(auto) next(Cursor& at) {
    const int index = at.index++;
    if (const std::string got = Value<T>::kind().wrong(at.L, index); !got.empty()) {
      bad_argument(at.record, index, Value<T>::kind().expected, got);
    }
    return Value<T>::read(at.L, index);
  }
  static void describe(FunctionRecord& record, std::vector<const char*>& names, bool is_object) {
    if (is_object) return;
    if (record.call == FunctionRecord::Call::operation) names = {"operand"};
    if (names.empty()) throw std::logic_error(record.name + ": a parameter has no name");
    record.parameters.push_back({names.front(), &Value<T>::kind()});
    names.erase(names.begin());
  }
};

template <>
struct Argument<lua_State*> {
  static lua_State* next(Cursor& at) { return at.L; }
  static void describe(FunctionRecord&, std::vector<const char*>&, bool) {}
};

template <>
struct Argument<Options> {
  static Options next(Cursor& at) {
    const int index = at.index++;
    return Options(at.L, lua_isnoneornil(at.L, index) ? 0 : index, at.record.options, at.record.name);
  }
  static void describe(FunctionRecord& record, std::vector<const char*>&, bool) { record.takes_options = true; }
};

template <class R>
int push_result(lua_State* L, R&& value) {
  using T = std::decay_t<R>;
  if constexpr (std::is_same_v<T, Pushed>) {
    return value.count;
  } else {
    Value<T>::push(L, std::forward<R>(value));
    return 1;
  }
}

template <class R>
std::string annotation_of() {
  using T = std::decay_t<R>;
  if constexpr (std::is_void_v<R>) return "";
  else if constexpr (std::is_same_v<T, Pushed>) return "any";
  else return Value<T>::kind().result();
}

/// A callable's result and parameter types: a lambda's or a plain function's.
template <class F>
struct Signature : Signature<decltype(&F::operator())> {};
template <class R, class... A>
struct Signature<R (*)(A...)> { using Type = R(A...); };
template <class F, class R, class... A>
struct Signature<R (F::*)(A...) const> { using Type = R(A...); };

/// Fills `record` for the C++ callable `f` and its parameter list.
template <class F, class R, class... A>
void describe(FunctionRecord& record, F f, std::vector<const char*> names, std::type_identity<R(A...)>) {
  [[maybe_unused]] bool is_object = record.call == FunctionRecord::Call::method;
  ((Argument<std::decay_t<A>>::describe(record, names, is_object && !std::is_same_v<A, lua_State*>),
    is_object = is_object && std::is_same_v<A, lua_State*>), ...);
  if (!names.empty()) throw std::logic_error(record.name + ": more parameter names than parameters");
  if (record.returns.empty()) record.returns = annotation_of<R>();
  record.body = [f = std::move(f), &record](lua_State* L) -> int {
    Cursor at{L, record};
    std::tuple<decltype(Argument<std::decay_t<A>>::next(at))...> arguments{Argument<std::decay_t<A>>::next(at)...};
    check_count(L, record, at.index - 1);
    if constexpr (std::is_void_v<R>) {
      std::apply(f, std::move(arguments));
      return 0;
    } else {
      return push_result(L, std::apply(f, std::move(arguments)));
    }
  };
}

template <class F>
void describe(FunctionRecord& record, F f, std::vector<const char*> names) {
  describe(record, std::move(f), std::move(names), std::type_identity<typename Signature<F>::Type>());
}

FunctionRecord& new_function(lua_State* L, std::string name, FunctionRecord::Call call, Def& def);
FunctionRecord& new_operation(lua_State* L, const std::string& class_name, const char* event);
void push_function(lua_State* L, const FunctionRecord& record);  ///< as a Lua closure

/// The untyped half of Class: makes the metatable.
class ClassBuilder {
 public:
  ClassBuilder(lua_State* L, const void* key, const char* name, const char* text, lua_CFunction collect);
  void add_method(const char* name, const FunctionRecord& record);
  void add_meta(const char* event, const FunctionRecord& record);
  void set_list_length(std::function<lua_Integer(lua_State*, int)> length);

  lua_State* L;
  ClassRecord& record;
};

template <class T>
int collect(lua_State* L) {
  auto* held = static_cast<Stored<T>*>(lua_touserdata(L, 1));
  if (held) {
    held->~Stored<T>();
    new (held) Stored<T>();  // a finaliser may run twice when a script asks for it
  }
  return 0;
}

}  // namespace detail

/// Registers class T (see the head of this file).
template <class T>
class Class {
 public:
  Class(lua_State* L, const char* text) : builder_(L, &class_key<T>, class_name<T>, text, &detail::collect<T>) {
    if constexpr (!is_inline<T>)
      operation("__eq", [](lua_State* L) {  // two handles of one object
        const T* left = object<T>(L, 1);
        return left && left == object<T>(L, 2);
      });
  }

  template <class F>
  Class& property(const char* name, const char* unit, const char* text, F get) {
    using R = std::decay_t<decltype(get(std::declval<T&>()))>;
    builder_.record.properties[name] = {name, Value<R>::kind().result(), unit, text,
                                        [get](lua_State* L, int index) { Value<R>::push(L, get(*object<T>(L, index))); }};
    return *this;
  }

  template <class F>
  Class& method(const char* name, Def def, F body) {
    FunctionRecord& record = detail::new_function(builder_.L, builder_.record.name + ":" + name,
                                                  FunctionRecord::Call::method, def);
    detail::describe(record, std::move(body), def.takes);
    builder_.add_method(name, record);
    return *this;
  }

  /// An operator: "__add", "__mul", ... Each operand is checked by its C++ type.
  template <class F>
  Class& operation(const char* event, F body) {
    FunctionRecord& record = detail::new_operation(builder_.L, builder_.record.name, event);
    detail::describe(record, std::move(body), {});
    builder_.add_meta(event, record);
    return *this;
  }

  template <class F>
  Class& tostring(F text) {
    return operation("__tostring", [text](const T& value) -> std::string { return text(value); });
  }

  /// A list: `#x`, `x[i]` from 1, ipairs. `at` takes an index from 0.
  template <class Size, class At>
  Class& list(Size size, At at) {
    builder_.set_list_length([size](lua_State* L, int index) { return static_cast<lua_Integer>(size(*object<T>(L, index))); });
    builder_.record.push_entry = [size, at](lua_State* L, int index, lua_Integer i) {
      T& value = *object<T>(L, index);
      if (i < 1 || i > static_cast<lua_Integer>(size(value))) return lua_pushnil(L);
      Value<std::decay_t<decltype(at(value, std::size_t()))>>::push(L, at(value, static_cast<std::size_t>(i - 1)));
    };
    return *this;
  }

  /// Members that depend on the object: `names(object)` lists them, `get(object, name)` gives an optional value.
  template <class Names, class Get>
  Class& members(Names names, Get get) {
    builder_.record.member_names = [names](lua_State* L, int index) { return names(*object<T>(L, index)); };
    builder_.record.push_member = [get](lua_State* L, int index, const std::string& name) {
      auto value = get(*object<T>(L, index), name);
      if (!value) return false;
      Value<std::decay_t<decltype(*value)>>::push(L, *value);
      return true;
    };
    return *this;
  }

 private:
  detail::ClassBuilder builder_;
};

/// A table of functions and constants. Without a name: the globals.
class Module {
 public:
  Module(lua_State* L, const char* name, const char* text);

  template <class F>
  Module& function(const char* name, Def def, F body) {
    FunctionRecord& record = detail::new_function(L_, record_.name.empty() ? name : record_.name + "." + name,
                                                  FunctionRecord::Call::function, def);
    detail::describe(record, std::move(body), def.takes);
    add(name, record);
    return *this;
  }

  Module& constant(const char* name, double value, const char* unit, const char* text);

 private:
  void add(const char* name, const FunctionRecord& record);

  lua_State* L_;
  ModuleRecord& record_;
};

}  // namespace tendril::lua
