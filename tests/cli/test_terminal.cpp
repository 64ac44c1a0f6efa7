// The interactive session on a terminal: editing, completion, pasted blocks, history, Ctrl-C and Ctrl-D.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "process.h"

using cli::Folder;
using cli::TerminalSession;
using Catch::Matchers::Contains;

namespace {

const std::string ctrl_c = "\x03", ctrl_d = "\x04", tab = "\t", up = "\033[A";

/// A session that has shown its first prompt.
struct Started : TerminalSession {
  explicit Started(const cli::Environment& environment = {}) : TerminalSession({}, environment) { wait_for("> "); }

  /// Types a line and waits for the text of its answer, then for the next prompt.
  std::string answer(const std::string& line, const std::string& text) {
    type(line + "\r");
    wait_for("\n");  // the typed line itself
    const std::string before = wait_for(text);
    wait_for("> ");
    return before;
  }

  int leave() {
    type(ctrl_d);
    return finish();
  }
};

std::string content_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("expressions print, statements run, Ctrl-D leaves", "[terminal]") {
  Started session;
  session.answer("6 * 7", "42");
  session.answer("x = 5", "");
  session.answer("x, x + 1", "5\t6");
  session.answer("vec(1, 2, 3) * 2", "vec(2, 4, 6)");
  session.answer("{1, 2, name = 'n'}", "{1, 2, name = \"n\"}");
  CHECK(session.leave() == 0);
}

TEST_CASE("an error is told and the session goes on", "[terminal]") {
  Started session;
  session.answer("frame{at = 3}", "option 'at': got a number (3)");
  session.answer("x = = 1", "unexpected symbol near '='");
  session.answer("'still ' .. 'here'", "still here");
  CHECK(session.leave() == 0);
}

TEST_CASE("a statement may take several lines", "[terminal]") {
  Started session;
  session.type("for i = 1, 2 do\r");
  session.wait_for(">> ");
  session.type("print('turn ' .. i)\r");
  session.wait_for(">> ");
  session.type("end\r");
  session.wait_for("turn 1\r\nturn 2");
  session.wait_for("> ");
  CHECK(session.leave() == 0);
}

TEST_CASE("Ctrl-C at the prompt clears the line, also in the middle of a statement", "[terminal]") {
  Started session;
  session.type("error('never run')" + ctrl_c);
  session.wait_for("> ");
  session.answer("1 + 1", "2");
  session.type("while true do\r");
  session.wait_for(">> ");
  session.type(ctrl_c);
  session.wait_for("> ");
  session.answer("2 + 2", "4");
  CHECK(session.leave() == 0);
  CHECK(session.transcript().find("never run\n") == std::string::npos);
}

TEST_CASE("Ctrl-C stops what runs and keeps the variables", "[terminal]") {
  Started session;
  session.answer("kept = 7", "");
  for (const char* loop :
       {"while true do end", "while true do pcall(function() while true do end end) end",
        "coroutine.wrap(function() while true do end end)()",
        "while true do pcall(coroutine.wrap(function() while true do pcall(function() while true do end end) end end)) end"}) {
    session.type("io.write('run' .. 'ning') io.flush() " + std::string(loop) + "\r");
    session.wait_for("running");
    session.type(ctrl_c);
    session.wait_for("interrupted");
    session.wait_for("> ");
    session.answer("kept + 1", "8");
  }
  CHECK(session.leave() == 0);
}

TEST_CASE("a coroutine that was interrupted does not trouble the session later", "[terminal]") {
  Started session;
  session.answer("co = coroutine.create(function() pcall(function() io.write('run' .. 'ning') io.flush() while true do end end) end)", "");
  session.answer("other = coroutine.wrap(function() for i = 1, 3 do coroutine.yield(i) end end)", "");
  session.type("coroutine.resume(co)\r");
  session.wait_for("running");
  session.type(ctrl_c);
  session.wait_for("> ");
  session.answer("other() + other()", "3");
  session.answer("pcall(function() local n = 0 for i = 1, 1e6 do n = n + 1 end return n end)", "true\t1000000");
  CHECK(session.leave() == 0);
}

TEST_CASE("completion of globals, members and option names", "[terminal]") {
  Started session;
  session.answer("uni" + tab + ".MP" + tab, "1000000.0");
  session.answer("v = vec(3, 4, 0)", "");
  session.answer("v:len" + tab + "()", "5.0");
  session.type("f = frame{a" + tab + tab);  // two names start so: both are listed
  const std::string listed = session.wait_for("at = ");
  CHECK_THAT(listed, Contains("along = "));
  session.type("t" + tab + "{1, 2, 3}, al" + tab + "{0, 0, 1}}\r");
  session.wait_for("\n");
  session.wait_for("> ");
  session.answer("f.at:le" + tab + "() > 3.74 and 'so long'", "so long");  // the type of a property is known
  session.answer("string.for" + tab + "('%d;', 3)", "3;");
  CHECK(session.leave() == 0);
}

TEST_CASE("a pasted block runs as one, and tabs in it do not complete", "[terminal]") {
  Started session;
  session.type("\033[200~local a = 20\n\tlocal b = 22\n\tif a then\n\t\tprint('sum ' .. a + b)\n\tend\n\033[201~");
  session.wait_for("sum 42");
  session.wait_for("> ");
  session.type("\033[200~1 + \0332\t3\033[201~" + ctrl_c);  // one line: typed, without its control characters
  session.wait_for("> ");
  session.type("\033[200~'pasted ' ..\n'with' ..\n' no end'\033[201~");
  session.wait_for("no end");
  session.type("\r");
  session.wait_for("pasted with no end");
  session.wait_for("> ");
  CHECK(session.leave() == 0);
  CHECK(session.transcript().find("200~") == std::string::npos);
  CHECK(session.transcript().find("201~") == std::string::npos);
}

TEST_CASE("nothing of a pasted block with an error in its syntax runs", "[terminal]") {
  Started session;
  session.type("\033[200~print('first' .. ' part')\nx = = 1\nprint('last' .. ' part')\n\033[201~");
  session.wait_for("unexpected symbol");
  session.wait_for("> ");
  CHECK(session.leave() == 0);
  CHECK(session.transcript().find("first part") == std::string::npos);
  CHECK(session.transcript().find("last part") == std::string::npos);
}

TEST_CASE("the history lasts over sessions", "[terminal]") {
  const Folder folder;
  const cli::Environment there{{"XDG_STATE_HOME", folder.path()}};
  {
    Started first(there);
    first.answer("'first ' .. 'session'", "first session");
    CHECK(first.leave() == 0);
  }
  {
    Started second(there);
    second.type(up + "\r");
    second.wait_for("first session");
    second.wait_for("> ");
    CHECK(second.leave() == 0);
  }
  CHECK(content_of(folder.path() + "/tendril/history") == "'first ' .. 'session'\n");
}

TEST_CASE("two sessions write one history", "[terminal]") {
  const Folder folder;
  const cli::Environment there{{"XDG_STATE_HOME", folder.path()}};
  Started one(there), two(there);
  one.answer("101", "101");
  two.answer("202", "202");
  one.answer("303", "303");
  CHECK(one.leave() == 0);
  CHECK(two.leave() == 0);
  CHECK(content_of(folder.path() + "/tendril/history") == "101\n202\n303\n");
}

TEST_CASE("a history that cannot be written is told once", "[terminal]") {
  const Folder folder;
  const std::string file = folder.file("in_the_way", "");
  Started session(cli::Environment{{"XDG_STATE_HOME", file}});
  session.answer("10", "10");
  session.answer("20", "20");
  CHECK(session.leave() == 0);
  const std::string& text = session.transcript();
  const auto told = text.find("history is not kept");
  REQUIRE(told != std::string::npos);
  CHECK(text.find("history is not kept", told + 1) == std::string::npos);
}

TEST_CASE("?x and help(x) explain", "[terminal]") {
  Started session;
  session.answer("?frame", "frame{at=, along=, [up=]} -> frame");
  session.answer("help(vec(1, 2, 3).length)", "vec:length() -> number");
  session.answer("? units", "units.MPa");
  session.answer("?vec.dot", "vec:dot(other) -> number");
  session.answer("?frmae", "did you mean 'frame'?");
  CHECK(session.leave() == 0);
}

TEST_CASE("a terminal that understands no escapes gets none, and no prompt", "[terminal]") {
  TerminalSession session({}, {{"TERM", "dumb"}});
  session.type("1 + 1\r");
  session.wait_for("\n2\r\n");
  session.type("error('no')\r");
  session.wait_for("stdin:1: no");
  session.type(ctrl_d);
  CHECK(session.finish() == 0);
  CHECK(session.transcript().find('\033') == std::string::npos);
  CHECK(session.transcript().find("> ") == std::string::npos);
}

TEST_CASE("errors are coloured unless NO_COLOR says otherwise", "[terminal]") {
  Started coloured;
  coloured.answer("error('a' .. 'b')", "\033[31mtendril: stdin:1: ab");
  CHECK(coloured.leave() == 0);
  Started plain(cli::Environment{{"NO_COLOR", "1"}});
  plain.answer("error('a' .. 'b')", "tendril: stdin:1: ab");
  CHECK(plain.leave() == 0);
  CHECK(plain.transcript().find("\033[31m") == std::string::npos);
}

TEST_CASE("letters beyond ASCII are edited whole", "[terminal]") {
  Started session;
  session.type("'Schl\xC3\xA4uche\xC3\xBC\x7F'\r");  // the last letter is rubbed out
  session.wait_for("\n");
  session.wait_for("Schl\xC3\xA4uche\r\n");
  session.wait_for("> ");
  CHECK(session.leave() == 0);
}

TEST_CASE("-i enters the session after a script, with its globals", "[terminal]") {
  const Folder folder;
  TerminalSession session({"-i", folder.file("s.lua", "answer = 41")});
  session.wait_for("> ");
  session.type("answer + 1\r");
  session.wait_for("42");
  session.wait_for("> ");
  session.type(ctrl_d);
  CHECK(session.finish() == 0);
}
