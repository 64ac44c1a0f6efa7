// Work for several threads. The library that keeps the threads is loaded when first needed: a program that never asks for
// more than one thread does not pay for it.
#pragma once

#include <functional>

namespace tendril {

/// Number of threads for a request: 0 means all that the machine has.
int thread_count(int requested);

/// Runs work(0) ... work(workers - 1), each once, on up to that many threads, and returns when all are done. The first
/// exception of a worker is thrown again here. Where the library of threads cannot be loaded, the calling thread does it all.
void run_workers(int workers, const std::function<void(int worker)>& work);

}  // namespace tendril
