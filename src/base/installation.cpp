#include "base/installation.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

namespace fs = std::filesystem;

namespace tendril {
namespace {

struct Place {
  const char* variable;   ///< of the environment; null: none
  const char* built;      ///< from the program's folder
  const char* installed;  ///< the same
};

Place place_of(Part part) {
  switch (part) {
    case Part::modules: return {"TENDRIL_MODULES", "modules", "../lib/tendril"};
    case Part::assets: return {"TENDRIL_ASSETS", "assets", "../share/tendril/assets"};
    case Part::lua: return {nullptr, "lua", "../share/tendril/lua"};
  }
  return {nullptr, "", ""};
}

std::vector<std::string> candidates(Part part) {
  const Place place = place_of(part);
  const char* named = place.variable ? std::getenv(place.variable) : nullptr;
  if (named && *named) return {named};
  const fs::path program = program_folder();
  if (program.empty()) return {};
  return {(program / place.built).lexically_normal().string(), (program / place.installed).lexically_normal().string()};
}

}  // namespace

std::string program_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? "" : program.parent_path().string();
}

std::string part_folder(Part part) {
  const std::vector<std::string> folders = candidates(part);
  if (folders.size() == 1) return folders.front();
  std::error_code error;
  for (const std::string& folder : folders)
    if (fs::is_directory(folder, error)) return folder;
  return {};
}

std::string part_places(Part part, const std::string& file) {
  std::string text;
  for (const std::string& folder : candidates(part)) text += (text.empty() ? "'" : " or '") + (fs::path(folder) / file).string() + "'";
  return text.empty() ? "'" + file + "' in the program's own folder" : text;
}

}  // namespace tendril
