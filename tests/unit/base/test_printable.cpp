#include <catch2/catch.hpp>

#include "base/printable.h"

using tendril::printable;

TEST_CASE("control characters of foreign text are not printed") {
  CHECK(printable("plain text, \xc3\xa9") == "plain text, \xc3\xa9");
  CHECK(printable(std::string_view("a\0b\x1b[31m\n\x7f", 9)) == "a?b?[31m?");
  CHECK(printable("") == "");
}

TEST_CASE("long foreign text keeps its beginning and its end") {
  const std::string text = "begin" + std::string(1000, 'x') + "end";
  const std::string shown = printable(text, 30);
  CHECK(shown == "begin" + std::string(15, 'x') + " ... " + "xxxxxxxend");
  CHECK(printable(text, text.size()) == text);
}

TEST_CASE("what is cut falls between characters of UTF-8") {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "\xe2\x82\xac";  // three bytes each
  for (std::size_t longest = 3; longest < 60; ++longest) {
    INFO(longest);
    std::string shown = printable(text, longest);
    const auto dots = shown.find(" ... ");
    REQUIRE(dots != shown.npos);
    CHECK(dots % 3 == 0);
    CHECK((shown.size() - dots - 5) % 3 == 0);
  }
}
