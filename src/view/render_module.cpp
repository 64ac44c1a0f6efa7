#include "view/render_module.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <mutex>

namespace tendril {
namespace {

std::filesystem::path module_folder() {
  if (const char* named = std::getenv("TENDRIL_MODULES"); named && *named) return named;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error)
    throw UsageError("picture: cannot tell where the program lies (" + error.message() +
                     "); set TENDRIL_MODULES to the folder of tendril_render.so");
  return program.parent_path() / "modules";
}

RenderPicture load() {
  const std::filesystem::path path = module_folder() / "tendril_render.so";
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw UsageError("picture: the drawing module '" + path.string() +
                     "' is missing; build it or set TENDRIL_MODULES to its folder");
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle)
    throw UsageError(std::string("picture: the drawing module cannot be loaded: ") + dlerror() +
                     " (package libosmesa6)");
  void* entry = dlsym(handle, render_entry);
  if (!entry) throw UsageError("picture: '" + path.string() + "' is not the drawing module: it has no " + render_entry);
  return reinterpret_cast<RenderPicture>(entry);
}

}  // namespace

RenderPicture render_module() {
  static std::mutex guard;
  static RenderPicture entry = nullptr;  // the process loads the module once; a failure is tried again
  const std::lock_guard lock(guard);
  if (!entry) entry = load();
  return entry;
}

}  // namespace tendril
