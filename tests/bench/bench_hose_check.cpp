// What is asked of finished hoses in the engine bay of over a million triangles: the certificate that a curve is clear, its
// smallest gap to 10 um, and whether two curves take the same passage. The curves are local optima from random starts; they
// touch what they run around.
#include <benchmark/benchmark.h>

#include "bench/bay_routes.h"
#include "method/pcc/gap_search.h"
#include "method/pcc/pcc_check.h"
#include "method/preform/passage_match.h"

namespace {

using namespace tendril;
using namespace tendril::routing;

struct Case {
  std::unique_ptr<FreeSpace> space;
  std::vector<PccPoints> curves;
  std::vector<std::pair<int, int>> pairs;  ///< those with the same ends
};

const Case& curves_in_bay() {
  static const Case made = [] {
    std::mt19937_64 random(1);
    Case c;
    c.space = std::make_unique<FreeSpace>(bench::engine_bay(), bench::bay_space(), std::vector<Vec3>(), 0.2);
    while (c.curves.size() < 24) {
      const std::vector<PccPoints> found = bench::random_optima(*c.space, bench::random_ends(*c.space, random), 60, random);
      const int first = static_cast<int>(c.curves.size()), count = static_cast<int>(found.size());
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j) c.pairs.emplace_back(first + i, first + j);
      c.curves.insert(c.curves.end(), found.begin(), found.end());
    }
    return c;
  }();
  return made;
}

benchmark::Counter each(std::size_t count) {
  return benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void certificate(benchmark::State& state) {
  const Case& c = curves_in_bay();
  int clear = 0;
  for (auto _ : state)
    for (const PccPoints& curve : c.curves) clear += is_clear(*c.space, curve, 0);
  if (clear != state.iterations() * static_cast<int>(c.curves.size())) state.SkipWithError("a curve is not clear");
  double queries = 0, length = 0;
  for (const PccPoints& curve : c.curves) {
    GapSearch search(*c.space, -0.5e-5, 0.5e-5);
    for (const PccPiece& piece : pieces_of(curve)) search.along(piece, 0, 1e3);
    queries += static_cast<double>(search.queries()) / static_cast<double>(c.curves.size());
    length += curve.length() / static_cast<double>(c.curves.size());
  }
  state.counters["per_curve"] = each(c.curves.size());
  state.counters["queries"] = queries;
  state.counters["length_m"] = length;
}
BENCHMARK(certificate);

void smallest_gap_of_curve(benchmark::State& state) {
  const Case& c = curves_in_bay();
  for (auto _ : state)
    for (const PccPoints& curve : c.curves) benchmark::DoNotOptimize(smallest_gap(*c.space, curve, 0, 0.2).value);
  state.counters["per_curve"] = each(c.curves.size());
}
BENCHMARK(smallest_gap_of_curve);

void same_passage_of_pair(benchmark::State& state) {
  const Case& c = curves_in_bay();
  long same = 0;
  for (auto _ : state)
    for (const auto& [i, j] : c.pairs) same += preform::same_passage(*c.space, c.curves[i], c.curves[j]);
  state.counters["per_pair"] = each(c.pairs.size());
  state.counters["pairs"] = static_cast<double>(c.pairs.size());
  state.counters["share_same"] = double(same) / double(state.iterations() * c.pairs.size());
}
BENCHMARK(same_passage_of_pair);

}  // namespace
