#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "view/ticks.h"

using namespace tendril;

TEST_CASE("round ticks of known ranges") {
  CHECK(round_ticks(0, 20).labels == std::vector<std::string>{"0", "5", "10", "15", "20"});
  CHECK(round_ticks(0, 1).labels == std::vector<std::string>{"0.00", "0.25", "0.50", "0.75", "1.00"});
  CHECK(round_ticks(-4, 4).labels == std::vector<std::string>{"-4", "-2", "0", "2", "4"});
  CHECK(round_ticks(8, 90).labels == std::vector<std::string>{"20", "40", "60", "80"});
  CHECK(round_ticks(1e-6, 5e-6).labels == std::vector<std::string>{"1e-06", "2e-06", "3e-06", "4e-06", "5e-06"});
  CHECK(round_ticks(0, 4e7).labels.back() == "4e+07");
}

TEST_CASE("any range gets three to nine ticks inside it, evenly spaced by a round step") {
  const unsigned seed = 20;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1, 1), power(-9, 9);
  for (int i = 0; i < 2000; ++i) {
    const double low = place(random) * std::pow(10, power(random)), high = low + std::pow(10, power(random));
    if (high - low < 1e-9 * std::abs(low)) continue;
    const Ticks ticks = round_ticks(low, high);
    INFO("range " << low << " ... " << high);
    REQUIRE(ticks.values.size() >= 3);
    REQUIRE(ticks.values.size() <= 9);
    REQUIRE(ticks.values.size() == ticks.labels.size());
    const double digits = ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step) + 1e-9));
    CHECK((digits == Approx(1) || digits == Approx(2) || digits == Approx(2.5) || digits == Approx(5)));
    for (std::size_t k = 0; k < ticks.values.size(); ++k) {
      CHECK(ticks.values[k] >= low);
      CHECK(ticks.values[k] <= high);
      const double turns = ticks.values[k] / ticks.step;
      CHECK(std::abs(turns - std::round(turns)) < 1e-6 * std::max(1.0, std::abs(turns)));
      if (k > 0) CHECK(ticks.values[k] - ticks.values[k - 1] == Approx(ticks.step).epsilon(1e-6));
    }
  }
}

TEST_CASE("round lengths and how they are written") {
  CHECK(round_length(0.27) == Approx(0.2));
  CHECK(round_length(0.5) == Approx(0.5));
  CHECK(round_length(0.099) == Approx(0.05));
  CHECK(round_length(1) == Approx(1));
  CHECK(round_length(4.9e-4) == Approx(2e-4));
  CHECK(length_text(0.2) == "200 mm");
  CHECK(length_text(2) == "2 m");
  CHECK(length_text(1) == "1 m");
  CHECK(length_text(5e-4) == "0.5 mm");
  CHECK(length_text(2e-5) == "20 µm");
  CHECK(length_text(0) == "0 mm");
}
