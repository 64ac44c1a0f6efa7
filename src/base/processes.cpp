#include "base/processes.h"

#include <algorithm>
#include <cstdlib>

#include "base/load_module.h"

namespace tendril {
namespace {

using Take = void (*)(void* into, int rank, const char* bytes, std::size_t size);
using Gather = void(const char* bytes, std::size_t size, Take take, void* into);

/// What the launcher says, by Open MPI's or MPICH's variable; `otherwise` without a launcher.
int launched(std::initializer_list<const char*> variables, int otherwise) {
  for (const char* name : variables)
    if (const char* text = std::getenv(name); text && *text) return std::atoi(text);
  return otherwise;
}

}  // namespace

int process_count() {
  static const int count = std::max(1, launched({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1));
  return count;
}

int process_rank() {
  static const int rank = process_count() > 1 ? std::max(0, launched({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}, 0)) : 0;
  return rank;
}

std::vector<std::string> gathered(const std::string& mine) {
  if (process_count() == 1) return {mine};
  static auto* const gather = reinterpret_cast<Gather*>(module_entry("several processes", "tendril_processes.so", "tendril_gather"));
  std::vector<std::string> all(process_count());
  const Take take = [](void* into, int rank, const char* bytes, std::size_t size) {
    static_cast<std::vector<std::string>*>(into)->at(rank).assign(bytes, size);
  };
  gather(mine.data(), mine.size(), take, &all);
  return all;
}

}  // namespace tendril
