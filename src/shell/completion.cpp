#include "shell/completion.h"

#include <algorithm>
#include <set>

#include "binding/lua_registry.h"
#include "shell/source_scan.h"

namespace tendril::shell {
namespace {

using lua::ClassRecord;
using lua::FunctionRecord;

/// What is known of an expression: its value (at a place on the stack), or only its declared type.
struct Known {
  int value = 0;           ///< stack index; 0: unknown
  std::string annotation;  ///< "" for unknown
  const FunctionRecord* function = nullptr;

  bool nothing() const { return value == 0 && annotation.empty() && !function; }
};

Known of_value(lua_State* L) {
  if (lua_isnil(L, -1)) return {};
  Known known;
  known.value = lua_gettop(L);
  known.function = lua::function_at(L, -1);
  if (const ClassRecord* record = lua::class_at(L, -1)) known.annotation = record->name;
  return known;
}

Known of_type(std::string annotation) {
  if (annotation.ends_with('?')) annotation.pop_back();
  Known known;
  known.annotation = std::move(annotation);
  return known;
}

/// "(vec)[]" holds entries of type "vec".
std::string entry_type(const std::string& annotation) {
  if (!annotation.starts_with('(') || !annotation.ends_with(")[]")) return {};
  return annotation.substr(1, annotation.size() - 4);
}

class Resolver {
 public:
  explicit Resolver(lua_State* L) : L_(L), registry_(*lua::context(L).registry), top_(lua_gettop(L)) {}
  ~Resolver() { lua_settop(L_, top_); }
  Resolver(const Resolver&) = delete;
  Resolver& operator=(const Resolver&) = delete;

  Known resolve(const std::vector<Link>& chain) {
    Known known;
    for (const Link& link : chain) {
      if (!lua_checkstack(L_, 8)) return {};
      known = step(known, link);
      if (known.nothing()) break;
    }
    return known;
  }

  const ClassRecord* class_of(const Known& known) const { return registry_.class_named(known.annotation); }

 private:
  Known step(const Known& known, const Link& link) {
    switch (link.kind) {
      case Link::Kind::name:
        lua_pushglobaltable(L_);
        return raw_field(lua_gettop(L_), link.name);
      case Link::Kind::field: return field(known, link.name);
      case Link::Kind::method: {
        if (const ClassRecord* record = class_of(known))
          if (const auto method = record->methods.find(link.name); method != record->methods.end()) {
            Known found;
            found.function = method->second;
            return found;
          }
        return field(known, link.name);
      }
      case Link::Kind::call: return known.function ? of_type(known.function->returns) : Known{};
      case Link::Kind::index: return of_type(entry_type(known.annotation));
    }
    return {};
  }

  Known field(const Known& known, std::string_view name) {
    if (const ClassRecord* record = class_of(known)) {
      const auto property = record->properties.find(name);
      return property == record->properties.end() ? Known{} : of_type(property->second.annotation);
    }
    return known.value && lua_type(L_, known.value) == LUA_TTABLE ? raw_field(known.value, name) : Known{};
  }

  Known raw_field(int table, std::string_view name) {
    lua_pushlstring(L_, name.data(), name.size());
    lua_rawget(L_, table);
    return of_value(L_);
  }

  lua_State* L_;
  const lua::Registry& registry_;
  int top_;
};

void add_table_keys(lua_State* L, int table, bool functions_only, std::set<std::string>& names) {
  table = lua_absindex(L, table);
  for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING || (functions_only && !lua_isfunction(L, -1))) continue;
    const std::string name = lua_tostring(L, -2);
    if (!name.empty() && std::all_of(name.begin(), name.end(), is_name_character)) names.insert(name);
  }
}

/// Members of a value that is no object of ours: its own keys and those of the table behind its __index.
void add_value_members(lua_State* L, int value, bool methods, std::set<std::string>& names) {
  if (lua_type(L, value) == LUA_TTABLE) add_table_keys(L, value, methods, names);
  if (!lua_getmetatable(L, value)) return;
  lua_pushliteral(L, "__index");
  if (lua_rawget(L, -2) == LUA_TTABLE) add_table_keys(L, -1, methods, names);
  lua_pop(L, 2);
}

std::set<std::string> members(lua_State* L, const Resolver& resolver, const Known& known, bool methods) {
  std::set<std::string> names;
  if (const ClassRecord* record = resolver.class_of(known)) {
    if (methods) {
      for (const auto& [name, method] : record->methods) names.insert(name);
      return names;
    }
    for (const auto& [name, property] : record->properties) names.insert(name);
    if (known.value && record->member_names)
      for (const std::string& name : record->member_names(L, known.value)) names.insert(name);
  } else if (known.value) {
    add_value_members(L, known.value, methods, names);
  }
  return names;
}

std::set<std::string> global_names(lua_State* L) {
  static const char* const keywords[] = {"and", "break", "do", "else", "elseif", "end", "false", "for", "function", "goto", "if",
                                         "in", "local", "nil", "not", "or", "repeat", "return", "then", "true", "until", "while"};
  std::set<std::string> names(std::begin(keywords), std::end(keywords));
  lua_pushglobaltable(L);
  add_table_keys(L, -1, false, names);
  lua_pop(L, 1);
  return names;
}

/// The function whose options table opens at the innermost bracket, or null.
const FunctionRecord* called_function(Resolver& resolver, const std::string& text, const Scan& scanned) {
  if (scanned.open.empty() || scanned.open.back().bracket != '{') return nullptr;
  std::size_t callee_end = scanned.open.back().at;
  std::size_t before = callee_end;
  while (before > 0 && (text[before - 1] == ' ' || text[before - 1] == '\n')) --before;
  const bool last_argument = before > 0 && (text[before - 1] == ',' || text[before - 1] == '(');
  if (last_argument) {
    if (scanned.open.size() < 2 || scanned.open[scanned.open.size() - 2].bracket != '(') return nullptr;
    callee_end = scanned.open[scanned.open.size() - 2].at;
  }
  const Known callee = resolver.resolve(chain_before(text, scanned, callee_end));
  return callee.function && callee.function->takes_options ? callee.function : nullptr;
}

/// Option names not yet given. `from`: behind the opening brace; `to`: where the name being typed starts.
std::set<std::string> option_names(const FunctionRecord& function, const std::string& text, std::size_t from, std::size_t to) {
  std::set<std::string> names;
  for (const lua::Option& option : function.options.entries()) {
    bool given = false;
    for (std::size_t at = text.find(option.name, from); at < to; at = text.find(option.name, at + 1)) {
      std::size_t behind = at + option.name.size();
      while (behind < to && text[behind] == ' ') ++behind;
      given = given || (!is_name_character(text[at - 1]) && behind < to && text[behind] == '=');
    }
    if (!given) names.insert(option.name + " = ");
  }
  return names;
}

Completion matching(const std::set<std::string>& names, std::string_view typed) {
  Completion completion;
  completion.typed = typed.size();
  for (const std::string& name : names)
    if (name.starts_with(typed)) completion.candidates.push_back(name);
  return completion;
}

/// Inside `name = "...`: the choices of that option.
Completion complete_choice(lua_State* L, const std::string& text, std::size_t quote) {
  std::size_t end = quote;
  while (end > 0 && text[end - 1] == ' ') --end;
  if (end == 0 || text[end - 1] != '=') return {};
  --end;
  while (end > 0 && text[end - 1] == ' ') --end;
  std::size_t start = end;
  while (start > 0 && is_name_character(text[start - 1])) --start;
  const std::string before = text.substr(0, start);
  Resolver resolver(L);
  const FunctionRecord* function = called_function(resolver, before, scan(before));
  const lua::Option* option = function ? function->options.find(text.substr(start, end - start)) : nullptr;
  if (!option) return {};
  return matching({option->choices.begin(), option->choices.end()}, std::string_view(text).substr(quote + 1));
}

}  // namespace

Completion complete(lua_State* L, const std::string& text) {
  const Scan scanned = scan(text);
  if (scanned.in_comment) return {};
  if (scanned.string_at) return complete_choice(L, text, *scanned.string_at);
  std::size_t start = text.size();
  while (start > 0 && is_name_character(text[start - 1])) --start;
  const std::string_view typed = std::string_view(text).substr(start);
  if (!typed.empty() && typed[0] >= '0' && typed[0] <= '9') return {};

  Resolver resolver(L);
  const char before = start > 0 ? text[start - 1] : '\0';
  const bool concatenation = start > 1 && before == '.' && text[start - 2] == '.';
  if ((before == '.' && !concatenation) || before == ':') {
    const Known known = resolver.resolve(chain_before(text, scanned, start - 1));
    return matching(members(L, resolver, known, before == ':'), typed);
  }
  std::size_t delimiter = start;
  while (delimiter > 0 && (text[delimiter - 1] == ' ' || text[delimiter - 1] == '\n')) --delimiter;
  const char mark = delimiter > 0 ? text[delimiter - 1] : '\0';
  if (mark == '{' || mark == ',' || mark == ';')
    if (const FunctionRecord* function = called_function(resolver, text, scanned))
      return matching(option_names(*function, text, scanned.open.back().at + 1, start), typed);
  return matching(global_names(L), typed);
}

}  // namespace tendril::shell
