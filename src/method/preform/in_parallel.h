// Many independent pieces of work, each with its own result, on the threads that the caller allows.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>

#include "base/parallel.h"
#include "base/run_context.h"

namespace tendril::preform {

/// Runs work(index) for all indices below `count`, until `context` says stop. Progress is reported by the calling thread alone.
template <class Work>
void in_parallel(std::size_t count, const RunContext& context, const char* what, const Work& work) {
  const int workers = static_cast<int>(std::min<std::size_t>(thread_count(context.threads), count));
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<std::size_t> next = 0, done = 0;
  run_workers(workers, [&](int) {
    for (std::size_t index; (index = next++) < count;) {
      if (context.stop()) return;
      work(index);
      const std::size_t now = ++done;
      if (context.progress && std::this_thread::get_id() == caller) context.progress(static_cast<double>(now) / count, what);
    }
  });
}

}  // namespace tendril::preform
