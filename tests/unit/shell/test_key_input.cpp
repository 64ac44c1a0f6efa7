#include <unistd.h>

#include <catch2/catch.hpp>

#include "shell/key_input.h"

using tendril::shell::KeyInput;

namespace {

/// What an editor would see typed when the terminal sends `bytes`, and then is gone.
struct Typed {
  explicit Typed(const std::string& bytes) {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    REQUIRE(::write(ends[1], bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
    ::close(ends[1]);
    KeyInput input(ends[0]);
    wchar_t character = 0;
    while (input.next(character) == KeyInput::Got::character) {
      keys += character;
      if (const std::string lines = character == L'\n' ? input.take_block() : ""; !lines.empty()) block = lines;
    }
    ::close(ends[0]);
  }
  std::wstring keys;
  std::string block;
};

const std::string start = "\033[200~", end = "\033[201~";

}  // namespace

TEST_CASE("keys come as they are, UTF-8 decoded") {
  CHECK(Typed("abc\n").keys == L"abc\n");
  CHECK(Typed("\033[A\033").keys == L"\033[A\033");
  CHECK(Typed("\033[20~\033[2").keys == L"\033[20~\033[2");
  CHECK(Typed("\033\033[200").keys == L"\033\033[200");
  CHECK(Typed("\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80").keys == L"\u00E4\u20AC\U0001F600");
}

TEST_CASE("bytes that are no UTF-8 come as replacement characters, none is lost") {
  CHECK(Typed("\x80").keys == L"\uFFFD");
  CHECK(Typed("\xC3x").keys == L"\uFFFDx");
  CHECK(Typed("\xE2\x82").keys == L"\uFFFD");
  CHECK(Typed("\xFF\xFEz").keys == L"\uFFFD\uFFFDz");
}

TEST_CASE("a pasted line is typed, without its control characters") {
  CHECK(Typed(start + "x = 1" + end + "!").keys == L"x = 1!");
  CHECK(Typed(start + "a\tb\033[Ac\x03" + end).keys == L"a  b[Ac");
  CHECK(Typed(start + end).keys.empty());
}

TEST_CASE("of a pasted block the first line is typed, then the last; the middle is kept as it is") {
  const Typed block("> " + start + "for i = 1, 2 do\n\tprint(i)\n\n\tprint('\xC3\xA4')\nend -- last" + end);
  CHECK(block.keys == L"> for i = 1, 2 do\nend -- last");
  CHECK(block.block == "\tprint(i)\n\n\tprint('\xC3\xA4')");
}

TEST_CASE("a block that ends its last line, and newlines of other systems") {
  const Typed block(start + "a\r\nb\rc\n" + end);
  CHECK(block.keys == L"a\n");
  CHECK(block.block == "b\nc");
  const Typed two(start + "a\nb" + end);
  CHECK(two.keys == L"a\nb");
  CHECK(two.block.empty());
}

TEST_CASE("a paste that never ends is not typed") {
  CHECK(Typed("x" + start + "while true do").keys == L"x");
}
