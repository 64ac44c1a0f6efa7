#include "robot/load_robot.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/installation.h"
#include "base/nearest_name.h"
#include "robot/urdf.h"

namespace fs = std::filesystem;

namespace tendril {

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
  std::error_code error;
  const std::string assets = part_folder(Part::assets), file = wanted + "/" + wanted + ".urdf";
  if (!assets.empty() && fs::exists(fs::path(assets) / file, error)) return from((fs::path(assets) / file).string());
  throw UsageError("robot: the files of '" + name + "' are missing (looked for " + part_places(Part::assets, file) +
                   "); build them or set TENDRIL_ASSETS to the folder of '" + wanted + "'");
}

}  // namespace tendril
