#include "compare_pictures.h"

#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "base/error.h"

namespace tendril::golden {

Pixels read_png(const std::string& bytes) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()))
    throw UsageError(std::string("no PNG: ") + image.message);
  image.format = PNG_FORMAT_RGB;
  Pixels pixels{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  pixels.rgb.resize(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr))
    throw UsageError(std::string("no PNG: ") + image.message);
  return pixels;
}

std::string write_png(const Pixels& pixels) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(pixels.width), image.height = static_cast<png_uint_32>(pixels.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, pixels.rgb.data(), 0, nullptr);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.rgb.data(), 0, nullptr))
    throw UsageError(image.message);
  bytes.resize(size);
  return bytes;
}

Difference difference_of(const Pixels& wanted, const Pixels& got) {
  Difference result;
  result.same_size = wanted.width == got.width && wanted.height == got.height;
  if (!result.same_size) {
    result.picture = got;
    return result;
  }
  result.picture = {wanted.width, wanted.height, std::vector<std::uint8_t>(wanted.rgb.size())};
  std::size_t off = 0;
  for (std::size_t i = 0; i < wanted.rgb.size(); i += 3) {
    int most = 0;
    for (std::size_t k = i; k < i + 3; ++k) {
      const int d = std::abs(int(wanted.rgb[k]) - int(got.rgb[k]));
      result.mean += d;
      most = std::max(most, d);
      result.picture.rgb[k] = static_cast<std::uint8_t>(std::max(0, 255 - 5 * d));
    }
    off += most > Difference::visible;
  }
  result.mean /= static_cast<double>(std::max<std::size_t>(wanted.rgb.size(), 1));
  result.share = static_cast<double>(off) / std::max(1.0, static_cast<double>(wanted.width) * wanted.height);
  return result;
}

}  // namespace tendril::golden
