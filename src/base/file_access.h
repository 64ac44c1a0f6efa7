// Which files the program may read and write: all that the system lets it, or only those below one folder.
#pragma once

#include <string>
#include <vector>

namespace tendril {

/// From now on files are read only below `folder` and the `readable` folders, and written only below `folder`. It holds for the
/// process, as its working directory does, and cannot be taken back. Throws UsageError when `folder` is no folder.
void confine_files(const std::string& folder, const std::vector<std::string>& readable);

/// The path to open in place of `path`: the same without a confinement, else absolute with its links resolved. Throws
/// UsageError naming the path when it leads out of the confinement: by `..`, as an absolute path or through a symbolic link.
std::string readable_path(const std::string& path);
std::string writable_path(const std::string& path);

/// Whether readable_path() gives a path. Without a confinement always true.
bool may_read(const std::string& path);

}  // namespace tendril
