// How often assembly verification is right: families of scenes that can be installed and that cannot, fresh seeds of each.
// assembly_families [seeds = 10] [first seed = 1000] [family] [details]
// Milliseconds are the processor's, without optimisation of what was found.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "unit/method/assembly_scenes.h"

namespace {

using namespace tendril;
using namespace tendril::assembly_scenes;

struct Family {
  const char* name;
  bool possible;
  std::function<Case(int)> make;
};

std::vector<Family> families() {
  const auto ground = std::make_shared<const TriangleSurface>(hills(217'800));
  const auto fine = std::make_shared<const TriangleSurface>(hills(1'160'000));
  return {{"two posts", true, two_posts},
          {"terrain", true, [=](int seed) { return terrain(seed, ground); }},
          {"fine terrain", true, [=](int seed) { return terrain(seed, fine); }},
          {"L channel", true, l_channel},
          {"ring", true, ring},
          {"ring, small connectors", true, ring_with_small_connectors},
          {"ring, one large connector", true, ring_with_one_large_connector},
          {"C channel", true, c_channel},
          {"lipped channel", true, lipped_channel},
          {"ring, large connectors", false, ring_with_large_connectors},
          {"ends behind rings", false, ends_behind_rings},
          {"closed box", false, closed_box}};
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

void print(int seed, const assembly::Result& result) {
  std::printf("  seed %d: %s, %.0f ms\n", seed, result.message.c_str(), 1e3 * result.seconds);
  for (const MethodStep& step : result.steps) {
    std::printf("    %-28s %7.1f ms", step.name.c_str(), 1e3 * step.seconds);
    for (const auto& [what, count] : step.counts) std::printf("  %s %ld", what.c_str(), count);
    std::printf("\n");
  }
  for (const assembly::Attempt& a : result.attempts)
    std::printf("    %s%s%s, %d grips: %s (%.0f ms)\n", a.handle.c_str(), a.gravity ? ", with gravity" : "", a.smoothed ? "" : ", as traced", a.grips,
                a.outcome.c_str(), 1e3 * a.seconds);
}

bool run(const Family& family, int seeds, int first, bool details) {
  std::vector<double> ms;
  int right = 0, attempts = 0, most = 0;
  std::map<std::string, int> wrong;
  double worst_deviation = 0, most_strain = 0;
  for (int seed = first; seed < first + seeds; ++seed) {
    Case c = family.make(seed);
    c.options.optimise = false;
    const std::clock_t begin = std::clock();
    const assembly::Result result = assembly::run(c.scene, c.options);
    ms.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    const int tries = static_cast<int>(result.attempts.size());
    attempts += tries;
    most = std::max(most, tries);
    if (details) print(seed, result);
    if (result.ok == family.possible && (result.ok || result.status == Status::infeasible)) ++right;
    else ++wrong["seed " + std::to_string(seed) + ": " + result.message];
    if (!result.ok) continue;
    worst_deviation = std::max(worst_deviation, result.proof.deviation);
    most_strain = std::max(most_strain, result.proof.strain);
  }
  std::printf("%-26s %-10s %4d/%-4d %8.1f %5d %10.0f %8.0f %10.3f %8.2f\n", family.name, family.possible ? "possible" : "impossible", right,
              seeds, double(attempts) / seeds, most, median(ms), *std::max_element(ms.begin(), ms.end()), 1e3 * worst_deviation, most_strain);
  for (const auto& [message, count] : wrong) std::printf("    %s\n", message.c_str());
  std::fflush(stdout);
  return right == seeds;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 10, first = argc > 2 ? std::atoi(argv[2]) : 1000;
  std::printf("%-26s %-10s %9s %8s %5s %10s %8s %10s %8s\n", "family", "", "right", "attempts", "most", "median ms", "worst ms", "off mm",
              "strain");
  bool all = true;
  for (const Family& family : families())
    if (argc <= 3 || std::string(family.name).find(argv[3]) != std::string::npos) all = run(family, std::max(1, seeds), first, argc > 4) && all;
  return all ? 0 : 1;
}
