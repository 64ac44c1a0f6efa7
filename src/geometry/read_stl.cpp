// STL, binary and text. Normals and colours are skipped; each triangle brings its own three vertices.

#include <cstdint>
#include <cstring>

#include "geometry/mesh_file.h"
#include "geometry/text_cursor.h"

namespace tendril {

namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

std::uint32_t announced(std::string_view content) {
  std::uint32_t count;
  std::memcpy(&count, content.data() + 80, sizeof count);
  return count;
}

void add_triangle(Mesh& mesh) {
  const int last = static_cast<int>(mesh.vertices.size());
  mesh.triangles.push_back({last - 3, last - 2, last - 1});
}

Mesh parse_binary(std::string_view content, const std::string& name) {
  if (content.size() < header_bytes) fail_mesh(name, "truncated or not an STL file: shorter than the header of one");
  const std::size_t count = announced(content), needed = header_bytes + triangle_bytes * count;
  if (content.size() != needed)
    fail_mesh(name, (content.size() < needed ? "truncated or not an STL file: " : "not an STL file, or damaged: ") +
                        std::to_string(count) + " triangles take " + std::to_string(needed) + " bytes, the file has " +
                        std::to_string(content.size()));
  if (count >= (1u << 28)) fail_mesh(name, "more than 2^28 triangles");
  Mesh mesh;
  mesh.vertices.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    float corners[9];
    std::memcpy(corners, content.data() + header_bytes + t * triangle_bytes + 12, sizeof corners);
    for (int k = 0; k < 9; k += 3) mesh.vertices.emplace_back(corners[k], corners[k + 1], corners[k + 2]);
    add_triangle(mesh);
  }
  return mesh;
}

Mesh parse_text(std::string_view content, const std::string& name) {
  Mesh mesh;
  TextCursor cursor(content);
  bool open = false;  // within a solid that has not ended
  for (; !cursor.done(); cursor.next_line()) {
    const std::string_view word = cursor.word();
    if (word == "solid") open = true;
    if (word == "endsolid") open = false;
    if (word == "endloop" || word == "endfacet") {
      if (mesh.vertices.size() != 3 * (mesh.triangles.size() + (word == "endloop" ? 1 : 0)))
        fail_mesh(name, "line " + std::to_string(cursor.line()) + ": a facet without three vertices");
      if (word == "endloop") add_triangle(mesh);
    }
    if (word != "vertex") continue;
    Vec3 p;
    for (int k = 0; k < 3; ++k)
      if (!cursor.number(p[k]))
        fail_mesh(name, "line " + std::to_string(cursor.line()) + ": a vertex without three numbers; is the file truncated?");
    mesh.vertices.push_back(p);
  }
  if (open || mesh.vertices.size() != 3 * mesh.triangles.size()) fail_mesh(name, "truncated: no 'endsolid' at its end");
  return mesh;
}

}  // namespace

Mesh parse_stl(std::string_view content, const std::string& name) {
  // Some binary files open with "solid" too, but hold what no text does.
  const bool text = content.substr(0, 5) == "solid" && content.substr(0, 1024).find('\0') == content.npos;
  Mesh mesh = text ? parse_text(content, name) : parse_binary(content, name);
  mesh.name = name;
  return mesh;
}

}  // namespace tendril
