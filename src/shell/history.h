// The lines of earlier sessions.
#pragma once

#include <string>
#include <vector>

namespace tendril::shell {

/// Where they are kept: $XDG_STATE_HOME/tendril/history or ~/.local/state/tendril/history; "" without a home.
std::string history_path();

/// One line an entry. Several sessions may append to one file at the same time.
class History {
 public:
  static constexpr std::size_t most_lines = 5000;

  /// Reads the file where there is one and shortens it when it has grown to twice the limit.
  explicit History(std::string path);

  const std::vector<std::string>& lines() const { return lines_; }

  /// Adds a line to the file; repeats of the last one and empty ones are left out. A file that cannot be written is told
  /// once, on standard error.
  void add(const std::string& line);

 private:
  void warn(const std::string& why);

  std::string path_;
  std::vector<std::string> lines_;
  bool warned_ = false;
};

}  // namespace tendril::shell
