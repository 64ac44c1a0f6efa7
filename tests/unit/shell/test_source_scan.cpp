#include <catch2/catch.hpp>
#include <random>

#include "shell/source_scan.h"

using namespace tendril::shell;

namespace {

std::string open_brackets(const std::string& text) {
  std::string brackets;
  for (const Scan::Open& open : scan(text).open) brackets += open.bracket;
  return brackets;
}

/// "name field() [..]" in short: n:name f:field m:method () []
std::string chain(const std::string& text) {
  std::string shown;
  for (const Link& link : chain_before(text, scan(text), text.size())) {
    static const char* const marks[] = {"", ".", ":", "()", "[]"};
    shown += marks[static_cast<int>(link.kind)] + std::string(link.name);
  }
  return shown;
}

}  // namespace

TEST_CASE("brackets that are open, outside strings and comments") {
  CHECK(open_brackets("f(a, {b, [c").empty() == false);
  CHECK(open_brackets("f(a, {b, [c") == "({[");
  CHECK(open_brackets("f(a, {b}, [1]) {") == "{");
  CHECK(open_brackets("f('(', \"{\", [[ [ ]], [==[ ]] ( ]==]) (") == "(");
  CHECK(open_brackets("f( -- ( {\n {") == "({");
  CHECK(open_brackets("f( --[[ ( \n { ]] [") == "([");
  CHECK(open_brackets("'it\\'s (' {") == "{");
}

TEST_CASE("the text may end inside a string or a comment") {
  CHECK(scan("x = 'abc").string_at == 4);
  CHECK(scan("x = [==[ abc ]]").string_at == 4);
  CHECK_FALSE(scan("x = 'abc'").string_at);
  CHECK(scan("x -- y").in_comment);
  CHECK(scan("x --[[ y \n").in_comment);
  CHECK_FALSE(scan("x -- y\n").in_comment);
  CHECK_FALSE(scan("x = 'never closed\ny").string_at);
}

TEST_CASE("chains before the cursor") {
  CHECK(chain("x = rod.section") == "rod.section");
  CHECK(chain("eq:rod(\"hose\").points[1]") == "eq:rod().points[]");
  CHECK(chain("a.b:c{x = {1}, y = ')'}") == "a.b:c()");
  CHECK(chain("f 'text'") == "f()");
  CHECK(chain("f {1}") == "f()");
  CHECK(chain("1 + x") == "x");
  CHECK(chain("(x)").empty());
  CHECK(chain("").empty());
  CHECK(chain("x.").empty());
}

TEST_CASE("no text of brackets, quotes and names breaks the scan") {
  std::mt19937 random(7);
  INFO("seed 7");
  const std::string letters = "ab.:()[]{}'\"-=\\\n ";
  for (int i = 0; i < 20000; ++i) {
    std::string text(std::uniform_int_distribution<std::size_t>(0, 24)(random), ' ');
    for (char& c : text) c = letters[std::uniform_int_distribution<std::size_t>(0, letters.size() - 1)(random)];
    const Scan scanned = scan(text);
    for (const Scan::Open& open : scanned.open) REQUIRE(text.at(open.at) == open.bracket);
    for (const auto& [end, start] : scanned.group_start) REQUIRE((start < end && end <= text.size()));
    for (std::size_t end = 0; end <= text.size(); ++end) chain_before(text, scanned, end);
  }
}
