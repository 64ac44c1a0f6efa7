// Flat drawing over an image: lines, boxes, text, all with smooth borders. Coordinates in pixels from the top left
// corner.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "view/picture.h"
#include "view/render/font.h"
#include "view/render/image.h"

namespace tendril::render {

struct Point {
  double x, y;
};

struct Rect {
  double x, y, width, height;
  bool meets(const Rect& o) const {
    return x < o.x + o.width && o.x < x + width && y < o.y + o.height && o.y < y + height;
  }
};

enum class Align { left, centre, right };

class Canvas {
 public:
  Canvas(Image& image, const Font& plain, const Font& bold) : image_(image), plain_(plain), bold_(bold) {}

  /// Later drawing is kept within the rectangle.
  void clip(const Rect& rect);
  void unclip();

  void box(const Rect& rect, const Rgb& colour, double opacity = 1, double round = 0);
  void frame(const Rect& rect, const Rgb& colour, double thickness, double round = 0);
  void line(Point from, Point to, double thickness, const Rgb& colour, double opacity = 1);
  void disc(Point centre, double radius, const Rgb& colour, double opacity = 1);
  void triangle(const std::array<Point, 3>& corners, const Rgb& colour);

  struct Type {
    double size = 12;
    Rgb colour;
    bool bold = false;
    Align align = Align::left;
    double halo = 0;  ///< pixels of paper around the letters
  };
  /// `at`: the baseline's left end, middle or right end.
  void text(const std::string& utf8, Point at, const Type& type);
  double text_width(const std::string& utf8, double size, bool bold = false) const;
  double capital_height(double size) const { return plain_.ascent(size); }
  /// The text, or as much of it as fits the width, with an ellipsis.
  std::string fitted(const std::string& utf8, double size, double width, bool bold = false) const;

  Image& image() { return image_; }

 private:
  template <class Coverage>
  void shade(const Rect& bounds, const Rgb& colour, double opacity, const Coverage& coverage);
  void blend(int x, int y, const Rgb& colour, double share);

  Image& image_;
  const Font& plain_;
  const Font& bold_;
  Rect clip_{0, 0, 1e9, 1e9};
};

}  // namespace tendril::render
