#include "harness/harness_spline.h"

#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

// Gauss-Legendre, eight points on -1 ... 1.
constexpr std::array<double, 4> gauss_at = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> gauss_weight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

/// The polar form of the curve over one span, at the parameters `u` (as many as the degree): de Boor's scheme.
Eigen::Vector4d polar_form(const HarnessCurve& curve, const std::vector<double>& knots, int span, const std::vector<double>& u) {
  const int degree = curve.degree;
  std::vector<Eigen::Vector4d> d(degree + 1);
  for (int j = 0; j <= degree; ++j) {
    const int point = span - degree + j;
    const double weight = curve.weights.empty() ? 1 : curve.weights[point];
    d[j] << weight * curve.points[point], weight;
  }
  for (int level = 1; level <= degree; ++level)
    for (int j = degree; j >= level; --j) {
      const double from = knots[span - degree + j], to = knots[span + 1 + j - level];
      const double share = (u[level - 1] - from) / (to - from);
      d[j] = (1 - share) * d[j - 1] + share * d[j];
    }
  return d[degree];
}

double binomial(int n, int k) {
  double found = 1;
  for (int i = 0; i < k; ++i) found = found * (n - i) / (i + 1);
  return found;
}

}  // namespace

std::vector<double> knots_of(const HarnessCurve& curve, KnotReading reading) {
  if (!curve.knots.empty()) return curve.knots;
  const int points = static_cast<int>(curve.points.size()), degree = curve.degree;
  std::vector<double> knots(points + degree + 1);
  for (int k = 0; k < static_cast<int>(knots.size()); ++k)
    knots[k] = reading == KnotReading::unclamped ? k : std::clamp(k, degree, points);
  return knots;
}

SplineSpan::SplineSpan(const HarnessCurve& curve, const std::vector<double>& knots, int span)
    : powers_(curve.degree + 1, Coefficient::Zero()), rational_(!curve.weights.empty()) {
  const int degree = curve.degree;
  // Bezier points are the polar form at mixtures of the span's two ends; from them the powers of t.
  std::vector<double> u(degree, knots[span]);
  std::vector<Coefficient> bezier(degree + 1);
  for (int j = 0; j <= degree; ++j) {
    if (j > 0) u[degree - j] = knots[span + 1];
    bezier[j] = polar_form(curve, knots, span, u);
  }
  for (int k = 0; k <= degree; ++k) {
    for (int j = 0; j <= k; ++j) powers_[k] += ((k - j) % 2 ? -1 : 1) * binomial(k, j) * bezier[j];
    powers_[k] *= binomial(degree, k);
    if (k > 0) rates_.push_back(k * powers_[k]);
  }
  for (int k = 0; k < parts; ++k) reached_[k + 1] = reached_[k] + length_between(double(k) / parts, double(k + 1) / parts);
}

SplineSpan::Values SplineSpan::values(double t) const {
  Coefficient value = Coefficient::Zero(), first = value, second = value;
  for (auto c = powers_.rbegin(); c != powers_.rend(); ++c) {
    second = second * t + 2 * first;
    first = first * t + value;
    value = value * t + *c;
  }
  Values found{value.head<3>(), first.head<3>(), second.head<3>()};
  if (!rational_) return found;
  const double w = value[3];
  found.at /= w;
  found.first = (found.first - first[3] * found.at) / w;
  found.second = (found.second - 2 * first[3] * found.first - second[3] * found.at) / w;
  return found;
}

/// Lengths need nothing else, and most of an import is lengths.
double SplineSpan::speed(double t) const {
  if (rational_) return values(t).first.norm();
  Coefficient rate = Coefficient::Zero();
  for (auto c = rates_.rbegin(); c != rates_.rend(); ++c) rate = rate * t + *c;
  return rate.head<3>().norm();
}

double SplineSpan::length_between(double t0, double t1) const {
  const double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0);
  double sum = 0;
  for (std::size_t k = 0; k < gauss_at.size(); ++k)
    sum += gauss_weight[k] * (speed(middle - half * gauss_at[k]) + speed(middle + half * gauss_at[k]));
  return sum * half;
}

double SplineSpan::length_to(double t) const {
  const int part = std::clamp(static_cast<int>(t * parts), 0, parts - 1);
  return reached_[part] + length_between(double(part) / parts, t);
}

double SplineSpan::parameter(double arc_length) const {
  const auto after = std::upper_bound(reached_.begin(), reached_.end(), arc_length);
  const int part = std::clamp(static_cast<int>(after - reached_.begin()) - 1, 0, parts - 1);
  const double begin = double(part) / parts, end = double(part + 1) / parts;
  const double extent = reached_[part + 1] - reached_[part];
  if (extent <= 0) return begin;
  double t = begin + (end - begin) * std::clamp((arc_length - reached_[part]) / extent, 0.0, 1.0);
  for (int step = 0; step < 20; ++step) {
    const double rate = speed(t), off = reached_[part] + length_between(begin, t) - arc_length;
    if (rate <= 0 || std::abs(off) < 1e-14 * length()) break;
    t = std::clamp(t - off / rate, begin, end);
  }
  return t;
}

std::vector<SplineSpan> spans_of(const HarnessCurve& curve, KnotReading reading) {
  const std::vector<double> knots = knots_of(curve, reading);
  std::vector<SplineSpan> spans;
  for (int k = curve.degree; k < static_cast<int>(curve.points.size()); ++k)
    if (knots[k + 1] > knots[k]) spans.emplace_back(curve, knots, k);
  return spans;
}

}  // namespace tendril
