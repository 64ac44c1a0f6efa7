#include "view/colour_map.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace tendril {
namespace {

float to_srgb(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

double from_srgb(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

struct Linear {
  double r, g, b;
  bool in_gamut() const { return std::min({r, g, b}) >= 0 && std::max({r, g, b}) <= 1; }
};

Linear from_oklab(double lightness, double a, double b) {
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

/// The colour of a lightness, chroma and hue; the chroma is lowered just until the colour can be shown.
Rgb shown(double lightness, double chroma, double hue) {
  const auto at = [&](double c) { return from_oklab(lightness, c * std::cos(hue), c * std::sin(hue)); };
  double low = 0, high = chroma;
  if (at(high).in_gamut()) low = high;
  for (int i = 0; i < 40 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    (at(middle).in_gamut() ? low : high) = middle;
  }
  const Linear c = at(low);
  return {to_srgb(c.r), to_srgb(c.g), to_srgb(c.b)};
}

template <class OfShare>
ColourTable filled(const OfShare& colour) {
  ColourTable table;
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = colour(static_cast<double>(i) / (table.size() - 1.0));
  return table;
}

Rgb looked_up(const ColourTable& table, double share) {
  const double x = std::clamp(share, 0.0, 1.0) * (table.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), table.size() - 2);
  const float w = static_cast<float>(x - static_cast<double>(i));
  const Rgb &p = table[i], &q = table[i + 1];
  return {p.r + w * (q.r - p.r), p.g + w * (q.g - p.g), p.b + w * (q.b - p.b)};
}

}  // namespace

const ColourTable& magnitude_colours() {
  static const ColourTable table = filled([](double t) {
    const double hue = (285 - 180 * std::pow(t, 1.1)) * units::deg;  // blue-violet, teal, green, yellow
    return shown(0.30 + 0.60 * t, 0.13 + 0.04 * t, hue);
  });
  return table;
}

const ColourTable& diverging_colours() {
  static const ColourTable table = filled([](double t) {
    const double side = std::abs(2 * t - 1);
    const double hue = (t < 0.5 ? 255 : 28) * units::deg;
    return shown(0.92 - 0.47 * side, 0.16 * std::pow(side, 0.8), hue);
  });
  return table;
}

Rgb category_colour(std::size_t index) {
  static constexpr std::array<std::uint32_t, 12> colours{0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0x56B4E9, 0xE69F00,
                                                         0x4D4D4D, 0x004466, 0x803800, 0x005C44, 0x7A4864, 0x8C6000};
  const std::uint32_t c = colours[index % colours.size()];
  return {float(c >> 16 & 255) / 255, float(c >> 8 & 255) / 255, float(c & 255) / 255};
}

double lightness(const Rgb& colour) {
  const double r = from_srgb(colour.r), g = from_srgb(colour.g), b = from_srgb(colour.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

bool ColourRange::breaks(double value) const {
  if (!limit) return false;
  return (broken == LimitSide::below && value < *limit) || (broken == LimitSide::above && value > *limit);
}

Rgb ColourRange::colour(double value) const {
  if (std::isnan(value)) return unknown_colour;
  if (breaks(value)) return broken_colour;
  if (meaning == ColourMeaning::clearance) {
    const double from = limit.value_or(low);  // the light end sits at the limit
    return looked_up(magnitude_colours(), high > from ? 1 - (value - from) / (high - from) : 0);
  }
  const double share = (value - low) / (high - low);
  return looked_up(meaning == ColourMeaning::diverging ? diverging_colours() : magnitude_colours(), share);
}

ColourRange settled_range(const Picture& picture) {
  const ColourScale& scale = picture.scale;
  ColourRange range{scale.meaning, INFINITY, -INFINITY, scale.limit, scale.broken};
  if (scale.meaning == ColourMeaning::clearance && scale.limit) range.broken = LimitSide::below;
  const auto include = [&](const std::vector<double>& values) {
    for (const double value : values)
      if (std::isfinite(value)) {
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
      }
  };
  for (const PictureTube& tube : picture.tubes) include(tube.values);
  for (const PictureSurface& surface : picture.surfaces) include(surface.values);
  if (range.low > range.high) range.low = 0, range.high = 1;
  if (scale.meaning == ColourMeaning::diverging) {
    const double span = std::max(std::abs(range.low), std::abs(range.high));
    range.low = -span, range.high = span;
  }
  if (scale.meaning == ColourMeaning::clearance && scale.limit) {
    range.low = std::min(range.low, *scale.limit);
    range.high = std::max(range.high, *scale.limit);
  }
  if (scale.low) range.low = *scale.low;
  if (scale.high) range.high = *scale.high;
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  if (!(range.high - range.low > 1e-9 * size)) {
    const double half = size > 0 ? 0.05 * size : 0.5;
    const double middle = 0.5 * (range.low + range.high);
    range.low = middle - half, range.high = middle + half;
  }
  return range;
}

}  // namespace tendril
