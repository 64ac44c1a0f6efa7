#include "view/inline_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "view/render_module.h"

namespace tendril {
namespace {

constexpr std::string_view signature{"\x89PNG\r\n\x1a\n", 8};

/// Width and height from the first chunk.
PictureTerminal::Size size_of(const std::string& png) {
  if (png.size() < 33 || !png.starts_with(signature) || png.compare(12, 4, "IHDR") != 0)
    throw UsageError("picture: what should be shown is no PNG");
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<std::uint8_t>(png[i]);
    return static_cast<int>(std::min<std::uint32_t>(value, 1u << 20));
  };
  const PictureTerminal::Size size{number(16), number(20)};
  if (size.width < 1 || size.height < 1) throw UsageError("picture: what should be shown is a PNG without pixels");
  return size;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

/// Pieces of 4096 characters, as the protocol wants them; the first one says what it is and how many columns it takes.
std::string by_kitty(const std::string& png, int columns) {
  constexpr std::size_t piece = 4096;
  const std::string data = base64(png);
  std::string text;
  for (std::size_t at = 0; at < data.size(); at += piece) {
    text += "\033_G";
    if (at == 0) text += "a=T,f=100,q=2,c=" + std::to_string(columns) + ",";
    text += at + piece < data.size() ? "m=1;" : "m=0;";
    text += data.substr(at, piece) + "\033\\";
  }
  return text + "\n";
}

std::string by_iterm(const std::string& png, int columns) {
  return "\033]1337;File=inline=1;size=" + std::to_string(png.size()) + ";width=" + std::to_string(columns) +
         ";preserveAspectRatio=1:" + base64(png) + "\a\n";
}

std::string by_sixel(const std::string& png, PictureTerminal::Size size) {
  std::string sixels, error;
  if (!sixel_module()(png, size.width, size.height, sixels, error)) throw UsageError("picture: " + error);
  return sixels + "\n";
}

}  // namespace

const char* name_of(PictureProtocol protocol) {
  switch (protocol) {
    case PictureProtocol::none: return "no protocol";
    case PictureProtocol::kitty: return "kitty's protocol";
    case PictureProtocol::iterm: return "iTerm2's protocol";
    case PictureProtocol::sixel: return "sixels";
  }
  return "";
}

PictureTerminal::Size PictureTerminal::fitting(double width_over_height, int most) const {
  const double widest = std::min({double(most), double(columns) * cell_width,
                                  width_over_height * std::max(1, rows - 3) * cell_height});
  const int width = std::max(16, static_cast<int>(widest));
  return {width, std::max(16, static_cast<int>(std::lround(width / width_over_height)))};
}

std::string inline_picture(const std::string& png, const PictureTerminal& terminal) {
  const PictureTerminal::Size whole = size_of(png);
  PictureTerminal::Size shown = terminal.fitting(double(whole.width) / whole.height);
  if (shown.width > whole.width) shown = whole;
  const int columns = std::clamp((shown.width + terminal.cell_width - 1) / terminal.cell_width, 1, terminal.columns);
  switch (terminal.protocol) {
    case PictureProtocol::kitty: return by_kitty(png, columns);
    case PictureProtocol::iterm: return by_iterm(png, columns);
    case PictureProtocol::sixel: return by_sixel(png, shown);
    case PictureProtocol::none: break;
  }
  throw UsageError("picture: " + (terminal.why.empty() ? std::string("there is no terminal that shows pictures") : terminal.why));
}

}  // namespace tendril
