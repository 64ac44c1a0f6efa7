#include "geometry/read_vrml.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <unordered_map>

#include <Eigen/LU>

#include "base/file_access.h"
#include "base/write_file.h"
#include "geometry/mesh_file.h"
#include "geometry/read_vrml_faces.h"
#include "geometry/read_vrml_nodes.h"

namespace tendril {

namespace {

constexpr int deepest_inline = 16;
constexpr std::size_t least_limit = 4'000'000;

void check_header(std::string_view content, const std::string& name) {
  if (content.substr(0, 2) == "\x1f\x8b")
    fail_mesh(name, "it is compressed with gzip; unpack it first: gunzip < packed > unpacked");
  if (content.substr(0, 3) == "\xef\xbb\xbf") content.remove_prefix(3);
  if (content.substr(0, 10) == "#VRML V1.0")
    fail_mesh(name, "it is in VRML 1.0, which is not read; export it as VRML97, also called VRML 2.0");
  if (content.substr(0, 10) != "#VRML V2.0")
    fail_mesh(name, "not a VRML97 file: it does not begin with '#VRML V2.0 utf8'");
}

std::string text(int count, const std::string& what) { return std::to_string(count) + " " + what; }

class VrmlReader {
 public:
  VrmlReader(const RunContext& context) : context_(context) {}

  Mesh read(std::string_view content, const std::string& path) {
    const int root = add_file(content, path, -1);
    std::vector<Visit> left{{root, {}}};
    for (std::size_t visits = 0; !left.empty(); ++visits) {
      if (visits % 1024 == 0 && context_.stop()) break;
      if (visits + left.size() > limit_) too_large(path);
      const Visit visit = left.back();
      left.pop_back();
      const VrmlNode& node = data_.nodes[visit.node];
      if (node.kind == VrmlKind::surface) add_surface(data_.surfaces[node.data], visit.place, path);
      else if (node.kind == VrmlKind::unread) ++unread_[data_.names[node.data]];
      else if (node.kind == VrmlKind::inlined) follow(data_.links[node.data], visit.place, left);
      else push_children(node, visit.place, left);
    }
    return std::move(mesh_);
  }

  std::string left_out() const {
    std::vector<std::string> parts;
    for (const auto& [name, count] : unread_) parts.push_back(text(count, name));
    if (network_ > 0) parts.push_back(text(network_, "Inline of a network address"));
    if (data_.short_polygons > 0) parts.push_back(text(data_.short_polygons, "faces of fewer than three corners"));
    if (data_.animated) parts.push_back("its animation");
    std::string said;
    for (const std::string& part : parts) said += (said.empty() ? "left out: " : ", ") + part;
    return said;
  }

 private:
  struct Visit {
    int node;
    VrmlPlace place;
  };
  struct File {
    std::string path;
    int from;  ///< index of the file that first led here, -1 for the first file
  };

  [[noreturn]] void too_large(const std::string& path) {
    fail_mesh(path, "with all that USE and Inline repeat it is larger than " + std::to_string(limit_) +
                        " triangles, vertices or nodes");
  }

  int add_file(std::string_view content, const std::string& path, int from) {
    check_header(content, path);
    files_.push_back({path, from});
    // A file that repeats nothing stays below a limit of its bytes: each triangle takes six at least.
    bytes_ += content.size();
    limit_ = std::max(least_limit, bytes_);
    return parse_vrml_nodes(content, path, static_cast<int>(files_.size()) - 1, data_);
  }

  void push_children(const VrmlNode& node, const VrmlPlace& outside, std::vector<Visit>& left) {
    const auto& children = node.children;
    if (node.kind == VrmlKind::nothing || node.kind == VrmlKind::points) return;
    VrmlPlace place = outside;
    if (node.kind == VrmlKind::transform) {
      const VrmlPlace& own = data_.places[node.data];
      place = {outside.linear * own.linear, outside.linear * own.offset + outside.offset};
    }
    const int count = static_cast<int>(children.size());
    if (node.kind == VrmlKind::chosen || node.kind == VrmlKind::finest || node.kind == VrmlKind::shape) {
      const int choice = node.kind == VrmlKind::chosen ? node.data : 0;
      if (choice >= 0 && choice < count) left.push_back({children[choice], place});
      return;
    }
    for (int i = count; i-- > 0;) left.push_back({children[i], place});
  }

  void add_surface(const Mesh& surface, const VrmlPlace& place, const std::string& path) {
    if (mesh_.triangles.size() + surface.triangles.size() > limit_ || mesh_.vertices.size() + surface.vertices.size() > limit_)
      too_large(path);
    const int first = static_cast<int>(mesh_.vertices.size());
    for (const Vec3& v : surface.vertices) mesh_.vertices.push_back(place.linear * v + place.offset);
    const bool mirrored = place.linear.determinant() < 0;
    for (const auto& [a, b, c] : surface.triangles)
      mesh_.triangles.push_back({first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
  }

  void follow(const VrmlLink link, const VrmlPlace& place, std::vector<Visit>& left) {
    const std::string from = files_[link.file].path;
    const std::string where = "line " + std::to_string(link.line) + ": Inline ";
    std::string missing;
    bool network = false;
    for (const std::string& address : link.addresses) {
      if (address.find("://") != address.npos && address.substr(0, 7) != "file://") {
        network = true;
        continue;
      }
      const std::filesystem::path name = address.substr(0, 7) == "file://" ? address.substr(7) : address;
      const std::string path = (std::filesystem::path(from).parent_path() / name).lexically_normal().string();
      std::error_code error;
      readable_path(path);  // before anything is told about a file
      if (!std::filesystem::is_regular_file(path, error)) {
        if (missing.empty()) missing = path;
        continue;
      }
      left.push_back({root_of(path, link, where), place});
      return;
    }
    if (!missing.empty()) fail_mesh(from, where + "of '" + missing + "': there is no such file");
    if (network) ++network_;
  }

  /// The node that holds a file, which is read when it is first met.
  int root_of(const std::string& path, const VrmlLink& link, const std::string& where) {
    std::error_code error;
    const std::filesystem::path canonical = std::filesystem::canonical(path, error);
    const std::string key = error ? path : canonical.string();
    // Files are met depth first, so that a loop always leads to one of those through which this file was first met.
    int depth = 0;
    for (int file = link.file; file >= 0; file = files_[file].from, ++depth) {
      const std::filesystem::path other = std::filesystem::canonical(files_[file].path, error);
      if ((error ? files_[file].path : other.string()) == key)
        fail_mesh(files_[link.file].path, where + "of '" + path + "' leads back to where it comes from");
    }
    if (depth > deepest_inline)
      fail_mesh(files_[link.file].path, where + "more than " + std::to_string(deepest_inline) + " deep");
    const auto known = roots_.find(key);
    if (known != roots_.end()) return known->second;
    const int root = add_file(read_file(path), path, link.file);
    roots_[key] = root;
    return root;
  }

  const RunContext& context_;
  VrmlNodes data_;
  std::vector<File> files_;
  std::unordered_map<std::string, int> roots_;  ///< by canonical path
  std::map<std::string, int> unread_;           ///< how often what is not read is drawn, by type
  int network_ = 0;
  std::size_t bytes_ = 0, limit_ = least_limit;
  Mesh mesh_;
};

}  // namespace

Mesh parse_vrml(std::string_view content, const std::string& path, const RunContext& context, std::string& left_out) {
  VrmlReader reader(context);
  Mesh mesh = reader.read(content, path);
  left_out = reader.left_out();
  return mesh;
}

}  // namespace tendril
