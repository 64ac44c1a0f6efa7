// The command line, with the flags of the standalone Lua interpreter.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tendril::shell {

/// What happens before the script, in order.
struct Step {
  enum class Kind { execute, require } kind;
  std::string text;  ///< code, or "mod" or "name=mod"
};

struct Arguments {
  enum class Mode { run, help, version_only, annotations, doctor };

  Mode mode = Mode::run;
  std::vector<Step> steps;
  bool version = false;       ///< -v
  bool interactive = false;   ///< -i
  bool ignore_environment = false;  ///< -E
  bool warnings = false;      ///< -W
  int script = 0;             ///< its place in argv; 0: none
  bool script_is_stdin = false;  ///< "-"
  bool has_code = false;      ///< -e was given
  std::optional<std::string> sandbox;  ///< --sandbox: the folder; "": that of the script
  std::optional<std::size_t> memory;   ///< --memory: bytes
  std::optional<double> seconds;       ///< --seconds
};

/// What a script in the sandbox may take unless --memory and --seconds say otherwise.
inline constexpr std::size_t sandbox_memory = 512ull << 20;  ///< bytes
inline constexpr double sandbox_seconds = 60;

/// Throws UsageError that names the wrong option.
Arguments parse_arguments(int argc, const char* const* argv);

/// The text of --help.
std::string usage();

}  // namespace tendril::shell
