// Parts of the program that are heavy and rare lie in modules, which load when first used.
#pragma once

#include <string>

namespace tendril {

/// What loading gave: an entry point, or the reason why there is none.
struct ModuleEntry {
  void* address = nullptr;
  std::string path;      ///< of the module
  std::string problem;   ///< empty with an address
};

/// Looks for `file` in the folder of modules (base/installation.h) and for the function `entry` in it. What was loaded once
/// stays loaded. Never throws for a module that cannot be loaded.
ModuleEntry load_module(const char* file, const char* entry);

/// As load_module(); throws UsageError "who: ..." where there is none.
void* module_entry(const char* who, const char* file, const char* entry);

}  // namespace tendril
