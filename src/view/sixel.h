// Pictures as sixels: bands of six rows, each a line of characters for every colour in it (DEC's STD 070).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tendril {

/// Rows from the top, 3 bytes a pixel.
struct RgbImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// The whole picture made smaller: every pixel is the mean of those it stands for. `width` and `height` at most the
/// picture's own.
RgbImage shrunk(const RgbImage& image, int width, int height);

/// At most 256 colours for an image, by halving the box of colours that spreads most (median cut: Heckbert, Color image
/// quantization for frame buffer display, SIGGRAPH 1982), and which of them each pixel takes. Colours are kept to 5 bits.
struct Palette {
  std::vector<std::uint8_t> rgb;       ///< 3 bytes a colour
  std::vector<std::uint8_t> of_pixel;  ///< one a pixel
};
Palette palette_of(const RgbImage& image);

/// The escape sequence that shows it.
std::string sixels_of(const RgbImage& image);

}  // namespace tendril
