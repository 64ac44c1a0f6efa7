#include "statics/first_guess.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.h"

namespace tendril {
namespace {

/// A held place along the rod, with the tangent that the first guess takes there.
struct Station {
  int vertex;
  Frame frame;
  bool oriented;
  double turns;
};

/// p(t) = cubic Hermite curve + bump * 16 t^2 (1-t)^2 * direction, t in 0 ... 1.
struct SpanCurve {
  Vec3 a, b, tangent_a, tangent_b, direction;
  double speed, bump;

  Vec3 at(double t) const {
    const double u = 1 - t;
    return (1 + 2 * t) * u * u * a + t * t * (3 - 2 * t) * b + speed * (t * u * u * tangent_a - t * t * u * tangent_b) +
           16 * bump * t * t * u * u * direction;
  }
  Vec3 slope(double t) const {
    const double u = 1 - t;
    return 6 * t * u * (b - a) + speed * (u * (1 - 3 * t) * tangent_a + t * (3 * t - 2) * tangent_b) +
           32 * bump * t * u * (u - t) * direction;
  }
};

constexpr int samples = 40;
using Lengths = std::array<double, samples + 1>;  ///< arc length up to each sample

double measure(const SpanCurve& curve, Lengths& upto) {
  Vec3 before = curve.a;
  upto[0] = 0;
  for (int i = 1; i <= samples; ++i) {
    const Vec3 here = i == samples ? curve.b : curve.at(i / double(samples));
    upto[i] = upto[i - 1] + (here - before).norm();
    before = here;
  }
  return upto[samples];
}

/// The way in which the span bulges: down, else as its tangents want, else to any side.
Vec3 bulge_direction(const SpanCurve& curve, const Vec3& gravity, const Vec3& side) {
  const Vec3 chord = curve.b - curve.a;
  const Vec3 along = chord.norm() > 0 ? Vec3(chord.normalized()) : curve.tangent_a;
  auto across = [&](const Vec3& v) { return Vec3(v - along * along.dot(v)); };
  if (!gravity.isZero(0)) {
    const Vec3 down = across(gravity.normalized());
    if (down.norm() > 0.1) return down.normalized();
  }
  const Vec3 wanted = across(curve.tangent_a - curve.tangent_b);
  if (wanted.norm() > 0.05) return wanted.normalized();
  const Vec3 other = across(side);
  return other.norm() > 0.05 ? Vec3(other.normalized()) : Vec3(along.unitOrthogonal());
}

/// Gives the curve the arc length `length`: less speed when it is too long, a bump when it is too short.
void fit_length(SpanCurve& curve, double length, Lengths& upto) {
  curve.bump = 0;
  curve.speed = 0.5 * ((curve.b - curve.a).norm() + length);
  if (measure(curve, upto) > length) {
    double low = 0, high = curve.speed;
    for (int i = 0; i < 12; ++i) {
      curve.speed = 0.5 * (low + high);
      (measure(curve, upto) > length ? high : low) = curve.speed;
    }
    return;
  }
  const double bare = upto[samples];
  double bump = std::sqrt(0.375 * std::max(bare, 0.1 * length) * (length - bare));
  double low = 0, low_length = bare, high = 0, high_length = 0;
  for (int i = 0; i < 12; ++i) {
    curve.bump = bump;
    const double got = measure(curve, upto);
    if (std::abs(got - length) < 2e-3 * length) return;
    if (got < length) {
      low = bump;
      low_length = got;
    } else {
      high = bump;
      high_length = got;
    }
    if (high == 0)
      bump *= 2;
    else
      bump = low + (high - low) * std::clamp((length - low_length) / (high_length - low_length), 0.1, 0.9);
  }
}

/// Frames of a span of a rod that is straight without load.
void fill_straight_span(const RodProblem& problem, const RodMesh& mesh, const Station& from, const Station& to,
                        std::vector<Frame>& frames) {
  const double s0 = mesh.s[from.vertex], length = mesh.s[to.vertex] - s0;
  SpanCurve curve{from.frame.at, to.frame.at, from.frame.d3(), to.frame.d3(), Vec3::Zero(), length, 0};
  curve.direction = bulge_direction(curve, problem.gravity, from.frame.d1());
  Lengths upto;
  fit_length(curve, length, upto);
  const double total = upto[samples];
  Quat q = from.frame.rotation;
  Vec3 tangent = from.frame.d3();
  int cell = 0;
  for (int i = from.vertex; i <= to.vertex; ++i) {
    const double want = (mesh.s[i] - s0) / length * total;
    while (cell + 1 < samples && upto[cell + 1] < want) ++cell;
    const double width = upto[cell + 1] - upto[cell];
    const double t = std::clamp((cell + (width > 0 ? (want - upto[cell]) / width : 0)) / samples, 0.0, 1.0);
    Vec3 next = i == to.vertex ? to.frame.d3() : i == from.vertex ? tangent : curve.slope(t);
    const double size = next.norm();
    if (size > 1e-9 * length) {
      next /= size;
      q = shortest_turn(tangent, next) * q;
      tangent = next;
    }
    frames[i] = {i == to.vertex ? to.frame.at : curve.at(t), q};
  }
  const Vec3 left = log_rotation(q.conjugate() * to.frame.rotation);
  const double twist = (to.oriented && from.oriented ? left.z() : 0) + 2 * units::pi * (to.turns - from.turns);
  if (twist != 0)
    for (int i = from.vertex; i <= to.vertex; ++i) {
      const double half = 0.5 * twist * (mesh.s[i] - s0) / length;
      frames[i].rotation = (frames[i].rotation * Quat(std::cos(half), 0, 0, std::sin(half))).normalized();
    }
  if (to.oriented) frames[to.vertex].rotation = to.frame.rotation;
}

/// Frames of a preformed rod's span: the reference shape, its misfit at the end spread along it.
void fill_preformed_span(const RodMesh& mesh, const Station& from, const Station& to, std::vector<Frame>& frames) {
  std::vector<Frame> shape = {Frame{}};
  for (int i = from.vertex; i < to.vertex; ++i) shape.push_back(shape.back() * mesh.segments[i].reference);
  Frame place = from.frame;
  if (!from.oriented) {
    const Vec3 chord = shape.back().at, wanted = to.frame.at - from.frame.at;
    if (chord.norm() > 0 && wanted.norm() > 0)
      place.rotation = shortest_turn(chord.normalized(), wanted.normalized());
  }
  const Frame reached = place * shape.back();
  const Vec3 move = to.frame.at - reached.at;
  const Vec3 turn = to.oriented ? log_rotation(to.frame.rotation * reached.rotation.conjugate()) : Vec3(Vec3::Zero());
  const double s0 = mesh.s[from.vertex], length = mesh.s[to.vertex] - s0;
  for (int i = from.vertex; i <= to.vertex; ++i) {
    const double t = (mesh.s[i] - s0) / length;
    const double share = t * t * (3 - 2 * t);
    const Frame here = place * shape[i - from.vertex];
    const double half = units::pi * (to.turns - from.turns) * t;
    frames[i] = {here.at + share * move,
                 (exp_rotation(share * turn) * here.rotation * Quat(std::cos(half), 0, 0, std::sin(half))).normalized()};
  }
}

/// The held places in order, each with a frame whose d3 is a sensible tangent.
std::vector<Station> stations_of(const RodProblem& problem, const RodMesh& mesh) {
  std::vector<Station> stations;
  for (std::size_t k = 0; k < problem.holds.size(); ++k) {
    const Hold& hold = problem.holds[k];
    if (hold.position)
      stations.push_back({mesh.hold_vertex[k], hold.frame, hold.orientation, hold.turns});
  }
  // A place may be held by two holds, one for the position and one for the orientation.
  for (std::size_t k = 0; k < problem.holds.size(); ++k)
    for (Station& station : stations)
      if (station.vertex == mesh.hold_vertex[k] && problem.holds[k].orientation && !problem.holds[k].position) {
        station.frame.rotation = problem.holds[k].frame.rotation;
        station.turns = problem.holds[k].turns;
        station.oriented = true;
      }
  std::sort(stations.begin(), stations.end(), [](const Station& a, const Station& b) { return a.vertex < b.vertex; });
  for (std::size_t k = 0; k < stations.size(); ++k) {
    if (stations[k].oriented) continue;
    const Vec3 before = stations[k > 0 ? k - 1 : k].frame.at;
    const Vec3 after = stations[std::min(k + 1, stations.size() - 1)].frame.at;
    Vec3 along = after - before;
    if (along.norm() == 0) along = problem.gravity.isZero(0) ? Vec3(Vec3::UnitX()) : problem.gravity;
    stations[k].frame = Frame::looking(stations[k].frame.at, along);
  }
  return stations;
}

}  // namespace

std::vector<Frame> first_guess(const RodProblem& problem, const RodMesh& mesh) {
  const std::vector<Station> stations = stations_of(problem, mesh);
  std::vector<Frame> frames(mesh.vertices());
  frames[stations.front().vertex] = stations.front().frame;
  for (std::size_t k = 1; k < stations.size(); ++k) {
    if (problem.rod.shape)
      fill_preformed_span(mesh, stations[k - 1], stations[k], frames);
    else
      fill_straight_span(problem, mesh, stations[k - 1], stations[k], frames);
  }
  for (int i = stations.front().vertex - 1; i >= 0; --i)
    frames[i] = frames[i + 1] * mesh.segments[i].reference.inverse();
  for (int i = stations.back().vertex; i + 1 < mesh.vertices(); ++i)
    frames[i + 1] = frames[i] * mesh.segments[i].reference;
  return frames;
}

}  // namespace tendril
