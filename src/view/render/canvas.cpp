#include "view/render/canvas.h"

#include <algorithm>
#include <cmath>

#include "view/render/view_painter.h"

namespace tendril::render {
namespace {

/// Distance to a rounded box, negative inside.
double box_distance(const Rect& r, double round, double x, double y) {
  const double dx = std::abs(x - r.x - 0.5 * r.width) - 0.5 * r.width + round;
  const double dy = std::abs(y - r.y - 0.5 * r.height) - 0.5 * r.height + round;
  return std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0) - round;
}

double covered(double distance) { return std::clamp(0.5 - distance, 0.0, 1.0); }

}  // namespace

void Canvas::clip(const Rect& rect) { clip_ = rect; }
void Canvas::unclip() { clip_ = {0, 0, 1e9, 1e9}; }

void Canvas::blend(int x, int y, const Rgb& colour, double share) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
  if (x < clip_.x || y < clip_.y || x >= clip_.x + clip_.width || y >= clip_.y + clip_.height) return;
  std::uint8_t* pixel = image_.at(x, y);
  const float wanted[3] = {colour.r, colour.g, colour.b};
  for (int k = 0; k < 3; ++k)
    pixel[k] = static_cast<std::uint8_t>(std::lround(pixel[k] + share * (255 * wanted[k] - pixel[k])));
}

template <class Coverage>
void Canvas::shade(const Rect& bounds, const Rgb& colour, double opacity, const Coverage& coverage) {
  const double right = std::min(bounds.x + bounds.width + 1, std::min<double>(image_.width, clip_.x + clip_.width));
  const double bottom = std::min(bounds.y + bounds.height + 1, std::min<double>(image_.height, clip_.y + clip_.height));
  for (int y = static_cast<int>(std::max({0.0, clip_.y, std::floor(bounds.y - 1)})); y < bottom; ++y)
    for (int x = static_cast<int>(std::max({0.0, clip_.x, std::floor(bounds.x - 1)})); x < right; ++x)
      if (const double share = opacity * coverage(x + 0.5, y + 0.5); share > 0) blend(x, y, colour, share);
}

void Canvas::box(const Rect& rect, const Rgb& colour, double opacity, double round) {
  shade(rect, colour, opacity, [&](double x, double y) { return covered(box_distance(rect, round, x, y)); });
}

void Canvas::frame(const Rect& rect, const Rgb& colour, double thickness, double round) {
  shade(rect, colour, 1, [&](double x, double y) {
    const double d = box_distance(rect, round, x, y);
    return covered(d) - covered(d + thickness);
  });
}

void Canvas::line(Point from, Point to, double thickness, const Rgb& colour, double opacity) {
  const double dx = to.x - from.x, dy = to.y - from.y, square = dx * dx + dy * dy;
  const Rect bounds{std::min(from.x, to.x) - thickness, std::min(from.y, to.y) - thickness,
                    std::abs(dx) + 2 * thickness, std::abs(dy) + 2 * thickness};
  shade(bounds, colour, opacity, [&](double x, double y) {
    const double t = square > 0 ? std::clamp(((x - from.x) * dx + (y - from.y) * dy) / square, 0.0, 1.0) : 0;
    return covered(std::hypot(x - from.x - t * dx, y - from.y - t * dy) - 0.5 * thickness);
  });
}

void Canvas::disc(Point centre, double radius, const Rgb& colour, double opacity) {
  shade({centre.x - radius, centre.y - radius, 2 * radius, 2 * radius}, colour, opacity,
        [&](double x, double y) { return covered(std::hypot(x - centre.x, y - centre.y) - radius); });
}

void Canvas::triangle(const std::array<Point, 3>& c, const Rgb& colour) {
  const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [top, bottom] = std::minmax({c[0].y, c[1].y, c[2].y});
  const double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
  if (area == 0) return;
  shade({left, top, right - left, bottom - top}, colour, 1, [&](double x, double y) {
    double outside = -1e9;
    for (int i = 0; i < 3; ++i) {
      const Point &p = c[i], &q = c[(i + 1) % 3];
      const double cross = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
      outside = std::max(outside, (area > 0 ? -cross : cross) / std::hypot(q.x - p.x, q.y - p.y));
    }
    return covered(outside);
  });
}

void Canvas::text(const std::string& utf8, Point at, const Type& type) {
  const Font& font = type.bold ? bold_ : plain_;
  const double width = font.width(utf8, type.size);
  const double x = at.x - (type.align == Align::left ? 0 : type.align == Align::centre ? 0.5 * width : width);
  if (type.halo > 0) {
    const int reach = static_cast<int>(std::ceil(type.halo));
    // The strongest of the letters' coverage within reach, gathered first so that overlapping letters do not add up.
    const int left = static_cast<int>(std::floor(x - type.size)) - reach,
              top = static_cast<int>(at.y - 1.5 * type.size) - reach;
    const int columns = static_cast<int>(width + 2 * type.size) + 2 * reach + 2,
              rows = static_cast<int>(2.2 * type.size) + 2 * reach + 2;
    std::vector<std::uint8_t> strongest(static_cast<std::size_t>(columns) * rows, 0);
    font.draw(utf8, type.size, x, at.y, [&](int px, int py, std::uint8_t coverage) {
      for (int v = -reach; v <= reach; ++v)
        for (int u = -reach; u <= reach; ++u) {
          const double weight = covered(std::hypot(u, v) - type.halo);
          const int cx = px + u - left, cy = py + v - top;
          if (weight <= 0 || cx < 0 || cy < 0 || cx >= columns || cy >= rows) continue;
          std::uint8_t& cell = strongest[static_cast<std::size_t>(cy) * columns + cx];
          cell = std::max(cell, static_cast<std::uint8_t>(weight * coverage));
        }
    });
    for (int cy = 0; cy < rows; ++cy)
      for (int cx = 0; cx < columns; ++cx)
        if (const std::uint8_t cell = strongest[static_cast<std::size_t>(cy) * columns + cx])
          blend(left + cx, top + cy, paper, 0.85 * cell / 255.0);
  }
  font.draw(utf8, type.size, x, at.y,
            [&](int px, int py, std::uint8_t coverage) { blend(px, py, type.colour, coverage / 255.0); });
}

double Canvas::text_width(const std::string& utf8, double size, bool bold) const {
  return (bold ? bold_ : plain_).width(utf8, size);
}

std::string Canvas::fitted(const std::string& utf8, double size, double width, bool bold) const {
  if (text_width(utf8, size, bold) <= width) return utf8;
  std::string cut = utf8.substr(0, 1000);
  while (!cut.empty()) {
    while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xc0) == 0x80) cut.pop_back();
    if (!cut.empty()) cut.pop_back();
    if (text_width(cut + "…", size, bold) <= width) return cut + "…";
  }
  return "";
}

}  // namespace tendril::render
