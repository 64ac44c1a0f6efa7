#include "view/render_module.h"

#include "base/load_module.h"

namespace tendril {

RenderPicture render_module() {
  // Loaded once and kept; a failed attempt is made again by the next call.
  static const auto entry = reinterpret_cast<RenderPicture>(module_entry("picture", "tendril_render.so", render_entry));
  return entry;
}

RenderSixels sixel_module() {
  static const auto entry = reinterpret_cast<RenderSixels>(module_entry("picture", "tendril_render.so", sixel_entry));
  return entry;
}

}  // namespace tendril
