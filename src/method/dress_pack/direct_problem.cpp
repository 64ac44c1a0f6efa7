#include "method/dress_pack/direct_problem.h"

#include <cmath>
#include <limits>

#include "base/units.h"

namespace tendril::dress_pack {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double turn_of_difference = 1e-4;    // rad, m, units of the wrench: for second derivatives' rate
constexpr double joint_difference = 1e-5;      // rad or m

}  // namespace

DirectProblem::DirectProblem(const PackProblem& pack, const ReducedProblem& start, int steps, const PackDemands& demands,
                             const PathWeights& weights, double seconds)
    : pack_(pack), path_(start.path()), demands_(demands), weights_(weights), statics_(pack), rods_(statics_, demands),
      times_(JointPath::times(steps)) {
  number_variables();
  place_steps(start);
  place_bounds(seconds);
  place_entries();
}

std::vector<DirectProblem::Via> DirectProblem::via_at(double t) const {
  const JointPath::Place place = path_.place(t);
  std::vector<Via> out;
  if (place.first >= 1 && place.first <= free_points() && place.share < 1) out.push_back({place.first - 1, 1 - place.share});
  if (place.first + 1 <= free_points() && place.share > 0) out.push_back({place.first, place.share});
  return out;
}

void DirectProblem::number_variables() {
  const RodNetwork& network = statics_.network();
  force_unit_ = std::isinf(demands_.force.limit) ? 1 : demands_.force.scale;
  const double moment_unit = 0.1 * force_unit_ * network.size();
  column_of_.assign(rods_.size(), -1);
  row_of_.assign(rods_.size(), -1);
  unit_.assign(rods_.size(), 1);
  row_unit_.assign(rods_.size(), 1);
  std::vector<HeldMask> carried(rods_.nodes(), 0);
  for (int k = 0; k < statics_.attachments(); ++k) carried[statics_.node_of(k)] = network.held()[statics_.node_of(k)];
  for (int i = 0; i < rods_.size(); ++i) {
    const bool turns = i % 6 >= 3, wrench = i >= 6 * rods_.nodes();
    (wrench ? unit_ : row_unit_)[i] = turns ? moment_unit : force_unit_;
    const bool held = !wrench && network.held()[i / 6] >> i % 6 & 1, by_link = !wrench && carried[i / 6] >> i % 6 & 1;
    if (!held || by_link) column_of_[i] = step_columns_++;
    if (!held || (by_link && !turns)) row_of_[i] = step_rows_++;
  }
  for (int k = 0; k < statics_.attachments(); ++k) {
    const int node = statics_.node_of(k);
    if (carried[node] & held_position) {
      pulls_.push_back({k, node, step_columns_});
      step_columns_ += 3;
    }
    for (int c = 0; c < 6; ++c)
      if (carried[node] >> c & 1) pose_rows_.push_back({k, c, 6 * node + c, step_rows_++});
  }
}

void DirectProblem::place_steps(const ReducedProblem& from) {
  const double whole = 1.0 / static_cast<double>(times_.size() - 1);
  PackCost cost(statics_, demands_);
  int columns = joints() * std::max(0, free_points()), rows = 0;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const double share = k == 0 || k + 1 == times_.size() ? 0.5 * whole : whole;
    const RodState& state = from.states()[k];
    if (!via_at(times_[k]).empty()) {
      steps_.push_back({times_[k], share, state, columns, rows});
      columns += step_columns_;
      rows += step_rows_;
      continue;
    }
    statics_.load_at(state);
    fixed_cost_ += share * cost.value(statics_, state);
  }
  start.setZero(columns);
  row_lower.setZero(rows);
  row_upper.setZero(rows);
  start.head(from.variables()) = from.values();
  for (const Step& step : steps_) {
    const Eigen::VectorXd numbers = rods_.numbers_of(step.reference);
    for (int i = 0; i < rods_.size(); ++i)
      if (column_of_[i] >= 0) start[step.column + column_of_[i]] = numbers[i] / unit_[i];
    statics_.load_at(step.reference);
    for (const Pull& pull : pulls_)
      start.segment<3>(step.column + pull.column) = statics_.end_load(pull.attachment).head<3>() / force_unit_;
  }
}

void DirectProblem::place_bounds(double seconds) {
  const int n = joints(), free = std::max(0, free_points());
  lower.setConstant(start.size(), -infinite);
  upper.setConstant(start.size(), infinite);
  for (int j = 0; j < free; ++j)
    for (int i = 0; i < n; ++i) {
      lower[j * n + i] = pack_.robot->lower()[i];
      upper[j * n + i] = pack_.robot->upper()[i];
    }
  if (seconds > 0 && free > 0) add_speed_rows(seconds);
}

void DirectProblem::add_speed_rows(double seconds) {
  const int n = joints(), free = free_points();
  std::vector<double> reach_of;
  for (int i = 0; i < n; ++i) {
    const double reach = pack_.robot->variable(i).velocity * seconds / (path_.points() - 1);
    if (std::isinf(reach)) continue;
    for (const auto& [j, end] : {std::pair(0, path_.via().front()[i]), std::pair(free - 1, path_.via().back()[i])}) {
      lower[j * n + i] = std::max(lower[j * n + i], end - reach);
      upper[j * n + i] = std::min(upper[j * n + i], end + reach);
    }
    for (int j = 0; j + 1 < free; ++j) {
      speed_rows_.push_back({(j + 1) * n + i, j * n + i});
      reach_of.push_back(reach);
    }
  }
  const Eigen::Map<const Eigen::VectorXd> reach(reach_of.data(), static_cast<int>(reach_of.size()));
  const int before = static_cast<int>(row_lower.size());
  row_lower.conservativeResize(before + reach.size());
  row_upper.conservativeResize(before + reach.size());
  row_lower.tail(reach.size()) = -reach;
  row_upper.tail(reach.size()) = reach;
}

void DirectProblem::place_entries() {
  const int n = joints(), free = std::max(0, free_points());
  // The effort couples neighbours joint by joint, a step the via points around it.
  for (int j = 0; j < n * free; ++j) {
    hessian_entries.push_back({j, j});
    if (j >= n) hessian_entries.push_back({j, j - n});
  }
  for (const Step& step : steps_) place_step_entries(step);
  for (std::size_t k = 0; k < speed_rows_.size(); ++k) {
    const int row = rows() - static_cast<int>(speed_rows_.size() - k);
    jacobian_entries.push_back({row, speed_rows_[k].plus});
    jacobian_entries.push_back({row, speed_rows_[k].minus});
  }
}

void DirectProblem::place_step_entries(const Step& step) {
  const int n = joints();
  rods_.each_pair(nullptr, [&](int i, int j, double) {
    if (row_of_[i] >= 0 && column_of_[j] >= 0) jacobian_entries.push_back({step.row + row_of_[i], step.column + column_of_[j]});
    if (i != j && row_of_[j] >= 0 && column_of_[i] >= 0) jacobian_entries.push_back({step.row + row_of_[j], step.column + column_of_[i]});
    if (column_of_[i] >= 0 && column_of_[j] >= 0) {
      const int a = step.column + column_of_[i], b = step.column + column_of_[j];
      hessian_entries.push_back({std::max(a, b), std::min(a, b)});
    }
  });
  for (const Pull& pull : pulls_)
    for (int c = 0; c < 3; ++c) {
      jacobian_entries.push_back({step.row + row_of_[6 * pull.node + c], step.column + pull.column + c});
      for (int d = 0; d <= c; ++d) hessian_entries.push_back({step.column + pull.column + c, step.column + pull.column + d});
    }
  const std::vector<Via> via = via_at(step.t);
  for (const PoseRow& row : pose_rows_) {
    jacobian_entries.push_back({step.row + row.row, step.column + column_of_[row.number]});
    for (const Via& one : via)
      for (int j = 0; j < n; ++j) jacobian_entries.push_back({step.row + row.row, one.point * n + j});
  }
  for (const Via& a : via)
    for (const Via& b : via)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          if (a.point * n + i >= b.point * n + j) hessian_entries.push_back({a.point * n + i, b.point * n + j});
}

JointPath DirectProblem::path_of(In x) const {
  std::vector<JointVector> via = path_.via();
  for (int j = 0; j < free_points(); ++j) via[j + 1] = x.segment(j * joints(), joints());
  return JointPath(std::move(via));
}

void DirectProblem::read(const Step& step, In x, Eigen::VectorXd& numbers) const {
  numbers.setZero(rods_.size());
  for (int i = 0; i < rods_.size(); ++i) {
    if (column_of_[i] >= 0) numbers[i] = unit_[i] * x[step.column + column_of_[i]];
    else if (i % 6 < 3) numbers[i] = step.reference.r[i / 6][i % 6];
  }
}

Eigen::Vector3d DirectProblem::force(const Step& step, In x, int held) const {
  return force_unit_ * x.segment<3>(step.column + pulls_[held].column);
}

bool DirectProblem::value(In x, double& f) {
  f = fixed_cost_ + weights_.effort * path_of(x).effort(weights_.joints);
  Eigen::VectorXd numbers;
  for (const Step& step : steps_) {
    read(step, x, numbers);
    if (!rods_.terms(step.reference, numbers, MixedRods::Part::shape, false, terms_)) return false;
    double cost = terms_.value;
    for (std::size_t k = 0; k < pulls_.size(); ++k) {
      const double s = soft_excess(force(step, x, static_cast<int>(k)).norm(), demands_.force).value;
      cost += 0.5 * s * s;
    }
    f += step.share * cost;
  }
  return std::isfinite(f);
}

bool DirectProblem::slope(In x, Out f_x) {
  f_x.setZero();
  const JointPath path = path_of(x);
  const int n = joints(), pieces = path.points() - 1;
  for (int p = 0; p < pieces; ++p)
    for (int i = 0; i < n; ++i) {
      const double weight = weights_.joints.empty() ? 1 : weights_.joints[i];
      const double pull = weights_.effort * pieces * weight * weight * (path.via()[p + 1][i] - path.via()[p][i]);
      if (p >= 1) f_x[(p - 1) * n + i] -= pull;
      if (p < free_points()) f_x[p * n + i] += pull;
    }
  Eigen::VectorXd numbers;
  for (const Step& step : steps_) {
    read(step, x, numbers);
    if (!rods_.terms(step.reference, numbers, MixedRods::Part::shape, false, terms_)) return false;
    for (int i = 0; i < rods_.size(); ++i)
      if (column_of_[i] >= 0) f_x[step.column + column_of_[i]] += step.share * unit_[i] * terms_.gradient[i];
    for (std::size_t k = 0; k < pulls_.size(); ++k) {
      const Vec3 pull = force(step, x, static_cast<int>(k));
      const SoftExcess s = soft_excess(pull.norm(), demands_.force);
      if (pull.norm() > 0)
        f_x.segment<3>(step.column + pulls_[k].column) += step.share * force_unit_ * s.value * s.slope / pull.norm() * pull;
    }
  }
  return f_x.allFinite();
}

/// The rotation vector, from the reference, of an attachment's pose; of the two that mean it, the one nearest to `near`.
Vec3 DirectProblem::held_rotation_vector(const Step& step, const Frame& pose, const Vec3& near, int k) const {
  const Vec3 short_way = log_rotation(step.reference.q[statics_.node_of(k)].conjugate() * pose.rotation);
  const double angle = short_way.norm();
  if (angle < 1e-9) return short_way;
  const Vec3 long_way = short_way * (1 - 2 * units::pi / angle);
  return (long_way - near).squaredNorm() < (short_way - near).squaredNorm() ? long_way : short_way;
}

void DirectProblem::pose_rows(const Step& step, In x, Out c) const {
  const std::vector<Frame> poses = pack_.poses(path_of(x).at(step.t));
  for (const PoseRow& row : pose_rows_) {
    const Frame& pose = poses[row.attachment];
    const int first = step.column + column_of_[row.number] - row.component % 3;
    const double held = row.component < 3 ? pose.at[row.component]
                                          : held_rotation_vector(step, pose, x.segment<3>(first), row.attachment)[row.component - 3];
    c[step.row + row.row] = x[first + row.component % 3] - held;
  }
}

bool DirectProblem::constraints(In x, Out c) {
  c.setZero();
  Eigen::VectorXd numbers;
  for (const Step& step : steps_) {
    read(step, x, numbers);
    if (!rods_.terms(step.reference, numbers, MixedRods::Part::functional, false, terms_)) return false;
    for (int i = 0; i < rods_.size(); ++i)
      if (row_of_[i] >= 0) c[step.row + row_of_[i]] = terms_.gradient[i] / row_unit_[i];
    for (const Pull& pull : pulls_)
      for (int k = 0; k < 3; ++k) c[step.row + row_of_[6 * pull.node + k]] -= x[step.column + pull.column + k];
    pose_rows(step, x, c);
  }
  for (std::size_t k = 0; k < speed_rows_.size(); ++k)
    c[rows() - static_cast<int>(speed_rows_.size() - k)] = x[speed_rows_[k].plus] - x[speed_rows_[k].minus];
  return c.allFinite();
}

Eigen::MatrixXd DirectProblem::pose_slope(const Step& step, const JointVector& q, In x, int k) const {
  Eigen::MatrixXd all;
  pack_.jacobian(q, all);
  Eigen::MatrixXd out = all.middleRows<6>(6 * k);
  const int number = 6 * statics_.node_of(k) + 3;
  if (column_of_[number] < 0) return out;
  const Vec3 e = held_rotation_vector(step, pack_.poses(q)[k], x.segment<3>(step.column + column_of_[number]), k);
  out.bottomRows<3>() = inverse_rotation_rate(e) * out.bottomRows<3>();
  return out;
}

bool DirectProblem::jacobian(In x, Out entries) {
  int at = 0;
  const JointPath path = path_of(x);
  const int n = joints();
  Eigen::VectorXd numbers;
  for (const Step& step : steps_) {
    read(step, x, numbers);
    if (!rods_.terms(step.reference, numbers, MixedRods::Part::functional, true, terms_)) return false;
    rods_.each_pair(&terms_, [&](int i, int j, double value) {
      if (row_of_[i] >= 0 && column_of_[j] >= 0) entries[at++] = value * unit_[j] / row_unit_[i];
      if (i != j && row_of_[j] >= 0 && column_of_[i] >= 0) entries[at++] = value * unit_[i] / row_unit_[j];
    });
    for (std::size_t k = 0; k < 3 * pulls_.size(); ++k) entries[at++] = -1;
    std::vector<Eigen::MatrixXd> slopes;
    for (int k = 0; k < statics_.attachments(); ++k) slopes.push_back(pose_slope(step, path.at(step.t), x, k));
    const std::vector<Via> via = via_at(step.t);
    for (const PoseRow& row : pose_rows_) {
      entries[at++] = 1;
      for (const Via& one : via)
        for (int j = 0; j < n; ++j) entries[at++] = -one.weight * slopes[row.attachment](row.component, j);
    }
  }
  for (std::size_t k = 0; k < speed_rows_.size(); ++k) {
    entries[at++] = 1;
    entries[at++] = -1;
  }
  return entries.allFinite();
}

/// Second derivative by the joints of the multipliers times the pose's equations.
Eigen::MatrixXd DirectProblem::pose_hessian(const Step& step, const JointVector& q, In x, In multipliers) const {
  const int n = joints();
  const auto gradient = [&](const JointVector& at) {
    JointVector sum = JointVector::Zero(n);
    for (int k = 0; k < statics_.attachments(); ++k) {
      const Eigen::MatrixXd slope = pose_slope(step, at, x, k);
      for (const PoseRow& row : pose_rows_)
        if (row.attachment == k) sum -= multipliers[step.row + row.row] * slope.row(row.component).transpose();
    }
    return sum;
  };
  Eigen::MatrixXd out(n, n);
  for (int j = 0; j < n; ++j) {
    const JointVector by = joint_difference * JointVector::Unit(n, j);
    out.col(j) = (gradient(q + by) - gradient(q - by)) / (2 * joint_difference);
  }
  return 0.5 * (out + out.transpose());
}

bool DirectProblem::step_hessian(const Step& step, In x, double factor, In multipliers, Out entries, int& at) {
  const int n = joints();
  Eigen::VectorXd numbers, along = Eigen::VectorXd::Zero(rods_.size());
  read(step, x, numbers);
  double turn = 1e-300;
  for (int i = 0; i < rods_.size(); ++i) {
    if (row_of_[i] >= 0) along[i] = multipliers[step.row + row_of_[i]] / row_unit_[i];
    turn = std::max(turn, std::abs(along[i]) / unit_[i]);
  }
  const double e = turn_of_difference / turn;
  StepTerms shape;
  if (!rods_.terms(step.reference, numbers + e * along, MixedRods::Part::functional, true, terms_) ||
      !rods_.terms(step.reference, numbers - e * along, MixedRods::Part::functional, true, other_) ||
      !rods_.terms(step.reference, numbers, MixedRods::Part::shape, true, shape))
    return false;
  std::vector<double> behind, bent;
  rods_.each_pair(&other_, [&](int, int, double value) { behind.push_back(value); });
  rods_.each_pair(&shape, [&](int, int, double value) { bent.push_back(value); });
  std::size_t k = 0;
  rods_.each_pair(&terms_, [&](int i, int j, double value) {
    const double both = (value - behind[k]) / (2 * e) + factor * step.share * bent[k];
    ++k;
    if (column_of_[i] >= 0 && column_of_[j] >= 0) entries[at++] = unit_[i] * unit_[j] * both;
  });
  for (std::size_t p = 0; p < pulls_.size(); ++p) {
    const Vec3 pull = force(step, x, static_cast<int>(p));
    const double size = pull.norm(), scale = factor * step.share * force_unit_ * force_unit_;
    const SoftExcess s = soft_excess(size, demands_.force);
    const Vec3 way = size > 0 ? Vec3(pull / size) : Vec3(Vec3::Zero());
    const double sideways = size > 0 ? s.value * s.slope / size : 0;
    const Mat3 twice = scale * ((s.slope * s.slope + s.value * s.bend - sideways) * way * way.transpose() + sideways * Mat3::Identity());
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d <= c; ++d) entries[at++] = twice(c, d);
  }
  const Eigen::MatrixXd poses = pose_hessian(step, path_of(x).at(step.t), x, multipliers);
  const std::vector<Via> via = via_at(step.t);
  for (const Via& a : via)
    for (const Via& b : via)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          if (a.point * n + i >= b.point * n + j) entries[at++] = a.weight * b.weight * poses(i, j);
  return true;
}

bool DirectProblem::hessian(In x, double factor, In multipliers, Out entries) {
  const int n = joints(), pieces = path_.points() - 1;
  int at = 0;
  for (int j = 0; j < n * std::max(0, free_points()); ++j) {
    const double weight = weights_.joints.empty() ? 1 : weights_.joints[j % n];
    const double k = factor * weights_.effort * pieces * weight * weight;
    entries[at++] = 2 * k;
    if (j >= n) entries[at++] = -k;
  }
  for (const Step& step : steps_)
    if (!step_hessian(step, x, factor, multipliers, entries, at)) return false;
  return entries.allFinite();
}

}  // namespace tendril::dress_pack
