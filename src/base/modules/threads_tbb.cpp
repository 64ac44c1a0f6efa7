// The module tendril_threads.so: oneTBB's threads behind one C function.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>

#include <algorithm>
#include <string>

extern "C" void tendril_run_workers(int workers, void (*work)(void* data, int worker), void* data) {
  // Not more threads than the machine has: workers beyond that wait for their turn.
  tbb::task_arena arena(std::min(workers, tbb::this_task_arena::max_concurrency()));
  arena.execute([&] {
    tbb::parallel_for(
        0, workers, [&](int worker) { work(data, worker); }, tbb::simple_partitioner());
  });
}

extern "C" const char* tendril_module_about() {
  static const std::string about = std::string("oneTBB ") + TBB_runtime_version();
  return about.c_str();
}
