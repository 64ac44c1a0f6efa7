// What is written over a drawn view: its name, the axes, a scale bar, notes with leader lines.
#pragma once

#include "view/render/canvas.h"
#include "view/view_camera.h"

namespace tendril::render {

/// `drawn`: the view's own image, whose fourth channel says where tubes are, so that notes keep off them. `taken`:
/// rectangles of the canvas that notes must leave free.
void draw_overlay(Canvas& canvas, const Rect& cell, double scale, const std::string& view, const ViewCamera& camera,
                  const Image& drawn, const Picture& picture, std::vector<Rect> taken);

}  // namespace tendril::render
