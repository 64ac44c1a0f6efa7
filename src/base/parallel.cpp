#include "base/parallel.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

#include "base/load_module.h"

namespace tendril {
namespace {

using RunWorkers = void(int workers, void (*work)(void* data, int worker), void* data);

struct Job {
  const std::function<void(int)>& work;
  std::mutex guard;
  std::exception_ptr failure;
};

void run_one(void* data, int worker) {
  Job& job = *static_cast<Job*>(data);
  try {
    job.work(worker);
  } catch (...) {
    const std::lock_guard lock(job.guard);
    if (!job.failure) job.failure = std::current_exception();
  }
}

}  // namespace

int thread_count(int requested) {
  return requested > 0 ? requested : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void run_workers(int workers, const std::function<void(int worker)>& work) {
  Job job{work, {}, nullptr};
  RunWorkers* const run = workers > 1 ? [] {
    static auto* const loaded = reinterpret_cast<RunWorkers*>(load_module("tendril_threads.so", "tendril_run_workers").address);
    return loaded;
  }() : nullptr;
  if (run)
    run(workers, run_one, &job);
  else
    for (int i = 0; i < workers; ++i) run_one(&job, i);
  if (job.failure) std::rethrow_exception(job.failure);
}

}  // namespace tendril
