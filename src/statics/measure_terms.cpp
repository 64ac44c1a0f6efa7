#include "statics/measure_terms.h"

#include <algorithm>
#include <cmath>

#include "statics/se3_packs.h"

namespace tendril {
namespace {

/// Right Jacobian of the rotation exp([x]): exp([x + dx]) = exp([x]) exp([J dx]).
Mat3 right_jacobian(const Vec3& x) {
  const double u = x.squaredNorm(), t = std::sqrt(u);
  const double a = t > 1e-2 ? (1 - std::cos(t)) / u : 0.5 - u / 24 + u * u / 720;
  const double b = t > 1e-2 ? (t - std::sin(t)) / (u * t) : 1.0 / 6 - u / 120 + u * u / 5040;
  const Mat3 c = cross_matrix(x);
  return Mat3::Identity() - a * c + b * c * c;
}

Mat3 dense(const M3<double>& m) { return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.e); }

/// phi = log(R_a^T R_b) and A(phi), the inverse left Jacobian.
struct Turn {
  Vec3 phi;
  Mat3 a;
  Turn(const Quat& qa, const Quat& qb) {
    JacobianCoefficients<double> k;
    const V3<double> p = rotation_log<double>(conjugate_times(in_lanes(qa), in_lanes(qb)), k);
    phi = from_lanes(p);
    a = dense(inverse_left_jacobian(p, k.c));
  }
};

/// Arc over chord of a circle whose tangents at the ends have this scalar product, and its derivative by the product.
struct ArcOverChord {
  double value, slope;
  explicit ArcOverChord(double cosine) {
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)), half = 0.5 * angle;
    value = angle > 1e-4 ? half / std::sin(half) : 1 + angle * angle / 24;
    if (angle > 1e-2)
      slope = -(0.5 * std::sin(half) - 0.5 * half * std::cos(half)) / (std::sin(half) * std::sin(half) * std::sin(angle));
    else
      slope = -(1 + 0.225 * angle * angle) / 12;
  }
};

double component(const Wrench<double>& w, int k) { return k < 3 ? w.n[k] : w.m[k - 3]; }
double& component(Wrench<double>& w, int k) { return k < 3 ? w.n[k] : w.m[k - 3]; }

}  // namespace

RodMeasureTerms::RodMeasureTerms(const RodDerivatives& rod, int index, int first_node, MeasureSlopes& out)
    : rod_(rod),
      mesh_(rod.system().mesh()),
      state_(rod.state()),
      first_(first_node),
      by_state_(out.by_state.data() + first_node),
      by_wrench_(rod.segments()),
      by_rod_(out.by_rod[index]),
      out_(out) {}

int RodMeasureTerms::segment_at(double at) const {
  const auto above = std::upper_bound(mesh_.s.begin(), mesh_.s.end(), at);
  return std::clamp(static_cast<int>(above - mesh_.s.begin()) - 1, 0, rod_.segments() - 1);
}

int RodMeasureTerms::vertex_at(double at) const {
  const int i = segment_at(at);
  return at - mesh_.s[i] > 0.5 * mesh_.segments[i].length ? i + 1 : i;
}

RodMeasureTerms::Place RodMeasureTerms::place_of(double at) const {
  const int i = segment_at(at);
  const double h = mesh_.segments[i].length;
  const double t = std::clamp((at - mesh_.s[i]) / h, 0.0, 1.0);
  const bool end = i == rod_.segments() - 1 && t > 1 - 1e-9;
  return {i, end ? 1 : t, h, end || (i == 0 && t == 0)};
}

/// A place that stays at its arc length slides along a mesh that moves: `slope` is by the share t of the segment.
void RodMeasureTerms::add_share(const Place& place, double slope) {
  if (place.moves_with_mesh) return;
  by_rod_.places[place.segment] -= slope * (1 - place.t) / place.h;
  by_rod_.places[place.segment + 1] -= slope * place.t / place.h;
}

/// The cubic through both vertices along their section normals.
Vec3 RodMeasureTerms::add_point(const Place& place, const Vec3& along) {
  const int a = place.segment, b = a + 1;
  const double t = place.t, u = 1 - t, h = place.h;
  const Vec3 na = state_.q[a] * Vec3::UnitZ(), nb = state_.q[b] * Vec3::UnitZ();
  const double ra = (1 + 2 * t) * u * u, rb = t * t * (3 - 2 * t), ta = t * u * u, tb = -t * t * u;
  const Vec3 by_length = ta * na + tb * nb;
  by_state_[a].head<3>() += ra * along;
  by_state_[b].head<3>() += rb * along;
  by_state_[a].tail<3>() += h * ta * Vec3::UnitZ().cross(state_.q[a].conjugate() * along);
  by_state_[b].tail<3>() += h * tb * Vec3::UnitZ().cross(state_.q[b].conjugate() * along);
  by_rod_.segments[a].length += along.dot(by_length);
  const Vec3 by_t = 6 * t * u * (state_.r[b] - state_.r[a]) + h * (u * (u - 2 * t) * na + t * (t - 2 * u) * nb);
  add_share(place, along.dot(by_t));
  return ra * state_.r[a] + rb * state_.r[b] + h * by_length;
}

void RodMeasureTerms::add_turn(const Place& place, const Vec3& weight) {
  const int a = place.segment, b = a + 1;
  const Turn turn(state_.q[a], state_.q[b]);
  // R = R_a exp(t phi): theta = exp(-t phi) theta_a + t J(t phi) (A^T theta_b - A theta_a).
  const Vec3 by_phi = place.t * right_jacobian(place.t * turn.phi).transpose() * weight;
  by_state_[a].tail<3>() += exp_rotation(place.t * turn.phi) * weight - turn.a.transpose() * by_phi;
  by_state_[b].tail<3>() += turn.a * by_phi;
  add_share(place, weight.dot(turn.phi));
}

Frame RodMeasureTerms::section_at(const Place& place) const {
  const Quat &qa = state_.q[place.segment], &qb = state_.q[place.segment + 1];
  return {Vec3::Zero(), qa * exp_rotation(place.t * log_rotation(qa.conjugate() * qb))};
}

void RodMeasureTerms::add_position(double at, const Vec3& along) { out_.value += along.dot(add_point(place_of(at), along)); }

void RodMeasureTerms::add_rotation(double at, const Vec3& along) {
  const Place place = place_of(at);
  add_turn(place, section_at(place).rotation.conjugate() * along);
}

void RodMeasureTerms::add_tangent(double at, const Vec3& along) {
  const Place place = place_of(at);
  const Vec3 body = section_at(place).rotation.conjugate() * along;
  out_.value += body.z();
  add_turn(place, Vec3::UnitZ().cross(body));
}

void RodMeasureTerms::add_gap(double at, const Vec3& origin, const Vec3& normal) {
  Place place = place_of(at);
  place.moves_with_mesh = true;
  out_.value += normal.dot(add_point(place, normal) - origin) - mesh_.segments[place.segment].section.radius();
  by_rod_.segments[place.segment].radius -= 1;
}

void RodMeasureTerms::add_force(int segment, const Vec3& along) {
  out_.value += along.dot(rod_.force(segment));
  rod_.add_force(segment, along, by_state_, by_rod_);
}

void RodMeasureTerms::add_moment(int segment, const Vec3& along) {
  out_.value += along.dot(from_lanes(rod_.wrench(segment).m));
  by_wrench_.add(segment, {{}, in_lanes(along)});
}

double RodMeasureTerms::tension(int segment) const {
  return rod_.force(segment).dot(section_at({segment, 0.5, 0, true}).d3());
}

void RodMeasureTerms::add_tension(int segment) {
  const Place middle{segment, 0.5, mesh_.segments[segment].length, true};
  const Frame section = section_at(middle);
  const Vec3 force = rod_.force(segment);
  rod_.add_force(segment, section.d3(), by_state_, by_rod_);
  out_.value += force.dot(section.d3());
  add_turn(middle, Vec3::UnitZ().cross(section.rotation.conjugate() * force));
}

int RodMeasureTerms::tightest_segment() const {
  int best = 0;
  double most = tension(0);
  for (int i = 1; i < rod_.segments(); ++i)
    if (const double here = tension(i); here > most) {
      most = here;
      best = i;
    }
  return best;
}

Vec3 RodMeasureTerms::curvature(int segment) const {
  const Se3Segment<double> s = rod_.segment(segment);
  return from_lanes(times(s.flexibility_phi, rod_.wrench(segment).m) + s.rate_phi);
}

Vec3 RodMeasureTerms::strain(int segment) const {
  const Se3Segment<double> s = rod_.segment(segment);
  const Wrench<double> w = rod_.wrench(segment);
  const Vec3 change = from_lanes(times(s.flexibility_phi, w.m));
  return {change.x(), change.y(), w.n.z * s.flexibility_v.z};
}

void RodMeasureTerms::add_twist(int segment) {
  const Se3Segment<double> s = rod_.segment(segment);
  out_.value += curvature(segment).z();
  SegmentChange& explicit_part = by_rod_.segments[segment];
  explicit_part.rate[5] += 1;
  explicit_part.flexibility[5] += rod_.wrench(segment).m.z;
  by_wrench_.add(segment, {{}, {0, 0, s.flexibility_phi.z}});
}

/// |stretch| + radius |curvature change| at mid-segment.
void RodMeasureTerms::add_strain(int segment) {
  const Se3Segment<double> s = rod_.segment(segment);
  const Vec3 e = strain(segment);
  const double radius = mesh_.segments[segment].section.radius(), bend = std::hypot(e.x(), e.y());
  const double sign = e.z() < 0 ? -1 : 1;
  out_.value += std::abs(e.z()) + radius * bend;
  const Vec3 by_bend = bend > 0 ? Vec3(radius * e.x() / bend, radius * e.y() / bend, 0) : Vec3(Vec3::Zero());
  const Wrench<double> w = rod_.wrench(segment);
  SegmentChange& explicit_part = by_rod_.segments[segment];
  explicit_part.flexibility[2] += sign * w.n.z;
  explicit_part.flexibility[3] += by_bend.x() * w.m.x;
  explicit_part.flexibility[4] += by_bend.y() * w.m.y;
  explicit_part.radius += bend;
  by_wrench_.add(segment, {{0, 0, sign * s.flexibility_v.z}, times(in_lanes(by_bend), s.flexibility_phi)});
}

int RodMeasureTerms::most_strained_segment() const {
  int best = 0;
  double most = -1;
  for (int i = 0; i < rod_.segments(); ++i) {
    const Vec3 e = strain(i);
    const double here = std::abs(e.z()) + mesh_.segments[i].section.radius() * std::hypot(e.x(), e.y());
    if (here <= most) continue;
    most = here;
    best = i;
  }
  return best;
}

/// Curvature is known at mid-segments; a vertex takes the mean of its neighbours, an end carries on linearly.
std::vector<RodMeasureTerms::BendWeight> RodMeasureTerms::bend_weights(int vertex) const {
  const int last = rod_.segments() - 1;
  if (last == 0) return {{0, 1}};
  if (vertex == 0) return {{0, 1.5}, {1, -0.5}};
  if (vertex > last) return {{last, 1.5}, {last - 1, -0.5}};
  return {{vertex - 1, 0.5}, {vertex, 0.5}};
}

int RodMeasureTerms::sharpest_vertex() const {
  int best = 0;
  double most = -1;
  for (int i = 0; i <= rod_.segments(); ++i) {
    Vec3 k = Vec3::Zero();
    for (const BendWeight& w : bend_weights(i)) k += w.weight * curvature(w.segment);
    if (k.head<2>().norm() <= most) continue;
    most = k.head<2>().norm();
    best = i;
  }
  return best;
}

void RodMeasureTerms::add_bend_radius(int vertex) {
  Vec3 k = Vec3::Zero();
  const std::vector<BendWeight> weights = bend_weights(vertex);
  for (const BendWeight& w : weights) k += w.weight * curvature(w.segment);
  k.z() = 0;
  const double bend = k.norm();
  out_.value += 1 / bend;
  if (bend == 0) return;  // a straight rod: infinite, and so is any change
  for (const BendWeight& w : weights) {
    const Se3Segment<double> s = rod_.segment(w.segment);
    const Vec3 by_curvature = -w.weight / (bend * bend * bend) * k;
    SegmentChange& explicit_part = by_rod_.segments[w.segment];
    explicit_part.rate.tail<3>() += by_curvature;
    explicit_part.flexibility.tail<3>() += by_curvature.cwiseProduct(from_lanes(rod_.wrench(w.segment).m));
    by_wrench_.add(w.segment, {{}, times(in_lanes(by_curvature), s.flexibility_phi)});
  }
}

void RodMeasureTerms::add_length() {
  for (int i = 0; i < rod_.segments(); ++i) {
    const Vec3 way = state_.r[i + 1] - state_.r[i];
    const Vec3 na = state_.q[i] * Vec3::UnitZ(), nb = state_.q[i + 1] * Vec3::UnitZ();
    const double chord = way.norm();
    const ArcOverChord arc(na.dot(nb));
    out_.value += chord * arc.value;
    const Vec3 by_way = arc.value / chord * way;
    by_state_[i].head<3>() -= by_way;
    by_state_[i + 1].head<3>() += by_way;
    by_state_[i].tail<3>() += chord * arc.slope * Vec3::UnitZ().cross(state_.q[i].conjugate() * nb);
    by_state_[i + 1].tail<3>() += chord * arc.slope * Vec3::UnitZ().cross(state_.q[i + 1].conjugate() * na);
  }
}

/// E_k = h/2 c_k (W_k^2 + q U_k^2): the strain at mid-segment and its variation along it, by component.
void RodMeasureTerms::add_elastic(std::initializer_list<int> components) {
  for (int i = 0; i < rod_.segments(); ++i) {
    const Se3Segment<double> s = rod_.segment(i);
    const Wrench<double> wrench = rod_.wrench(i), variation = rod_.variation(i);
    const Wrench<double> flexibility{s.flexibility_v, s.flexibility_phi};
    Wrench<double> by_wrench{}, by_variation{};
    SegmentChange& explicit_part = by_rod_.segments[i];
    for (const int k : components) {
      const double c = component(flexibility, k), w = component(wrench, k), u = component(variation, k);
      const double square = w * w + s.q * u * u;
      out_.value += 0.5 * s.h * c * square;
      explicit_part.flexibility[k] += 0.5 * s.h * square;
      explicit_part.length += 0.5 * c * (square + 2 * s.q * u * u);
      component(by_wrench, k) = s.h * c * w;
      component(by_variation, k) = s.h * c * s.q * u;
    }
    const Wrench<double> more = detail::adjoint(rod_.rate(i), by_variation);
    const Wrench<double> by_rate = detail::coadjoint(wrench, by_variation);
    by_wrench_.add(i, {by_wrench.n + more.n, by_wrench.m + more.m}, {-by_rate.n, -by_rate.m});
  }
}

void RodMeasureTerms::add_gravity() {
  const Vec3& gravity = rod_.system().problem().gravity;
  for (int i = 0; i < rod_.segments(); ++i) {
    const double h = mesh_.segments[i].length, mass = mesh_.segments[i].section.mass;
    const Vec3 places = state_.r[i] + state_.r[i + 1];
    const Vec3 normals = state_.q[i + 1] * Vec3::UnitZ() - state_.q[i] * Vec3::UnitZ();
    const Vec3 by_mass = -0.5 * h * places + h * h / 12 * normals;
    out_.value += mass * gravity.dot(by_mass);
    by_rod_.segments[i].mass += gravity.dot(by_mass);
    by_rod_.segments[i].length += mass * gravity.dot(-0.5 * places + h / 6 * normals);
    by_rod_.gravity += mass * by_mass;
    for (const int node : {i, i + 1}) {
      by_state_[node].head<3>() -= 0.5 * h * mass * gravity;
      const Vec3 b = state_.q[node].conjugate() * ((node == i ? -1 : 1) * h * h / 12 * mass * gravity);
      by_state_[node].tail<3>() += Vec3(-b.y(), b.x(), 0);
    }
  }
}

void RodMeasureTerms::add_loads() {
  const RodProblem& problem = rod_.system().problem();
  for (std::size_t k = 0; k < problem.loads.size(); ++k) {
    const int node = mesh_.load_vertex[k];
    const Vec3& force = problem.loads[k].force;
    out_.value -= force.dot(state_.r[node]);
    by_state_[node].head<3>() -= force;
    out_.by_load.push_back({first_ + node, (Vec6() << -state_.r[node], Vec3::Zero()).finished()});
  }
}

}  // namespace tendril
