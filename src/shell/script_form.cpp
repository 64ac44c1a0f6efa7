#include "shell/script_form.h"

#include <string_view>

#include "shell/source_scan.h"

namespace tendril::shell {
namespace {

constexpr const char* blank = " \t\n";

bool compiles(lua_State* L, const std::string& code) {
  const int status = luaL_loadbufferx(L, code.data(), code.size(), "=stdin", "t");
  lua_pop(L, 1);
  return status == LUA_OK;
}

/// Where the word stands alone, also in a string or a comment; npos for nowhere.
std::size_t find_word(const std::string& text, std::string_view word) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_name_character(text[at - 1])) && (end == text.size() || !is_name_character(text[end]))) return at;
  }
  return std::string::npos;
}

/// Without blanks at both ends and without semicolons behind.
std::string bare(const std::string& code) {
  const auto first = code.find_first_not_of(blank);
  if (first == std::string::npos) return {};
  return code.substr(first, code.find_last_not_of(" \t\n;") + 1 - first);
}

std::string in_function(const std::string& code, bool gave_values) {
  const std::string call = "(function(...)\n" + code + "\nend)()";
  return gave_values ? "print(" + call + ")" : ";" + call;
}

/// A line that begins with a bracket would be taken for arguments of the line before.
std::string apart(const std::string& code) { return code.starts_with('(') ? ";" + code : code; }

std::string form_of_expression(lua_State* L, const std::string& code, bool gave_values) {
  if (!gave_values && compiles(L, code)) return apart(code);
  const std::string one_line = "print(" + code + ")", more_lines = "print(" + code + "\n)";
  if (!gave_values) return in_function("return " + code, false);
  if (compiles(L, one_line)) return one_line;
  return compiles(L, more_lines) ? more_lines : in_function("return " + code, true);
}

}  // namespace

std::string script_form(lua_State* L, const std::string& code, bool gave_values) {
  const std::string text = bare(code);
  if (compiles(L, "return " + text)) return form_of_expression(L, text, gave_values);
  const bool returns_last = !compiles(L, text + "\nlocal _");
  if (returns_last || find_word(text, "return") < find_word(text, "function")) return in_function(text, gave_values);
  const bool own_names = find_word(text, "local") != std::string::npos || find_word(text, "goto") != std::string::npos ||
                         text.find("::") != std::string::npos;
  return own_names ? "do\n" + text + "\nend" : apart(text);
}

bool is_about_session(const std::string& code) {
  const std::string text = bare(code);
  if (text.starts_with('?')) return true;
  for (const std::string_view name : {"help", "session"}) {
    if (find_word(text, name) != 0) continue;
    const auto next = text.find_first_not_of(blank, name.size());
    return next == std::string::npos || text[next] != '=';  // else it is given another value
  }
  return false;
}

}  // namespace tendril::shell
