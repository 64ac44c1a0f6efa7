// Compiled for every processor of its family, unlike the rest of the program.
#include "shell/run.h"

#if defined(__x86_64__) && defined(TENDRIL_NEEDS)
#include <unistd.h>

#include <cstring>

namespace {

void say(const char* text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
}

/// Words instead of an illegal instruction. Runs before anything else of the program, the constructors of its objects
/// included, and calls nothing but the system's library.
__attribute__((constructor(101))) void check_processor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports(TENDRIL_NEEDS)) return;
  say("tendril: this processor lacks instructions that this build needs (" TENDRIL_NEEDS
      ": AVX2, FMA, BMI2, F16C).\nBuild it for older ones with cmake -DTENDRIL_ARCH=x86-64-v2 (or x86-64).\n");
  ::_exit(2);
}

}  // namespace
#endif

int main(int argc, char** argv) { return tendril::shell::run(argc, argv); }
