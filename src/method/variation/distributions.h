// Distribution functions of statistics, and their inverses.
#pragma once

namespace tendril::variation {

double normal_below(double z);             ///< share of a standard normal distribution below z
double normal_quantile(double share);      ///< its inverse, 0 < share < 1
double student_quantile(double share, double freedom);
/// The smallest count that a binomial distribution stays at or below with at least this probability.
int binomial_quantile(double share, int trials, double chance);
double binomial_below(int count, int trials, double chance);  ///< probability of at most `count`
double beta_quantile(double share, double a, double b);

}  // namespace tendril::variation
