// The kernel for processors with AVX2 and fused multiply-add: compiled with flags of its own, hence in a namespace of its
// own, and run only where the processor has them.
#if defined(__x86_64__)
#define TENDRIL_LANES_NAMESPACE tendril_envelope_avx2

#include "method/envelope/kernel_loops.h"

namespace tendril::envelope {

extern const Kernel kernel_avx2;
const Kernel kernel_avx2 = tendril_envelope_avx2::kernel_named("avx2");

}  // namespace tendril::envelope
#endif
