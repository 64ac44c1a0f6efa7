// The kernel for processors with AVX-512: compiled with flags of its own, hence in a namespace of its
// own, and run only where the processor has it.
#if defined(__x86_64__)
#define TENDRIL_LANES_NAMESPACE tendril_envelope_avx512

#include "method/envelope/kernel_loops.h"

namespace tendril::envelope {

extern const Kernel kernel_avx512;
const Kernel kernel_avx512 = tendril_envelope_avx512::kernel_named("avx512");

}  // namespace tendril::envelope
#endif
