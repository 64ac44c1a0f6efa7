// Text as coverage, from the DejaVu fonts.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::render {

class Font {
 public:
  /// "DejaVuSans.ttf" or another file of the folder that the environment's TENDRIL_FONTS names, else of
  /// /usr/share/fonts/truetype/dejavu. Throws UsageError naming the package when it is missing or no font.
  explicit Font(const std::string& file);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  double width(std::string_view utf8, double size) const;  ///< pixels
  double ascent(double size) const;                        ///< pixels from the baseline to the top of capitals

  /// Calls `pixel(x, y, coverage 0 ... 255)` for every touched pixel of the text that starts at (x, baseline).
  void draw(std::string_view utf8, double size, double x, double baseline,
            const std::function<void(int x, int y, std::uint8_t coverage)>& pixel) const;

 private:
  struct Face;
  std::unique_ptr<Face> face_;
};

/// The code points of UTF-8 text; a byte that makes no sense becomes U+FFFD, control characters a space.
std::vector<int> code_points(std::string_view utf8);

}  // namespace tendril::render
