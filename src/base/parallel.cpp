#include "base/parallel.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

namespace tendril {
namespace {

using RunWorkers = void(int workers, void (*work)(void* data, int worker), void* data);

RunWorkers* load() {
  std::filesystem::path folder;
  if (const char* named = std::getenv("TENDRIL_MODULES"); named && *named) {
    folder = named;
  } else {
    std::error_code error;
    folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "modules";
    if (error) return nullptr;
  }
  void* handle = ::dlopen((folder / "tendril_threads.so").c_str(), RTLD_NOW | RTLD_LOCAL);
  return handle ? reinterpret_cast<RunWorkers*>(::dlsym(handle, "tendril_run_workers")) : nullptr;
}

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
    static RunWorkers* const loaded = load();
    return loaded;
  }() : nullptr;
  if (run)
    run(workers, run_one, &job);
  else
    for (int i = 0; i < workers; ++i) run_one(&job, i);
  if (job.failure) std::rethrow_exception(job.failure);
}

}  // namespace tendril
