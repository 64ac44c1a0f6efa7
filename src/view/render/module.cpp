// The drawing module's entry. Exceptions end here: the caller gets words.
#include <png.h>

#include <algorithm>
#include <exception>

#include "view/render/gl.h"
#include "view/render/sheet.h"
#include "view/render_module.h"

extern "C" __attribute__((visibility("default"))) bool tendril_render_picture(const tendril::Picture& picture,
                                                                              const tendril::RunContext& context,
                                                                              tendril::PictureReport& report,
                                                                              std::string& png, std::string& error) {
  try {
    const tendril::render::Image page = tendril::render::draw_sheet(picture, context, report);
    png.clear();
    if (const auto stop = context.stop()) {
      report.status = *stop;
      return true;
    }
    png = tendril::render::png_of(page);
    return true;
  } catch (const std::exception& failure) {
    error = failure.what();
    return false;
  }
}

extern "C" __attribute__((visibility("default"))) bool tendril_render_sixels(const std::string& png, int width, int height,
                                                                             std::string& sixels, std::string& error) {
  try {
    const tendril::RgbImage image = tendril::render::image_of(png);
    sixels = tendril::sixels_of(tendril::shrunk(image, std::min(width, image.width), std::min(height, image.height)));
    return true;
  } catch (const std::exception& failure) {
    error = failure.what();
    return false;
  }
}

/// What draws, by making a context of it.
extern "C" __attribute__((visibility("default"))) const char* tendril_module_about() {
  static std::string about;
  try {
    const tendril::render::Context context;
    about = "OpenGL " + std::string(reinterpret_cast<const char*>(glGetString(GL_VERSION))) + ", " +
            reinterpret_cast<const char*>(glGetString(GL_RENDERER)) + "; libpng " PNG_LIBPNG_VER_STRING;
  } catch (const std::exception& failure) {
    about = std::string("broken: ") + failure.what();
  }
  return about.c_str();
}
