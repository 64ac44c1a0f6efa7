#include "shell/module_path.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <vector>

namespace tendril::shell {
namespace {

bool is_folder(const std::string& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode);
}

std::string folder_of_program() {
  char path[4096];
  const ssize_t size = ::readlink("/proc/self/exe", path, sizeof path);
  return size > 0 ? folder_of(std::string(path, static_cast<std::size_t>(size))) : "./";
}

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
  const std::string program = folder_of_program();
  for (const std::string& folder : {program + "../lua", program + "../share/tendril/lua", std::string(TENDRIL_SOURCE_LUA)})
    if (is_folder(folder)) {
      folders.push_back(folder + "/");
      break;
    }
  std::string path;
  for (const std::string& folder : folders) {
    if (folder.find_first_of(";?") != std::string::npos) continue;  // Lua's own separators: no such folder can be named
    path += (path.empty() ? "" : ";") + folder + "?.lua;" + folder + "?/init.lua";
  }
  return path;
}

}  // namespace tendril::shell
