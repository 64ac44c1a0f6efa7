// What a long computation is told by its caller and asks while it runs.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "base/error.h"

namespace tendril {

/// Cancel flag, deadline, seed, threads and progress of one computation. Every loop that can take longer than a
/// millisecond polls `stop()`. Default: never stops, seed 1, all cores.
struct RunContext {
  using Clock = std::chrono::steady_clock;

  const std::atomic<bool>* cancel = nullptr;  ///< set by Ctrl-C; not owned
  std::optional<Clock::time_point> deadline;
  std::uint64_t seed = 1;
  int threads = 0;                                          ///< 0: all
  std::function<void(double share, const char* what)> progress;  ///< share done, 0 ... 1

  /// Status::cancelled or Status::timeout when the computation must end now, else nothing.
  std::optional<Status> stop() const {
    if (cancel && cancel->load(std::memory_order_relaxed)) return Status::cancelled;
    if (deadline && Clock::now() >= *deadline) return Status::timeout;
    return std::nullopt;
  }
};

}  // namespace tendril
