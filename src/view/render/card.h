// The card and the colour bar of a sheet.
#pragma once

#include "view/colour_map.h"
#include "view/render/canvas.h"

namespace tendril::render {

/// Title and rows, as large as the cell allows; rows that do not fit are counted in the last line. `scale`: 1 for a
/// cell of 800 x 600 pixels.
void draw_card(Canvas& canvas, const Rect& cell, double scale, const PictureCard& card);

/// Height of a colour bar with its name and numbers, pixels.
double colour_bar_height(double scale);

/// Name and unit, the limit's mark, the bar, five round numbers.
void draw_colour_bar(Canvas& canvas, const Rect& place, double scale, const ColourScale& wanted,
                     const ColourRange& range);

}  // namespace tendril::render
