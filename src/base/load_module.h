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

/// Every module has this entry of type `const char* ()`: the library that it wraps, with its version. What begins with "broken: "
/// says why the library cannot be used.
inline constexpr const char* module_about = "tendril_module_about";

/// As load_module(); throws UsageError "who: ..." where there is none.
void* module_entry(const char* who, const char* file, const char* entry);

}  // namespace tendril
