// MPI behind base/processes.h: begun by the first call, ended with the process.
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

void begin() {
  int running = 0;
  MPI_Initialized(&running);
  if (running) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  std::atexit([] {
    int ended = 0;
    MPI_Finalized(&ended);
    if (!ended) MPI_Finalize();
  });
}

}  // namespace

/// Hands every process's bytes to `take`, by rank. MPI counts in int: longer messages go in pieces.
extern "C" void tendril_gather(const char* bytes, std::size_t size, void (*take)(void*, int, const char*, std::size_t), void* into) {
  begin();
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  std::vector<unsigned long long> sizes(count);
  const unsigned long long own = size;
  MPI_Allgather(&own, 1, MPI_UNSIGNED_LONG_LONG, sizes.data(), 1, MPI_UNSIGNED_LONG_LONG, MPI_COMM_WORLD);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  constexpr unsigned long long most = 1ull << 30;
  for (int from = 0; from < count; ++from) {
    std::vector<char> message(sizes[from]);
    if (from == rank) message.assign(bytes, bytes + size);
    for (unsigned long long at = 0; at < sizes[from]; at += most)
      MPI_Bcast(message.data() + at, static_cast<int>(std::min(most, sizes[from] - at)), MPI_CHAR, from, MPI_COMM_WORLD);
    take(into, from, message.data(), message.size());
  }
}

/// Needs no MPI_Init: safe in a process that no launcher started.
extern "C" const char* tendril_module_about() {
  static char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int size = 0;
  MPI_Get_library_version(text, &size);
  if (char* rest = std::strpbrk(text, ",\n")) *rest = '\0';  // who built it, when and from what
  return text;
}
