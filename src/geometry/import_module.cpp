// Loads the assimp module when a file first needs it, so that no one else pays for assimp.

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "geometry/mesh_file.h"

namespace tendril {

namespace {

constexpr const char* file_name = "tendril_import.so";

std::filesystem::path module_folder() {
  if (const char* named = std::getenv("TENDRIL_MODULES"); named && *named) return named;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error)
    throw UsageError("mesh import: cannot tell where the program lies (" + error.message() +
                     "); set TENDRIL_MODULES to the folder of " + file_name);
  return program.parent_path() / "modules";
}

ImportMeshFunction* import_function() {
  const std::filesystem::path path = module_folder() / file_name;
  void* handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle)
    throw UsageError(std::string("mesh import: the module for glTF, COLLADA and 3MF cannot be loaded: ") + ::dlerror());
  auto* function = reinterpret_cast<ImportMeshFunction*>(::dlsym(handle, "tendril_import_mesh"));
  if (!function) throw UsageError("mesh import: '" + path.string() + "' is not the import module of this program");
  return function;
}

}  // namespace

Mesh import_by_module(const std::string& path, const RunContext& context) {
  // Loaded once and kept; a failed attempt is made again by the next call.
  static ImportMeshFunction* const import = import_function();
  Mesh mesh;
  std::string error;
  if (!import(path.c_str(), context, mesh, error)) fail_mesh(path, error);
  return mesh;
}

}  // namespace tendril
