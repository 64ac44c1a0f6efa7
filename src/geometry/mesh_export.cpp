#include "geometry/mesh_export.h"

#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/write_file.h"
#include "geometry/glb_file.h"

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

namespace {

/// What glTF calls (x, y, z): its y axis points up.
void append_y_up(std::string& out, const Vec3& v) {
  append(out, static_cast<float>(v.x()));
  append(out, static_cast<float>(v.z()));
  append(out, static_cast<float>(-v.y()));
}

std::string glb_header(const Mesh& mesh) {
  Eigen::AlignedBox3f box;  // of the numbers as the file holds them
  for (const Vec3& v : mesh.vertices) box.extend(Eigen::Vector3f(Vec3(v.x(), v.z(), -v.y()).cast<float>()));
  const auto list = [](const Eigen::Vector3f& v) {
    std::string text = "[";
    for (int k = 0; k < 3; ++k) text += k > 0 ? "," : "", append_text(text, v[k]);
    return text + "]";
  };
  const std::string vertices = std::to_string(mesh.vertices.size()), rows = std::to_string(12 * mesh.vertices.size());
  const std::string corners = std::to_string(3 * mesh.triangles.size()), indices = std::to_string(12 * mesh.triangles.size());
  return R"({"asset":{"version":"2.0","generator":"tendril"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":2,"mode":4}]}],)"
         R"("buffers":[{"byteLength":)" + std::to_string(24 * mesh.vertices.size() + 12 * mesh.triangles.size()) +
         R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" + rows + R"(,"target":34962},)" +
         R"({"buffer":0,"byteOffset":)" + rows + R"(,"byteLength":)" + rows + R"(,"target":34962},)" +
         R"({"buffer":0,"byteOffset":)" + std::to_string(24 * mesh.vertices.size()) + R"(,"byteLength":)" + indices +
         R"(,"target":34963}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" + vertices +
         R"(,"type":"VEC3","min":)" + list(box.min()) + R"(,"max":)" + list(box.max()) +
         R"(},{"bufferView":1,"componentType":5126,"count":)" + vertices +
         R"(,"type":"VEC3"},{"bufferView":2,"componentType":5125,"count":)" + corners + R"(,"type":"SCALAR"}]})";
}

}  // namespace

std::vector<Vec3> smooth_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 area = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    for (const int corner : {a, b, c}) normals[corner] += area;
  }
  for (Vec3& normal : normals) {
    normal.stableNormalize();
    if (!(std::abs(normal.squaredNorm() - 1) < 1e-6)) normal = Vec3::UnitZ();  // of no triangle with a face
  }
  return normals;
}

std::string glb_of(const Mesh& mesh) {
  std::string data;
  data.reserve(24 * mesh.vertices.size() + 12 * mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) append_y_up(data, v);
  for (const Vec3& normal : smooth_normals(mesh)) append_y_up(data, normal);
  for (const auto& t : mesh.triangles)
    for (const int corner : t) append(data, static_cast<std::uint32_t>(corner));
  return glb_file(glb_header(mesh), data, "mesh '" + mesh.name + "'");
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
  else if (suffix == ".glb" && unit != 1) throw UsageError("mesh '" + path + "': glTF files are in metres; leave the unit out");
  else if (suffix == ".glb") write_file(path, glb_of(mesh));
  else throw UsageError("mesh '" + path + "': files of the suffix '" + suffix +
                        "' are not written; what is written: .stl, .ply, .obj, .glb");
}

}  // namespace tendril
