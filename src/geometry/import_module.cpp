// Loads the assimp module when a file first needs it, so that no one else pays for assimp.
#include "base/file_access.h"
#include "base/load_module.h"
#include "geometry/mesh_file.h"

namespace tendril {

Mesh import_by_module(const std::string& path, const RunContext& context) {
  // Loaded once and kept; a failed attempt is made again by the next call.
  static auto* const import =
      reinterpret_cast<ImportMeshFunction*>(module_entry("mesh import", "tendril_import.so", "tendril_import_mesh"));
  Mesh mesh;
  std::string error;
  if (!import(path.c_str(), may_read, context, mesh, error)) fail_mesh(path, error);
  return mesh;
}

}  // namespace tendril
