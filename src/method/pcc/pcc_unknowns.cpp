#include "method/pcc/pcc_unknowns.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/units.h"

namespace tendril::routing {

namespace {

// Below this sine (turns of nearly 0 and pi) the direction in which a turn changes is not known: no derivative.
constexpr double least_sine = 1e-12;

/// Adds the derivative of the angle between two unit directions.
void add_turn(const Vec3& in, const Vec3& out, double by, Vec3* to_in, Vec3* to_out) {
  const double cosine = in.dot(out), sine = in.cross(out).norm();
  if (sine < least_sine || by == 0) return;
  if (to_in) *to_in += by / sine * (cosine * in - out);
  if (to_out) *to_out += by / sine * (cosine * out - in);
}

}  // namespace

Vec3 crossing(const Ends& ends) {
  const Vec3 between = ends.finish - ends.start;
  const double cosine = ends.start_along.dot(ends.finish_along), squared_sine = ends.start_along.cross(ends.finish_along).squaredNorm();
  if (!(squared_sine > 1e-20)) return ends.start + 0.5 * between;
  const double p = between.dot(ends.start_along), q = between.dot(ends.finish_along);
  const double along = std::max(0.0, (p - cosine * q) / squared_sine), back = std::max(0.0, (q - cosine * p) / squared_sine);
  return 0.5 * (ends.start + along * ends.start_along + ends.finish - back * ends.finish_along);
}

void PccAdjoint::reset(int bends) {
  points.assign(bends + 2, Vec3::Zero());
  along.assign(bends + 1, Vec3::Zero());
  edges.assign(bends + 1, 0);
  turns.assign(bends, 0);
}

void PccAdjoint::add_straight(const PccShape& shape, int edge, double by) {
  edges[edge] += by;
  if (edge > 0) turns[edge - 1] -= by * shape.tangent_slopes[edge - 1];
  if (edge < static_cast<int>(turns.size())) turns[edge] -= by * shape.tangent_slopes[edge];
}

void PccAdjoint::add_length(const PccShape& shape, const std::vector<double>& radii, double by) {
  for (double& edge : edges) edge += by;
  for (std::size_t i = 0; i < turns.size(); ++i) turns[i] += by * (radii[i] - 2 * shape.tangent_slopes[i]);
}

PccUnknowns::PccUnknowns(const PccDemands& demands, const Ends& ends, const std::vector<double>& radii) : radii_(radii) {
  if (radii.empty()) throw UsageError("pcc: no bends; at least one is expected");
  for (const double radius : radii)
    if (!(radius > 0) || !std::isfinite(radius)) {
      std::ostringstream said;
      said << "pcc: a bend radius of " << radius << " m; a finite one above 0 is expected";
      throw UsageError(said.str());
    }
  move(ends);
  angle_unit_ = 2 * *std::min_element(radii.begin(), radii.end());
  // A single vertex lies on one end's direction; that of the end with the wider cone follows from it.
  start_.tied = demands.start_cone < units::pi;
  finish_.tied = demands.finish_cone < units::pi;
  if (radii.size() == 1 && start_.tied && finish_.tied) (demands.start_cone > demands.finish_cone ? start_ : finish_).tied = false;
  const auto count = [this](End& end, double cone) {
    if (!end.tied) return;
    end.distance = size_++;
    if (!(cone > 0)) return;
    end.angles = size_;
    size_ += 2;
  };
  count(start_, demands.start_cone);
  count(finish_, demands.finish_cone);
  inner_ = size_;
  first_ = start_.tied ? 2 : 1;
  inner_count_ = bends() - (start_.tied ? 1 : 0) - (finish_.tied ? 1 : 0);
  size_ += 3 * inner_count_;
}

void PccUnknowns::move(const Ends& ends) {
  const bool finite = all_finite(ends.start) && all_finite(ends.finish) && all_finite(ends.start_along) && all_finite(ends.finish_along);
  if (!finite || ends.start_along.isZero(0) || ends.finish_along.isZero(0))
    throw UsageError("pcc: an end without a finite place and direction");
  const auto set = [](End& end, const Vec3& at, const Vec3& along, double sign) {
    end.at = at;
    end.along = along.stableNormalized();
    end.side = end.along.unitOrthogonal();
    end.up = end.along.cross(end.side);
    end.sign = sign;
  };
  set(start_, ends.start, ends.start_along, 1);
  set(finish_, ends.finish, ends.finish_along, -1);
}

Ends PccUnknowns::pull_to_ends(const Eigen::VectorXd& x, const PccAdjoint& adjoint) const {
  const int m = bends();
  Ends by;
  by.start = adjoint.points[0];
  by.finish = adjoint.points[m + 1];
  by.start_along = by.finish_along = Vec3::Zero();
  if (start_.tied) {
    by.start += adjoint.points[1];
    by.start_along = adjoint.along.front() + x[start_.distance] * adjoint.points[1];
  }
  if (finish_.tied) {
    by.finish += adjoint.points[m];
    by.finish_along = adjoint.along.back() - x[finish_.distance] * adjoint.points[m];
  }
  return by;
}

Vec3 PccUnknowns::direction(const End& end, const Eigen::VectorXd& x) const {
  if (end.angles < 0) return end.along;
  // The exponential map of the sphere: the angle turned by is the length of (p, q).
  const double p = x[end.angles] / angle_unit_, q = x[end.angles + 1] / angle_unit_, angle = std::hypot(p, q);
  const double share = angle > 1e-8 ? std::sin(angle) / angle : 1;
  return std::cos(angle) * end.along + share * (p * end.side + q * end.up);
}

void PccUnknowns::place_end(const End& end, const Vec3& vertex, Eigen::VectorXd& x) const {
  if (!end.tied) return;
  const Vec3 way = end.sign * (vertex - end.at);
  x[end.distance] = way.dot(end.along);
  const double off = (way - x[end.distance] * end.along).norm();
  if (end.angles < 0) return;
  x[end.distance] = way.norm();
  const double angle = std::atan2(off, way.dot(end.along));
  if (off > 0) {
    x[end.angles] = angle_unit_ * angle * way.dot(end.side) / off;
    x[end.angles + 1] = angle_unit_ * angle * way.dot(end.up) / off;
  }
}

Eigen::VectorXd PccUnknowns::nearest(const PccPoints& curve) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size_);
  place_end(start_, curve.points[1], x);
  place_end(finish_, curve.points[bends()], x);
  for (int i = 0; i < inner_count_; ++i) x.segment<3>(inner_ + 3 * i) = curve.points[first_ + i];
  return x;
}

void PccUnknowns::evaluate(const Eigen::VectorXd& x, PccShape& shape) const {
  const int m = bends();
  shape.points.resize(m + 2);
  shape.along.resize(m + 1);
  for (auto* numbers : {&shape.edges, &shape.straights}) numbers->resize(m + 1);
  for (auto* numbers : {&shape.turns, &shape.tangents, &shape.tangent_slopes}) numbers->resize(m);
  shape.points.front() = start_.at;
  shape.points.back() = finish_.at;
  if (start_.tied) {
    shape.along.front() = direction(start_, x);
    shape.edges.front() = x[start_.distance];
    shape.points[1] = start_.at + x[start_.distance] * shape.along.front();
  }
  if (finish_.tied) {
    shape.along.back() = direction(finish_, x);
    shape.edges.back() = x[finish_.distance];
    shape.points[m] = finish_.at - x[finish_.distance] * shape.along.back();
  }
  for (int i = 0; i < inner_count_; ++i) shape.points[first_ + i] = x.segment<3>(inner_ + 3 * i);
  for (int i = start_.tied ? 1 : 0; i < (finish_.tied ? m : m + 1); ++i) {
    const Vec3 edge = shape.points[i + 1] - shape.points[i];
    shape.edges[i] = edge.norm();
    shape.along[i] = shape.edges[i] > 0 ? Vec3(edge / shape.edges[i]) : i > 0 ? shape.along[i - 1] : start_.along;
  }
  shape.length = 0;
  for (int i = 0; i <= m; ++i) shape.length += shape.straights[i] = shape.edges[i];
  const double half = std::tan(0.5 * linear_from), slope = 0.5 * (1 + half * half);
  for (int i = 0; i < m; ++i) {
    const double turn = turn_between(shape.along[i], shape.along[i + 1]), tangent = std::tan(0.5 * turn);
    const bool linear = turn > linear_from;
    shape.turns[i] = turn;
    shape.tangents[i] = radii_[i] * (linear ? half + slope * (turn - linear_from) : tangent);
    shape.tangent_slopes[i] = radii_[i] * (linear ? slope : 0.5 * (1 + tangent * tangent));
    shape.straights[i] -= shape.tangents[i];
    shape.straights[i + 1] -= shape.tangents[i];
    shape.length += radii_[i] * turn - 2 * shape.tangents[i];
  }
}

void PccUnknowns::add_start_turn(const PccShape& shape, double by, PccAdjoint& adjoint) const {
  add_turn(start_.along, shape.along.front(), by, nullptr, &adjoint.along.front());
}

void PccUnknowns::add_finish_turn(const PccShape& shape, double by, PccAdjoint& adjoint) const {
  add_turn(finish_.along, shape.along.back(), by, nullptr, &adjoint.along.back());
}

void PccUnknowns::pull_end(const End& end, const Eigen::VectorXd& x, double edge, const Vec3& along, const Vec3& vertex,
                           Eigen::VectorXd& gradient) const {
  const Vec3 way = end.sign * vertex;  // by the vector from the end to its vertex, in the curve's sense
  gradient[end.distance] = edge + way.dot(direction(end, x));
  if (end.angles < 0) return;
  const Vec3 by = along + x[end.distance] * way;
  const double p = x[end.angles] / angle_unit_, q = x[end.angles + 1] / angle_unit_, angle = std::hypot(p, q);
  const Vec3 off = p * end.side + q * end.up;
  const double share = angle > 1e-8 ? std::sin(angle) / angle : 1;
  const double bend = angle > 1e-4 ? (std::cos(angle) - share) / (angle * angle) : -1.0 / 3;
  const double common = bend * off.dot(by) - share * end.along.dot(by);
  gradient[end.angles] = (share * end.side.dot(by) + p * common) / angle_unit_;
  gradient[end.angles + 1] = (share * end.up.dot(by) + q * common) / angle_unit_;
}

void PccUnknowns::pull_back(const Eigen::VectorXd& x, const PccShape& shape, PccAdjoint& adjoint, Eigen::VectorXd& gradient) const {
  const int m = bends();
  gradient.resize(size_);
  for (int i = 0; i < m; ++i)
    add_turn(shape.along[i], shape.along[i + 1], adjoint.turns[i], &adjoint.along[i], &adjoint.along[i + 1]);
  for (int i = start_.tied ? 1 : 0; i < (finish_.tied ? m : m + 1); ++i) {
    const Vec3 &along = shape.along[i], &by = adjoint.along[i];
    Vec3 edge = adjoint.edges[i] * along;
    if (shape.edges[i] > 0) edge += (by - by.dot(along) * along) / shape.edges[i];
    adjoint.points[i + 1] += edge;
    adjoint.points[i] -= edge;
  }
  if (start_.tied) pull_end(start_, x, adjoint.edges.front(), adjoint.along.front(), adjoint.points[1], gradient);
  if (finish_.tied) pull_end(finish_, x, adjoint.edges.back(), adjoint.along.back(), adjoint.points[m], gradient);
  for (int i = 0; i < inner_count_; ++i) gradient.segment<3>(inner_ + 3 * i) = adjoint.points[first_ + i];
}

}  // namespace tendril::routing
