// The one door between the shell's process and the drawing module.
#pragma once

#include <string>

#include "view/picture.h"

namespace tendril {

/// The name of the module's entry, and its type. It writes the PNG's bytes into `png` and returns true; on failure it
/// returns false and the reason stands in `error`. Stopped by the context: true, `png` empty and the status in
/// `report`. Throws nothing.
inline constexpr const char* render_entry = "tendril_render_picture";
using RenderPicture = bool (*)(const Picture& picture, const RunContext& context, PictureReport& report,
                               std::string& png, std::string& error);

/// The entry of tendril_render.so, loaded on the first call. Throws UsageError when it cannot be
/// loaded.
RenderPicture render_module();

/// A PNG as sixels of at most that size (view/sixel.h): its door in the same module, which has libpng. On failure it returns
/// false and the reason stands in `error`. Throws nothing.
inline constexpr const char* sixel_entry = "tendril_render_sixels";
using RenderSixels = bool (*)(const std::string& png, int width, int height, std::string& sixels, std::string& error);

/// The entry of tendril_render.so; throws as render_module().
RenderSixels sixel_module();

}  // namespace tendril
