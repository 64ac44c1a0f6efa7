// The batch solver's inner loop in four lanes, compiled like the rest of the program, and the choice between the kernels.
#include <cstdlib>
#include <string_view>
#include <type_traits>

#include "base/instruction_sets.h"
#include "statics/batch_iteration.h"

namespace tendril {

extern const BatchKernel batch_kernel_avx2, batch_kernel_avx512;

namespace {

constexpr BatchKernel common{"common", 4, iterate_lanes<Pack>, BatchIteration<Pack>::scratch_size};

const BatchKernel* choose() {
  const char* asked = std::getenv("TENDRIL_BATCH");
  const std::string_view name = asked ? asked : "";
  for (const InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::common}) {
    const BatchKernel* kernel = batch_kernel(set);
    if (kernel && (name.empty() || name == kernel->name)) return kernel;
  }
  return &common;
}

}  // namespace

const BatchKernel* batch_kernel(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return runs_x86_64_v4() ? &batch_kernel_avx512 : nullptr;
  if (set == InstructionSet::avx2) return runs_x86_64_v3() ? &batch_kernel_avx2 : nullptr;
#endif
  return set == InstructionSet::common ? &common : nullptr;
}

const BatchKernel& best_batch_kernel() {
  static const BatchKernel* const kernel = choose();
  return *kernel;
}

}  // namespace tendril
