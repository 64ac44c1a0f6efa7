// Flags, scripts and exit codes.
#include <catch2/catch.hpp>

#include "process.h"

using cli::Folder;
using cli::Outcome;
using cli::run;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("-e runs code, in the order given, before the script") {
  const Folder folder;
  const std::string script = folder.file("s.lua", "print('script', a, ...)");
  const Outcome o = run({"-e", "a = 1", "-ea = a + 1", "-e", "print(a)", script, "x", "y"});
  CHECK(o.out == "2\nscript\t2\tx\ty\n");
  CHECK(o.err.empty());
  CHECK(o.code == 0);
}

TEST_CASE("a script gets its arguments in ... and arg, with what came before at negative places") {
  const Folder folder;
  const std::string script = folder.file("s.lua", "print(#arg, arg[0], arg[1], arg[2], arg[-1], arg[-2], select('#', ...))");
  CHECK(run({"-W", script, "-e", "--help"}).out == "2\t" + script + "\t-e\t--help\t-W\ttendril\t2\n");
  CHECK(run({"--", script, "a"}).out == "1\t" + script + "\ta\tnil\t--\ttendril\t1\n");
}

TEST_CASE("arg without a script names the program") {
  CHECK(run({"-e", "print(arg[0], arg[1], arg[2])"}).out == "tendril\t-e\tprint(arg[0], arg[1], arg[2])\n");
}

TEST_CASE("a script on standard input, asked for or because it is no terminal") {
  CHECK(run({}, "print('in', ...)").out == "in\n");
  CHECK(run({"-", "a", "b"}, "print(arg[0], ...)").out == "-\ta\tb\n");
  const Outcome wrong = run({}, "print(1)\nerror('oops')");
  CHECK(wrong.out == "1\n");
  CHECK_THAT(wrong.err, StartsWith("tendril: stdin:2: oops\nstack traceback:"));
  CHECK(wrong.code == 1);
}

TEST_CASE("-l requires a module into a global") {
  const Folder folder;
  folder.file("shapes.lua", "return {sides = 6}");
  const cli::Environment there{{"TENDRIL_LUA", folder.path()}};
  CHECK(run({"-l", "shapes", "-e", "print(shapes.sides)"}, "", there).out == "6\n");
  CHECK(run({"-lshapes", "-e", "print(shapes.sides)"}, "", there).out == "6\n");
  CHECK(run({"-l", "s=shapes", "-e", "print(s.sides)"}, "", there).out == "6\n");
  const Outcome ignored = run({"-E", "-l", "shapes"}, "", there);
  CHECK(ignored.code == 1);
  CHECK_THAT(ignored.err, Contains("module 'shapes' not found"));
}

TEST_CASE("version and help") {
  for (const char* flag : {"-v", "--version"}) {
    const Outcome o = run({flag});
    CHECK_THAT(o.out, StartsWith("tendril 0.") && Contains("Lua 5.4"));
    CHECK(o.code == 0);
  }
  CHECK_THAT(run({"-v", "-e", "print(7)"}).out, StartsWith("tendril ") && Contains("\n7\n"));
  for (const char* flag : {"-h", "--help"}) {
    const Outcome o = run({flag});
    CHECK_THAT(o.out, StartsWith("usage: tendril") && Contains("--version"));
    CHECK(o.err.empty());
    CHECK(o.code == 0);
  }
}

TEST_CASE("wrong usage names the option and exits with 2") {
  const auto [arguments, message] = GENERATE(table<std::vector<std::string>, std::string>(
      {{{"-x"}, "unrecognized option '-x'"},
       {{"-ix"}, "unrecognized option '-ix'"},
       {{"--hepl"}, "unrecognized option '--hepl'; did you mean '--help'?"},
       {{"-e"}, "'-e' needs argument"},
       {{"-e", "-v"}, "'-e' needs argument"},
       {{"-l"}, "'-l' needs argument"}}));
  const Outcome o = run(arguments);
  CHECK_THAT(o.err, StartsWith("tendril: " + message + "\n"));
  CHECK(o.out.empty());
  CHECK(o.code == 2);
}

TEST_CASE("a memory limit that is no size is wrong usage") {
  const Outcome o = run({"-e", "print(1)"}, "", {{"TENDRIL_MEMORY", "lots"}});
  CHECK_THAT(o.err, StartsWith("tendril: TENDRIL_MEMORY: got 'lots', expected a size such as 512M or 8G\n"));
  CHECK(o.code == 2);
}

TEST_CASE("a missing script, a folder and a binary chunk are errors") {
  const Folder folder;
  const Outcome missing = run({folder.path() + "/none.lua"});
  CHECK_THAT(missing.err, Contains("cannot open " + folder.path() + "/none.lua"));
  CHECK(missing.code == 1);
  CHECK(run({folder.path()}).code == 1);
  const std::string binary = folder.file("b.luac", std::string("\x1bLua\x54\0garbage", 13));
  const Outcome refused = run({binary});
  CHECK_THAT(refused.err, Contains("attempt to load a binary chunk"));
  CHECK(refused.code == 1);
}

TEST_CASE("the exit code of a script") {
  const auto [code, wanted] = GENERATE(table<std::string, int>({{"", 0},
                                                                {"os.exit()", 0},
                                                                {"os.exit(3)", 3},
                                                                {"os.exit(true)", 0},
                                                                {"os.exit(false)", 1},
                                                                {"pcall(os.exit, 4)", 4},
                                                                {"coroutine.wrap(function() os.exit(5) end)()", 5},
                                                                {"error('x')", 1},
                                                                {"x = = 1", 1}}));
  INFO(code);
  CHECK(run({"-e", code}).code == wanted);
}

TEST_CASE("os.exit finalises objects and keeps what was printed") {
  const Outcome o = run({"-e", "setmetatable({}, {__gc = function() print('collected') end}) io.write('before ') os.exit(6)"});
  CHECK(o.out == "before collected\n");
  CHECK(o.code == 6);
}

TEST_CASE("nothing runs after a step that failed") {
  const Outcome o = run({"-e", "error('first')", "-e", "print('second')"});
  CHECK(o.out.empty());
  CHECK(o.code == 1);
}

TEST_CASE("standard output that cannot be written is an error") {
  CHECK(run({"-e", "assert(io.output('/dev/full')) io.write(('x'):rep(1e5)) print(io.output():close())"}).code == 0);
}
