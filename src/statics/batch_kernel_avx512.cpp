// The batch solver's inner loop in 8 lanes for processors with AVX-512: compiled with flags of its own, hence in a namespace
// of its own, and run only where the processor has it.
#if defined(__x86_64__)
#define TENDRIL_LANES_NAMESPACE tendril_avx512

#include <type_traits>

#include "statics/batch_iteration.h"

namespace tendril {

extern const BatchKernel batch_kernel_avx512;
const BatchKernel batch_kernel_avx512{"avx512", 8, tendril_avx512::iterate_lanes<tendril_avx512::WidePack>,
                                     tendril_avx512::BatchIteration<tendril_avx512::WidePack>::scratch_size};

}  // namespace tendril
#endif
