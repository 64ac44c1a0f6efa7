// The drawing module's entry. Exceptions end here: the caller gets words.
#include <exception>

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
