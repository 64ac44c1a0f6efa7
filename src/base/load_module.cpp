#include "base/load_module.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.h"

namespace tendril {

ModuleEntry load_module(const char* file, const char* entry) {
  std::filesystem::path folder;
  std::error_code error;
  if (const char* named = std::getenv("TENDRIL_MODULES"); named && *named) {
    folder = named;
  } else {
    folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "modules";
    if (error)
      return {nullptr, file, "cannot tell where the program lies (" + error.message() + "); set TENDRIL_MODULES to the folder of " + file};
  }
  ModuleEntry out{nullptr, (folder / file).string(), {}};
  if (!std::filesystem::exists(out.path, error)) {
    out.problem = "the module '" + out.path + "' is missing; build it or set TENDRIL_MODULES to its folder";
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
