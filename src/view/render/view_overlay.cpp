#include "view/render/view_overlay.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "view/render/tube_mesh.h"
#include "view/render/view_painter.h"
#include "view/ticks.h"

namespace tendril::render {
namespace {

constexpr Rgb quiet{0.42f, 0.43f, 0.46f}, alarm{0.78f, 0.08f, 0.10f};

void draw_name(Canvas& canvas, const Rect& cell, double scale, const std::string& view) {
  const double size = 17 * scale, x = cell.x + 16 * scale, y = cell.y + 16 * scale + canvas.capital_height(size);
  canvas.text(view, {x, y}, {size, ink, true, Align::left, 2.5 * scale});
  const std::string seen = view == "front" ? "along +y" : view == "top" ? "along −z" : view == "side" ? "along −x" : "";
  if (!seen.empty())
    canvas.text(seen, {x + canvas.text_width(view, size, true) + 9 * scale, y},
                {13 * scale, quiet, false, Align::left, 2.5 * scale});
}

Rect draw_triad(Canvas& canvas, const Rect& cell, double scale, const ViewCamera& camera) {
  static constexpr Rgb colours[] = {{0.76f, 0.20f, 0.17f}, {0.20f, 0.52f, 0.24f}, {0.16f, 0.34f, 0.74f}};
  const Point o{cell.x + 48 * scale, cell.y + cell.height - 46 * scale};
  const double length = 34 * scale, thick = std::max(2.2 * scale, 1.2);
  // Farther axes first, one seen end-on last.
  const auto rank = [&](int axis) { return std::abs(camera.back[axis]) > 0.99 ? 2.0 : camera.back[axis]; };
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
  for (int axis : order) {
    const double dx = camera.right[axis] * length, dy = -camera.up[axis] * length, flat = std::hypot(dx, dy);
    const Rgb& colour = colours[axis];
    const std::string name(1, "xyz"[axis]);
    if (flat < 0.1 * length) {  // towards the eye (dot) or away from it (cross)
      canvas.disc(o, 6.5 * scale, paper);
      const bool towards = camera.back[axis] > 0;
      canvas.frame({o.x - 6 * scale, o.y - 6 * scale, 12 * scale, 12 * scale}, colour, 1.6 * scale, 6 * scale);
      if (towards) canvas.disc(o, 2.3 * scale, colour);
      else
        for (double side : {-1.0, 1.0})
          canvas.line({o.x - 3.4 * scale, o.y - side * 3.4 * scale}, {o.x + 3.4 * scale, o.y + side * 3.4 * scale},
                      1.4 * scale, colour);
      canvas.text(name, {o.x - 15 * scale, o.y + 15 * scale}, {14 * scale, colour, true, Align::centre, 2 * scale});
      continue;
    }
    const double ux = dx / flat, uy = dy / flat, head = 8 * scale;
    const Point tip{o.x + dx, o.y + dy}, neck{tip.x - head * ux, tip.y - head * uy};
    canvas.line(o, tip, thick + 3 * scale, paper, 0.8);
    canvas.line(o, neck, thick, colour);
    canvas.triangle({tip, Point{neck.x - 0.42 * head * uy, neck.y + 0.42 * head * ux},
                     Point{neck.x + 0.42 * head * uy, neck.y - 0.42 * head * ux}},
                    colour);
    const double beyond = 9 * scale;
    canvas.text(name, {tip.x + beyond * ux, tip.y + beyond * uy + 0.5 * canvas.capital_height(14 * scale)},
                {14 * scale, colour, true, Align::centre, 2 * scale});
  }
  return {cell.x, cell.y + cell.height - 100 * scale, 104 * scale, 100 * scale};
}

/// How much of a rectangle of the canvas is tube, 0 ... 1, by a grid of probes.
double tube_share(const Image& drawn, const Rect& cell, const Rect& box) {
  double sum = 0;
  for (int i = 0; i <= 12; ++i)
    for (int k = 0; k <= 4; ++k) {
      const int x = static_cast<int>(box.x + box.width * i / 12 - cell.x),
                y = static_cast<int>(box.y + box.height * k / 4 - cell.y);
      if (x >= 0 && y >= 0 && x < drawn.width && y < drawn.height) sum += drawn.at(x, y)[3] / 255.0;
    }
  return sum / 65;
}

/// At the bottom right, or further left where a tube passes there.
Rect draw_scale_bar(Canvas& canvas, const Rect& cell, double scale, double metres_per_pixel, const Image& drawn) {
  const double metres = round_length(0.24 * cell.width * metres_per_pixel), pixels = metres / metres_per_pixel;
  const double y = std::round(cell.y + cell.height - 24 * scale);
  double right = 0, least = 2;
  for (double share : {1.0, 0.8, 0.62}) {
    const double end = std::round(cell.x + share * cell.width - 22 * scale);
    const double hidden = tube_share(drawn, cell, {end - pixels, y - 28 * scale, pixels, 40 * scale});
    if (hidden < least) least = hidden, right = end;
  }
  const double left = right - pixels;
  const double thick = std::max(3 * scale, 1.5), tick = 5 * scale;
  canvas.box({left - 2, y - tick - 2, pixels + 4, thick + 2 * tick + 4}, paper, 0.6, 3);
  canvas.box({left, y, pixels, thick}, ink);
  for (double x : {left, right - std::max(1.5 * scale, 1.0)})
    canvas.box({x, y - tick, std::max(1.5 * scale, 1.0), thick + 2 * tick}, ink);
  const double size = 14 * scale;
  canvas.text(length_text(metres), {0.5 * (left + right), y - 8 * scale},
              {size, ink, false, Align::centre, 2.5 * scale});
  return {left - 8 * scale, y - 30 * scale, pixels + 30 * scale, 60 * scale};
}

/// A note and the point it speaks of, both on the page.
struct Note {
  Point at;
  std::string text;
  bool alarm;
};

class Placer {
 public:
  Placer(Canvas& canvas, const Rect& cell, double scale, const Image& drawn, std::vector<Rect> taken)
      : canvas_(canvas), cell_(cell), scale_(scale), drawn_(drawn), taken_(std::move(taken)) {}

  void place(const Note& note) {
    const double size = 14 * scale_;
    const std::string text = canvas_.fitted(note.text, size, 0.6 * cell_.width);
    const double width = canvas_.text_width(text, size) + 14 * scale_, height = 22 * scale_;
    Rect best{};
    double least = 1e300;
    for (double reach : {34.0, 54.0, 80.0, 115.0, 160.0, 220.0})
      for (int turn = 0; turn < 16; ++turn) {
        const double angle = (turn + 0.5) * units::pi / 8, dx = std::cos(angle), dy = std::sin(angle);
        const Rect box{note.at.x + dx * (reach * scale_ + 0.5 * width) - 0.5 * width,
                       note.at.y + dy * (reach * scale_ + 0.5 * height) - 0.5 * height, width, height};
        if (const double cost = cost_of(box, note.at) + reach * 0.5; cost < least) least = cost, best = box;
      }
    const Rgb colour = note.alarm ? alarm : ink;
    const Point end{std::clamp(note.at.x, best.x + 4 * scale_, best.x + width - 4 * scale_),
                    std::clamp(note.at.y, best.y, best.y + height)};
    canvas_.line(note.at, end, 3.4 * scale_, paper, 0.8);
    canvas_.line(note.at, end, std::max(1.3 * scale_, 1.0), colour);
    canvas_.box(best, {1, 1, 1}, 0.93, 3 * scale_);
    canvas_.frame(best, colour, std::max(1.2 * scale_, 1.0), 3 * scale_);
    canvas_.text(text, {best.x + 7 * scale_, best.y + 0.5 * (height + canvas_.capital_height(size))},
                 {size, colour, false});
    taken_.push_back({best.x - 3 * scale_, best.y - 3 * scale_, width + 6 * scale_, height + 6 * scale_});
    leaders_.push_back({note.at, end});
  }

 private:
  double tube_at(double x, double y) const {
    const int px = static_cast<int>(x - cell_.x), py = static_cast<int>(y - cell_.y);
    return px < 0 || py < 0 || px >= drawn_.width || py >= drawn_.height ? 0 : drawn_.at(px, py)[3] / 255.0;
  }

  static bool touches(Point a, Point b, const Rect& box) {
    for (int i = 0; i <= 24; ++i) {
      const double x = a.x + (b.x - a.x) * i / 24, y = a.y + (b.y - a.y) * i / 24;
      if (x >= box.x && x <= box.x + box.width && y >= box.y && y <= box.y + box.height) return true;
    }
    return false;
  }

  double cost_of(const Rect& box, Point from) const {
    double cost = 0;
    const double pad = 8 * scale_;
    if (box.x < cell_.x + pad || box.y < cell_.y + pad || box.x + box.width > cell_.x + cell_.width - pad ||
        box.y + box.height > cell_.y + cell_.height - pad)
      cost += 1e6;
    for (const Rect& other : taken_) cost += box.meets(other) ? 1e4 : 0;
    for (const std::array<Point, 2>& leader : leaders_) cost += touches(leader[0], leader[1], box) ? 3e3 : 0;
    cost += 1300 * tube_share(drawn_, cell_, box);
    const Point end{box.x + 0.5 * box.width, box.y + 0.5 * box.height};
    for (const Rect& other : taken_)
      cost += touches({from.x + 0.3 * (end.x - from.x), from.y + 0.3 * (end.y - from.y)}, end, other) ? 1e3 : 0;
    for (int i = 4; i <= 20; ++i)
      cost += 3 * tube_at(from.x + (end.x - from.x) * i / 20, from.y + (end.y - from.y) * i / 20);
    return cost;
  }

  Canvas& canvas_;
  Rect cell_;
  double scale_;
  const Image& drawn_;
  std::vector<Rect> taken_;
  std::vector<std::array<Point, 2>> leaders_;
};

}  // namespace

void draw_overlay(Canvas& canvas, const Rect& cell, double scale, const std::string& view, const ViewCamera& camera,
                  const Image& drawn, const Picture& picture, std::vector<Rect> taken) {
  canvas.clip(cell);
  draw_name(canvas, cell, scale, view);
  taken.push_back({cell.x, cell.y, 200 * scale, 44 * scale});
  taken.push_back(draw_triad(canvas, cell, scale, camera));
  taken.push_back(draw_scale_bar(canvas, cell, scale, camera.metres_per_pixel, drawn));

  const auto on_page = [&](const Vec3& world) {
    const Vec3 p = camera.project(world);
    return Point{cell.x + p.x(), cell.y + p.y()};
  };
  const auto inside = [&](Point p) {
    return p.x > cell.x && p.y > cell.y && p.x < cell.x + cell.width && p.y < cell.y + cell.height;
  };
  std::vector<Note> notes;
  for (const PictureLabel& label : picture.labels) {
    Point at = on_page(label.at);
    const Rgb colour = label.alarm ? alarm : ink;
    if (label.to) {
      const Point to = on_page(*label.to);
      canvas.line(at, to, std::max(4 * scale, 3.0), paper, 0.9);
      canvas.line(at, to, std::max(1.8 * scale, 1.3), colour);
      for (Point end : {at, to}) canvas.disc(end, std::max(2.4 * scale, 1.5), colour);
      at = {0.5 * (at.x + to.x), 0.5 * (at.y + to.y)};
    } else {
      canvas.disc(at, 4.6 * scale, paper);
      canvas.disc(at, 3.2 * scale, colour);
    }
    if (inside(at)) notes.push_back({at, label.text, label.alarm});
  }
  for (const PictureHold& hold : picture.holds)
    if (const Point at = on_page(hold.frame.at); !hold.label.empty() && inside(at))
      notes.push_back({at, hold.label, false});
  for (const PictureArrow& arrow : picture.arrows) {
    const auto [tail, tip] = arrow_ends(arrow, camera);
    if (const Point at = on_page(arrow.pushes ? tail : tip); !arrow.label.empty() && inside(at))
      notes.push_back({at, arrow.label, false});
  }
  for (const Note& note : notes)
    taken.push_back({note.at.x - 8 * scale, note.at.y - 8 * scale, 16 * scale, 16 * scale});
  constexpr std::size_t most_notes = 40;  // more would hide the picture
  if (notes.size() > most_notes) notes.resize(most_notes);
  Placer placer(canvas, cell, scale, drawn, std::move(taken));
  for (const Note& note : notes)
    if (!note.text.empty()) placer.place(note);
  canvas.unclip();
}

}  // namespace tendril::render
