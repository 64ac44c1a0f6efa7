// Where targets that may open or write files do so: an empty folder that the process is confined to.
#pragma once

#include <unistd.h>

#include <filesystem>

#include "base/file_access.h"

namespace tendril::fuzz {

class EmptyFolder {
 public:
  EmptyFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tendril-fuzz-XXXXXX").string();
    if (!::mkdtemp(name.data())) std::abort();
    path_ = name;
    std::filesystem::current_path(path_);
    confine_files(path_.string(), {});
  }
  ~EmptyFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  EmptyFolder(const EmptyFolder&) = delete;
  EmptyFolder& operator=(const EmptyFolder&) = delete;

  /// Once for the process.
  static void enter() { static const EmptyFolder folder; }

 private:
  std::filesystem::path path_;
};

}  // namespace tendril::fuzz
