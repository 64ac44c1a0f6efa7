#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>
#include <random>

#include "view/histogram.h"

using namespace tendril;

namespace {

std::size_t total(const Histogram& h) { return std::accumulate(h.counts.begin(), h.counts.end(), std::size_t{0}); }

}  // namespace

TEST_CASE("Freedman and Diaconis on evenly spread values: width 2 IQR / n^(1/3)") {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(i / 999.0);
  const Histogram h = histogram_of(values);
  CHECK(h.counts.size() == 10);  // the interquartile range is 1/2, the width 1/10
  CHECK(total(h) == 1000);
  for (std::size_t count : h.counts) CHECK(std::abs(static_cast<double>(count) - 100) <= 1);
}

TEST_CASE("bins cover the range evenly and hold every finite value, as counted by hand") {
  const unsigned seed = 8;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(3, 2);
  std::vector<double> values;
  for (int i = 0; i < 5000; ++i) values.push_back(normal(random));
  values.push_back(NAN), values.push_back(INFINITY), values.push_back(-INFINITY);
  for (int bins : {0, 1, 2, 17, 1000}) {
    const Histogram h = histogram_of(values, bins);
    REQUIRE(h.edges.size() == h.counts.size() + 1);
    if (bins > 0) CHECK(h.counts.size() == static_cast<std::size_t>(bins));
    CHECK(total(h) == 5000);
    for (std::size_t k = 0; k < h.counts.size(); ++k) {
      std::size_t count = 0;
      for (double v : values)
        count += std::isfinite(v) && v >= h.edges[k] &&
                 (v < h.edges[k + 1] || (k + 1 == h.counts.size() && v <= h.edges[k + 1]));
      CHECK(h.counts[k] == count);
    }
  }
}

TEST_CASE("histograms of little or odd data") {
  CHECK(histogram_of({}).counts.empty());
  CHECK(histogram_of({NAN, INFINITY}).counts.empty());
  const Histogram one = histogram_of({5});
  CHECK(one.counts == std::vector<std::size_t>{1});
  CHECK((one.edges[0] < 5 && one.edges[1] > 5));
  const Histogram zeros = histogram_of({0, 0, 0});
  CHECK(zeros.counts == std::vector<std::size_t>{3});
  CHECK(zeros.edges[0] < zeros.edges[1]);
  // Quartiles that agree: Sturges. 9 values: ceil(log2 9) + 1 = 5.
  CHECK(histogram_of({1, 1, 1, 1, 1, 1, 1, 0, 2}).counts.size() == 5);
  // One far outlier would ask for a million bins.
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(i);
  values.push_back(1e12);
  CHECK(histogram_of(values).counts.size() == 200);
  const Histogram huge = histogram_of({-1.7e308, 0, 1.7e308});
  CHECK(total(huge) == 3);
  for (double edge : huge.edges) CHECK(std::isfinite(edge));
}
