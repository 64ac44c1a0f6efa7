#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include "base/error.h"
#include "method/variation/distributions.h"
#include "method/variation/random_stream.h"
#include "method/variation/sampler.h"
#include "method/variation/sobol.h"

using namespace tendril;
using namespace tendril::variation;

namespace {

/// How the points [first, first + 2^m) fall into all elementary intervals of volume 2^(t-m): true if each gets 2^t.
bool is_net(int m, int t, const std::vector<int>& dimensions, std::uint32_t first, bool scrambled) {
  const int dims = static_cast<int>(dimensions.size()), digits = m - t;
  std::vector<int> split(dims, 0);
  std::function<bool(int, int)> all = [&](int d, int left) -> bool {
    if (d == dims - 1) {
      split[d] = left;
      std::vector<int> count(std::size_t{1} << digits, 0);
      for (std::uint32_t k = first; k < first + (1u << m); ++k) {
        std::size_t box = 0;
        for (int j = 0; j < dims; ++j) {
          std::uint32_t x = sobol_bits(k, dimensions[j]);
          if (scrambled) x = owen_scrambled(x, random_bits(5, 0, dimensions[j]));
          box = box << split[j] | (split[j] ? x >> (32 - split[j]) : 0);
        }
        ++count[box];
      }
      return std::all_of(count.begin(), count.end(), [&](int c) { return c == 1 << t; });
    }
    for (split[d] = 0; split[d] <= left; ++split[d])
      if (!all(d + 1, left - split[d])) return false;
    return true;
  };
  return all(0, digits);
}

}  // namespace

TEST_CASE("sobol: the first two dimensions make (0, m, 2)-nets, plain and scrambled", "[variation]") {
  for (const bool scrambled : {false, true})
    for (int m = 1; m <= 8; ++m)
      for (const std::uint32_t first : {0u, 3u << m}) CHECK(is_net(m, 0, {0, 1}, first, scrambled));
}

TEST_CASE("sobol: the first four dimensions make (3, m, 4)-nets: t is the sum of the polynomials' degrees less one",
          "[variation]") {
  // Degrees 1, 2, 3: t = 0 + 1 + 2.
  for (int m = 4; m <= 8; ++m) {
    CHECK(is_net(m, 3, {0, 1, 2, 3}, 0, false));
    CHECK(is_net(m, 3, {0, 1, 2, 3}, 0, true));
  }
  CHECK_FALSE(is_net(6, 0, {0, 1, 2, 3}, 0, false));  // no four-dimensional net in base 2 can have t = 0
}

TEST_CASE("sobol: every dimension is a permutation at every power of two, and no two dimensions are alike", "[variation]") {
  std::set<std::vector<std::uint32_t>> seen;
  for (int d = 0; d < sobol_dimensions; ++d) {
    std::vector<std::uint32_t> points;
    for (std::uint32_t k = 0; k < 1024; ++k) points.push_back(sobol_bits(k, d));
    for (int m = 0; m <= 10; ++m) {
      std::set<std::uint32_t> cells;
      for (std::uint32_t k = 0; k < 1u << m; ++k) cells.insert(m ? points[k] >> (32 - m) : 0);
      CHECK(cells.size() == std::size_t{1} << m);
    }
    CHECK(seen.insert(points).second);
  }
}

TEST_CASE("sampler: Latin hypercubes have one outcome in each stratum, in every replicate", "[variation]") {
  for (const int outcomes : {10, 37, 1000}) {
    const int replicates = 4, dimensions = 5;
    const Sampler sampler(Sampling::latin, 7, dimensions, outcomes, replicates);
    for (int d = 0; d < dimensions; ++d)
      for (int r = 0; r < replicates; ++r) {
        std::vector<double> own;
        for (int k = r; k < outcomes; k += replicates) own.push_back(sampler.at(k, d));
        std::vector<int> count(own.size(), 0);
        for (const double u : own) ++count.at(static_cast<std::size_t>(u * static_cast<double>(own.size())));
        CHECK(std::all_of(count.begin(), count.end(), [](int c) { return c == 1; }));
      }
  }
}

TEST_CASE("sampler: numbers are uniform and unrelated, whichever way they are drawn", "[variation]") {
  constexpr int outcomes = 4096, dimensions = 12;
  for (const Sampling sampling : {Sampling::random, Sampling::sobol, Sampling::latin}) {
    const Sampler sampler(sampling, 11, dimensions, outcomes, 8);
    CAPTURE(name_of(sampling));
    for (int d = 0; d < dimensions; ++d) {
      std::vector<double> u;
      for (int k = 0; k < outcomes; ++k) u.push_back(sampler.at(k, d));
      std::sort(u.begin(), u.end());
      CHECK(u.front() > 0);
      CHECK(u.back() < 1);
      double kolmogorov = 0;
      for (int k = 0; k < outcomes; ++k) kolmogorov = std::max(kolmogorov, std::abs(u[k] - (k + 0.5) / outcomes));
      CHECK(kolmogorov < 2.2 / std::sqrt(outcomes));  // of independent numbers: exceeded once in 10^4
      for (int e = 0; e < d; ++e) {
        double product = 0;
        for (int k = 0; k < outcomes; ++k) product += (sampler.at(k, d) - 0.5) * (sampler.at(k, e) - 0.5);
        CHECK(std::abs(12 * product / outcomes) < 5 / std::sqrt(outcomes));
      }
    }
  }
}

TEST_CASE("sampler: over many seeds every point is uniform, and replicates and seeds know nothing of each other", "[variation]") {
  constexpr int seeds = 2000;
  for (const Sampling sampling : {Sampling::random, Sampling::sobol, Sampling::latin}) {
    CAPTURE(name_of(sampling));
    for (const int k : {0, 1, 14, 30}) {
      double mean = 0, other_replicate = 0, other_seed = 0;
      for (int seed = 0; seed < seeds; ++seed) {
        const Sampler sampler(sampling, seed, 2, 32, 2);
        const double x = sampler.at(k, 1) - 0.5;
        mean += x;
        other_replicate += 12 * x * (sampler.at(k ^ 1, 1) - 0.5);
        other_seed += 12 * x * (Sampler(sampling, seed + 1, 2, 32, 2).at(k, 1) - 0.5);
      }
      CHECK(std::abs(mean) < 5 * std::sqrt(seeds / 12.0));
      CHECK(std::abs(other_replicate) < 5 * std::sqrt(seeds));
      CHECK(std::abs(other_seed) < 5 * std::sqrt(seeds));
    }
  }
}

TEST_CASE("sampler: an integral of a smooth function converges faster by Sobol' points and Latin hypercubes", "[variation]") {
  const auto error = [](Sampling sampling) {
    constexpr int outcomes = 4096, dimensions = 5, seeds = 20;
    double squares = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      const Sampler sampler(sampling, seed, dimensions, outcomes, 1);
      double sum = 0;
      for (int k = 0; k < outcomes; ++k) {
        double f = 1;
        for (int d = 0; d < dimensions; ++d) f *= 1 + 0.3 * (sampler.at(k, d) - 0.5);
        sum += f / outcomes;
      }
      squares += (sum - 1) * (sum - 1) / seeds;
    }
    return std::sqrt(squares);
  };
  const double random = error(Sampling::random);
  CHECK(error(Sampling::sobol) < 0.02 * random);
  CHECK(error(Sampling::latin) < 0.3 * random);
}

TEST_CASE("sampler: a shuffle is a permutation, and each place is as likely", "[variation]") {
  for (const std::uint32_t count : {1u, 2u, 3u, 10u, 100u}) {
    std::set<std::uint32_t> seen;
    for (std::uint32_t k = 0; k < count; ++k) seen.insert(shuffled(k, count, 3));
    CHECK(seen.size() == count);
    CHECK(*seen.rbegin() == count - 1);
  }
  constexpr int seeds = 20000, count = 5;
  std::vector<int> places(count * count, 0);
  for (int seed = 0; seed < seeds; ++seed)
    for (std::uint32_t k = 0; k < count; ++k) ++places[count * k + shuffled(k, count, mixed(seed))];
  for (const int c : places) CHECK(std::abs(c - seeds / count) < 5 * std::sqrt(seeds / count));
}

TEST_CASE("sampler: what cannot be drawn is refused", "[variation]") {
  CHECK_THROWS_WITH(Sampler(Sampling::sobol, 1, 65, 100, 1), Catch::Contains("at most 64 dimensions, got 65"));
  CHECK_THROWS_WITH(Sampler(Sampling::latin, 1, 2, 100, 51),
                    Catch::Contains("got 51 replicates of 100 outcomes, expected 1 to 50"));
  CHECK_THROWS_WITH(Sampler(Sampling::sobol, 1, 2, 100, 0), Catch::Contains("got 0 replicates"));
  CHECK_NOTHROW(Sampler(Sampling::random, 1, 200, 1, 0));
}

TEST_CASE("distributions: known values and inverses", "[variation]") {
  CHECK(normal_quantile(0.975) == Approx(1.959963984540054).epsilon(1e-13));
  CHECK(normal_below(1.959963984540054) == Approx(0.975).epsilon(1e-13));
  CHECK(student_quantile(0.975, 1) == Approx(12.7062047361747).epsilon(1e-10));
  CHECK(student_quantile(0.975, 10) == Approx(2.22813885198627).epsilon(1e-10));
  CHECK(student_quantile(0.025, 10) == Approx(-2.22813885198627).epsilon(1e-10));
  CHECK(student_quantile(0.975, 1e6) == Approx(1.95996636).epsilon(1e-7));
  CHECK(beta_quantile(0.025, 5, 96) == Approx(0.0164319).epsilon(1e-4));  // Clopper-Pearson's lower end for 5 of 100
  CHECK(binomial_quantile(0.5, 10, 0.5) == 5);
  CHECK(binomial_below(3, 10, 0.5) == Approx(176.0 / 1024).epsilon(1e-12));
  for (const double chance : {0.001, 0.3, 0.999})
    for (const double share : {0.025, 0.5, 0.975}) {
      const int k = binomial_quantile(share, 1000, chance);
      CHECK(binomial_below(k, 1000, chance) >= share);
      CHECK(binomial_below(k - 1, 1000, chance) < share);
    }
}
