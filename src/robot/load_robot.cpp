#include "robot/load_robot.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/nearest_name.h"
#include "robot/urdf.h"

namespace fs = std::filesystem;

namespace tendril {

namespace {

std::vector<fs::path> asset_folders() {
  if (const char* named = std::getenv("TENDRIL_ASSETS"); named && *named) return {named};
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return {};
  return {program / "assets", program / "../share/tendril/assets"};
}

}  // namespace

const std::vector<std::string>& builtin_robots() {
  static const std::vector<std::string> names = {"six_axis"};
  return names;
}

std::shared_ptr<const Robot> load_robot(const std::string& name) {
  constexpr const char* builtin = "builtin:";
  const auto from = [&](const std::string& file) { return std::make_shared<const Robot>(load_urdf(file)->with_source(name)); };
  if (!name.starts_with(builtin)) return from(name);
  const std::string wanted = name.substr(8);
  const auto& known = builtin_robots();
  if (std::find(known.begin(), known.end(), wanted) == known.end())
    throw UsageError("robot: there is no builtin robot " + unknown_name(wanted, "builtin robots", known));
  std::string looked;
  std::error_code error;
  for (const fs::path& folder : asset_folders()) {
    const fs::path file = folder / wanted / (wanted + ".urdf");
    if (fs::exists(file, error)) return from(file.lexically_normal().string());
    looked += (looked.empty() ? "'" : ", '") + file.lexically_normal().string() + "'";
  }
  throw UsageError("robot: the files of '" + name + "' are missing (looked for " +
                   (looked.empty() ? "the program's own folder" : looked) +
                   "); build them or set TENDRIL_ASSETS to the folder of '" + wanted + "'");
}

}  // namespace tendril
