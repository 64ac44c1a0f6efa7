// Compiled for every processor of its family, unlike the rest of the program.
#include "shell/run.h"

#if defined(__x86_64__) && defined(TENDRIL_NEEDS)
#include <unistd.h>

#include <cstring>

#include "base/instruction_sets.h"

namespace {

#if defined(__clang__)  // knows no levels by name, and this build's is rarely another one
bool has_what_it_needs() { return std::strcmp(TENDRIL_NEEDS, "x86-64-v3") != 0 || tendril::runs_x86_64_v3(); }
#else
bool has_what_it_needs() { return __builtin_cpu_supports(TENDRIL_NEEDS); }
#endif

void say(const char* text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
}

/// Words instead of an illegal instruction. Runs before anything else of the program, the constructors of its objects
/// included, and calls nothing but the system's library.
__attribute__((constructor(101))) void check_processor() {
  __builtin_cpu_init();
  if (has_what_it_needs()) return;
  say("tendril: this processor lacks instructions that this build needs (" TENDRIL_NEEDS
      ": AVX2, FMA, BMI2, F16C).\nBuild it for older ones with cmake -DTENDRIL_ARCH=x86-64-v2 (or x86-64).\n");
  ::_exit(2);
}

}  // namespace
#endif

int main(int argc, char** argv) { return tendril::shell::run(argc, argv); }
