#include "method/variation/variables.h"

#include <algorithm>
#include <cmath>

#include "method/variation/sampler.h"

namespace tendril::variation {
namespace {

using Kind = Parameter::Kind;

/// A preformed rod of another length is cut off, or goes on straight, at its finish: its bends are where the tool makes them.
void cut_at_finish(RodProblem& rod, double shape_length) {
  if (!rod.rod.shape || rod.rod.length <= shape_length) return;
  rod.rod.shape = [shape = rod.rod.shape, shape_length](double s) {
    return s <= shape_length ? shape(s) : shape(shape_length) * Frame{{0, 0, s - shape_length}, Quat::Identity()};
  };
}

/// Two unit vectors normal to `axis` and to each other.
std::pair<Vec3, Vec3> normals_of(const Vec3& axis) {
  const Frame frame = Frame::looking(Vec3::Zero(), axis);
  return {frame.d1(), frame.d2()};
}

}  // namespace

Frame& Variables::frame_at(SystemProblem& problem, const Place& place) {
  switch (place.kind) {
    case Kind::branch_position: return problem.branches[place.index].frame;
    case Kind::joint_position: return problem.branches[place.index].sections[place.section].relative;
    default: return problem.rods[place.rod].holds[place.index].frame;
  }
}

void Variables::draw_piece(const Piece& piece, std::span<const double> u, std::span<double> values) const {
  double* out = &values[piece.column];
  const double* in = &u[piece.column];
  switch (piece.kind) {
    case Piece::Kind::ball: Eigen::Map<Vec3>{out} = in_ball(piece.spread, in[0], in[1], in[2]); break;
    case Piece::Kind::cone: case Piece::Kind::gravity_cone:
      Eigen::Map<Eigen::Vector2d>{out} = in_cone(piece.spread, in[0], in[1]);
      break;
    case Piece::Kind::table_frame: break;
    default: *out = columns_[piece.column].nominal + piece.spread.at(*in);
  }
}

void Variables::draw(int outcome, std::span<const double> u, std::span<double> values) const {
  std::span<const double> joined = u;
  std::vector<double> all, group;
  if (!groups_.empty()) {
    all.assign(u.begin(), u.end());
    for (const Correlated& correlated : groups_)
      for (const std::vector<int>& columns : correlated.columns) {
        group.clear();
        for (const int c : columns) group.push_back(u[c]);
        correlated.copula.join(group);
        for (std::size_t i = 0; i < columns.size(); ++i) all[columns[i]] = group[i];
      }
    joined = all;
  }
  for (const Piece& piece : pieces_) {
    if (!from_table(piece)) draw_piece(piece, joined, values);
    else
      for (int c = piece.column; c < piece.column + piece.columns(); ++c) values[c] = tables_[c][outcome];
  }
}

void Variables::move(const Piece& piece, const double* by, double share, SystemProblem& problem) {
  if (piece.kind == Piece::Kind::gravity_cone) {
    for (RodProblem& rod : problem.rods) {
      if (rod.gravity.isZero(0)) continue;
      const auto [a, b] = normals_of(rod.gravity);
      rod.gravity = exp_rotation(share * (by[0] * a + by[1] * b)) * rod.gravity;
    }
    return;
  }
  Frame& frame = frame_at(problem, piece.place);
  switch (piece.kind) {
    case Piece::Kind::shift: frame.at[piece.axis] += share * by[0]; break;
    case Piece::Kind::ball: frame.at += share * Vec3(by[0], by[1], by[2]); break;
    case Piece::Kind::cone:
      frame.rotation = (frame.rotation * exp_rotation({share * by[0], share * by[1], 0})).normalized();
      break;
    case Piece::Kind::twist: frame.rotation = (frame.rotation * exp_rotation({0, 0, share * by[0]})).normalized(); break;
    default:
      frame.at += share * Vec3(by[0], by[1], by[2]);
      frame.rotation = (exp_rotation(share * Vec3(by[3], by[4], by[5])) * frame.rotation).normalized();
  }
}

void Variables::apply(int system, std::span<const double> values, double share, SystemProblem& problem) const {
  for (const Piece& piece : pieces_) {
    if (piece.kind != Piece::Kind::number) {
      if (piece.place.system < 0 || piece.place.system == system) move(piece, &values[piece.column], share, problem);
      continue;
    }
    if (piece.number.system >= 0 && piece.number.system != system) continue;
    const double by = share * (values[piece.column] - columns_[piece.column].nominal);
    if (by == 0) continue;
    const Parameter& parameter = piece.number.parameter;
    const double before = parameter.kind == Kind::length ? problem.rods[parameter.rod].rod.length : 0;
    change(problem, parameter, by);
    if (parameter.kind == Kind::length) cut_at_finish(problem.rods[parameter.rod], before);
  }
}

bool Variables::reaches(int system) const {
  return std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
    const int own = piece.kind == Piece::Kind::number ? piece.number.system : piece.place.system;
    return own < 0 || own == system;
  });
}

// ---------------------------------------------------------------- covariance

void Variables::add_variance(const Piece& piece, Eigen::MatrixXd& covariance) const {
  const auto set = [&](double variance) {
    for (int c = piece.column; c < piece.column + piece.columns(); ++c) covariance(c, c) = variance;
  };
  if (from_table(piece)) {
    for (int c = piece.column; c < piece.column + piece.columns(); ++c) {
      const Eigen::Map<const Eigen::ArrayXd> values(tables_[c].data(), static_cast<Eigen::Index>(tables_[c].size()));
      covariance(c, c) = (values - values.mean()).square().mean();
    }
    return;
  }
  switch (piece.kind) {
    case Piece::Kind::ball: set(ball_variance(piece.spread)); break;
    case Piece::Kind::cone: case Piece::Kind::gravity_cone: set(cone_variance(piece.spread)); break;
    default: set(piece.spread.variance());
  }
}

/// By drawing: distributions that are not normal change the correlation of the underlying normal numbers.
void Variables::add_group_covariance(Eigen::MatrixXd& covariance) const {
  constexpr int drawn = 4096;
  const Sampler sampler(Sampling::random, 1, dimensions(), drawn, 1);
  std::vector<int> columns;
  for (const Correlated& group : groups_)
    for (const std::vector<int>& members : group.columns) columns.insert(columns.end(), members.begin(), members.end());
  Eigen::MatrixXd values(drawn, dimensions());
  std::vector<double> u(dimensions(), 0.5), row(dimensions());
  for (int k = 0; k < drawn; ++k) {
    for (const int c : columns) u[c] = sampler.at(k, c);
    draw(0, u, row);
    for (int c = 0; c < dimensions(); ++c) values(k, c) = row[c];
  }
  values.rowwise() -= values.colwise().mean().eval();
  for (const int a : columns)
    for (const int b : columns) {
      const double correlation =
          values.col(a).dot(values.col(b)) / std::sqrt(values.col(a).squaredNorm() * values.col(b).squaredNorm());
      if (a != b && std::isfinite(correlation))
        covariance(a, b) = correlation * std::sqrt(covariance(a, a) * covariance(b, b));
    }
}

Eigen::MatrixXd Variables::covariance() const {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(dimensions(), dimensions());
  for (const Piece& piece : pieces_) add_variance(piece, covariance);
  if (!groups_.empty()) add_group_covariance(covariance);
  return covariance;
}

}  // namespace tendril::variation
