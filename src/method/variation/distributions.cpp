#include "method/variation/distributions.h"

#include <boost/math/policies/policy.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

namespace tendril::variation {
namespace {

using namespace boost::math::policies;
/// Double precision throughout: nothing here needs more.
using Plain = policy<promote_double<false>, domain_error<ignore_error>, overflow_error<ignore_error>>;

}  // namespace

double normal_below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

double normal_quantile(double share) { return -std::sqrt(2.0) * boost::math::erfc_inv(2 * share, Plain()); }

double beta_quantile(double share, double a, double b) { return boost::math::ibeta_inv(a, b, share, Plain()); }

/// By the beta distribution that t^2 / (t^2 + freedom) has.
double student_quantile(double share, double freedom) {
  if (share == 0.5) return 0;
  const double tail = share < 0.5 ? share : 1 - share;
  double complement = 0;  // 1 - x, without cancellation
  const double x = boost::math::ibeta_inv(0.5 * freedom, 0.5, 2 * tail, &complement, Plain());
  const double t = std::sqrt(freedom * complement / x);
  return share < 0.5 ? -t : t;
}

double binomial_below(int count, int trials, double chance) {
  if (count < 0) return 0;
  if (count >= trials) return 1;
  return boost::math::ibetac(count + 1.0, static_cast<double>(trials - count), chance, Plain());
}

int binomial_quantile(double share, int trials, double chance) {
  int low = -1, high = trials;  // too few, enough
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (binomial_below(middle, trials, chance) >= share ? high : low) = middle;
  }
  return high;
}

}  // namespace tendril::variation
