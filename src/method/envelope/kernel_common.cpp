// The kernel compiled like the rest of the program, and the choice between the kernels.
#define TENDRIL_LANES_NAMESPACE tendril_envelope_common

#include "base/instruction_sets.h"
#include "method/envelope/kernel_loops.h"

namespace tendril::envelope {

extern const Kernel kernel_avx2, kernel_avx512;

namespace {
constexpr Kernel common = tendril_envelope_common::kernel_named("common");
}

const Kernel* kernel_for(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return runs_x86_64_v4() ? &kernel_avx512 : nullptr;
  if (set == InstructionSet::avx2) return runs_x86_64_v3() ? &kernel_avx2 : nullptr;
#endif
  return set == InstructionSet::common ? &common : nullptr;
}

const Kernel& best_kernel() {
  if (const Kernel* kernel = kernel_for(InstructionSet::avx512)) return *kernel;
  if (const Kernel* kernel = kernel_for(InstructionSet::avx2)) return *kernel;
  return common;
}

}  // namespace tendril::envelope
