// A picture in memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "view/sixel.h"

namespace tendril::render {

/// Rows from the top; 4 bytes a pixel. The fourth says how much of the pixel is tube, where that is known.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgba(static_cast<std::size_t>(w) * h * 4, 0) {}
  std::uint8_t* at(int x, int y) { return &rgba[(static_cast<std::size_t>(y) * width + x) * 4]; }
  const std::uint8_t* at(int x, int y) const { return &rgba[(static_cast<std::size_t>(y) * width + x) * 4]; }
};

/// The colours as a PNG (8 bits, no alpha): fast rather than small. Throws UsageError with libpng's words.
std::string png_of(const Image& image);

/// A PNG of any kind as plain colours, on white where it is transparent. Throws UsageError with libpng's words, and for more
/// than 64 million pixels.
RgbImage image_of(const std::string& png);

}  // namespace tendril::render
