#include "geometry/mesh_export.h"

#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "base/error.h"
#include "base/write_file.h"

namespace tendril {

namespace {

static_assert(std::endian::native == std::endian::little, "binary files are written in the order of the machine's bytes");

template <class T>
void append(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Number>
void append_text(std::string& out, Number value) {
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
  out.append(digits, end);
}

}  // namespace

std::string stl_of(const Mesh& mesh, double unit) {
  std::string out = "triangles written by tendril";
  out.resize(80, ' ');
  out.reserve(84 + 50 * mesh.triangles.size());
  append(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    const Vec3 corners[3] = {mesh.vertices[t[0]] / unit, mesh.vertices[t[1]] / unit, mesh.vertices[t[2]] / unit};
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
    for (int k = 0; k < 3; ++k) append(out, static_cast<float>(normal[k]));
    for (const Vec3& corner : corners)
      for (int k = 0; k < 3; ++k) append(out, static_cast<float>(corner[k]));
    append(out, std::uint16_t{0});
  }
  return out;
}

std::string ply_of(const Mesh& mesh, double unit) {
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment written by tendril\nelement vertex " +
                    std::to_string(mesh.vertices.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                    std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  out.reserve(out.size() + 24 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) append(out, v[k] / unit);
  for (const auto& t : mesh.triangles) {
    append(out, std::uint8_t{3});
    for (int corner : t) append(out, static_cast<std::int32_t>(corner));
  }
  return out;
}

std::string obj_of(const Mesh& mesh, double unit) {
  std::string out = "# written by tendril\n";
  for (const Vec3& v : mesh.vertices) {
    out += 'v';
    for (int k = 0; k < 3; ++k) out += ' ', append_text(out, v[k] / unit);
    out += '\n';
  }
  for (const auto& t : mesh.triangles) {
    out += 'f';
    for (int corner : t) out += ' ', append_text(out, corner + 1);
    out += '\n';
  }
  return out;
}

void save_mesh(const std::string& path, const Mesh& mesh, double unit) {
  mesh.check();
  if (!(std::isfinite(unit) && unit > 0))
    throw UsageError("mesh '" + path + "': the unit must be a finite number of metres above 0");
  std::string suffix = std::filesystem::path(path).extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (suffix == ".stl") write_file(path, stl_of(mesh, unit));
  else if (suffix == ".ply") write_file(path, ply_of(mesh, unit));
  else if (suffix == ".obj") write_file(path, obj_of(mesh, unit));
  else throw UsageError("mesh '" + path + "': files of the suffix '" + suffix +
                        "' are not written; what is written: .stl, .ply, .obj");
}

}  // namespace tendril
