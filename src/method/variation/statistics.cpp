#include "method/variation/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/number_text.h"
#include "method/variation/distributions.h"

namespace tendril::variation {
namespace {

constexpr double tail = 0.025;  // on each side of a 95 % interval
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int least_beside = 5;  // outcomes on either side of a limit or quantile in each replicate

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Sum of a power of the distances from `centre`.
double moment(const std::vector<double>& values, double centre, int power) {
  double sum = 0;
  for (const double x : values) sum += std::pow(x - centre, power);
  return sum;
}

double deviation_of(const std::vector<double>& values) {
  return values.size() < 2 ? NAN : std::sqrt(moment(values, mean_of(values), 2) / static_cast<double>(values.size() - 1));
}

double quantile_of(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size() || place == static_cast<double>(below)) return sorted[below];
  const double part = place - static_cast<double>(below);
  return (1 - part) * sorted[below] + part * sorted[below + 1];
}

/// For the standard deviation of a distribution that need not be normal (Bonett 2006).
void set_bonett(const std::vector<double>& sorted, Estimate& out) {
  const int n = static_cast<int>(sorted.size());
  if (n < 5 || !(out.value > 0) || !std::isfinite(out.value)) return;
  const double z = normal_quantile(1 - tail), correction = n / (n - z);
  const int trimmed = static_cast<int>(n / (2 * std::sqrt(n - 4.0)));
  const int from = std::min(trimmed, (n - 1) / 2), to = n - from;
  const double middle = std::accumulate(sorted.begin() + from, sorted.begin() + to, 0.0) / (to - from);
  const double squares = moment(sorted, mean_of(sorted), 2);
  const double kurtosis = n * moment(sorted, middle, 4) / (squares * squares);
  const double error = correction * std::sqrt(std::max(0.0, (kurtosis - (n - 3.0) / n) / (n - 1)));
  const double centre = std::log(correction * out.value * out.value);
  out.low = std::exp(0.5 * (centre - z * error));
  out.high = std::exp(0.5 * (centre + z * error));
  out.kind = IntervalKind::bonett;
}

}  // namespace

const char* name_of(IntervalKind kind) {
  switch (kind) {
    case IntervalKind::none: return "none";
    case IntervalKind::student: return "Student";
    case IntervalKind::bonett: return "Bonett";
    case IntervalKind::order: return "order statistics";
    case IntervalKind::exact: return "Clopper-Pearson";
    case IntervalKind::replicates: return "replicates";
    case IntervalKind::as_random: return "as for independent outcomes";
    case IntervalKind::delta: return "delta method";
  }
  return "";
}

Sample::Sample(std::vector<double> values, int replicates, int missing) : missing_(missing), independent_(replicates <= 1) {
  if (!independent_) replicates_.resize(replicates);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isnan(values[k])) {
      ++missing_;
      continue;
    }
    sorted_.push_back(values[k]);
    if (!independent_) replicates_[k % replicates].push_back(values[k]);
  }
  std::sort(sorted_.begin(), sorted_.end());
  for (std::vector<double>& replicate : replicates_) std::sort(replicate.begin(), replicate.end());
}

Sample::Sample(const Outcomes& outcomes, int measure, int replicates) : independent_(replicates <= 1) {
  if (!independent_) replicates_.resize(replicates);
  for (int k = outcomes.first(); k < outcomes.last(); ++k) {
    if (outcomes.status(k) == OutcomeStatus::unsolved) continue;
    const double value = outcomes.has_measures(k) ? outcomes.measures_of(k)[measure] : NAN;
    if (std::isnan(value)) {
      ++missing_;
      continue;
    }
    sorted_.push_back(value);
    if (!independent_) replicates_[k % replicates].push_back(value);
  }
  std::sort(sorted_.begin(), sorted_.end());
  for (std::vector<double>& replicate : replicates_) std::sort(replicate.begin(), replicate.end());
}

double Sample::min() const { return sorted_.empty() ? NAN : sorted_.front(); }
double Sample::max() const { return sorted_.empty() ? NAN : sorted_.back(); }

/// An interval about the value from the spread of independent replicates' own values; false where one has fewer than `least`
/// outcomes.
template <class Statistic>
bool Sample::by_replicates(const Statistic& statistic, int least, Estimate& out) const {
  if (replicates_.size() < 2) return false;
  std::vector<double> own;
  for (const std::vector<double>& replicate : replicates_) {
    if (static_cast<int>(replicate.size()) < std::max(1, least)) return false;
    own.push_back(statistic(replicate));
  }
  const double count = static_cast<double>(own.size());
  const double half = student_quantile(1 - tail, count - 1) * deviation_of(own) / std::sqrt(count);
  if (!std::isfinite(half)) return false;
  out.low = out.value - half;
  out.high = out.value + half;
  out.kind = IntervalKind::replicates;
  return true;
}

Estimate Sample::mean() const {
  Estimate out;
  if (sorted_.empty()) return out;
  out.value = mean_of(sorted_);
  if (!independent_ && by_replicates(mean_of, 1, out)) return out;
  const double error = deviation_of(sorted_) / std::sqrt(static_cast<double>(size()));
  if (!std::isfinite(error)) return out;
  const double half = student_quantile(1 - tail, size() - 1.0) * error;
  out.low = out.value - half;
  out.high = out.value + half;
  out.kind = independent_ ? IntervalKind::student : IntervalKind::as_random;
  return out;
}

Estimate Sample::deviation() const {
  Estimate out;
  if (size() < 2) return out;
  out.value = deviation_of(sorted_);
  if (!independent_ && by_replicates(deviation_of, 2 * least_beside, out)) {
    out.low = std::max(0.0, out.low);
    return out;
  }
  set_bonett(sorted_, out);
  if (!independent_ && out.kind == IntervalKind::bonett) out.kind = IntervalKind::as_random;
  if (out.kind == IntervalKind::none) out.low = 0;
  return out;
}

Estimate Sample::quantile(double share) const {
  if (!(share > 0 && share < 1))
    throw UsageError("method.variation: got a quantile of " + number_text(share) + ", expected a share between 0 and 1");
  Estimate out;
  if (sorted_.empty()) return out;
  out.value = quantile_of(sorted_, share);
  const int least = static_cast<int>(std::ceil(least_beside / std::min(share, 1 - share)));
  if (!independent_ && by_replicates([&](const std::vector<double>& own) { return quantile_of(own, share); }, least, out))
    return out;
  const int low = binomial_quantile(tail, size(), share), high = binomial_quantile(1 - tail, size(), share) + 1;
  out.low = low >= 1 ? sorted_[low - 1] : -infinity;
  out.high = high <= size() ? sorted_[high - 1] : infinity;
  out.kind = independent_ ? IntervalKind::order : IntervalKind::as_random;
  return out;
}

Estimate Sample::share_below(double limit) const {
  return share([limit](const std::vector<double>& sorted) {
    return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), limit) - sorted.begin());
  });
}

Estimate Sample::share_above(double limit) const {
  return share([limit](const std::vector<double>& sorted) {
    return static_cast<int>(sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), limit));
  });
}

Estimate Sample::share(const std::function<int(const std::vector<double>&)>& count) const {
  Estimate out;
  const int drawn = size() + missing_;
  if (drawn == 0) return out;
  const int inside = count(sorted_);
  if (size() > 0) out.value = static_cast<double>(inside) / size();
  const int replicates = static_cast<int>(replicates_.size());
  const bool many = std::min(inside, size() - inside) >= least_beside * replicates && missing_ == 0;
  const auto own_share = [&](const std::vector<double>& own) {
    return static_cast<double>(count(own)) / static_cast<double>(own.size());
  };
  if (!independent_ && many && by_replicates(own_share, 1, out)) {
    out.low = std::max(0.0, out.low);
    out.high = std::min(1.0, out.high);
    return out;
  }
  const int most = inside + missing_;  // whatever became of those without a value
  out.low = inside == 0 ? 0 : beta_quantile(tail, inside, drawn - inside + 1.0);
  out.high = most == drawn ? 1 : beta_quantile(1 - tail, most + 1.0, drawn - most);
  out.kind = independent_ ? IntervalKind::exact : IntervalKind::as_random;
  return out;
}

}  // namespace tendril::variation
