// The readers behind load_mesh: each turns the content of a file into a mesh in the file's own unit.
#pragma once

#include <string>
#include <string_view>

#include "base/run_context.h"
#include "geometry/mesh.h"

namespace tendril {

/// Throws UsageError: "mesh 'name': why".
[[noreturn]] void fail_mesh(const std::string& name, const std::string& why);

/// Indices are within range, vertices may be not finite. Each throws UsageError through fail_mesh.
Mesh parse_obj(std::string_view content, const std::string& name);
Mesh parse_stl(std::string_view content, const std::string& name);
Mesh parse_ply(std::string_view content, const std::string& name);

/// glTF, COLLADA, 3MF and X3D: loads the module tendril_import.so when first called. Nothing when `context` says stop.
Mesh import_by_module(const std::string& path, const RunContext& context);

/// What the module exports under the name `tendril_import_mesh`: fills `mesh`, or `error` and returns false. Polls the
/// context; stopped by it, it returns true with an empty mesh. Other files that the file names are opened where `may_read`
/// says so.
using ImportMeshFunction = bool(const char* path, bool (*may_read)(const std::string& path), const RunContext& context, Mesh& mesh,
                                std::string& error);

/// Cuts a polygon of three or more corners, given by their vertices' indices, into triangles, along its own sides only:
/// ears are cut off, so that hollow corners stay hollow. Appends count - 2 triangles.
void triangulate(const std::vector<Vec3>& vertices, const std::vector<int>& corners,
                 std::vector<std::array<int, 3>>& triangles);
inline constexpr int most_corners = 1000;  ///< of one polygon

}  // namespace tendril
