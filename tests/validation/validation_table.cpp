// Prints the error of every reference case over the number of segments, for all three discretisations.
//   validation_table [part of a case's name]
//   validation_table report [FILE]     writes the report, by default tests/validation/report.md
#include <cstdio>
#include <cstring>
#include <string>

#include "base/write_file.h"
#include "validation/reference.h"
#include "validation/validation_report.h"

using namespace tendril;
using namespace tendril::validation;

namespace {

void print_row(const Reference& reference, const Method& method, int segments) {
  const Equilibrium e = solve_reference(reference, method, segments, true);
  const Errors errors = errors_of(reference, e);
  std::printf("  %-9s %5d  %9.2e %9.2e %9.2e", method.name, segments, errors.line, errors.reaction, errors.energy);
  if (e.error)
    std::printf("  %9.2e %-7s %5.2f", e.error->value / reference.rod.length, e.error->valid ? "valid" : "invalid",
                e.error->order);
  std::printf("  %3d it %d fb %s%s\n", e.iterations, e.fallbacks, name_of(e.status), e.stable ? "" : " (unstable)");
}

}  // namespace

int main(int count, char** arguments) {
  const char* wanted = count > 1 ? arguments[1] : "";
  if (std::strcmp(wanted, "report") == 0) {
    write_file(count > 2 ? arguments[2] : "tests/validation/report.md", validation_report());
    return 0;
  }
  std::printf("centre line relative to L, reactions and energies relative to the largest;\n");
  std::printf("estimate: of the centre line's error\n");
  std::printf("  %-9s %5s  %9s %9s %9s  %9s %-7s %5s\n", "method", "N", "line", "reaction", "energy", "estimate", "",
              "order");
  for (const Reference* reference : all_references()) {
    if (!std::strstr(reference->name, wanted)) continue;
    std::printf("%s, %s\n", reference->name, reference->label);
    for (const Method* method : {&se3, &staggered, &thesis})
      for (const int segments : {10, 20, 40, 80, 160, 320, 640}) print_row(*reference, *method, segments);
  }
}
