#include <catch2/catch.hpp>

#include "base/error.h"
#include "shell/arguments.h"

using namespace tendril::shell;

namespace {
Arguments parse(std::vector<const char*> words) {
  words.insert(words.begin(), "tendril");
  return parse_arguments(static_cast<int>(words.size()), words.data());
}
}  // namespace

TEST_CASE("steps keep their order, with their text joined or apart") {
  const Arguments a = parse({"-e", "x = 1", "-ly", "-ez = 3", "-l", "g=mod", "-W", "-E", "s.lua", "-v"});
  REQUIRE(a.steps.size() == 4);
  CHECK(a.steps[0].text == "x = 1");
  CHECK((a.steps[1].kind == Step::Kind::require && a.steps[1].text == "y"));
  CHECK((a.steps[2].kind == Step::Kind::execute && a.steps[2].text == "z = 3"));
  CHECK(a.steps[3].text == "g=mod");
  CHECK((a.warnings && a.ignore_environment && a.has_code));
  CHECK_FALSE(a.version);  // behind the script: the script's own
  CHECK(a.script == 9);
}

TEST_CASE("where options end") {
  CHECK(parse({}).script == 0);
  CHECK(parse({"-v"}).script == 0);
  CHECK(parse({"-i", "a.lua"}).script == 2);
  CHECK(parse({"-i", "a.lua"}).interactive);
  CHECK(parse({"--", "-e"}).script == 2);
  CHECK(parse({"--"}).script == 0);
  const Arguments in = parse({"-", "x"});
  CHECK((in.script == 1 && in.script_is_stdin));
  CHECK_FALSE(parse({"--", "-"}).script_is_stdin);  // a file of that name, as in Lua
}

TEST_CASE("modes") {
  CHECK(parse({"--help"}).mode == Arguments::Mode::help);
  CHECK(parse({"-e", "x", "-h", "-nonsense"}).mode == Arguments::Mode::help);
  CHECK(parse({"--version"}).mode == Arguments::Mode::version_only);
  CHECK(parse({"--annotations"}).mode == Arguments::Mode::annotations);
  CHECK(parse({"-v"}).mode == Arguments::Mode::run);
}

TEST_CASE("options that are none") {
  CHECK_THROWS_WITH(parse({"-z"}), "unrecognized option '-z'");
  CHECK_THROWS_WITH(parse({"-vv"}), "unrecognized option '-vv'");
  CHECK_THROWS_WITH(parse({"--verison"}), "unrecognized option '--verison'; did you mean '--version'?");
  CHECK_THROWS_WITH(parse({"-e"}), "'-e' needs argument");
  CHECK_THROWS_WITH(parse({"-l", "-i"}), "'-l' needs argument");
}
