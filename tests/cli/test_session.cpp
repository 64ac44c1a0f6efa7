// What an interactive session keeps and begins with: session.save, init.lua; and pictures between its lines.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "process.h"

using cli::Environment;
using cli::Folder;
using cli::Outcome;
using cli::run;
using cli::TerminalSession;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string content_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// The output of an interactive session fed by a pipe.
Outcome session(const std::string& lines, std::vector<std::string> arguments = {}, const Environment& environment = {}) {
  arguments.insert(arguments.begin(), "-i");
  return run(arguments, lines, environment);
}

/// Without what would tell one terminal from another.
Environment plain_terminal(Environment more = {}) {
  for (const char* name : {"TERM_PROGRAM", "LC_TERMINAL", "KITTY_WINDOW_ID", "KONSOLE_VERSION", "TMUX", "STY", "TENDRIL_PICTURES"})
    more.emplace(name, "");
  return more;
}

const std::string picture = "view.new{(function() local s = scene.new{} s:obstacle('b', scene.box{size = {1, 1, 1}}) return s end)()}";

}  // namespace

TEST_CASE("a saved session runs as a script and prints the same", "[session]") {
  const Folder folder;
  const std::string file = folder.path() + "/study.lua";
  const Outcome typed = session("x = 6\nlocal x = 7\nx * 7\nerror('wrong')\nx = = 2\n?vec\nhelp(vec)\nfor i = 1, 2 do\nprint(i)\nend\n"
                                "session.save('" + file + "')\n");
  CHECK(typed.code == 0);
  CHECK_THAT(typed.out, StartsWith("42\n") && Contains("1\n2\nsaved " + file));
  const std::string script = content_of(file);
  CHECK_THAT(script, StartsWith("-- A session of tendril "));
  for (const char* left_out : {"wrong", "= =", "help", "vec", "save"}) {
    INFO(script);
    CHECK(script.find(left_out) == std::string::npos);
  }
  const Outcome again = run({file});
  CHECK(again.out == "42\n1\n2\n");
  CHECK(again.code == 0);
}

TEST_CASE("the lines of a session", "[session]") {
  CHECK(session("a = 1\nerror()\nprint(a)\nfor i, line in ipairs(session.lines()) do print(i, line) end\n").out == "1\n1\ta = 1\n2\tprint(a)\n");
}

TEST_CASE("a saved session begins with what ran before the prompt", "[session]") {
  const Folder folder;
  const std::string file = folder.path() + "/again.lua", script = folder.file("s \"q\".lua", "base = base + #({...}) + (#tostring(...))");
  folder.file("four.lua", "return {four = 4}");
  folder.file("tendril/init.lua", "tenfold = function(x) return 10 * x end");
  const Environment environment{{"TENDRIL_LUA", folder.path()}, {"XDG_CONFIG_HOME", folder.path()}};
  const Outcome typed = session("tenfold(base + f.four)\nsession.save('" + file + "')\n", {"-e", "base = 1", "-l", "f=four", script, "a\nb", "c"}, environment);
  CHECK_THAT(typed.out, StartsWith("100\n"));  // 10 * (1 + 2 + 3 + 4)
  const Outcome again = run({file}, "", environment);
  CHECK(again.out == "100\n");
  CHECK(again.err.empty());
}

TEST_CASE("only saved sessions are overwritten, unless asked to", "[session]") {
  const Folder folder;
  const std::string file = folder.file("mine.lua", "print('mine')");
  const Outcome refused = session("x = 1\nsession.save('" + file + "')\n");
  CHECK_THAT(refused.err, Contains("session.save: '" + file + "' exists and is no saved session; choose another name or say {overwrite = true}"));
  CHECK(content_of(file) == "print('mine')");
  CHECK_THAT(session("x = 1\nsession.save('" + file + "', {overwrite = true})\n").out, StartsWith("saved "));
  CHECK_THAT(content_of(file), Contains("x = 1\n"));
  CHECK_THAT(session("x = 2\nsession.save('" + file + "')\n").out, StartsWith("saved "));
  CHECK_THAT(content_of(file), Contains("x = 2\n") && !Contains("x = 1\n"));
  CHECK_THAT(session("session.save('" + file + "')\n").err, Contains("session.save: nothing has run in this session yet"));
  CHECK_THAT(run({"-e", "session.save('x.lua')"}).err, Contains("session.save: this is a script; only the interactive shell keeps its lines"));
  CHECK(run({"-e", "print(#session.lines())"}).out == "0\n");
}

TEST_CASE("init.lua runs in interactive sessions, and only there", "[session]") {
  const Folder folder;
  folder.file("tendril/init.lua", "greeting = 'hello'");
  const Environment there{{"XDG_CONFIG_HOME", folder.path()}};
  CHECK(session("greeting\n", {}, there).out == "hello\n");
  CHECK(session("greeting\n", {"-E"}, there).out == "nil\n");
  CHECK(run({"-e", "print(greeting)"}, "", there).out == "nil\n");
  CHECK(run({}, "print(greeting)", there).out == "nil\n");
  const Folder home;
  home.file(".config/tendril/init.lua", "greeting = 'at home'");
  CHECK(session("greeting\n", {}, {{"HOME", home.path()}}).out == "at home\n");
}

TEST_CASE("an error in init.lua is told and the session goes on", "[session]") {
  const Folder folder;
  folder.file("tendril/init.lua", "first = 1\nerror('half way')");
  const Environment there{{"XDG_CONFIG_HOME", folder.path()}};
  const Outcome failed = session("first\n", {}, there);
  CHECK(failed.out == "1\n");
  CHECK_THAT(failed.err, StartsWith("tendril: ") && Contains("init.lua:2: half way"));
  CHECK(failed.code == 0);
  folder.file("tendril/init.lua", "x = = 1");
  const Outcome wrong = session("5\n", {}, there);
  CHECK(wrong.out == "5\n");
  CHECK_THAT(wrong.err, Contains("init.lua:1: unexpected symbol near '='"));
}

TEST_CASE("on a terminal a session begins with init.lua and is saved", "[terminal]") {
  const Folder folder;
  folder.file("tendril/init.lua", "greeting = 'hel' .. 'lo'");
  TerminalSession typed({}, {{"XDG_CONFIG_HOME", folder.path()}});
  typed.wait_for("> ");
  typed.type("greeting\r");
  typed.wait_for("hello");
  typed.wait_for("> ");
  typed.type("session.save('" + folder.path() + "/s.lua')\r");
  typed.wait_for("saved /");
  typed.wait_for("> ");
  typed.type("\x04");
  CHECK(typed.finish() == 0);
  CHECK_THAT(content_of(folder.path() + "/s.lua"), Contains("print(greeting)\n") && Contains("tendril/init.lua"));
}

TEST_CASE("pictures by the protocol that the environment tells", "[terminal]") {
  const auto [name, value, escape] = GENERATE(table<std::string, std::string, std::string>(
      {{"TERM", "xterm-kitty", "\033_Ga=T,f=100,q=2,c="},
       {"TERM", "xterm-ghostty", "\033_Ga=T,f=100"},
       {"KONSOLE_VERSION", "230800", "\033_Ga=T,f=100"},
       {"TERM_PROGRAM", "iTerm.app", "\033]1337;File=inline=1;size="},
       {"TERM_PROGRAM", "WezTerm", "\033]1337;File=inline=1;size="},
       {"TENDRIL_PICTURES", "sixel", "\033P0;1;0q\"1;1;"}}));
  INFO(value);
  TerminalSession session({"-i"}, plain_terminal({{name, value}}));
  session.wait_for("> ");
  session.type(picture + ":show{size = {160, 120}}\r");
  session.wait_for(escape);
  session.wait_for("shown by ");
  session.wait_for("> ");
  session.type("\x04");
  CHECK(session.finish() == 0);
  CHECK(session.transcript().find("\033[c") == std::string::npos);  // the terminal was not asked
}

TEST_CASE("a terminal that says nothing of itself is asked, once", "[terminal]") {
  TerminalSession session({"-i"}, plain_terminal());
  session.wait_for("> ");
  session.type(picture + ":show{size = {160, 120}}.ok\r");
  session.wait_for("\033[16t\033[c");
  session.type("\033[6;20;10t\033[?62;4;22c");
  session.wait_for("\033P0;1;0q\"1;1;160;120");
  session.wait_for("true");
  session.wait_for("> ");
  session.type(picture + ":show{}.ok\r");
  session.wait_for("\033P0;1;0q\"1;1;986;740");  // 37 rows of 20 pixels, 4 to 3
  session.wait_for("true");
  session.wait_for("> ");
  session.type("\x04");
  CHECK(session.finish() == 0);
  const std::string all = session.transcript();
  CHECK(all.find("\033[c") == all.rfind("\033[c"));
}

TEST_CASE("a terminal without pictures gets words", "[terminal]") {
  TerminalSession asked({"-i"}, plain_terminal());
  asked.wait_for("> ");
  asked.type(picture + ":show{}\r");
  asked.wait_for("\033[c");
  asked.type("\033[?1;2c");
  asked.wait_for("not shown: this terminal shows no pictures");
  asked.wait_for("view:save(\"picture.png\") writes a file");
  asked.wait_for("> ");
  asked.type("1 + 41\r");
  asked.wait_for("42");
  asked.wait_for("> ");
  asked.type("\x04");
  CHECK(asked.finish() == 0);

  TerminalSession silent({"-i"}, plain_terminal());  // never answers: half a second later the same
  silent.wait_for("> ");
  silent.type(picture + ":show{}\r");
  silent.wait_for("not shown: this terminal shows no pictures");
  silent.wait_for("> ");
  silent.type("\x04");
  CHECK(silent.finish() == 0);
}

TEST_CASE("a dumb terminal and a pipe get no escapes for a picture", "[terminal]") {
  TerminalSession dumb({"-i"}, plain_terminal({{"TERM", "dumb"}, {"KITTY_WINDOW_ID", "1"}}));
  dumb.type(picture + ":show{}\r");
  dumb.wait_for("not shown: standard output is no terminal that shows pictures");
  dumb.type("\x04");
  CHECK(dumb.finish() == 0);
  CHECK(dumb.transcript().find('\033') == std::string::npos);
  const Outcome piped = run({"-e", "local p = " + picture + ":show{} print(p.ok, p.status, p.message)"}, "", {{"TERM", "xterm-kitty"}, {"TENDRIL_PICTURES", "kitty"}});
  CHECK(piped.out == "false\tinfeasible\tstandard output is no terminal that shows pictures; view:save(\"picture.png\") writes a file\n");
}

TEST_CASE("within tmux the terminal outside does not count", "[terminal]") {
  TerminalSession session({"-i"}, plain_terminal({{"TMUX", "/tmp/tmux"}, {"KITTY_WINDOW_ID", "1"}}));
  session.wait_for("> ");
  session.type(picture + ":show{}\r");
  session.wait_for("\033[c");
  session.type("\033[?1;2c");
  session.wait_for("not shown: ");
  session.wait_for("> ");
  session.type("\x04");
  CHECK(session.finish() == 0);
}

TEST_CASE("a saved picture is shown too", "[terminal]") {
  const Folder folder;
  TerminalSession session({"-i"}, plain_terminal({{"TENDRIL_PICTURES", "kitty"}}));
  session.wait_for("> ");
  session.type(picture + ":save('" + folder.path() + "/a.png', {size = {160, 120}}):show()\r");
  session.wait_for("\033_Ga=T,f=100");
  session.wait_for("shown by kitty's protocol");
  session.wait_for("> ");
  session.type("study.chart{series = {{name = 'a', x = {1, 2}, y = {1, 2}}}}:save('" + folder.path() + "/a.svg'):show()\r");
  session.wait_for("is no picture that a terminal shows, expected a .png");
  session.wait_for("> ");
  session.type("\x04");
  CHECK(session.finish() == 0);
}

TEST_CASE("a protocol that is none is an error", "[terminal]") {
  TerminalSession session({"-i"}, plain_terminal({{"TENDRIL_PICTURES", "gif"}}));
  session.wait_for("> ");
  session.type(picture + ":show{}\r");
  session.wait_for("TENDRIL_PICTURES: got 'gif', expected kitty, iterm, sixel or none");
  session.wait_for("> ");
  session.type("\x04");
  CHECK(session.finish() == 0);
}

TEST_CASE("what takes long says how far it is and what time is left, and takes the line away", "[terminal]") {
  const Folder folder;
  const std::string study = folder.file(
      "long.lua",
      "local s = scene.new{}\n"
      "local r = rod.new{length = 1, segments = 40, section = rod.section{outer = 0.02, material = rod.material{young = 5e6, poisson = 0.4, density = 1100}}}\n"
      "s:rod('hose', r, {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.9, 0, 0}, along = {1, 0, 0}}})\n"
      "method.variation(s, {vary = {['hose.length'] = 0.01}, measure = {len = function(eq) return eq:rod('hose').length end}, outcomes = 100000, timeout = 3})\n"
      "print('after' .. 'wards')");
  TerminalSession session({study});
  session.wait_for(" %, ");
  session.wait_for(" left");
  const std::string last = session.wait_for("afterwards");
  CHECK_THAT(last, Contains("\r\033[Kafterwards"));
  CHECK(session.finish() == 0);
  const Outcome piped = run({study});
  CHECK(piped.out == "afterwards\n");
  CHECK(piped.err.find(" left") == std::string::npos);
}
