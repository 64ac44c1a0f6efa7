#include "base/load_module.h"

#include <dlfcn.h>

#include <filesystem>

#include "base/error.h"
#include "base/installation.h"

namespace tendril {

ModuleEntry load_module(const char* file, const char* entry) {
  const std::string folder = part_folder(Part::modules);
  std::error_code error;
  ModuleEntry out{nullptr, (std::filesystem::path(folder) / file).string(), {}};
  if (folder.empty() || !std::filesystem::exists(out.path, error)) {
    out.problem = "the module " + (folder.empty() ? part_places(Part::modules, file) : "'" + out.path + "'") +
                  " is missing; build it or set TENDRIL_MODULES to its folder";
    return out;
  }
  void* handle = ::dlopen(out.path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    const char* why = ::dlerror();
    out.problem = "the module '" + out.path + "' cannot be loaded: " + (why ? why : "no reason given");
    return out;
  }
  out.address = ::dlsym(handle, entry);
  if (!out.address) out.problem = "'" + out.path + "' is not a module of this program: it has no " + entry;
  return out;
}

void* module_entry(const char* who, const char* file, const char* entry) {
  const ModuleEntry found = load_module(file, entry);
  if (!found.address) throw UsageError(std::string(who) + ": " + found.problem);
  return found.address;
}

}  // namespace tendril
