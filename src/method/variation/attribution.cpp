#include "method/variation/attribution.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "method/variation/distributions.h"

namespace tendril::variation {
namespace {

constexpr double difference = 0.02;  // of a standard deviation

/// The ratio of two means over the same outcomes, with its interval to first order.
Estimate ratio(const std::vector<double>& above, const std::vector<double>& below, bool independent) {
  Estimate out;
  const int n = static_cast<int>(above.size());
  double a = 0, b = 0;
  for (int k = 0; k < n; ++k) {
    a += above[k] / n;
    b += below[k] / n;
  }
  if (n < 2 || !(b > 0)) return out;
  out.value = a / b;
  double squares = 0;
  for (int k = 0; k < n; ++k) squares += std::pow(above[k] - out.value * below[k], 2);
  const double half = student_quantile(0.975, n - 1.0) * std::sqrt(squares / (n - 1.0) / n) / b;
  out.low = out.value - half;
  out.high = out.value + half;
  out.kind = independent ? IntervalKind::delta : IntervalKind::as_random;
  return out;
}

Estimate one_minus(const Estimate& e) {
  Estimate out = e;
  out.value = 1 - e.value;
  out.low = 1 - e.high;
  out.high = 1 - e.low;
  return out;
}

}  // namespace

Eigen::MatrixXd gradient_of(const std::vector<double>& nominal, const Eigen::VectorXd& variances, const Measures& measures,
                            const RowSolver& solver, const RunContext& context) {
  const int columns = static_cast<int>(nominal.size()), count = measures.count();
  std::vector<double> values, steps;
  for (int c = 0; c < columns; ++c) {
    steps.push_back(difference * std::sqrt(variances[c]));
    for (const double sign : {1.0, -1.0}) {
      values.insert(values.end(), nominal.begin(), nominal.end());
      values[values.size() - columns + c] += sign * steps[c];
    }
  }
  RowAnswers answers;
  solver.solve(values, 2 * columns, false, answers, context);
  if (measures.has_functions())
    for (int r = 0; r < 2 * columns; ++r)
      if (answers.status[r] == OutcomeStatus::solved)
        measures.call(
            solver.equilibrium({&values[static_cast<std::size_t>(r) * columns], static_cast<std::size_t>(columns)}, answers, r),
            {&answers.measured[static_cast<std::size_t>(r) * count], static_cast<std::size_t>(count)});
  Eigen::MatrixXd gradient(count, columns);
  for (int c = 0; c < columns; ++c)
    for (int m = 0; m < count; ++m) {
      const auto at = [&](int row) { return answers.measured[static_cast<std::size_t>(2 * c + row) * count + m]; };
      gradient(m, c) = steps[c] > 0 ? (at(0) - at(1)) / (2 * steps[c]) : 0;
    }
  return gradient;
}

Attribution::Attribution(const std::vector<Variables::Contributor>& contributors, bool independent) : independent_(independent) {
  for (const Variables::Contributor& from : contributors) {
    Contributor contributor;
    contributor.name = from.name;
    contributor.columns = from.columns;
    out_.all.push_back(std::move(contributor));
  }
}

void Attribution::add_linear(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& covariance) {
  const double variance = gradient.dot(covariance * gradient);
  if (!std::isfinite(variance)) {
    out_.message = "the measure has no gradient at the nominal design";
    return;
  }
  out_.linear_deviation = std::sqrt(std::max(0.0, variance));
  if (!(variance > 0)) return;
  for (Contributor& contributor : out_.all) {
    double own = 0;
    for (const int a : contributor.columns)
      for (const int b : contributor.columns) own += gradient[a] * covariance(a, b) * gradient[b];
    contributor.linear = own / variance;
  }
}

/// Least squares in columns scaled to a deviation of one.
void Attribution::add_regression(const Outcomes& outcomes, int measure) {
  std::vector<int> rows;
  for (int k = outcomes.first(); k < outcomes.last(); ++k)
    if (outcomes.has_measures(k) && std::isfinite(outcomes.measures_of(k)[measure])) rows.push_back(k);
  const Eigen::Index n = static_cast<Eigen::Index>(rows.size()), columns = static_cast<Eigen::Index>(outcomes.variables().size());
  if (n < 2 * columns + 2) return;
  Eigen::MatrixXd x(n, columns);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    y[i] = outcomes.measures_of(rows[i])[measure];
    for (Eigen::Index c = 0; c < columns; ++c) x(i, c) = outcomes.variables_of(rows[i])[c];
  }
  x.rowwise() -= x.colwise().mean().eval();
  y.array() -= y.mean();
  for (Eigen::Index c = 0; c < columns; ++c)
    if (const double norm = x.col(c).norm(); norm > 0) x.col(c) /= norm;
  const double variance = y.squaredNorm();
  if (!(variance > 0)) return;
  const Eigen::VectorXd slopes = x.colPivHouseholderQr().solve(y);
  out_.explained = 1 - (y - x * slopes).squaredNorm() / variance;
  for (Contributor& contributor : out_.all) {
    Eigen::VectorXd own = Eigen::VectorXd::Zero(n);
    for (const int c : contributor.columns) own += slopes[c] * x.col(c);
    contributor.regression = own.squaredNorm() / variance;
  }
}

/// With f at an outcome (A), with everything drawn anew (B), and with one contributor drawn anew (AB): total effect
/// E(A - AB)^2 / 2V, first order 1 - E(B - AB)^2 / 2V.
void Attribution::add_effects(const Outcomes& outcomes, int measure, const std::vector<int>& drawn) {
  const std::size_t count = outcomes.measures().size();
  std::vector<int> rows;
  double sum = 0;
  const auto effect = [&](int outcome, std::size_t row) { return outcomes.effects_of(outcome)[row * count + measure]; };
  for (int k = outcomes.first(); k < outcomes.last(); ++k) {
    if (outcomes.effects_of(k).empty() || !outcomes.has_measures(k)) continue;
    bool whole = std::isfinite(outcomes.measures_of(k)[measure]);
    for (std::size_t row = 0; row <= drawn.size(); ++row) whole = whole && std::isfinite(effect(k, row));
    if (!whole) continue;
    rows.push_back(k);
    sum += outcomes.measures_of(k)[measure] + effect(k, drawn.size());
  }
  if (rows.size() < 2) return;
  const double mean = sum / (2.0 * static_cast<double>(rows.size()));
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    std::vector<double> total, rest, variance;
    for (const int k : rows) {
      const double a = outcomes.measures_of(k)[measure], b = effect(k, drawn.size()), ab = effect(k, i);
      total.push_back(0.5 * (a - ab) * (a - ab));
      rest.push_back(0.5 * (b - ab) * (b - ab));
      variance.push_back(0.5 * ((a - mean) * (a - mean) + (b - mean) * (b - mean)));
    }
    Contributor& contributor = out_.all[drawn[i]];
    contributor.total = ratio(total, variance, independent_);
    contributor.first = one_minus(ratio(rest, variance, independent_));
  }
}

Contributions Attribution::finish() {
  const auto rank = [](const Contributor& c) {
    for (const double share : {c.total.value, c.regression, c.linear})
      if (!std::isnan(share)) return share;
    return -1.0;
  };
  std::stable_sort(out_.all.begin(), out_.all.end(),
                   [&](const Contributor& a, const Contributor& b) { return rank(a) > rank(b); });
  return std::move(out_);
}

}  // namespace tendril::variation
