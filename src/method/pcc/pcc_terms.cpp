#include "method/pcc/pcc_terms.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tendril::routing {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Gaps are looked for so much farther than they matter, in the smallest bend radius: samples need not be asked again until
// they have moved by what was found to be spare.
constexpr double spare = 0.05;

}  // namespace

PccTerms::PccTerms(const FreeSpace& space, const PccDemands& demands, const PccUnknowns& unknowns, double margin)
    : space_(space), demands_(demands), unknowns_(unknowns), margin_(margin),
      unit_(*std::min_element(unknowns.radii().begin(), unknowns.radii().end())),
      // A length changes by at most 2 with a vertex; what a metre costs more by a preference adds to it.
      most_(4 * (1 + (space.has_preferences() ? space.demands().preference + space.demands().clearance_weight : 0))),
      sampled_(space.has_obstacles() || space.demands().keep_in || space.has_preferences()) {
  const int m = unknowns.bends();
  // Straights, turns, least and largest length, both ends.
  fixed_ = (m + 1) + m + 2 + 2;
  multipliers_.assign(fixed_, 0);
  slacks_.assign(fixed_, infinity);
}

void PccTerms::plan(const Eigen::VectorXd& x, double spacing) {
  unknowns_.evaluate(x, shape_);
  if (sampled_) samples_.plan(shape_, unknowns_.radii(), spacing, demands_.start_free(), demands_.finish_free(), space_.has_preferences());
  multipliers_.resize(fixed_ + samples_.size());
  slacks_.resize(fixed_ + samples_.size());
  known_.assign(samples_.size(), {Vec3::Zero(), -infinity});
  std::fill(multipliers_.begin() + fixed_, multipliers_.end(), 0.0);
  std::fill(slacks_.begin() + fixed_, slacks_.end(), infinity);
}

bool PccTerms::planned(const Eigen::VectorXd& x) {
  unknowns_.evaluate(x, shape_);
  return !sampled_ || samples_.fits(shape_, unknowns_.radii());
}

double PccTerms::penalty(int term, double slack, double& sum) {
  slacks_[term] = slack;
  const double missed = multipliers_[term] / (2 * weight) - slack;
  if (!(missed > 0)) return 0;
  sum += weight * missed * missed;
  return -2 * weight * missed;
}

void PccTerms::add_demands(double& sum) {
  const int m = unknowns_.bends();
  int term = 0;
  for (int i = 0; i <= m; ++i) {
    const double least = i == 0 || i == m ? demands_.end_straight : demands_.min_straight;
    const double by = penalty(term++, shape_.straights[i] - least - slack, sum);
    if (by != 0) adjoint_.add_straight(shape_, i, by);
  }
  // Where tangents are not what they are in truth a curve could fold up for free.
  const double most = std::min(demands_.max_turn, unknowns_.linear_from - 0.05);
  for (int i = 0; i < m; ++i) adjoint_.turns[i] -= unit_ * penalty(term++, unit_ * (most - shape_.turns[i]), sum);
  double by_length = penalty(term++, shape_.length - demands_.min_length, sum);
  by_length -= std::isfinite(demands_.max_length) ? penalty(term, demands_.max_length - shape_.length, sum) : 0;
  ++term;
  if (by_length != 0) adjoint_.add_length(shape_, unknowns_.radii(), by_length);
  // Directions that are fixed stay as they are; those that follow from a single vertex are held by a cone of zero.
  const double start = unit_ * (demands_.start_cone - unknowns_.start_turn(shape_));
  unknowns_.add_start_turn(shape_, -unit_ * penalty(term++, start, sum), adjoint_);
  const double finish = unit_ * (demands_.finish_cone - unknowns_.finish_turn(shape_));
  unknowns_.add_finish_turn(shape_, -unit_ * penalty(term++, finish, sum), adjoint_);
}

/// Obstacle -1 where it is not below the limit.
Gap PccTerms::gap_of(int sample, double limit) {
  const Vec3& place = samples_.place(sample);
  Known& known = known_[sample];
  if (known.low - (place - known.at).norm() >= limit) return {};
  known = {place, space_.bounds(place).low};
  if (known.low >= limit) return {};
  const Gap gap = space_.gap(place, limit + spare * unit_);
  ++queries_;
  known.low = gap.value;
  return gap.value < limit ? gap : Gap{};
}

double PccTerms::add_samples(double& sum) {
  const std::vector<double>& radii = unknowns_.radii();
  const bool prefers = space_.has_preferences();
  double extra = 0;
  samples_.locate(shape_, radii);
  for (int i = 0; i < samples_.size(); ++i) {
    Vec3 by = Vec3::Zero(), slope;
    double by_length = 0;
    const double limit = margin_ + multipliers_[fixed_ + i] / (2 * weight);
    slacks_[fixed_ + i] = infinity;
    if (samples_.asked(i)) {
      const Gap gap = gap_of(i, limit);
      if (gap.obstacle >= 0) by = penalty(fixed_ + i, gap.value - margin_, sum) * gap.gradient;
    }
    if (prefers) {
      by_length = space_.cost_interpolated(samples_.place(i), &slope, fine_costs) - 1;
      extra += by_length * samples_.length(i);
      by += samples_.length(i) * slope;
    }
    if (by_length != 0 || !by.isZero(0)) samples_.pull_back(i, by, by_length, shape_, radii, adjoint_);
  }
  return extra;
}

double PccTerms::operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
  unknowns_.evaluate(x, shape_);
  adjoint_.reset(unknowns_.bends());
  adjoint_.add_length(shape_, unknowns_.radii(), 1);
  double sum = shape_.length;
  add_demands(sum);
  if (sampled_) sum += add_samples(sum);
  unknowns_.pull_back(x, shape_, adjoint_, gradient);
  return sum;
}

void PccTerms::update_multipliers(bool with_gaps) {
  const int count = with_gaps ? static_cast<int>(multipliers_.size()) : fixed_;
  for (int i = 0; i < count; ++i) {
    multipliers_[i] = slacks_[i] < infinity ? std::max(0.0, multipliers_[i] - 2 * weight * slacks_[i]) : 0;
    if (i >= fixed_) multipliers_[i] = std::min(multipliers_[i], most_);
  }
}

double PccTerms::mismatch(int from, int to) const {
  double worst = 0;
  for (int i = from; i < to; ++i)
    if (i < fixed_ || multipliers_[i] < most_ || slacks_[i] > 0)
      worst = std::max(worst, std::abs(std::min(multipliers_[i] / (2 * weight), slacks_[i])));
  return worst;
}

}  // namespace tendril::routing
