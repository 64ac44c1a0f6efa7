// Colours of values. The maps are computed, not tabulated by hand: paths through OKLab (B. Ottosson, 2020), a space
// whose lightness follows the eye, so that equal steps of a value look like equal steps. Never a rainbow.
#pragma once

#include <array>

#include "view/picture.h"

namespace tendril {

using ColourTable = std::array<Rgb, 256>;

/// Dark blue over green to light yellow; lightness grows strictly from first to last.
const ColourTable& magnitude_colours();

/// Blue, pale grey in the middle, red; lightness falls on both sides of the middle by the same amounts.
const ColourTable& diverging_colours();

/// Of a value that breaks the limit, and the darker one of its stripes.
inline constexpr Rgb broken_colour{0.86f, 0.12f, 0.13f};
inline constexpr Rgb broken_stripe{0.55f, 0.02f, 0.05f};
/// Of a value that is not known (NaN).
inline constexpr Rgb unknown_colour{0.62f, 0.62f, 0.62f};

/// Of things that are told apart and not compared: Okabe and Ito's eight colours for every kind of colour vision, without yellow
/// (pale on white), then darker relatives; twelve, then again.
Rgb category_colour(std::size_t index);

/// OKLab lightness, 0 black ... 1 white.
double lightness(const Rgb& colour);

/// A scale with its range settled: finite, low < high.
struct ColourRange {
  ColourMeaning meaning = ColourMeaning::magnitude;
  double low = 0, high = 1;
  std::optional<double> limit;
  LimitSide broken = LimitSide::none;

  bool breaks(double value) const;
  /// Of a value; outside low ... high the colour of the nearer end.
  Rgb colour(double value) const;
};

/// The range that `picture.scale` asks for, from the values of its tubes and surfaces where it leaves the ends open. The limit of a
/// clearance scale lies within the range. A range of no width is widened about its value.
ColourRange settled_range(const Picture& picture);

}  // namespace tendril
