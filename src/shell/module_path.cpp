#include "shell/module_path.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "base/installation.h"

namespace tendril::shell {
namespace {

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  while (from <= list.size()) {
    const std::size_t to = std::min(list.find(':', from), list.size());
    if (to > from) parts.push_back(list.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

}  // namespace

std::string folder_of(const std::string& script) {
  const auto slash = script.rfind('/');
  return slash == std::string::npos ? "./" : script.substr(0, slash + 1);
}

std::string module_path(const std::string& script_folder, bool with_environment) {
  std::vector<std::string> folders{script_folder};
  const char* wanted = with_environment ? std::getenv("TENDRIL_LUA") : nullptr;
  if (wanted)
    for (const std::string& folder : split(wanted)) folders.push_back(folder + "/");
  if (const std::string own = part_folder(Part::lua); !own.empty()) folders.push_back(own + "/");
  std::string path;
  for (const std::string& folder : folders) {
    if (folder.find_first_of(";?") != std::string::npos) continue;  // Lua's own separators: no such folder can be named
    path += (path.empty() ? "" : ";") + folder + "?.lua;" + folder + "?/init.lua";
  }
  return path;
}

}  // namespace tendril::shell
