#include "geometry/surface_parts.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/number_text.h"
#include "base/write_file.h"
#include "geometry/glb_scene.h"
#include "geometry/mesh_export.h"

namespace tendril {

namespace {

template <class Number>
void append_text(std::string& out, Number value) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

std::string suffix_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix;
}

/// One word, whatever the name holds.
std::string group_name(const std::string& name) {
  std::string word = name.empty() ? "part" : name;
  for (char& c : word)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  return word;
}

}  // namespace

Mesh joined(const std::vector<SurfacePart>& parts) {
  Mesh all;
  all.name = "scene";
  for (const SurfacePart& part : parts) {
    const int first = static_cast<int>(all.vertices.size());
    for (const Vec3& v : part.mesh->vertices) all.vertices.push_back(part.pose.at + part.pose.rotation * v);
    for (const auto& [a, b, c] : part.mesh->triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

std::string obj_of(const std::vector<SurfacePart>& parts, double unit) {
  std::string out = "# written by tendril\n";
  std::size_t first = 1;
  for (const SurfacePart& part : parts) {
    out += "g " + group_name(part.name) + "\n";
    for (const Vec3& local : part.mesh->vertices) {
      const Vec3 v = part.pose.at + part.pose.rotation * local;
      out += 'v';
      for (int k = 0; k < 3; ++k) out += ' ', append_text(out, v[k] / unit);
      out += '\n';
    }
    for (const auto& t : part.mesh->triangles) {
      out += 'f';
      for (const int corner : t) out += ' ', append_text(out, first + static_cast<std::size_t>(corner));
      out += '\n';
    }
    first += part.mesh->vertices.size();
  }
  return out;
}

void save_surfaces(const std::string& path, const std::vector<SurfacePart>& parts, double unit) {
  if (parts.empty()) throw UsageError("surfaces '" + path + "': there is nothing to write");
  if (!(std::isfinite(unit) && unit > 0))
    throw UsageError("surfaces '" + path + "': the unit is " + number_text(unit) + "; a finite number of metres above 0 expected");
  const std::string suffix = suffix_of(path);
  if (suffix == ".glb" && unit != 1) throw UsageError("surfaces '" + path + "': glTF files are in metres; leave the unit out");
  for (const SurfacePart& part : parts) part.mesh->check();
  if (suffix == ".glb") write_file(path, glb_of(parts));
  else if (suffix == ".obj") write_file(path, obj_of(parts, unit));
  else save_mesh(path, joined(parts), unit);
}

}  // namespace tendril
