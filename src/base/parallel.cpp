#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "base/load_module.h"

namespace tendril {
namespace {

using RunWorkers = void(int workers, void (*work)(void* data, int worker), void* data);

/// The library of threads orders what came before the workers, they, and what comes after. The lock and the count say so once more,
/// where the thread sanitizer, which does not see into that library, can see it.
struct Job {
  const std::function<void(int)>& work;
  std::mutex guard{};
  std::exception_ptr failure{};
  std::atomic<int> finished{0};
};

void pass_the_job() {
  static std::mutex handover;
  const std::lock_guard passed(handover);
}

void run_one(void* data, int worker) {
  pass_the_job();
  Job& job = *static_cast<Job*>(data);
  try {
    job.work(worker);
  } catch (...) {
    const std::lock_guard lock(job.guard);
    if (!job.failure) job.failure = std::current_exception();
  }
  job.finished.fetch_add(1, std::memory_order_release);
}

}  // namespace

int thread_count(int requested) {
  return requested > 0 ? requested : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void run_workers(int workers, const std::function<void(int worker)>& work) {
  Job job{work};
  pass_the_job();
  RunWorkers* const run = workers > 1 ? [] {
    static auto* const loaded = reinterpret_cast<RunWorkers*>(load_module("tendril_threads.so", "tendril_run_workers").address);
    return loaded;
  }() : nullptr;
  if (run)
    run(workers, run_one, &job);
  else
    for (int i = 0; i < workers; ++i) run_one(&job, i);
  job.finished.load(std::memory_order_acquire);
  if (job.failure) std::rethrow_exception(job.failure);
}

}  // namespace tendril
