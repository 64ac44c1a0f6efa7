// The whole page: views and card in cells.
#pragma once

#include "view/render/image.h"
#include "view/render/view_painter.h"

namespace tendril::render {

/// Draws every view and the card. What lies in `report` beforehand stays; the steps' times are added.
Image draw_sheet(const Picture& picture, const RunContext& context, PictureReport& report);

}  // namespace tendril::render
