#include "view/render/card.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "view/render/view_painter.h"
#include "view/ticks.h"

namespace tendril::render {
namespace {

constexpr Rgb quiet{0.42f, 0.43f, 0.46f}, rule{0.82f, 0.82f, 0.82f}, alarm{0.78f, 0.08f, 0.10f};

std::string number_text(double value) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace

void draw_card(Canvas& canvas, const Rect& cell, double scale, const PictureCard& card) {
  const double margin = 34 * scale, left = cell.x + margin, width = cell.width - 2 * margin;
  double y = cell.y + 30 * scale;
  if (!card.title.empty()) {
    const double wide = canvas.text_width(card.title.substr(0, 1000), 22 * scale, true);
    const double size = 22 * scale * std::clamp(width / std::max(wide, 1.0), 0.65, 1.0);
    y += canvas.capital_height(size) + 4 * scale;
    canvas.text(canvas.fitted(card.title, size, width, true), {left, y}, {size, ink, true});
    y += 16 * scale;
    canvas.box({left, y, width, std::max(1.5 * scale, 1.0)}, ink);
    y += 6 * scale;
  }
  if (card.rows.empty()) return;
  const double space = cell.y + cell.height - 14 * scale - y;
  const double least = std::max(15 * scale, 10.0);
  const double height = std::clamp(space / static_cast<double>(card.rows.size()), least, std::max(least, 36 * scale));
  const std::size_t fit = std::min(card.rows.size(), static_cast<std::size_t>(std::max(space / height + 1e-9, 1.0)));
  const double size = std::min(0.52 * height, 17 * scale);
  for (std::size_t i = 0; i < fit; ++i) {
    const double baseline = y + 0.5 * (height + canvas.capital_height(size));
    const PictureCard::Row& row = card.rows[i];
    if (i + 1 == fit && fit < card.rows.size()) {
      canvas.text("and " + std::to_string(card.rows.size() - i) + " more", {left, baseline}, {size, quiet});
      break;
    }
    const std::string value = canvas.fitted(row.value, size, 0.62 * width, row.alarm);
    const double room = width - canvas.text_width(value, size, row.alarm) - 12 * scale;
    canvas.text(canvas.fitted(row.label, size, room), {left, baseline}, {size, quiet});
    canvas.text(value, {left + width, baseline}, {size, row.alarm ? alarm : ink, row.alarm, Align::right});
    y += height;
    if (i + 1 < card.rows.size()) canvas.box({left, y, width, std::max(0.75 * scale, 0.75)}, rule);
  }
}

double colour_bar_height(double scale) { return 78 * scale; }

void draw_colour_bar(Canvas& canvas, const Rect& place, double scale, const ColourScale& wanted,
                     const ColourRange& range) {
  const double size = 14 * scale, small = 13 * scale;
  double y = place.y + canvas.capital_height(size);
  const std::string name = wanted.name + (wanted.unit.empty() ? "" : " [" + wanted.unit + "]");
  canvas.text(canvas.fitted(name, size, place.width, true), {place.x, y}, {size, ink, true, Align::left, 2 * scale});
  y += 18 * scale;

  // Whole pixels: no column of the bar is blended with its neighbour.
  const Rect bar{std::round(place.x), std::round(y), std::round(place.width), std::round(16 * scale)};
  const auto at = [&](double value) { return bar.x + bar.width * (value - range.low) / (range.high - range.low); };
  for (int column = 0; column < static_cast<int>(bar.width); ++column) {
    const double value = range.low + (range.high - range.low) * (column + 0.5) / bar.width;
    canvas.box({bar.x + column, bar.y, 1, bar.height}, range.colour(value));
  }
  if (range.limit && range.broken != LimitSide::none) {  // stripes where the limit is broken, slanted as on the tubes
    const double cut = std::clamp(at(*range.limit), bar.x, bar.x + bar.width);
    const double from = range.broken == LimitSide::below ? bar.x : cut,
                 to = range.broken == LimitSide::below ? cut : bar.x + bar.width;
    canvas.clip({from, bar.y, to - from, bar.height});
    for (double x = from - bar.height; x < to; x += 9 * scale)
      canvas.line({x, bar.y + bar.height}, {x + bar.height, bar.y}, 3 * scale, broken_stripe);
    canvas.unclip();
  }
  canvas.frame({bar.x - 0.5, bar.y - 0.5, bar.width + 1, bar.height + 1}, ink, 1);

  const Ticks ticks = round_ticks(range.low, range.high, 5);
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double x = at(ticks.values[i]);
    canvas.line({x, bar.y + bar.height}, {x, bar.y + bar.height + 5 * scale}, 1, ink);
    canvas.text(ticks.labels[i], {x, bar.y + bar.height + 8 * scale + canvas.capital_height(small)},
                {small, ink, false, Align::centre, 2 * scale});
  }
  if (range.limit && *range.limit >= range.low && *range.limit <= range.high) {
    const double x = at(*range.limit), t = 5 * scale;
    canvas.line({x, bar.y - 2}, {x, bar.y + bar.height + 2}, std::max(2 * scale, 1.5), ink);
    canvas.triangle({Point{x - t, bar.y - 2 - 1.4 * t}, Point{x + t, bar.y - 2 - 1.4 * t}, Point{x, bar.y - 1}}, ink);
    const std::string text =
        (range.meaning == ColourMeaning::clearance ? "required " : "limit ") + number_text(*range.limit);
    const double width = canvas.text_width(text, small),
                 name_end = place.x + canvas.text_width(name, size, true) + 10 * scale;
    double middle = std::clamp(x, place.x + 0.5 * width, place.x + place.width - 0.5 * width);
    double baseline = bar.y - 4 - 1.4 * t;
    if (middle - 0.5 * width < name_end) {  // beside the mark, so that it does not run into the name
      middle = std::max(x + t + 3 * scale, name_end) + 0.5 * width;
      baseline = std::min(baseline + 1.2 * t, bar.y - 3.0);
    }
    canvas.text(text, {middle, baseline}, {small, ink, false, Align::centre, 2 * scale});
  }
}

}  // namespace tendril::render
