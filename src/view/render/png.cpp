#include <png.h>

#include <csetjmp>

#include "base/error.h"
#include "view/render/image.h"

namespace tendril::render {
namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

/// Everything between setjmp and longjmp: nothing here owns memory.
bool encode(png_structp png, png_infop info, const Image& image, std::string& bytes, std::uint8_t* row) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 3);
  png_set_filter(png, 0, PNG_FILTER_SUB);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* from = image.at(0, y);
    for (int x = 0; x < image.width; ++x)
      for (int k = 0; k < 3; ++k) row[3 * x + k] = from[4 * x + k];
    png_write_row(png, row);
  }
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

std::string png_of(const Image& image) {
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(image.width) * image.height);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(image.width) * 3);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool good = info && encode(png, info, image, bytes, row.data());
  png_destroy_write_struct(&png, &info);
  if (!good) throw UsageError("libpng cannot encode the picture");
  return bytes;
}

RgbImage image_of(const std::string& png) {
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  const auto refuse = [&reader] {
    const std::string why = reader.message;
    png_image_free(&reader);
    throw UsageError("libpng cannot read the picture: " + why);
  };
  if (!png_image_begin_read_from_memory(&reader, png.data(), png.size())) refuse();
  if (std::uint64_t(reader.width) * reader.height > 64'000'000) {
    png_image_free(&reader);
    throw UsageError("a picture of more than 64 million pixels cannot be shown");
  }
  reader.format = PNG_FORMAT_RGB;
  RgbImage image{static_cast<int>(reader.width), static_cast<int>(reader.height), {}};
  image.rgb.resize(PNG_IMAGE_SIZE(reader));
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&reader, &white, image.rgb.data(), 0, nullptr)) refuse();
  return image;
}

}  // namespace tendril::render
