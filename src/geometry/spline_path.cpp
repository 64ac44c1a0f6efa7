// The interpolating cubic spline, with its arc length by Gauss-Legendre quadrature on intervals that are halved until
// the quadrature agrees with that of the halves, and rotation-minimising frames by double reflection
// (W. Wang, B. Juettler, D. Zheng, Y. Liu: Computation of rotation minimizing frames, ACM TOG 27, 2008).

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/error.h"
#include "geometry/curve.h"

namespace tendril {

namespace {

// Gauss-Legendre rule of 8 points on [-1, 1]; the other four are at the negative places.
constexpr std::array<double, 4> places = {0.18343464249564980, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623};
constexpr std::array<double, 4> shares = {0.36268378337836198, 0.31370664587788729, 0.22238103445337447, 0.10122853629037626};
// Relative to the chord, well below the 1e-9 that lengths are good for.
constexpr double length_tolerance = 1e-13;
constexpr double largest_turn = 0.05;  ///< rad an interval: double reflection then errs by less than 1e-6 rad a turn
constexpr int deepest = 16;

// r(t) = c0 + c1 t + c2 t^2 + c3 t^3 for t in 0 ... span.
struct Cubic {
  Vec3 c0, c1, c2, c3;
  double span;
  Vec3 at(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
  Vec3 velocity(double t) const { return c1 + t * (2 * c2 + 3 * t * c3); }
  Vec3 tangent(double t) const { return velocity(t).normalized(); }
  Vec3 curvature(double t) const {
    const Vec3 v = velocity(t), a = 2 * c2 + 6 * t * c3;
    const double vv = v.squaredNorm();
    return (a - v * (v.dot(a) / vv)) / vv;
  }
  double length(double from, double to) const {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      sum += shares[i] * (velocity(middle + half * places[i]).norm() + velocity(middle - half * places[i]).norm());
    return half * sum;
  }
};

// From here on the curve follows its cubic from parameter t at arc length s.
struct Node {
  double s, t;
  int cubic;
  Frame frame;
};

// The frame at another place of the curve: reflected in the plane between the places, then in that between the reflected tangent
// and the wanted one. Where the way there is nothing but rounding, its direction says nothing and the shortest turn must do.
Frame carried(const Frame& from, const Vec3& to, const Vec3& tangent) {
  const Vec3 way = to - from.at, d1 = from.d1(), d3 = from.d3();
  if (!(way.dot(d3) > 0.5 * way.norm())) return Frame::looking(to, tangent, shortest_turn(d3, tangent) * d1);
  const auto reflected = [](const Vec3& v, const Vec3& normal) -> Vec3 { return v - (2 * normal.dot(v) / normal.squaredNorm()) * normal; };
  return Frame::looking(to, tangent, reflected(reflected(d1, way), tangent - reflected(d3, way)));
}

class SplinePath final : public CurvePath {
 public:
  explicit SplinePath(std::vector<Cubic> cubics) : cubics_(std::move(cubics)) {
    Frame frame = Frame::looking(cubics_[0].c0, cubics_[0].c1);
    for (std::size_t i = 0; i < cubics_.size(); ++i) {
      check_speed(i);
      const Cubic& cubic = cubics_[i];
      divide(static_cast<int>(i), 0, cubic.span, cubic.length(0, cubic.span), 0, frame);
    }
    find_sharpest();
  }
  double length() const override { return length_; }
  Frame frame(double s) const override {
    const auto [node, t] = locate(s);
    const Cubic& cubic = cubics_[node->cubic];
    return carried(node->frame, cubic.at(t), cubic.tangent(t));
  }
  Vec3 curvature(double s) const override {
    const auto [node, t] = locate(s);
    return cubics_[node->cubic].curvature(t);
  }
  Sharpest sharpest() const override { return sharpest_; }
  const std::vector<double>& breaks() const override { return none_; }

 private:
  void check_speed(std::size_t i) const {
    for (int k = 0; k <= 64; ++k) {
      if (cubics_[i].velocity(cubics_[i].span * k / 64).norm() > 1e-4) continue;
      std::ostringstream said;
      said << "curve.spline: between points " << i + 1 << " and " << i + 2
           << " the curve turns back on itself, where it has no direction; add points that lead it around";
      throw UsageError(said.str());
    }
  }

  void divide(int cubic, double from, double to, double whole, int depth, Frame& frame) {
    const Cubic& c = cubics_[cubic];
    const double middle = 0.5 * (from + to), first = c.length(from, middle), second = c.length(middle, to);
    const double turn = std::acos(std::clamp(c.tangent(from).dot(c.tangent(to)), -1.0, 1.0));
    const bool good = std::abs(first + second - whole) <= length_tolerance * c.span && turn <= largest_turn;
    if (depth < 2 || (!good && depth < deepest)) {
      divide(cubic, from, middle, first, depth + 1, frame);
      divide(cubic, middle, to, second, depth + 1, frame);
      return;
    }
    nodes_.push_back({length_, from, cubic, frame});
    length_ += whole;
    frame = carried(frame, c.at(to), c.tangent(to));
  }

  // The interval that holds s and the parameter there: Newton's method on the arc length, kept within the interval.
  std::pair<const Node*, double> locate(double s) const {
    const auto after = std::upper_bound(nodes_.begin() + 1, nodes_.end(), s,
                                        [](double value, const Node& node) { return value < node.s; });
    const Node& node = *(after - 1);
    const Cubic& cubic = cubics_[node.cubic];
    const bool last_of_cubic = after == nodes_.end() || after->cubic != node.cubic;
    double low = node.t, high = last_of_cubic ? cubic.span : after->t;
    double t = std::clamp(node.t + (s - node.s) / cubic.velocity(node.t).norm(), low, high);
    for (int i = 0; i < 60; ++i) {
      const double over = node.s + cubic.length(node.t, t) - s;
      if (std::abs(over) <= 1e-14 * length_) break;
      (over > 0 ? high : low) = t;
      const double next = t - over / cubic.velocity(t).norm();
      t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return {&node, t};
  }

  // Samples every interval, then narrows down around each sample that may hide the sharpest place.
  void find_sharpest() {
    constexpr int samples = 8;
    double best = 0;
    std::vector<double> at, value;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const double to = i + 1 < nodes_.size() ? nodes_[i + 1].s : length_;
      for (int k = 0; k < samples; ++k) {
        at.push_back(nodes_[i].s + (to - nodes_[i].s) * k / samples);
        value.push_back(curvature(at.back()).norm());
      }
    }
    at.push_back(length_);
    value.push_back(curvature(length_).norm());
    best = *std::max_element(value.begin(), value.end());
    if (!(best * length_ > 1e-10)) return;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double before = i > 0 ? value[i - 1] : 0, after = i + 1 < at.size() ? value[i + 1] : 0;
      if (value[i] < 0.9 * best || value[i] < before || value[i] < after) continue;
      const auto [place, curvature] = narrowed(i > 0 ? at[i - 1] : at[i], i + 1 < at.size() ? at[i + 1] : at[i]);
      if (1 / curvature < sharpest_.radius * (1 - 1e-9)) sharpest_ = {1 / curvature, place};
    }
  }

  // Golden-section search for the largest curvature between two arc lengths.
  std::pair<double, double> narrowed(double from, double to) const {
    const double golden = 0.5 * (std::sqrt(5.0) - 1);
    const auto f = [&](double s) { return curvature(s).norm(); };
    double a = to - golden * (to - from), b = from + golden * (to - from), fa = f(a), fb = f(b);
    for (int i = 0; i < 60 && to - from > 1e-12 * length_; ++i) {
      if (fa >= fb) {
        to = b, b = a, fb = fa;
        a = to - golden * (to - from), fa = f(a);
      } else {
        from = a, a = b, fa = fb;
        b = from + golden * (to - from), fb = f(b);
      }
    }
    // The largest may be at an end of the curve, which the search only draws near to.
    const double middle = 0.5 * (from + to);
    std::pair<double, double> best{middle, f(middle)};
    for (double s : {from, to})
      if (f(s) > best.second) best = {s, f(s)};
    return best;
  }

  std::vector<Cubic> cubics_;
  std::vector<Node> nodes_;
  std::vector<double> none_;
  Sharpest sharpest_{std::numeric_limits<double>::infinity(), 0};
  double length_ = 0;
};

// The second derivatives at the points, by the tridiagonal system that makes them continuous.
std::vector<Vec3> second_derivatives(const std::vector<Vec3>& p, const std::vector<double>& h, const Curve::SplineEnds& ends) {
  const std::size_t n = p.size();
  std::vector<double> below(n, 0), diagonal(n, 1), above(n, 0);
  std::vector<Vec3> right(n, Vec3::Zero());
  for (std::size_t i = 1; i + 1 < n; ++i) {
    below[i] = h[i - 1];
    diagonal[i] = 2 * (h[i - 1] + h[i]);
    above[i] = h[i];
    right[i] = 6 * ((p[i + 1] - p[i]) / h[i] - (p[i] - p[i - 1]) / h[i - 1]);
  }
  if (ends.start) {
    diagonal[0] = 2 * h[0];
    above[0] = h[0];
    right[0] = 6 * ((p[1] - p[0]) / h[0] - ends.start->normalized());
  }
  if (ends.finish) {
    diagonal[n - 1] = 2 * h[n - 2];
    below[n - 1] = h[n - 2];
    right[n - 1] = 6 * (ends.finish->normalized() - (p[n - 1] - p[n - 2]) / h[n - 2]);
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = below[i] / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    right[i] -= factor * right[i - 1];
  }
  right[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) right[i] = (right[i] - above[i] * right[i + 1]) / diagonal[i];
  return right;
}

}  // namespace

std::unique_ptr<const CurvePath> make_spline_path(const std::vector<Vec3>& points, const Curve::SplineEnds& ends) {
  std::vector<double> h;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) h.push_back((points[i + 1] - points[i]).norm());
  const std::vector<Vec3> m = second_derivatives(points, h, ends);
  std::vector<Cubic> cubics;
  for (std::size_t i = 0; i < h.size(); ++i)
    cubics.push_back({points[i], (points[i + 1] - points[i]) / h[i] - h[i] / 6 * (2 * m[i] + m[i + 1]), 0.5 * m[i],
                      (m[i + 1] - m[i]) / (6 * h[i]), h[i]});
  return std::make_unique<SplinePath>(std::move(cubics));
}

}  // namespace tendril
