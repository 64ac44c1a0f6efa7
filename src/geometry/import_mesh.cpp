#include "geometry/import_mesh.h"

#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "base/file_access.h"
#include "base/printable.h"
#include "base/write_file.h"
#include "geometry/mesh_file.h"
#include "geometry/read_vrml.h"

namespace tendril {

namespace {

std::string suffix_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix;
}

// What a file begins like, where that is certain; else an empty string.
std::string kind_of(std::string_view content) {
  const auto begins = [&](std::string_view sign) { return content.substr(0, sign.size()) == sign; };
  if (begins("glTF")) return ".glb";
  if (begins("PK\x03\x04")) return ".3mf";
  if (begins("ply\n") || begins("ply\r")) return ".ply";
  if (content.substr(0, 4096).find("<COLLADA") != content.npos) return ".dae";
  if (content.substr(0, 4096).find("<X3D") != content.npos) return ".x3d";
  if (begins("\x89PNG")) return "PNG picture";
  if (begins("\xff\xd8\xff")) return "JPEG picture";
  if (begins("#VRML")) return ".wrl";
  if (begins("ISO-10303-21")) return "STEP";
  if (begins("\x7f" "ELF")) return "program";
  if (begins("%PDF")) return "PDF";
  if (begins("Kaydara FBX")) return "FBX";
  return "";
}

void check_kind(const std::string& path, const std::string& suffix, std::string_view content) {
  const std::string kind = kind_of(content);
  const bool text = suffix == ".obj" || suffix == ".gltf" || suffix == ".dae" || suffix == ".wrl" || suffix == ".x3d";
  if (!kind.empty() && kind != suffix)
    fail_mesh(path, "the file is of another kind than its name says: it begins like a " + kind + " file");
  if (kind.empty() && (suffix == ".glb" || suffix == ".3mf" || suffix == ".dae" || suffix == ".x3d"))
    fail_mesh(path, "truncated or not a " + suffix + " file: it does not begin like one");
  if (text && content.substr(0, 4096).find('\0') != content.npos)
    fail_mesh(path, "not a " + suffix + " file: it holds binary data");
  if (suffix == ".glb" && content.size() >= 12) {
    std::uint32_t announced;
    std::memcpy(&announced, content.data() + 8, sizeof announced);
    if (content.size() < announced)
      fail_mesh(path, "truncated: " + std::to_string(content.size()) + " of " + std::to_string(announced) + " bytes");
  }
}

Mesh parsed(const std::string& path, const std::string& suffix, const RunContext& context, std::string& left_out) {
  const std::string content = read_file(path);
  if (content.find_first_not_of(" \t\r\n") == content.npos) fail_mesh(path, "the file is empty");
  if (content.substr(0, 2) == "\x1f\x8b") fail_mesh(path, "it is compressed with gzip; unpack it first: gunzip < packed > unpacked");
  check_kind(path, suffix, content);
  if (context.stop()) return {};
  if (suffix == ".obj") return parse_obj(content, path);
  if (suffix == ".stl") return parse_stl(content, path);
  if (suffix == ".ply") return parse_ply(content, path);
  if (suffix == ".wrl") return parse_vrml(content, path, context, left_out);
  return import_by_module(path, context);
}

// The message of read_file names the path and the reason, but not what the file was wanted for.
void check_readable(const std::string& path) {
  std::error_code error;
  if (path.empty()) fail_mesh(path, "no file name was given");
  readable_path(path);  // before anything is told about a file
  if (std::filesystem::is_directory(path, error)) fail_mesh(path, "it is a folder, not a file");
  if (!std::filesystem::exists(path, error)) fail_mesh(path, "there is no such file");
  if (!std::filesystem::is_regular_file(path, error)) fail_mesh(path, "it is not a regular file");
}

}  // namespace

void fail_mesh(const std::string& name, const std::string& why) { throw UsageError("mesh '" + name + "': " + printable(why)); }

const std::vector<std::string>& mesh_suffixes() {
  static const std::vector<std::string> suffixes = {".obj", ".stl", ".ply", ".gltf", ".glb", ".dae", ".3mf", ".wrl", ".vrml", ".x3d"};
  return suffixes;
}

std::string unlikely_size(double diagonal, double unit) {
  if (diagonal >= 1e-3 && diagonal <= 1e3) return "";
  const double in_file = diagonal / unit;
  std::ostringstream said;
  said.precision(3);
  said << "it is " << diagonal << " m across, which is unlikely";
  constexpr std::pair<const char*, double> units[] = {{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}, {"um", 1e-6}};
  for (const auto& [name, metres] : units) {
    if (in_file * metres < 0.02 || in_file * metres > 50) continue;
    said << "; if the file's unit is " << name << ", it is " << in_file * metres << " m";
    break;
  }
  return said.str();
}

LoadedMesh load_mesh(const std::string& path, double unit, const RunContext& context) {
  if (!(std::isfinite(unit) && unit > 0)) {
    std::ostringstream said;
    said << "the unit is " << unit << "; the metres in one unit of the file expected, such as 0.001 for mm";
    fail_mesh(path, said.str());
  }
  check_readable(path);
  const std::string suffix = suffix_of(path);
  std::string read, left_out;
  bool known = false;
  for (const std::string& other : mesh_suffixes()) {
    known |= suffix == other;
    read += (read.empty() ? "" : ", ") + other;
  }
  if (!known)
    fail_mesh(path, (suffix.empty() ? "a name without a suffix" : "files of the suffix '" + suffix + "' are not read") +
                        "; what is read: " + read);

  LoadedMesh loaded;
  Mesh raw = parsed(path, suffix == ".vrml" ? ".wrl" : suffix, context, left_out);
  if (const auto stop = context.stop()) {
    loaded.status = *stop;
    return loaded;
  }
  raw.name = path;
  if (raw.triangles.empty() && !left_out.empty()) fail_mesh(path, "no triangles; " + left_out);
  for (Vec3& v : raw.vertices) v *= unit;
  raw.check();
  loaded.triangles_in_file = static_cast<int>(raw.triangles.size());
  Welded clean = welded(raw, weld_tolerance(raw));
  loaded.degenerate_triangles = clean.degenerate_triangles;
  loaded.repeated_triangles = clean.repeated_triangles;
  loaded.mesh = std::move(clean.mesh);
  if (loaded.mesh.triangles.empty()) fail_mesh(path, "all of its triangles are degenerate");
  const double diagonal = loaded.mesh.box().diagonal().norm();
  const std::string why = unlikely_size(diagonal, unit);
  if (!why.empty() || !left_out.empty())
    loaded.warning = "mesh '" + path + "': " + left_out + (why.empty() || left_out.empty() ? "" : "; ") + why;
  return loaded;
}

}  // namespace tendril
