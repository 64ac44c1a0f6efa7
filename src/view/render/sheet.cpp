#include "view/render/sheet.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

#include "view/render/card.h"
#include "view/render/view_overlay.h"

namespace tendril::render {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(PictureReport& report) : report_(report) {}
  void step(const std::string& name) {
    const auto now = RunContext::Clock::now();
    report_.steps.push_back({name, std::chrono::duration<double>(now - since_).count()});
    since_ = now;
  }

 private:
  PictureReport& report_;
  RunContext::Clock::time_point since_ = RunContext::Clock::now();
};

/// Whole-pixel cells in reading order.
std::vector<Rect> cells_in(int columns, int count, int width, int height) {
  const int rows = (count + columns - 1) / columns;
  std::vector<Rect> cells;
  for (int i = 0; i < count; ++i) {
    const int column = i % columns, row = i / columns;
    const int x0 = width * column / columns, x1 = width * (column + 1) / columns;
    const int y0 = height * row / rows, y1 = height * (row + 1) / rows;
    cells.push_back({double(x0), double(y0), double(x1 - x0), double(y1 - y0)});
  }
  return cells;
}

/// One fills the page, two share its longer side, more stand in two columns (or three).
std::vector<Rect> cells_of(int count, int width, int height) {
  const int columns = count == 1 ? 1 : count == 2 ? (width >= height ? 2 : 1) : count <= 4 ? 2 : (width >= height ? 3 : 2);
  return cells_in(columns, count, width, height);
}

bool has_values(const Picture& picture) {
  const auto valued = [](const auto& part) { return !part.values.empty(); };
  return std::any_of(picture.tubes.begin(), picture.tubes.end(), valued) ||
         std::any_of(picture.surfaces.begin(), picture.surfaces.end(), valued);
}

Vec3 middle_of(const std::vector<FitBall>& balls) {
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
  for (const FitBall& ball : balls) low = low.cwiseMin(ball.at), high = high.cwiseMax(ball.at);
  return balls.empty() ? Vec3::Zero() : Vec3(0.5 * (low + high));
}

double scale_of(const Rect& cell) { return std::clamp(std::min(cell.width / 800, cell.height / 600), 0.55, 12.0); }

void paste(const Image& from, const Rect& cell, Image& page) {
  for (int y = 0; y < from.height; ++y)
    std::copy_n(from.at(0, y), static_cast<std::size_t>(from.width) * 4,
                page.at(static_cast<int>(cell.x), static_cast<int>(cell.y) + y));
}

void draw_card_cell(Canvas& canvas, const Rect& cell, const Picture& picture) {
  const double scale = scale_of(cell);
  canvas.box(cell, {1, 1, 1});
  Rect rest = cell;
  if (has_values(picture)) {
    const double height = colour_bar_height(scale), margin = 34 * scale;
    rest.height -= height + 26 * scale;
    draw_colour_bar(canvas, {cell.x + margin, cell.y + rest.height + 8 * scale, cell.width - 2 * margin, height}, scale,
                    picture.scale, settled_range(picture));
  }
  draw_card(canvas, rest, scale, picture.card);
}

/// Without a card the colour bar and the title stand at the top of the first view: what they need there, pixels.
double head_height(const Picture& picture, const Rect& cell) {
  const double scale = scale_of(cell);
  return has_values(picture) ? 26 * scale + colour_bar_height(scale) : picture.card.title.empty() ? 0 : 56 * scale;
}

/// The view fitted below a strip of `head` pixels.
ViewCamera camera_below(double head, const std::string& view, const std::vector<FitBall>& balls, const Rect& cell) {
  ViewCamera camera = fitted_camera(view, balls, cell.width, cell.height - head);
  camera.height = cell.height;
  camera.centre += 0.5 * head * camera.metres_per_pixel * camera.up;
  return camera;
}

std::vector<Rect> draw_bar_in_view(Canvas& canvas, const Rect& cell, const Picture& picture) {
  const double scale = scale_of(cell), width = 0.40 * cell.width, margin = 26 * scale;
  const Rect place{cell.x + cell.width - width - margin, cell.y + 18 * scale, width, colour_bar_height(scale)};
  const Rect pad{place.x - 14 * scale, place.y - 8 * scale, place.width + 28 * scale, place.height};
  canvas.box(pad, paper, 0.86, 6 * scale);
  draw_colour_bar(canvas, place, scale, picture.scale, settled_range(picture));
  return {pad};
}

void draw_title_in_view(Canvas& canvas, const Rect& cell, const std::string& title) {
  const double scale = scale_of(cell), size = 15 * scale;
  canvas.text(canvas.fitted(title, size, 0.5 * cell.width, true), {cell.x + 16 * scale, cell.y + 50 * scale},
              {size, ink, true, Align::left, 2.5 * scale});
}

void draw_hairlines(Canvas& canvas, const std::vector<Rect>& cells) {
  const Rgb hair{0.72f, 0.72f, 0.72f};
  for (const Rect& cell : cells) {
    if (cell.x > 0) canvas.box({cell.x - 0.5, cell.y, 1, cell.height}, hair);
    if (cell.y > 0) canvas.box({cell.x, cell.y - 0.5, cell.width, 1}, hair);
  }
}

/// Each panel as a page of its own, of the size of its cell.
Image draw_panels(const Picture& picture, const RunContext& context, PictureReport& report) {
  const int count = static_cast<int>(picture.panels.size());
  Image page(picture.width, picture.height);
  const Font plain("DejaVuSans.ttf"), bold("DejaVuSans-Bold.ttf");
  Canvas canvas(page, plain, bold);
  canvas.box({0, 0, double(page.width), double(page.height)}, paper);
  const std::vector<Rect> cells = cells_in(picture.columns > 0 ? std::min(picture.columns, count) : count, count, picture.width, picture.height);
  for (int k = 0; k < count && !context.stop(); ++k) {
    Picture panel = picture.panels[k];
    panel.panels.clear();
    panel.width = static_cast<int>(cells[k].width);
    panel.height = static_cast<int>(cells[k].height);
    RunContext own = context;
    if (context.progress)
      own.progress = [&, k](double share, const char* what) { context.progress((k + share) / count, what); };
    paste(draw_sheet(panel, own, report), cells[k], page);
  }
  draw_hairlines(canvas, cells);
  return page;
}

}  // namespace

Image draw_sheet(const Picture& picture, const RunContext& context, PictureReport& report) {
  if (!picture.panels.empty()) return draw_panels(picture, context, report);
  Stopwatch watch(report);
  const Font plain("DejaVuSans.ttf"), bold("DejaVuSans-Bold.ttf");
  const std::vector<FitBall> balls = fit_balls(picture);
  const Vec3 origin = middle_of(balls);
  // The mesh is made ready while OSMesa starts and compiles.
  std::future<PreparedScene> scene =
      std::async(std::launch::async, [&] { return prepare_scene(picture, origin, context); });
  const Context gl;
  watch.step("context");
  PreparedScene prepared = scene.get();
  report.triangles = prepared.triangles, report.edges = prepared.edges, report.left_out = prepared.left_out;
  watch.step("meshes");
  const SceneGeometry surroundings(std::move(prepared));
  ViewPainter painter(picture, surroundings, origin);
  watch.step("upload and shaders");

  Image page(picture.width, picture.height);
  Canvas canvas(page, plain, bold);
  canvas.box({0, 0, double(page.width), double(page.height)}, paper);
  const std::vector<Rect> cells = cells_of(static_cast<int>(picture.views.size()), picture.width, picture.height);
  const bool card_shown = std::find(picture.views.begin(), picture.views.end(), "card") != picture.views.end();
  bool first_view = true;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (context.stop()) return page;
    const std::string& view = picture.views[i];
    if (context.progress) context.progress(static_cast<double>(i) / static_cast<double>(cells.size()), view.c_str());
    if (view == "card") {
      draw_card_cell(canvas, cells[i], picture);
    } else {
      const bool headed = first_view && !card_shown;
      const ViewCamera camera = camera_below(headed ? head_height(picture, cells[i]) : 0, view, balls, cells[i]);
      const Image drawn = painter.paint(camera, context);
      paste(drawn, cells[i], page);
      std::vector<Rect> taken;
      if (headed && has_values(picture)) taken = draw_bar_in_view(canvas, cells[i], picture);
      if (headed && !picture.card.title.empty()) draw_title_in_view(canvas, cells[i], picture.card.title);
      first_view = false;
      draw_overlay(canvas, cells[i], scale_of(cells[i]), view, camera, drawn, picture, taken);
    }
    watch.step(view);
  }
  draw_hairlines(canvas, cells);
  return page;
}

}  // namespace tendril::render
