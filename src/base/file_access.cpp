#include "base/file_access.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/error.h"

namespace fs = std::filesystem;

namespace tendril {
namespace {

struct Confinement {
  fs::path folder;
  std::vector<fs::path> readable;  ///< beside the folder
};

/// A confinement that any part of the program could leave by not being handed it would be none.
std::optional<Confinement>& confinement() {
  static std::optional<Confinement> state;
  return state;
}

fs::path resolved(const fs::path& path, std::error_code& error) {
  const fs::path absolute = fs::absolute(path, error);
  if (error) return {};
  fs::path real = fs::weakly_canonical(absolute, error);
  // What is left of links are those that lead nowhere yet: something written through them would come to lie there.
  fs::path part;
  for (const fs::path& name : real) {
    part /= name;
    std::error_code gone;
    if (!error && fs::is_symlink(fs::symlink_status(part, gone))) error = std::make_error_code(std::errc::no_such_file_or_directory);
  }
  return real;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Nothing when the path leads out.
std::optional<std::string> path_within(const std::string& path, bool for_writing) {
  const Confinement& allowed = *confinement();
  if (path.find('\0') != path.npos) return std::nullopt;
  std::error_code error;
  const fs::path real = resolved(path, error);
  if (error) return std::nullopt;
  bool within = is_below(real, allowed.folder);
  for (const fs::path& folder : allowed.readable) within |= !for_writing && is_below(real, folder);
  if (!within) return std::nullopt;
  return real.string();
}

std::string checked(const std::string& path, bool for_writing) {
  if (!confinement() || path.empty()) return path;  // what has no name cannot be opened
  if (auto allowed = path_within(path, for_writing)) return *allowed;
  throw UsageError(std::string("cannot ") + (for_writing ? "write" : "read") + " '" + path + "': outside of '" +
                   confinement()->folder.string() + "', the only folder that is allowed");
}

fs::path canonical_folder(const std::string& folder) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  if (error || !fs::is_directory(real, error)) throw UsageError("'" + folder + "' is no folder to confine files to");
  return real;
}

}  // namespace

void confine_files(const std::string& folder, const std::vector<std::string>& readable) {
  Confinement wanted{canonical_folder(folder), {}};
  std::error_code error;
  for (const std::string& other : readable)
    if (const fs::path real = fs::canonical(other, error); !error) wanted.readable.push_back(real);
  if (confinement()) throw UsageError("files are confined to '" + confinement()->folder.string() + "' already");
  confinement() = std::move(wanted);
}

std::string readable_path(const std::string& path) { return checked(path, false); }
std::string writable_path(const std::string& path) { return checked(path, true); }

bool may_read(const std::string& path) { return !confinement() || path_within(path, false).has_value(); }

}  // namespace tendril
