#include "shell/session.h"

#include <cstdio>
#include <new>

#include "binding/open.h"
#include "shell/limits.h"

namespace tendril::shell {
namespace {

/// The message handler: adds the traceback. An error that is no string keeps its own text where it has one.
int with_traceback(lua_State* L) {
  const char* message = lua_tostring(L, 1);
  if (!message) {
    if (luaL_callmeta(L, 1, "__tostring") && lua_type(L, -1) == LUA_TSTRING) return 1;
    message = lua_pushfstring(L, "(error object is a %s value)", luaL_typename(L, 1));
  }
  luaL_traceback(L, L, message, 1);
  return 1;
}

/// Lua's warn(): on standard error, switched by "@on" and "@off".
struct Warnings {
  static void off(void* L, const char* message, int to_continue) {
    if (!to_continue && std::string_view(message) == "@on") lua_setwarnf(static_cast<lua_State*>(L), on, L);
  }
  static void on(void* L, const char* message, int to_continue) {
    if (!to_continue && std::string_view(message) == "@off") return lua_setwarnf(static_cast<lua_State*>(L), off, L);
    std::fflush(stdout);
    std::fputs("warning: ", stderr);
    more(L, message, to_continue);
  }
  static void more(void* L, const char* message, int to_continue) {
    std::fputs(message, stderr);
    if (!to_continue) std::fputc('\n', stderr);
    lua_setwarnf(static_cast<lua_State*>(L), to_continue ? more : on, L);
  }
};

/// Ends the program the tidy way: objects are finalised, files flushed. Upvalue 1: the library's own os.exit.
int exit_after_closing(lua_State* L) {
  if (lua_isnoneornil(L, 2)) {
    lua_settop(L, 1);
    lua_pushboolean(L, true);
  }
  return lua_tocfunction(L, lua_upvalueindex(1))(L);
}

}  // namespace

void tell(const Terminal& terminal, const std::string& message) {
  std::fflush(stdout);
  const bool colour = terminal.colour;
  std::fprintf(stderr, "%stendril: %s%s\n", colour ? "\033[31m" : "", message.c_str(), colour ? "\033[0m" : "");
  std::fflush(stderr);
}

Session::Session(const Terminal& terminal, std::size_t memory_limit)
    : terminal_(terminal), interrupts_(context_), progress_(context_, terminal.can_progress()) {
  context_.memory_limit = memory_limit;
  context_.colour = terminal.colour;
  L_ = lua::open_state(context_);
  if (!L_) throw std::bad_alloc();
  lua_setwarnf(L_, Warnings::off, L_);
  lua_getglobal(L_, "os");
  lua_getfield(L_, -1, "exit");
  lua_pushcclosure(L_, exit_after_closing, 1);
  lua_setfield(L_, -2, "exit");
  lua_pop(L_, 1);
  services_.unicode = terminal.unicode;
  services_.picture_terminal = [this] { return pictures_.look(terminal_); };
  lua::provide(L_, services_);
  lua::open_tendril(L_);
}

Session::~Session() { lua_close(L_); }

bool Session::call(int arguments, int results) {
  const int handler = lua_gettop(L_) - arguments;
  lua_pushcfunction(L_, with_traceback);
  lua_insert(L_, handler);
  const int status = lua_pcall(L_, arguments, results, handler);
  lua_remove(L_, handler);
  if (status == LUA_OK && !lua::interrupted(L_)) return true;
  if (lua::interrupted(L_)) {
    was_interrupted_ = true;
    tell_interrupt();
    if (status != LUA_OK) lua_pop(L_, 1);
    return status == LUA_OK;  // then the computation gave its best result so far
  }
  tell_error();
  return false;
}

void Session::tell_error() {
  const char* text = lua_tostring(L_, -1);
  tell(terminal_, text ? text : std::string("(error object is a ") + luaL_typename(L_, -1) + " value)");
  lua_pop(L_, 1);
}

void Session::tell_interrupt() {
  if (terminal_.input && terminal_.messages) std::fputc('\n', stderr);  // behind the terminal's own ^C
  constexpr std::string_view interrupted = "interrupted";
  std::string text = context_.struck_at.empty() ? std::string(interrupted) : context_.struck_at;
  if (time_is_over() && text.ends_with(interrupted)) text.replace(text.size() - interrupted.size(), text.npos, time_limit_text());
  tell(terminal_, text);
}

void Session::begin_transcript(const std::vector<std::string>& before) {
  for (const std::string& script : before) transcript_.entries.push_back({"", script});
  services_.transcript = &transcript_;
}

void Session::resume_after_interrupt() {
  Interrupts::clear();
  was_interrupted_ = false;
  lua::rearm(L_);
}

}  // namespace tendril::shell
