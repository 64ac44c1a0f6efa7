#include "shell/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace tendril::shell {
namespace {

void write_message(const std::string& text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::min(1e9, std::max(0.0, seconds) + 0.5));
  const long minutes = whole / 60, hours = minutes / 60;
  if (hours > 0) return std::to_string(hours) + " h " + std::to_string(minutes % 60) + " min";
  if (minutes > 0) return std::to_string(minutes) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole) + " s";
}

Progress::Progress(lua::Context& context, bool shown) {
  if (!shown) return;
  context.progress = [this](double share, const char* what) { show(share, what); };
  context.computation_ended = [this] { end(); };
}

void Progress::show(double share, const char* what) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (!running_) {
    running_ = true;
    start_ = now;
    last_ = now;
  }
  const double passed = std::chrono::duration<double>(now - start_).count();
  if (passed < 0.5 || (drawn_ && now - last_ < std::chrono::milliseconds(100))) return;
  last_ = now;
  drawn_ = true;
  share = std::clamp(share, 0.0, 1.0);
  std::string line = "\r\033[K" + std::string(what ? what : "");
  if (share > 0) {
    char percent[16];
    std::snprintf(percent, sizeof percent, " %3.0f %%, ", 100 * share);
    line += percent + duration_text(passed * (1 - share) / share) + " left";
  } else {
    line += " " + duration_text(passed);
  }
  write_message(line);
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  if (drawn_) write_message("\r\033[K");
  running_ = drawn_ = false;
}

}  // namespace tendril::shell
