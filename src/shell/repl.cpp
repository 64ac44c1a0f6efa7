#include "shell/repl.h"

#include <cstdio>
#include <optional>
#include <string_view>
#include <vector>

#include "binding/shell_services.h"
#include "binding/transcript.h"
#include "shell/completion.h"
#include "shell/script_form.h"
#include "shell/show_value.h"

namespace tendril::shell {
namespace {

enum class Loaded { ready, incomplete, wrong };

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

bool ends_too_early(lua_State* L, int status) {
  return status == LUA_ERRSYNTAX && std::string_view(lua_tostring(L, -1)).ends_with("<eof>");
}

/// Compiles `code` as an expression, else as statements. Leaves the function, or the message when it is wrong.
Loaded load(lua_State* L, const std::string& code) {
  const std::string expression = "return " + code;
  int status = luaL_loadbufferx(L, expression.data(), expression.size(), "=stdin", "t");
  if (status == LUA_OK) return Loaded::ready;
  const bool begun = ends_too_early(L, status);  // "1 +" can only go on as an expression
  lua_pop(L, 1);
  status = luaL_loadbufferx(L, code.data(), code.size(), "=stdin", "t");
  if (status == LUA_OK) return Loaded::ready;
  if (!begun && !ends_too_early(L, status)) return Loaded::wrong;
  lua_pop(L, 1);
  return Loaded::incomplete;
}

/// Parts of a pasted block that each compile, or one part with the whole block when it compiles as it is, or does not.
std::vector<std::string> parts_of(lua_State* L, const std::string& block) {
  std::vector<std::string> parts;
  const Loaded whole = load(L, block);
  if (whole != Loaded::incomplete) lua_pop(L, 1);
  if (whole != Loaded::wrong) return {block};
  std::string part;
  for (std::size_t from = 0; from <= block.size();) {
    const std::size_t to = std::min(block.find('\n', from), block.size());
    part += (part.empty() ? "" : "\n") + block.substr(from, to - from);
    from = to + 1;
    const Loaded loaded = load(L, part);
    if (loaded == Loaded::incomplete) continue;
    lua_pop(L, 1);
    if (loaded == Loaded::wrong) return {block};  // nothing of it runs
    parts.push_back(std::move(part));
    part.clear();
  }
  if (!part.empty()) parts.push_back(std::move(part));
  return parts;
}

void finish_interrupt(Session& session) {
  if (session.was_interrupted() || lua::interrupted(session.state())) session.resume_after_interrupt();
}

/// How many values it gave, which were printed; nothing when it failed.
std::optional<int> run_loaded(Session& session) {
  lua_State* L = session.state();
  const int first = lua_gettop(L);
  const bool done = session.call(0, LUA_MULTRET);
  const int count = lua_gettop(L) - first + 1;
  finish_interrupt(session);  // before printing, which may call Lua
  if (done) print_results(session, first);
  finish_interrupt(session);
  lua_settop(L, first - 1);
  return done ? std::optional(count) : std::nullopt;
}

/// "?rod.section" asks for help.
std::string with_help(const std::string& code) {
  const std::string_view text = trimmed(code);
  if (text.empty() || text[0] != '?') return code;
  std::string subject(trimmed(text.substr(1)));
  if (subject.empty()) return "help()";
  std::string quoted;
  for (const char c : subject) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? ' ' : c;
  }
  return "help(\"" + quoted + "\")";
}

void remember(LineReader& reader, const std::string& text) {
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    reader.remember(text.substr(from, to - from));
    from = to + 1;
  }
}

/// What ran is kept for session.save.
void keep(Session& session, const std::string& code, bool gave_values) {
  lua_State* L = session.state();
  lua::Transcript* transcript = lua::shell_services(L).transcript;
  if (transcript && !is_about_session(code)) transcript->entries.push_back({code, script_form(L, code, gave_values)});
}

/// Runs `code` unless more lines are needed.
Loaded run_code(Session& session, const std::string& code) {
  const Loaded loaded = load(session.state(), with_help(code));
  if (loaded == Loaded::wrong) session.tell_error();
  if (loaded != Loaded::ready) return loaded;
  const std::optional<int> values = run_loaded(session);
  if (values) keep(session, code, *values > 0);
  return values ? Loaded::ready : Loaded::wrong;
}

}  // namespace

void print_results(Session& session, int first) {
  lua_State* L = session.state();
  const int count = lua_gettop(L) - first + 1;
  if (count <= 0) return;
  lua_pushcfunction(L, show_values);
  lua_insert(L, first);
  session.call(count, 0);
}

void run_repl(Session& session, LineReader& reader, std::string& pending) {
  pending.clear();
  for (;;) {
    const Line line = reader.read(pending.empty() ? "> " : ">> ");
    if (line.kind == Line::Kind::interrupted) {
      pending.clear();
      session.resume_after_interrupt();
      continue;
    }
    if (line.kind == Line::Kind::end) {
      if (!pending.empty() && load(session.state(), pending) == Loaded::incomplete)
        tell(session.terminal(), "the last statement is not complete");
      return;
    }
    remember(reader, line.text);
    pending += (pending.empty() ? "" : "\n") + line.text;
    if (trimmed(pending).empty()) {
      pending.clear();
      continue;
    }
    const std::vector<std::string> parts =
        line.text.find('\n') == std::string::npos ? std::vector{pending} : parts_of(session.state(), pending);
    pending.clear();
    for (const std::string& part : parts) {
      const Loaded outcome = run_code(session, part);
      if (outcome == Loaded::incomplete) pending = part;  // only the last part can be
      if (outcome == Loaded::wrong) break;
    }
  }
}

Completer completer_for(Session& session, const std::string& pending) {
  return [&session, &pending](std::string_view line) {
    return complete(session.state(), pending.empty() ? std::string(line) : pending + "\n" + std::string(line));
  };
}

}  // namespace tendril::shell
