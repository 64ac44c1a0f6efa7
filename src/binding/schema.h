// Options tables: one entry says a name's type, unit, default, range and meaning, and drives the check, the help text,
// the completion and the editor annotations.
//
//   Schema section_options() {
//     return {
//       option<double>("outer", "m", "Outer diameter").required().above(0),
//       option<double>("inner", "m", "Inner diameter").at_least(0).preset(0),
//       option<std::string>("kind", "", "How it holds").one_of({"fixed", "swivel", "slide"}).preset("fixed"),
//       option<std::variant<double, std::array<double, 2>>>("EI", "N m^2", "Bending stiffness, or {about d1, about d2}"),
//       option<Material>("material", "", "What it is made of"),
//     };
//   }
//
// and in the bound function, which takes a `const Options& o` after its positional arguments:
//
//   o.get<double>("inner")       the preset when it was not given; of the type the schema says
//   o.maybe<Material>("material")   std::optional; for a class a pointer: o.find<Material>("material")
//   o.has("outer")
#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "binding/lua_value.h"

namespace tendril::lua {

/// One entry of an options table.
struct Option {
  std::string name;
  const Kind* kind = nullptr;
  std::string unit;  ///< "" for none
  std::string text;
  std::variant<std::monostate, double, bool, std::string> standard;  ///< the preset value
  bool needed = false;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false, high_excluded = false;
  std::vector<std::string> choices;  ///< of a string; empty: any

  Option required() && { needed = true; return std::move(*this); }
  Option preset(double value) && { standard = value; return std::move(*this); }
  Option preset(int value) && { standard = double(value); return std::move(*this); }
  Option preset(bool value) && { standard = value; return std::move(*this); }
  Option preset(const char* value) && { standard = std::string(value); return std::move(*this); }
  Option above(double bound) && { low = bound; low_excluded = true; return std::move(*this); }
  Option below(double bound) && { high = bound; high_excluded = true; return std::move(*this); }
  Option at_least(double bound) && { low = bound; low_excluded = false; return std::move(*this); }
  Option at_most(double bound) && { high = bound; high_excluded = false; return std::move(*this); }
  Option one_of(std::vector<std::string> names) && { choices = std::move(names); return std::move(*this); }

  std::string range() const;     ///< "> 0", "0 ... 1", "" without a bound
  std::string expected() const;  ///< "a finite number (m) > 0", "'fixed', 'swivel' or 'slide'"
  std::string preset_text() const;  ///< as Lua source, "" without one
};

template <class T>
Option option(std::string name, std::string unit, std::string text) {
  Option entry;
  entry.name = std::move(name);
  entry.kind = &Value<T>::kind();
  entry.unit = std::move(unit);
  entry.text = std::move(text);
  return entry;
}

/// All entries of one options table. Options shared by several functions are joined with `+`.
class Schema {
 public:
  Schema() = default;
  Schema(std::initializer_list<Option> entries) : entries_(entries) {}

  /// Also takes entries without a name, each of this kind: view.new{s, eq, color = ...}. `name` and `text` describe them.
  Schema with_list(const Kind& kind, std::string name, std::string text) &&;

  /// The same with nothing required: what may be given here or elsewhere.
  Schema all_optional() const;

  const std::vector<Option>& entries() const { return entries_; }
  const std::optional<Option>& list() const { return list_; }
  bool empty() const { return entries_.empty() && !list_; }
  const Option* find(std::string_view name) const;
  std::vector<std::string> names() const;
  bool needs_something() const;

  friend Schema operator+(Schema a, const Schema& b);

  /// Throws UsageError for the first thing wrong with the table at `index` (0: no table was given): unknown names,
  /// wrong types, numbers out of range, missing required entries. `who`: "rod.section".
  void check(lua_State* L, int index, const std::string& who) const;

 private:
  std::vector<Option> entries_;
  std::optional<Option> list_;
};

/// One checked options table.
class Options {
 public:
  /// `index` 0: no table was given. Checks; see Schema::check.
  Options(lua_State* L, int index, const Schema& schema, const std::string& who);

  bool has(const char* name) const;  ///< given, and not nil

  /// The given value, else the preset. Of a class: a reference. Asking for a name that the schema does not have, or
  /// for an optional entry that was neither given nor preset, is a mistake in the binding: std::logic_error.
  template <class T>
  auto get(const char* name) const -> decltype(Value<T>::read(nullptr, 0)) {
    const Option& entry = entry_of(name, &Value<T>::kind());
    if (push(name)) {
      const Popped popped{L_};
      return Value<T>::read(L_, -1);  // a class: a reference to the object, which the table keeps alive
    }
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
      if (const double* value = std::get_if<double>(&entry.standard)) return static_cast<T>(*value);
    } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
      if (const T* value = std::get_if<T>(&entry.standard)) return *value;
    }
    absent(name);
  }

  template <class T>
  std::optional<T> maybe(const char* name) const {
    if (!has(name)) return std::nullopt;
    return get<T>(name);
  }

  /// The object, or null when it was not given. Valid while the bound function runs.
  template <class T>
  T* find(const char* name) const {
    return has(name) ? &get<T>(name) : nullptr;
  }

  /// The entries without a name, as a list of T.
  template <class T>
  std::vector<T> list() const {
    return index_ ? Value<std::vector<T>>::read(L_, index_) : std::vector<T>();
  }

  int index() const { return index_; }  ///< of the table on the stack; 0: none was given
  const std::string& who() const { return who_; }

 private:
  struct Popped {
    lua_State* L;
    ~Popped() { lua_pop(L, 1); }
  };
  const Option& entry_of(const char* name, const Kind* kind) const;
  bool push(const char* name) const;  ///< false, and nothing pushed, when not given
  [[noreturn]] void absent(const char* name) const;

  lua_State* L_;
  int index_;
  const Schema& schema_;
  const std::string& who_;
};

}  // namespace tendril::lua
