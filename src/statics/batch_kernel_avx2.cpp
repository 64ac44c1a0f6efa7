// The batch solver's inner loop in 4 lanes for processors with AVX2 and fused multiply-add: compiled with flags of its own, hence in a namespace
// of its own, and run only where the processor has it.
#if defined(__x86_64__)
#define TENDRIL_LANES_NAMESPACE tendril_avx2

#include <type_traits>

#include "statics/batch_iteration.h"

namespace tendril {

extern const BatchKernel batch_kernel_avx2;
const BatchKernel batch_kernel_avx2{"avx2", 4, tendril_avx2::iterate_lanes<tendril_avx2::Pack>,
                                     tendril_avx2::BatchIteration<tendril_avx2::Pack>::scratch_size};

}  // namespace tendril
#endif
