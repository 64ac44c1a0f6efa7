#include <catch2/catch.hpp>

#include "shell/picture_query.h"

using tendril::shell::picture_answer;
using tendril::shell::PictureAnswer;

TEST_CASE("what terminals answer about pictures") {
  const auto [text, complete, sixels, width, height] = GENERATE(table<std::string, bool, bool, int, int>({
      {"", false, false, 0, 0},
      {"\033[?62;4;6;22c", true, true, 0, 0},
      {"\033[?4;6c", true, false, 0, 0},            // class 4 and no attribute 4: a VT132
      {"\033[?62;44;14c", true, false, 0, 0},
      {"\033[?65;1;4c", true, true, 0, 0},
      {"\033[6;18;9t\033[?64;4c", true, true, 9, 18},
      {"\033[6;0;9t\033[?1;2c", true, false, 0, 0},
      {"\033[6;99999;99999t\033[?1;2c", true, false, 0, 0},
      {"abc\033[A\033[?6c", true, false, 0, 0},
      {"\033[?62;4", false, false, 0, 0},
      {"\033[>0;10;1c", false, false, 0, 0},         // secondary attributes are another answer
  }));
  INFO(text.substr(text.empty() ? 0 : 1));
  const PictureAnswer answer = picture_answer(text);
  CHECK(answer.complete == complete);
  CHECK(answer.sixels == sixels);
  CHECK(answer.cell_width == width);
  CHECK(answer.cell_height == height);
}
