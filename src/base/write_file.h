// Files appear whole or not at all. Both directions keep to what the program may use (base/file_access.h).
#pragma once

#include <string>
#include <string_view>

namespace tendril {

/// Writes `content` beside `path` under a temporary name, then renames it. Missing folders are created. Throws
/// UsageError naming the path and the system's reason; an existing file is then left as it was. Of several processes
/// (base/processes.h) only the first one writes.
void write_file(const std::string& path, std::string_view content);

/// The whole file as bytes; a pipe until its end. Throws UsageError naming the path and the reason, also for folders and devices.
std::string read_file(const std::string& path);

}  // namespace tendril
