// What a sample of outcomes says of a measure, and how well it is known: every estimate with a 95 % confidence interval.
//
// Independent outcomes: the mean by Student's t; the deviation by Bonett's interval (Comput. Stat. Data Anal. 50, 2006), which
// takes heavy tails into account; quantiles by order statistics and shares by Clopper and Pearson, both without any assumption
// on the distribution. Sobol' points and Latin hypercubes are not independent: there every estimate comes from independent
// replicates, by Student's t; where a replicate holds too few outcomes for that (a quantile far out), the interval is that of
// independent outcomes and says so. Outcomes that failed have no value: a share's interval holds whatever they are.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "method/variation/outcomes.h"

namespace tendril::variation {

/// How an interval was made.
enum class IntervalKind {
  none,          ///< too few outcomes
  student,       ///< mean, independent outcomes
  bonett,        ///< deviation
  order,         ///< quantile by order statistics; open where no outcome can bound it
  exact,         ///< share, Clopper and Pearson
  replicates,    ///< Student's t over independent replicates
  as_random,     ///< of independent outcomes, though these are not
  delta,         ///< a ratio of means, to first order
};

/// "Student", "Bonett", "order statistics", ...
const char* name_of(IntervalKind kind);

struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  IntervalKind kind = IntervalKind::none;
  double half_width() const { return 0.5 * (high - low); }
};

/// The values of one measure over all outcomes. Jumped outcomes count: they are equilibria.
class Sample {
 public:
  /// `replicates`: how many independent sets the outcomes belong to in turn; 1: all independent.
  Sample(const Outcomes& outcomes, int measure, int replicates = 1);
  /// Values in the order of outcomes, NaN for those without one; `missing`: how many more were drawn but have no value.
  explicit Sample(std::vector<double> values, int replicates = 1, int missing = 0);

  int size() const { return static_cast<int>(sorted_.size()); }
  int missing() const { return missing_; }
  double min() const;  ///< NaN for an empty sample, as all that follows
  double max() const;
  Estimate mean() const;
  Estimate deviation() const;  ///< standard deviation, unbiased in its square
  /// `share` of the outcomes lies below (linear between order statistics). Throws UsageError unless 0 < share < 1.
  Estimate quantile(double share) const;
  Estimate share_below(double limit) const;
  Estimate share_above(double limit) const;
  const std::vector<double>& sorted() const { return sorted_; }

 private:
  template <class Statistic>
  bool by_replicates(const Statistic& statistic, int least, Estimate& out) const;
  Estimate share(const std::function<int(const std::vector<double>&)>& count) const;

  std::vector<double> sorted_;
  std::vector<std::vector<double>> replicates_;  ///< sorted; empty: independent outcomes
  int missing_ = 0;
  bool independent_ = true;
};

}  // namespace tendril::variation
