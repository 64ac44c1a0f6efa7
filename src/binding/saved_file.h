// What saving a picture or chart gives back.
#pragma once

#include <string>

#include "binding/lua_value.h"

namespace tendril::lua {

/// A file that was written, or not: stopped before the end nothing is written.
struct SavedFile {
  std::string path;
  Status status = Status::solved;
  double seconds = 0;
};

template <> inline constexpr const char* class_name<SavedFile> = "saved_file";

}  // namespace tendril::lua
