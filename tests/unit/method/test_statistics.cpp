#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <vector>

#include "base/error.h"
#include "method/variation/copula.h"
#include "method/variation/distributions.h"
#include "method/variation/random_stream.h"
#include "method/variation/sampler.h"
#include "method/variation/spreads.h"
#include "method/variation/statistics.h"

using namespace tendril;
using namespace tendril::variation;

namespace {

std::vector<double> drawn(int count, int seed, const std::function<double(double)>& inverse) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(inverse(open_unit(random_bits(seed, k, 0))));
  return values;
}

bool holds(const Estimate& e, double truth) { return e.low <= truth && truth <= e.high; }

}  // namespace

TEST_CASE("statistics: intervals cover the truth as often as they say, for light and heavy tails", "[variation]") {
  constexpr int seeds = 400, count = 200;
  struct Case {
    const char* name;
    std::function<double(double)> inverse;
    double mean, deviation, q90;
  };
  const Case cases[] = {
      {"normal", [](double u) { return normal_quantile(u); }, 0, 1, 1.2815515655446},
      {"uniform", [](double u) { return u; }, 0.5, 1 / std::sqrt(12.0), 0.9},
      {"exponential", [](double u) { return -std::log1p(-u); }, 1, 1, std::log(10.0)},
      // Student's t with 5 degrees of freedom: kurtosis 9.
      {"heavy", [](double u) { return student_quantile(u, 5); }, 0, std::sqrt(5.0 / 3), 1.4758840488}};
  for (const Case& c : cases) {
    int mean = 0, deviation = 0, quantile = 0, share = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      const Sample sample(drawn(count, seed, c.inverse));
      mean += holds(sample.mean(), c.mean);
      deviation += holds(sample.deviation(), c.deviation);
      quantile += holds(sample.quantile(0.9), c.q90);
      share += holds(sample.share_above(c.q90), 0.1);
    }
    CAPTURE(c.name, mean, deviation, quantile, share);
    // 95 % of 400 is 380, with a deviation of 4.4.
    CHECK(mean >= 366);
    CHECK(deviation >= 356);  // to first order only: a little short for skew and heavy tails
    CHECK(quantile >= 366);   // exact, so that at least 95 %
    CHECK(share >= 366);
    CHECK(mean < 398);
    CHECK(deviation < 399);
  }
}

TEST_CASE("statistics: replicates' intervals cover the truth and are far narrower", "[variation]") {
  constexpr int seeds = 200, count = 1024, replicates = 8;
  int covered = 0, as_random = 0;
  double width = 0, plain = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const Sampler sampler(Sampling::sobol, seed, 3, count, replicates);
    std::vector<double> values;
    for (int k = 0; k < count; ++k) values.push_back(std::exp(sampler.at(k, 0)) * (1 + sampler.at(k, 1)) + sampler.at(k, 2));
    const Sample sample(values, replicates), independent(values);
    const Estimate mean = sample.mean();
    covered += holds(mean, (std::exp(1.0) - 1) * 1.5 + 0.5);
    CHECK(mean.kind == IntervalKind::replicates);
    width += mean.half_width();
    plain += independent.mean().half_width();
    as_random += sample.quantile(0.999).kind == IntervalKind::as_random;
    CHECK(sample.quantile(0.5).kind == IntervalKind::replicates);
    CHECK(sample.share_below(2).kind == IntervalKind::replicates);
    CHECK(sample.share_above(100).kind == IntervalKind::as_random);
  }
  CHECK(covered >= 180);
  CHECK(as_random == seeds);
  CHECK(width < 0.1 * plain);
}

TEST_CASE("statistics: exact values of a small sample", "[variation]") {
  const Sample sample({3, 1, 2, 5, 4});
  CHECK(sample.size() == 5);
  CHECK(sample.min() == 1);
  CHECK(sample.max() == 5);
  CHECK(sample.mean().value == 3);
  CHECK(sample.mean().half_width() == Approx(student_quantile(0.975, 4) * std::sqrt(2.5 / 5)));
  CHECK(sample.deviation().value == Approx(std::sqrt(2.5)));
  CHECK(sample.quantile(0.5).value == 3);
  CHECK(sample.quantile(0.1).value == Approx(1.4));
  CHECK(std::isinf(sample.quantile(0.5).high));  // five outcomes bound no quantile at 95 %: the chance that all lie below is 1/32
  CHECK(Sample({1, 2, 3, 4, 5, 6}).quantile(0.5).high == 6);  // six do: 1/64
  CHECK(sample.share_below(3).value == 0.4);
  CHECK(sample.share_above(3).value == 0.4);
  CHECK(sample.share_below(0).low == 0);
  CHECK(sample.share_below(0).high == Approx(1 - std::pow(0.025, 0.2)));
  CHECK(sample.share_above(0).high == 1);
  CHECK_THROWS_WITH(sample.quantile(1), Catch::Contains("got a quantile of 1, expected a share between 0 and 1"));
  CHECK_THROWS_WITH(sample.quantile(NAN), Catch::Contains("got a quantile of nan"));
}

TEST_CASE("statistics: outcomes without a value widen a share's interval to both sides", "[variation]") {
  std::vector<double> values(90, 1.0);
  values.resize(100, NAN);
  const Sample sample(values, 1, 10);
  CHECK(sample.size() == 90);
  CHECK(sample.missing() == 20);
  const Estimate below = sample.share_below(0);
  CHECK(below.value == 0);
  CHECK(below.low == 0);
  CHECK(below.high == Approx(beta_quantile(0.975, 21, 90)));
  CHECK(sample.share_above(0).low == Approx(beta_quantile(0.025, 90, 21)));
}

TEST_CASE("statistics: empty, single and constant samples", "[variation]") {
  const Sample empty{std::vector<double>{}};
  CHECK(std::isnan(empty.mean().value));
  CHECK(std::isnan(empty.min()));
  CHECK(std::isnan(empty.quantile(0.5).value));
  CHECK(std::isnan(empty.share_below(1).value));
  CHECK(empty.mean().kind == IntervalKind::none);
  const Sample one(std::vector<double>{2.0});
  CHECK(one.mean().value == 2);
  CHECK(one.mean().kind == IntervalKind::none);
  CHECK(std::isnan(one.deviation().value));
  CHECK(one.quantile(0.3).value == 2);
  const Sample same(std::vector<double>(50, 4.0));
  CHECK(same.mean().low == 4);
  CHECK(same.deviation().value == 0);
  CHECK(same.deviation().kind == IntervalKind::none);
  const Sample straight(std::vector<double>{1, 2, INFINITY});
  CHECK(std::isinf(straight.mean().value));
  CHECK(straight.mean().kind == IntervalKind::none);
  CHECK(straight.quantile(0.5).value == 2);
  CHECK(straight.share_above(10).value == Approx(1.0 / 3));
}

TEST_CASE("spreads: shapes and variances", "[variation]") {
  ComponentSpread spread;
  spread.tolerance = 0.3;
  spread.sigma = 0.1;
  const std::function<double(double)> square = [](double u) { return u * u; };
  spread.inverse = &square;
  constexpr int count = 200000;
  for (const Spread kind : {Spread::normal, Spread::uniform, Spread::triangular, Spread::function}) {
    spread.kind = kind;
    double squares = 0, sum = 0;
    for (int k = 0; k < count; ++k) {
      const double x = spread.at((k + 0.5) / count);
      sum += x / count;
      squares += x * x / count;
    }
    CHECK(spread.variance() == Approx(squares - sum * sum).epsilon(2e-3));
  }
  spread.kind = Spread::uniform;
  int inside = 0, in_half = 0, near_axis = 0;
  Vec3 second = Vec3::Zero();
  double tilts = 0, first_tilts = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto u = [&](int d) { return open_unit(random_bits(3, k, d)); };
    const Vec3 p = in_ball(spread, u(0), u(1), u(2));
    inside += p.norm() <= 0.3;
    in_half += p.norm() <= 0.15;
    second += p.cwiseAbs2() / 20000;
    const Eigen::Vector2d tilt = in_cone(spread, u(3), u(4));
    CHECK(tilt.norm() <= 0.3 * (1 + 1e-12));
    // Half of the cap's area is inside this angle.
    near_axis += 1 - std::cos(tilt.norm()) <= 0.5 * (1 - std::cos(0.3));
    tilts += 0.5 * tilt.squaredNorm() / 20000;
    first_tilts += tilt.x() / 20000;
  }
  CHECK(inside == 20000);
  CHECK(in_half == Approx(2500).margin(5 * std::sqrt(2500.0)));
  CHECK(near_axis == Approx(10000).margin(5 * 71));
  for (int c = 0; c < 3; ++c) CHECK(second[c] == Approx(ball_variance(spread)).epsilon(0.05));
  CHECK(tilts == Approx(cone_variance(spread)).epsilon(0.05));
  CHECK(std::abs(first_tilts) < 0.005);
  spread.name = "hose.length";
  spread.kind = Spread::function;
  const std::function<double(double)> broken = [](double) { return NAN; };
  spread.inverse = &broken;
  CHECK_THROWS_WITH(spread.at(0.25),
                    Catch::Contains("'hose.length': the inverse distribution gave nan at 0.25, expected a finite number"));
}

TEST_CASE("copula: correlated as asked, each number still uniform", "[variation]") {
  Eigen::MatrixXd asked(3, 3);
  asked << 1, 0.8, -0.5, 0.8, 1, -0.2, -0.5, -0.2, 1;
  const Copula copula(asked, 3, "group");
  constexpr int count = 20000;
  Eigen::Matrix3d found = Eigen::Matrix3d::Zero();
  Vec3 mean = Vec3::Zero();
  for (int k = 0; k < count; ++k) {
    double u[3];
    for (int d = 0; d < 3; ++d) u[d] = open_unit(random_bits(9, k, d));
    copula.join(u);
    const Vec3 z(normal_quantile(u[0]), normal_quantile(u[1]), normal_quantile(u[2]));
    found += z * z.transpose() / count;
    mean += Vec3(u[0], u[1], u[2]) / count;
  }
  CHECK((found - asked).cwiseAbs().maxCoeff() < 0.04);
  CHECK((mean - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() < 0.01);
  // Wholly dependent: the same number.
  double same[2] = {0.3, 0.9};
  Copula(Eigen::MatrixXd::Ones(1, 1), 2, "group").join(same);
  CHECK(same[0] == Approx(0.3));
  CHECK(same[1] == Approx(0.3));
}

TEST_CASE("copula: matrices that are no correlations are refused", "[variation]") {
  const auto matrix = [](std::initializer_list<double> entries) {
    const int n = static_cast<int>(std::lround(std::sqrt(static_cast<double>(entries.size()))));
    Eigen::MatrixXd m(n, n);
    int i = 0;
    for (const double e : entries) {
      m(i / n, i % n) = e;
      ++i;
    }
    return m;
  };
  CHECK_THROWS_WITH(Copula(matrix({1, 0, 0, 1}), 3, "group 1"),
                    Catch::Contains("group 1: the correlation is 2x2, expected 3x3 or one number"));
  CHECK_THROWS_WITH(Copula(matrix({1, 1.5, 1.5, 1}), 2, "g"), Catch::Contains("got a correlation of 1.5 in row 1, column 2"));
  CHECK_THROWS_WITH(Copula(matrix({1, NAN, NAN, 1}), 2, "g"), Catch::Contains("got a correlation of nan"));
  CHECK_THROWS_WITH(Copula(matrix({1, 0.5, 0.4, 1}), 2, "g"), Catch::Contains("not symmetric in row 1, column 2"));
  CHECK_THROWS_WITH(Copula(matrix({0.9, 0, 0, 1}), 2, "g"), Catch::Contains("correlation with itself is 1, got 0.9"));
  CHECK_THROWS_WITH(Copula(matrix({1, 0.9, -0.9, 0.9, 1, 0.9, -0.9, 0.9, 1}), 3, "g"),
                    Catch::Contains("not positive semi-definite (smallest eigenvalue -0.8)"));
  CHECK_THROWS_WITH(Copula(matrix({-0.6}), 3, "g"), Catch::Contains("not positive semi-definite (smallest eigenvalue -0.2)"));
}
