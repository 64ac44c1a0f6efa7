#include "view/render/font.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/write_file.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_truetype.h>
#pragma GCC diagnostic pop

namespace tendril::render {

struct Font::Face {
  std::string bytes;
  stbtt_fontinfo info;
  double scale(double size) const { return stbtt_ScaleForMappingEmToPixels(&info, static_cast<float>(size)); }
};

Font::Font(const std::string& file) : face_(std::make_unique<Face>()) {
  const char* named = std::getenv("TENDRIL_FONTS");
  const std::string path = (named && *named ? std::string(named) : "/usr/share/fonts/truetype/dejavu") + "/" + file;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw UsageError("the font '" + path + "' is missing (package fonts-dejavu-core)");
  face_->bytes = read_file(path);
  const auto* data = reinterpret_cast<const unsigned char*>(face_->bytes.data());
  // stb_truetype trusts its input: only what looks like a whole TrueType file reaches it.
  const bool looks_right = face_->bytes.size() > 1000 && face_->bytes.compare(0, 4, std::string("\0\1\0\0", 4)) == 0;
  if (!looks_right || !stbtt_InitFont(&face_->info, data, 0))
    throw UsageError("'" + path + "' is not a TrueType font (package fonts-dejavu-core)");
}

Font::~Font() = default;

std::vector<int> code_points(std::string_view utf8) {
  std::vector<int> points;
  for (std::size_t i = 0; i < utf8.size();) {
    const unsigned char lead = static_cast<unsigned char>(utf8[i++]);
    const int more = lead < 0x80 ? 0 : lead >= 0xf0 && lead < 0xf5 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc2 ? 1 : -1;
    int point = more < 0 || lead >= 0xf5 ? 0xfffd : more == 0 ? lead : lead & (0x3f >> more);
    for (int k = 0; k < more && point != 0xfffd; ++k) {
      if (i >= utf8.size() || (static_cast<unsigned char>(utf8[i]) & 0xc0) != 0x80) point = 0xfffd;
      else point = point << 6 | (static_cast<unsigned char>(utf8[i++]) & 0x3f);
    }
    points.push_back(point < 0x20 || point == 0x7f ? ' ' : point);
  }
  return points;
}

double Font::width(std::string_view utf8, double size) const {
  double units = 0;
  int before = 0;
  for (int point : code_points(utf8)) {
    int advance = 0, bearing = 0;
    stbtt_GetCodepointHMetrics(&face_->info, point, &advance, &bearing);
    if (before) units += stbtt_GetCodepointKernAdvance(&face_->info, before, point);
    units += advance;
    before = point;
  }
  return units * face_->scale(size);
}

double Font::ascent(double size) const {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  stbtt_GetCodepointBox(&face_->info, 'H', &x0, &y0, &x1, &y1);
  return y1 * face_->scale(size);
}

void Font::draw(std::string_view utf8, double size, double x, double baseline,
                const std::function<void(int, int, std::uint8_t)>& pixel) const {
  const float scale = static_cast<float>(face_->scale(size));
  const int row =
      static_cast<int>(std::lround(baseline));  // rows sit on whole pixels: crisp; columns keep their thirds
  int before = 0;
  std::vector<std::uint8_t> bitmap;
  for (int point : code_points(utf8)) {
    if (before) x += scale * stbtt_GetCodepointKernAdvance(&face_->info, before, point);
    const int column = static_cast<int>(std::floor(x));
    const float shift = static_cast<float>(std::floor((x - column) * 4) / 4);
    int x0, y0, x1, y1;
    stbtt_GetCodepointBitmapBoxSubpixel(&face_->info, point, scale, scale, shift, 0, &x0, &y0, &x1, &y1);
    const int w = x1 - x0, h = y1 - y0;
    if (w > 0 && h > 0) {
      bitmap.assign(static_cast<std::size_t>(w) * h, 0);
      stbtt_MakeCodepointBitmapSubpixel(&face_->info, bitmap.data(), w, h, w, scale, scale, shift, 0, point);
      for (int v = 0; v < h; ++v)
        for (int u = 0; u < w; ++u)
          if (const std::uint8_t coverage = bitmap[static_cast<std::size_t>(v) * w + u])
            pixel(column + x0 + u, row + y0 + v, coverage);
    }
    int advance = 0, bearing = 0;
    stbtt_GetCodepointHMetrics(&face_->info, point, &advance, &bearing);
    x += advance * scale;
    before = point;
  }
}

}  // namespace tendril::render
