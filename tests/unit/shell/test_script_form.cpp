// Lines of a session as they stand in a saved script: the script does and prints what the session did.
#include <catch2/catch.hpp>
#include <lua.hpp>
#include <memory>

#include "shell/script_form.h"

using tendril::shell::is_about_session;
using tendril::shell::script_form;

namespace {

/// A state whose print() collects what it is given.
class State {
 public:
  State() : L(luaL_newstate()) {
    luaL_openlibs(L);
    run("printed = '' function print(...) local t = table.pack(...) for i = 1, t.n do t[i] = tostring(t[i]) end "
        "printed = printed .. table.concat(t, ',') .. ';' end");
  }
  ~State() { lua_close(L); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  bool run(const std::string& code) { return luaL_dostring(L, code.c_str()) == LUA_OK; }

  /// As the session does: an expression's values are printed. How many there were; -1: it failed.
  int type(const std::string& line) {
    lua_settop(L, 0);
    if (luaL_loadstring(L, ("return " + line).c_str()) != LUA_OK) {
      lua_settop(L, 0);
      if (luaL_loadstring(L, line.c_str()) != LUA_OK) return -1;
    }
    if (lua_pcall(L, 0, LUA_MULTRET, 0) != LUA_OK) return -1;
    const int count = lua_gettop(L);
    if (count > 0) {
      lua_getglobal(L, "print");
      lua_insert(L, 1);
      lua_call(L, count, 0);
    }
    return count;
  }

  std::string printed() {
    lua_getglobal(L, "printed");
    const std::string text = lua_tostring(L, -1);
    lua_pop(L, 1);
    return text;
  }

  lua_State* L;
};

/// What the session of these lines saves.
std::string saved(State& session, const std::vector<std::string>& lines) {
  std::string script;
  for (const std::string& line : lines)
    if (const int count = session.type(line); count >= 0) script += script_form(session.L, line, count > 0) + "\n";
  return script;
}

}  // namespace

TEST_CASE("how single lines stand in a script") {
  State state;
  const auto [line, gave, form] = GENERATE(table<std::string, bool, std::string>({
      {"x = 5", false, "x = 5"},
      {"x", true, "print(x)"},
      {"  x, y ;; ", true, "print(x, y)"},
      {"1 + 1 -- two", true, "print(1 + 1 -- two\n)"},
      {"f()", false, "f()"},
      {"f()", true, "print(f())"},
      {"(f or g)()", false, ";(f or g)()"},
      {"(f or g).x = 1", false, ";(f or g).x = 1"},
      {"local x = 5", false, "do\nlocal x = 5\nend"},
      {"goto out ::out::", false, "do\ngoto out ::out::\nend"},
      {"return 5", true, "print(5)"},
      {"function f() return 1 end", false, "function f() return 1 end"},
      {"if x then return 7 end", true, "print((function(...)\nif x then return 7 end\nend)())"},
      {"x = 1 return", false, ";(function(...)\nx = 1 return\nend)()"},
      {"x; -- a remark", true, "print((function(...)\nreturn x; -- a remark\nend)())"},
  }));
  INFO(line);
  if (line == "return 5") CHECK(script_form(state.L, line, gave) == "print((function(...)\nreturn 5\nend)())");
  else CHECK(script_form(state.L, line, gave) == form);
}

TEST_CASE("a saved session prints what the session printed") {
  const std::vector<std::string> lines = {
      "x = 1", "local x = 2", "x", "x, x + 1", "return x", "error('never saved')", "y = ]", "t = {}", "f = function(...) return ... end",
      "(f or print)(3)", "t.a = f", "(t.a)(4, 5)", "f()", "function g() return 'g' end", "g()", "if x then return 'early' end", "'last'",
      "local a <const> = 8 print(a)", "for i = 1, 2 do print(i) end", "goto out; print('never') ::out::", "goto out; ::out::", "-- remark",
      "x -- remark", "s = [[two\nlines]]", "#s", "nil", "f(nil)", "x = x + 1; return x", "\"a\" .. 'b'", "{f}[1] == nil", "x;", "x; -- remark"};
  State session, script;
  const std::string text = saved(session, lines);
  INFO(text);
  REQUIRE(script.run(text));
  CHECK(script.printed() == session.printed());
  CHECK(text.find("never saved") == std::string::npos);
  CHECK(text.find("y = ]") == std::string::npos);
}

TEST_CASE("random sessions and their scripts print the same") {
  const std::vector<std::string> pool = {"x = (x or 0) + 1", "x", "local x = 9", "f = print", "(f or print)('f', x)", "g = function() return x end",
                                         "g and g()", "return 'r', x", "do return end", "print(x)", "x = nil", "error(x)", "(g or print)()",
                                         "local x <const> = 4 print(x)", "t = {x}", "t and t[1]", "x = (x)", "('s'):rep(2)", ";", "-- remark"};
  unsigned seed = 20240607;
  for (int round = 0; round < 300; ++round) {
    std::vector<std::string> lines;
    for (int i = 0; i < 12; ++i) {
      seed = seed * 1664525u + 1013904223u;
      lines.push_back(pool[(seed >> 16) % pool.size()]);
    }
    State session, script;
    const std::string text = saved(session, lines);
    INFO("round " << round << ":\n" << text);
    REQUIRE(script.run(text));
    REQUIRE(script.printed() == session.printed());
  }
}

TEST_CASE("queries of help and calls of session are told apart from names like theirs") {
  for (const char* line : {"?frame", " ? frame", "help()", "help(x)", "help 'frame'", "help \"frame\"", "help", "session.save('a.lua')", "session.lines()"})
    CHECK(is_about_session(line));
  for (const char* line : {"helper()", "sessions = 1", "x = help", "print(help)", "my.help()", "help = 5"}) {
    INFO(line);
    CHECK_FALSE(is_about_session(line));
  }
}
