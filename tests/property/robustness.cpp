// How random rods of every family are solved.
//   robustness [members of a family] [element: se3 or staggered] [part of a family's name]    prints
//   robustness report [members of a family] [FILE]    both elements, by default 3000 into
//                                                     tests/property/robustness_report.md
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "base/write_file.h"
#include "rod_families.h"
#include "statics/solve.h"

using namespace tendril;

namespace {

struct Tally {
  std::vector<int> iterations, failed;
  std::vector<double> seconds;
  int stable = 0, saddle = 0, unknown = 0, other_element = 0;
  int fallbacks[3] = {};

  int members() const { return static_cast<int>(iterations.size()); }
  void sort() {
    std::sort(iterations.begin(), iterations.end());
    std::sort(seconds.begin(), seconds.end());
  }
};

Tally tally(int family, const test::RodFamily& rods, int members, const SolveOptions& options) {
  Tally all;
  for (int member = 0; member < members; ++member) {
    auto random = test::stream_of(family, member);
    const Equilibrium e = solve(rods.make(random), options);
    all.iterations.push_back(e.iterations);
    all.seconds.push_back(e.seconds);
    ++all.fallbacks[std::min(e.fallbacks, 2)];
    if (!e.ok()) all.failed.push_back(member);
    else if (e.stable) ++all.stable;
    else if (e.negative_pivots > 0) ++all.saddle;
    else ++all.unknown;
    all.other_element += e.ok() && e.message != "solved";
  }
  all.sort();
  return all;
}

std::string solved_share(const Tally& all) {
  char text[32];
  const int failed = static_cast<int>(all.failed.size());
  std::snprintf(text, sizeof text, "%.2f", 100.0 * (all.members() - failed) / all.members());
  return text;
}

void print(const std::string& name, const Tally& all) {
  const int n = all.members();
  std::printf("%-28s %7s%%  %6d %6d %6d  %9d %9d  %9.0f ", name.c_str(), solved_share(all).c_str(), all.iterations[n / 2],
              all.iterations[n * 9 / 10], all.iterations.back(), all.fallbacks[1], all.fallbacks[2], 1e6 * all.seconds[n / 2]);
  for (std::size_t i = 0; i < std::min<std::size_t>(all.failed.size(), 8); ++i) std::printf(" %d", all.failed[i]);
  std::printf("\n");
  std::fflush(stdout);
}

std::string row(const std::string& name, const Tally& all) {
  const int n = all.members();
  char text[256];
  std::snprintf(text, sizeof text, "| %s | %s | %d | %d | %d | %.0f | %.0f | %d / %d / %d | %d | %d |\n", name.c_str(),
                solved_share(all).c_str(), all.iterations[n / 2], all.iterations[n * 9 / 10], all.iterations.back(),
                1e6 * all.seconds[n / 2], 1e6 * all.seconds[n * 9 / 10], all.stable, all.saddle, all.unknown,
                all.fallbacks[1] + all.fallbacks[2], all.other_element);
  return text;
}

std::string report(int members) {
  std::string text =
      "# Random rods of every family\n\n"
      "Written by `build/robustness report " + std::to_string(members) + "`: " + std::to_string(members) +
      " rods a family, 40 segments, cold, one thread. Member m of family f is\ndrawn from std::seed_seq{20261, f, m} "
      "(rod_families.cpp). Iterations are factorisations over all stages; microseconds of the\nwhole solve, on two cores of "
      "an AMD EPYC that other work shared: for orientation. Verdict by the signs of the pivots.\nFallbacks: solved, but not by the "
      "first method. Other element: the fourth-order element's segments are too long for the force\nin them, the "
      "staggered element's answer stands in and the message says so.\n";
  for (const Element element : {Element::se3, Element::staggered}) {
    SolveOptions options;
    options.element = element;
    text += element == Element::se3 ? "\n## SE(3) element\n\n" : "\n## Staggered element\n\n";
    text += "| family | solved % | iterations: median | 90 % | most | us: median | 90 % | stable / saddle / unknown | fallbacks | "
            "other element |\n|---|---|---|---|---|---|---|---|---|---|\n";
    const auto families = test::rod_families();
    for (std::size_t family = 0; family < families.size(); ++family) {
      const Tally all = tally(static_cast<int>(family), families[family], members, options);
      print(families[family].name, all);
      text += row(families[family].name, all);
    }
  }
  return text +
         "\nA weight that the stretch stiffness cannot carry is not sane input: it is refused, and the message says by how much "
         "(test_problem.cpp).\n";
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 1 && std::strcmp(arguments[1], "report") == 0) {
    const int members = count > 2 ? std::atoi(arguments[2]) : 3000;
    write_file(count > 3 ? arguments[3] : "tests/property/robustness_report.md", report(std::max(members, 1)));
    return 0;
  }
  const int members = std::max(1, count > 1 ? std::atoi(arguments[1]) : 1000);
  SolveOptions options;
  if (count > 2 && std::strcmp(arguments[2], "staggered") == 0) options.element = Element::staggered;
  const char* wanted = count > 3 ? arguments[3] : "";
  std::printf("%d rods a family, 40 segments, %s\n", members, options.element == Element::se3 ? "se3" : "staggered");
  std::printf("%-28s %8s  %6s %6s %6s  %9s %9s  %9s  %s\n", "family", "solved", "median", "90 %", "most", "fallback1",
              "fallback2", "us median", "not solved");
  const auto families = test::rod_families();
  for (std::size_t family = 0; family < families.size(); ++family)
    if (std::strstr(families[family].name.c_str(), wanted))
      print(families[family].name, tally(static_cast<int>(family), families[family], members, options));
}
