#include "robot/package_path.h"

#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/file_access.h"
#include "base/write_file.h"

namespace fs = std::filesystem;

namespace tendril {

namespace {

struct Searched {
  std::vector<fs::path> folders;  ///< where the package may be
  bool named = false;             ///< one of them says that it is the package
};

Searched package_folders(const std::string& package, const fs::path& start) {
  Searched found;
  std::error_code error;
  for (fs::path folder = start; may_read(folder.string()); folder = folder.parent_path()) {
    const fs::path xml = folder / "package.xml";
    if (fs::is_regular_file(xml, error) && package_name(read_file(xml.string())) == package) {
      found.folders.insert(found.folders.begin(), folder);
      found.named = true;
      return found;
    }
    if (folder.filename() == package) found.folders.push_back(folder);
    if (fs::is_directory(folder / package, error)) found.folders.push_back(folder / package);
    if (folder == folder.parent_path()) break;
  }
  return found;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return may_read(path.string()) && fs::is_regular_file(path, error);
}

std::string in_package(const std::string& name, const fs::path& start) {
  const std::string inner = name.substr(std::string("package://").size());
  const auto slash = inner.find('/');
  const std::string package = inner.substr(0, slash);
  if (package.empty() || slash == inner.npos || slash + 1 == inner.size())
    throw UsageError("'" + name + "' names no file, expected package://PACKAGE/PATH");
  const fs::path rest = inner.substr(slash + 1);
  const Searched searched = package_folders(package, start);
  for (const fs::path& folder : searched.folders)
    if (is_file(folder / rest)) return (folder / rest).string();
  // Shorter ends of the path, the longest first.
  const std::vector<fs::path> parts(rest.begin(), rest.end());
  for (std::size_t from = 1; searched.named && from < parts.size(); ++from) {
    fs::path tail = searched.folders.front();
    for (std::size_t i = from; i < parts.size(); ++i) tail /= parts[i];
    if (is_file(tail)) return tail.string();
  }
  if (searched.folders.empty())
    throw UsageError("there is no package '" + package + "' for '" + name + "': looked for a package.xml of that name in '" +
                     start.string() + "' and the folders above it");
  throw UsageError("there is no file '" + rest.string() + "' in the package '" + package + "' (" +
                   searched.folders.front().string() + ")");
}

}  // namespace

std::string package_name(const std::string& package_xml) {
  const auto open = package_xml.find("<name>");
  if (open == package_xml.npos) return "";
  const auto from = open + 6, to = package_xml.find("</name>", from);
  if (to == package_xml.npos) return "";
  const std::string text = package_xml.substr(from, to - from);
  const auto first = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
  return first == text.npos ? "" : text.substr(first, last - first + 1);
}

std::string resolve_mesh_path(const std::string& name, const std::string& file) {
  std::error_code error;
  const fs::path start = fs::absolute(file, error).lexically_normal().parent_path();
  if (name.starts_with("package://")) return in_package(name, start);
  if (name.empty()) throw UsageError("a mesh without a file name");
  fs::path path = name.starts_with("file://") ? name.substr(7) : name;
  if (path.is_relative()) path = start / path;
  if (!is_file(path)) throw UsageError("there is no mesh file '" + path.lexically_normal().string() + "'");
  return path.lexically_normal().string();
}

}  // namespace tendril
