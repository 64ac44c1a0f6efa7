#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>

#include "base/write_file.h"
#include "view/picture.h"
#include "view/render_module.h"

namespace tendril {
namespace {

bool ends_in_png(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png";
}

}  // namespace

std::string picture_png(const Picture& picture, const RunContext& context, PictureReport* report) {
  const auto start = RunContext::Clock::now();
  check_picture(picture);
  PictureReport own;
  PictureReport& said = report ? *report : own;
  said = {};
  std::string png, error;
  if (!render_module()(picture, context, said, png, error)) throw UsageError("picture: " + error);
  said.seconds = std::chrono::duration<double>(RunContext::Clock::now() - start).count();
  return png;
}

PictureReport save_picture(const Picture& picture, const std::string& path, const RunContext& context) {
  const auto start = RunContext::Clock::now();
  if (!ends_in_png(path)) throw UsageError("picture: cannot write '" + path + "': expected a name that ends in .png");
  PictureReport report;
  const std::string png = picture_png(picture, context, &report);
  if (report.status == Status::solved) write_file(path, png);
  report.seconds = std::chrono::duration<double>(RunContext::Clock::now() - start).count();
  return report;
}

}  // namespace tendril
