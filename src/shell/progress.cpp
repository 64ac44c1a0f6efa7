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
  char line[160];
  if (share > 0) {
    const double left = passed * (1 - share) / share;
    std::snprintf(line, sizeof line, "\r\033[K%s %3.0f %%, %.0f s left", what ? what : "", 100 * share, left);
  } else {
    std::snprintf(line, sizeof line, "\r\033[K%s %.0f s", what ? what : "", passed);
  }
  write_message(line);
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  if (drawn_) write_message("\r\033[K");
  running_ = drawn_ = false;
}

}  // namespace tendril::shell
