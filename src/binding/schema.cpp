#include "binding/schema.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "base/nearest_name.h"

namespace tendril::lua {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

bool is_bounded(double bound) { return std::isfinite(bound); }

std::string quoted(const std::string& text) { return "'" + text + "'"; }

/// Gives the reason why the value on top of the stack does not fit, or "".
std::string wrong_value(lua_State* L, const Option& option) {
  std::string got = option.kind->wrong(L, -1);
  if (!got.empty()) return got;
  if (lua_type(L, -1) == LUA_TNUMBER) {
    const double value = lua_tonumber(L, -1);
    const bool low = option.low_excluded ? !(value > option.low) : !(value >= option.low);
    const bool high = option.high_excluded ? !(value < option.high) : !(value <= option.high);
    if ((is_bounded(option.low) && low) || (is_bounded(option.high) && high)) return number(value);
  }
  if (lua_type(L, -1) == LUA_TSTRING && !option.choices.empty()) {
    const std::string value = lua_tostring(L, -1);
    if (std::find(option.choices.begin(), option.choices.end(), value) == option.choices.end()) {
      const std::string near = nearest_name(value, option.choices);
      return quoted(value) + (near.empty() ? "" : " (did you mean " + quoted(near) + "?)");
    }
  }
  return {};
}

}  // namespace

std::string Option::range() const {
  const std::string from = is_bounded(low) ? number(low) : "", to = is_bounded(high) ? number(high) : "";
  if (!from.empty() && !to.empty() && !low_excluded && !high_excluded) return from + " ... " + to;
  std::string text;
  if (!from.empty()) text = (low_excluded ? "> " : ">= ") + from;
  if (!to.empty()) text += (text.empty() ? "" : " and ") + std::string(high_excluded ? "< " : "<= ") + to;
  return text;
}

std::string Option::expected() const {
  if (!choices.empty()) {
    std::string text;
    for (std::size_t i = 0; i < choices.size(); ++i)
      text += (i == 0 ? "" : i + 1 == choices.size() ? " or " : ", ") + quoted(choices[i]);
    return text;
  }
  std::string text = kind->expected;
  if (!unit.empty()) text += " (" + unit + ")";
  const std::string bounds = range();
  return bounds.empty() ? text : text + (bounds[0] == '>' || bounds[0] == '<' ? " " : " in ") + bounds;
}

std::string Option::preset_text() const {
  if (const double* value = std::get_if<double>(&standard)) return number(*value);
  if (const bool* value = std::get_if<bool>(&standard)) return *value ? "true" : "false";
  if (const std::string* value = std::get_if<std::string>(&standard)) return '"' + *value + '"';
  return {};
}

Schema Schema::with_list(const Kind& kind, std::string name, std::string text) && {
  Option entry;
  entry.name = std::move(name);
  entry.kind = &kind;
  entry.text = std::move(text);
  list_ = std::move(entry);
  return std::move(*this);
}

Schema Schema::all_optional() const {
  Schema optional = *this;
  for (Option& entry : optional.entries_) entry.needed = false;
  return optional;
}

const Option* Schema::find(std::string_view name) const {
  for (const Option& entry : entries_)
    if (entry.name == name) return &entry;
  return nullptr;
}

std::vector<std::string> Schema::names() const {
  std::vector<std::string> names;
  for (const Option& entry : entries_) names.push_back(entry.name);
  return names;
}

bool Schema::needs_something() const {
  return std::any_of(entries_.begin(), entries_.end(), [](const Option& entry) { return entry.needed; });
}

Schema operator+(Schema a, const Schema& b) {
  a.entries_.insert(a.entries_.end(), b.entries_.begin(), b.entries_.end());
  if (b.list_) a.list_ = b.list_;
  return a;
}

void Schema::check(lua_State* L, int index, const std::string& who) const {
  if (index != 0) {
    if (lua_type(L, index) != LUA_TTABLE) throw UsageError(who + ": got " + describe(L, index) + ", expected a table of options");
    const auto size = static_cast<lua_Integer>(lua_rawlen(L, index));
    for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
      if (lua_isinteger(L, -2) && list_ && lua_tointeger(L, -2) >= 1 && lua_tointeger(L, -2) <= size) continue;
      if (lua_type(L, -2) != LUA_TSTRING)
        throw UsageError(who + ": got an entry without a name (key: " + describe(L, -2) + "), expected " +
                         (list_ ? "a list and " : "") + "named options");
      const std::string name = Value<std::string>::read(L, -2);
      const Option* entry = find(name);
      if (!entry) throw UsageError(who + ": unknown option " + unknown_name(name, "options", names()));
      const std::string got = wrong_value(L, *entry);
      if (!got.empty())
        throw UsageError(who + ": option " + quoted(name) + ": got " + got + ", expected " + entry->expected());
    }
    if (list_)
      if (const std::string wrong = wrong_list(L, index, *list_->kind, -1); !wrong.empty())
        throw UsageError(who + ": got " + wrong + ", expected a list of " + list_->name + ", each " + list_->kind->expected);
  }
  for (const Option& entry : entries_) {
    if (!entry.needed) continue;
    const bool given = index != 0 && (lua_pushstring(L, entry.name.c_str()), lua_rawget(L, index)) != LUA_TNIL;
    if (index != 0) lua_pop(L, 1);
    if (!given) throw UsageError(who + ": missing option " + quoted(entry.name) + ": expected " + entry.expected() + "; " + entry.text);
  }
}

Options::Options(lua_State* L, int index, const Schema& schema, const std::string& who)
    : L_(L), index_(index), schema_(schema), who_(who) {
  schema.check(L, index, who);
}

bool Options::push(const char* name) const {
  if (index_ == 0) return false;
  luaL_checkstack(L_, 6, name);
  lua_pushstring(L_, name);
  if (lua_rawget(L_, index_) != LUA_TNIL) return true;
  lua_pop(L_, 1);
  return false;
}

bool Options::has(const char* name) const {
  if (!schema_.find(name)) throw std::logic_error(who_ + ": the schema has no option '" + name + "'");
  if (!push(name)) return false;
  lua_pop(L_, 1);
  return true;
}

const Option& Options::entry_of(const char* name, const Kind* kind) const {
  const Option* entry = schema_.find(name);
  if (!entry) throw std::logic_error(who_ + ": the schema has no option '" + name + "'");
  if (entry->kind != kind) throw std::logic_error(who_ + ": option '" + name + "' is of another type in the schema");
  return *entry;
}

void Options::absent(const char* name) const {
  throw std::logic_error(who_ + ": option '" + name + "' has neither a value nor a preset");
}

}  // namespace tendril::lua
