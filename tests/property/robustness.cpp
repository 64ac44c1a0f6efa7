// Prints how random rods of every family are solved.
//   robustness [members of a family] [element: se3 or staggered] [part of a family's name]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "rod_families.h"
#include "statics/solve.h"

using namespace tendril;

int main(int count, char** arguments) {
  const int members = count > 1 ? std::atoi(arguments[1]) : 1000;
  SolveOptions options;
  if (count > 2 && std::strcmp(arguments[2], "staggered") == 0) options.element = Element::staggered;
  const char* wanted = count > 3 ? arguments[3] : "";
  std::printf("%d rods a family, 40 segments, %s\n", members, options.element == Element::se3 ? "se3" : "staggered");
  std::printf("%-28s %8s  %6s %6s %6s  %9s %9s  %9s  %s\n", "family", "solved", "median", "90 %", "most", "fallback1",
              "fallback2", "us median", "not solved");
  const auto families = test::rod_families();
  for (std::size_t family = 0; family < families.size(); ++family) {
    if (!std::strstr(families[family].name.c_str(), wanted)) continue;
    std::vector<int> iterations, failed;
    std::vector<double> seconds;
    int fallbacks[3] = {};
    for (int member = 0; member < members; ++member) {
      auto random = test::stream_of(static_cast<int>(family), member);
      const Equilibrium e = solve(families[family].make(random), options);
      iterations.push_back(e.iterations);
      seconds.push_back(e.seconds);
      ++fallbacks[std::min(e.fallbacks, 2)];
      if (!e.ok()) failed.push_back(member);
    }
    std::sort(iterations.begin(), iterations.end());
    std::sort(seconds.begin(), seconds.end());
    std::printf("%-28s %7.2f%%  %6d %6d %6d  %9d %9d  %9.0f ", families[family].name.c_str(),
                100.0 * (members - static_cast<int>(failed.size())) / members, iterations[members / 2],
                iterations[members * 9 / 10], iterations.back(), fallbacks[1], fallbacks[2], 1e6 * seconds[members / 2]);
    for (std::size_t i = 0; i < std::min<std::size_t>(failed.size(), 8); ++i) std::printf(" %d", failed[i]);
    std::printf("\n");
    std::fflush(stdout);
  }
}
