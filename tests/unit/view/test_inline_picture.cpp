// Pictures for terminals: what the escape sequences carry is decoded again and compared.
#include <catch2/catch.hpp>
#include <cstdio>
#include <map>

#include "base/error.h"
#include "view/inline_picture.h"
#include "view/picture.h"
#include "view/sixel.h"

using namespace tendril;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

RgbImage image_of(int width, int height, const std::function<std::array<int, 3>(int x, int y)>& colour) {
  RgbImage image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int part : colour(x, y)) image.rgb.push_back(static_cast<std::uint8_t>(part));
  return image;
}

int number_at(const std::string& text, std::size_t& at) {
  int value = 0;
  while (at < text.size() && text[at] >= '0' && text[at] <= '9') value = 10 * value + (text[at++] - '0');
  return value;
}

/// What a terminal draws: colours in percent; -1 where nothing was drawn.
struct Drawn {
  int width = 0, height = 0, colours = 0;
  std::vector<std::array<int, 3>> pixels;
};

Drawn drawn_by(const std::string& text) {
  Drawn drawn;
  REQUIRE_THAT(text, StartsWith("\033P0;1;0q\"1;1;"));
  std::size_t at = 13;
  drawn.width = number_at(text, at);
  REQUIRE(text[at++] == ';');
  drawn.height = number_at(text, at);
  drawn.pixels.assign(std::size_t(drawn.width) * drawn.height, {-1, -1, -1});
  std::map<int, std::array<int, 3>> palette;
  int x = 0, top = 0, colour = 0;
  while (text[at] != '\033') {
    const char c = text[at++];
    int count = 1;
    char bits = c;
    if (c == '#') {
      colour = number_at(text, at);
      if (text[at] != ';') continue;
      REQUIRE(text.substr(at, 3) == ";2;");
      at += 3;
      std::array<int, 3> rgb{};
      for (int k = 0; k < 3; ++k) {
        rgb[k] = number_at(text, at);
        if (k < 2) REQUIRE(text[at++] == ';');
      }
      palette[colour] = rgb;
      continue;
    }
    if (c == '$' || c == '-') {
      x = 0;
      top += c == '-' ? 6 : 0;
      continue;
    }
    if (c == '!') {
      count = number_at(text, at);
      bits = text[at++];
    }
    REQUIRE((bits >= '?' && bits <= '~'));
    for (; count > 0; --count, ++x)
      for (int k = 0; k < 6; ++k)
        if ((bits - '?') >> k & 1) {
          REQUIRE((x < drawn.width && top + k < drawn.height));
          drawn.pixels[std::size_t(top + k) * drawn.width + x] = palette.at(colour);
        }
  }
  CHECK(text.substr(at) == "\033\\");
  drawn.colours = static_cast<int>(palette.size());
  return drawn;
}

int percent(int level) { return (level * 100 + 127) / 255; }

std::string decoded(const std::string& base64) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int have = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | unsigned(digits.find(c));
    if ((have += 6) >= 8) bytes += static_cast<char>(bits >> (have -= 8) & 255);
  }
  return bytes;
}

std::string small_png() {
  Picture picture;
  picture.tubes.push_back({"hose", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0.5)}, 0.05, {}, {}, Rgb{0.8f, 0.2f, 0.1f}});
  picture.views = {"iso"};
  picture.width = 320;
  picture.height = 240;
  return picture_png(picture, {});
}

PictureTerminal terminal_of(PictureProtocol protocol) {
  PictureTerminal terminal;
  terminal.protocol = protocol;
  terminal.columns = 100;
  terminal.rows = 40;
  terminal.cell_width = 8;
  terminal.cell_height = 16;
  return terminal;
}

}  // namespace

TEST_CASE("sixels draw every pixel, in its own colour while there are few", "[terminal picture]") {
  const auto [width, height] = GENERATE(table<int, int>({{1, 1}, {5, 6}, {7, 13}, {64, 37}, {300, 12}}));
  const RgbImage image = image_of(width, height, [&](int x, int y) { return std::array{(x / 3) % 6 * 51, y % 5 * 60, (x + y) % 2 * 255}; });
  const Drawn drawn = drawn_by(sixels_of(image));
  CHECK((drawn.width == width && drawn.height == height));
  CHECK(drawn.colours <= 60);
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i)
    for (int k = 0; k < 3; ++k) REQUIRE(drawn.pixels[i][k] == percent(image.rgb[3 * i + k]));
}

TEST_CASE("of many colours 256 near ones are left", "[terminal picture]") {
  const RgbImage ramp = image_of(256, 256, [](int x, int y) { return std::array{x, y, (x + y) / 2}; });
  const Palette palette = palette_of(ramp);
  CHECK(palette.rgb.size() == 3 * 256);
  double squares = 0;
  for (std::size_t i = 0; i < palette.of_pixel.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const double off = double(ramp.rgb[3 * i + k]) - palette.rgb[3 * palette.of_pixel[i] + k];
      squares += off * off;
    }
  // A plane of 256 x 256 levels in 256 boxes: at best 16 x 16 each, whose deviation is 16/sqrt(12) = 4.6 a channel.
  CHECK(std::sqrt(squares / double(ramp.rgb.size())) < 7);
  const Drawn drawn = drawn_by(sixels_of(ramp));
  for (const auto& pixel : drawn.pixels) REQUIRE(pixel[0] >= 0);
}

TEST_CASE("a picture made smaller keeps the mean of what it covers", "[terminal picture]") {
  const RgbImage board = image_of(64, 48, [](int x, int y) { return std::array{(x + y) % 2 * 200, x * 4, 77}; });
  const RgbImage small = shrunk(board, 16, 12);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      const std::uint8_t* pixel = &small.rgb[(std::size_t(y) * 16 + x) * 3];
      REQUIRE(int(pixel[0]) == 100);
      REQUIRE(int(pixel[1]) == 16 * x + 6);
      REQUIRE(int(pixel[2]) == 77);
    }
  CHECK(shrunk(board, 64, 48).rgb == board.rgb);
  const RgbImage odd = shrunk(board, 13, 7);
  CHECK(odd.rgb.size() == 13 * 7 * 3);
}

TEST_CASE("kitty and iTerm2 get the PNG itself", "[terminal picture]") {
  const std::string png = small_png();
  const std::string kitty = inline_picture(png, terminal_of(PictureProtocol::kitty));
  REQUIRE_THAT(kitty, StartsWith("\033_Ga=T,f=100,q=2,c=40,m="));  // 320 pixels in cells of 8
  std::string data;
  std::size_t at = 0;
  bool more = true;
  while (more) {
    REQUIRE(kitty.compare(at, 3, "\033_G") == 0);
    const auto semicolon = kitty.find(';', at), end = kitty.find("\033\\", at);
    REQUIRE(end - semicolon - 1 <= 4096);
    more = kitty[semicolon - 1] == '1';
    data += kitty.substr(semicolon + 1, end - semicolon - 1);
    at = end + 2;
  }
  CHECK(kitty.substr(at) == "\n");
  CHECK((decoded(data) == png));

  const std::string iterm = inline_picture(png, terminal_of(PictureProtocol::iterm));
  const std::string head = "\033]1337;File=inline=1;size=" + std::to_string(png.size()) + ";width=40;preserveAspectRatio=1:";
  REQUIRE_THAT(iterm, StartsWith(head));
  CHECK(iterm.substr(iterm.size() - 2) == "\a\n");
  CHECK((decoded(iterm.substr(head.size(), iterm.size() - head.size() - 2)) == png));
}

TEST_CASE("sixels of a PNG, whole where it fits and smaller where not", "[terminal picture]") {
  const std::string png = small_png();
  const std::string whole = inline_picture(png, terminal_of(PictureProtocol::sixel));
  CHECK(drawn_by(whole.substr(0, whole.size() - 1)).width == 320);
  PictureTerminal narrow = terminal_of(PictureProtocol::sixel);
  narrow.columns = 20;
  const std::string less = inline_picture(png, narrow);
  const Drawn drawn = drawn_by(less.substr(0, less.size() - 1));
  CHECK((drawn.width == 160 && drawn.height == 120));
  for (const auto& pixel : drawn.pixels) REQUIRE(pixel[0] >= 0);
}

TEST_CASE("the size that fits a terminal", "[terminal picture]") {
  const PictureTerminal terminal = terminal_of(PictureProtocol::kitty);  // 800 x 640 pixels
  CHECK(terminal.fitting(4.0 / 3).width == 789);                         // 37 rows high
  CHECK(terminal.fitting(4.0 / 3).height == 592);
  CHECK(terminal.fitting(4).width == 800);
  CHECK(terminal.fitting(4, 400).height == 100);
  PictureTerminal tiny;
  tiny.columns = 1;
  tiny.rows = 1;
  CHECK(tiny.fitting(1).width >= 16);
}

TEST_CASE("what is no picture, and a terminal that shows none", "[terminal picture]") {
  const PictureTerminal kitty = terminal_of(PictureProtocol::kitty), sixel = terminal_of(PictureProtocol::sixel);
  CHECK_THROWS_WITH(inline_picture("", kitty), "picture: what should be shown is no PNG");
  CHECK_THROWS_WITH(inline_picture(std::string(100, 'x'), kitty), "picture: what should be shown is no PNG");
  const std::string png = small_png();
  CHECK_THROWS_WITH(inline_picture(png.substr(0, png.size() / 2), sixel), StartsWith("picture: libpng cannot read the picture: "));
  std::string empty = png;
  for (int i = 16; i < 20; ++i) empty[i] = 0;
  CHECK_THROWS_WITH(inline_picture(empty, kitty), "picture: what should be shown is a PNG without pixels");
  CHECK_THROWS_WITH(inline_picture(png, PictureTerminal{}), Contains("there is no terminal that shows pictures"));
}
