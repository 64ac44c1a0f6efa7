// How far a long computation is, on the terminal of the messages.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "binding/lua_context.h"

namespace tendril::shell {

/// "8 s", "2 min 5 s", "1 h 12 min": what a person waits for.
std::string duration_text(double seconds);

/// Shows nothing in the first half second; then one line, with the time left, redrawn at most ten times a second and
/// removed at the end. Shows nothing at all where the standard error is no terminal that understands it.
class Progress {
 public:
  explicit Progress(lua::Context& context, bool shown);

 private:
  using Clock = std::chrono::steady_clock;
  void show(double share, const char* what);
  void end();

  std::mutex mutex_;  // computations may report from several threads
  bool running_ = false, drawn_ = false;
  Clock::time_point start_, last_;
};

}  // namespace tendril::shell
