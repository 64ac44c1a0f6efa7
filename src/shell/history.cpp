#include "shell/history.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/write_file.h"

namespace tendril::shell {
namespace {

std::vector<std::string> split_lines(const std::string& content) {
  std::vector<std::string> lines;
  std::size_t from = 0;
  while (from < content.size()) {
    const std::size_t to = std::min(content.find('\n', from), content.size());
    if (to > from) lines.push_back(content.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

}  // namespace

std::string history_path() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state && state[0] == '/') return std::string(state) + "/tendril/history";
  const char* home = std::getenv("HOME");
  return home && *home ? std::string(home) + "/.local/state/tendril/history" : "";
}

History::History(std::string path) : path_(std::move(path)) {
  std::error_code error;
  if (path_.empty() || !std::filesystem::is_regular_file(path_, error)) return;
  try {
    lines_ = split_lines(read_file(path_));
    const bool too_long = lines_.size() >= 2 * most_lines;
    if (lines_.size() > most_lines) lines_.erase(lines_.begin(), lines_.end() - most_lines);
    if (!too_long) return;
    std::string content;
    for (const std::string& line : lines_) content += line + "\n";
    write_file(path_, content);
  } catch (const UsageError& problem) {
    warn(problem.what());
  }
}

void History::add(const std::string& line) {
  if (line.find_first_not_of(" \t") == std::string::npos || line.find('\n') != std::string::npos) return;
  if (!lines_.empty() && lines_.back() == line) return;
  lines_.push_back(line);
  if (path_.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), error);
  const int file = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
  const std::string entry = line + "\n";  // one write: lines of several sessions do not mix
  if (file < 0 || ::write(file, entry.data(), entry.size()) != static_cast<ssize_t>(entry.size()))
    warn("cannot write '" + path_ + "': " + std::strerror(errno));
  if (file >= 0) ::close(file);
}

void History::warn(const std::string& why) {
  if (!warned_) std::fprintf(stderr, "tendril: the history is not kept: %s\n", why.c_str());
  warned_ = true;
}

}  // namespace tendril::shell
