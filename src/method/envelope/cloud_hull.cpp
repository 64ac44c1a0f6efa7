#include "method/envelope/cloud_hull.h"

#include <algorithm>
#include <cmath>

#include "method/envelope/directions.h"

namespace tendril::envelope {
namespace {

int filled_up(int count) { return (count + 15) / 16 * 16; }

}  // namespace

Vec3 CloudHull::place(const Point& p) const {
  const PointArrays& points = clouds_[p.cloud].points;
  return {points.x[p.index], points.y[p.index], points.z[p.index]};
}

void CloudHull::build(const Kernel& kernel, std::span<const Cloud> clouds, double tolerance) {
  kernel_ = &kernel;
  clouds_ = clouds;
  tolerance_ = tolerance;
  find_candidates();
  thin_ = !find_line();
  if (!thin_ && !begin_solid()) thin_ = true;
  if (thin_) {
    measure_line();
    return;
  }
  for (int c = 0; c < static_cast<int>(clouds_.size()); ++c)
    for (int i = 0; i < clouds_[c].settled; ++i) insert({c, i});
  for (const Point& candidate : candidates_)
    if (hull_.height(place(candidate)) > tolerance_) insert(candidate);
  insert_farthest();
  collect_outermost();
}

// The extreme points of all directions, each once, and the two that lie farthest apart in one of them.
void CloudHull::find_candidates() {
  candidates_.clear();
  float widest = -1;
  for (int k = 0; k < direction_pairs; ++k) {
    Point low{0, clouds_[0].extremes[k].low_index}, high{0, clouds_[0].extremes[k].high_index};
    float lowest = clouds_[0].extremes[k].low, highest = clouds_[0].extremes[k].high;
    for (int c = 1; c < static_cast<int>(clouds_.size()); ++c) {
      const Extreme& other = clouds_[c].extremes[k];
      if (other.low < lowest) lowest = other.low, low = {c, other.low_index};
      if (other.high > highest) highest = other.high, high = {c, other.high_index};
    }
    candidates_.push_back(low);
    candidates_.push_back(high);
    if (highest - lowest > widest) {
      widest = highest - lowest;
      ends_[0] = low;
      ends_[1] = high;
    }
  }
  std::sort(candidates_.begin(), candidates_.end());
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
}

// False when all candidates lie within the tolerance of the line between the ends.
bool CloudHull::find_line() {
  start_ = place(ends_[0]);
  finish_ = place(ends_[1]);
  const Vec3 along = (finish_ - start_).normalized();
  if (!((finish_ - start_).norm() > tolerance_)) return false;
  for (const Point& candidate : candidates_)
    if (along.cross(place(candidate) - start_).norm() > tolerance_) return true;
  return false;
}

// The segment of the line that all points project to, and how far they lie from it.
void CloudHull::measure_line() {
  const Vec3 from = start_, chord = finish_ - start_;
  const double length = chord.norm();
  const Vec3 along = length > 0 ? Vec3(chord / length) : Vec3::Zero();
  double first = 0, last = length;
  deviation_ = 0;
  for (int c = 0; c < static_cast<int>(clouds_.size()); ++c)
    for (int i = 0; i < clouds_[c].count; ++i) {
      const Vec3 away = place({c, i}) - from;
      const double at = along.dot(away);
      first = std::min(first, at);
      last = std::max(last, at);
      deviation_ = std::max(deviation_, (away - at * along).norm());
    }
  start_ = from + first * along;
  finish_ = from + last * along;
}

// Four candidates far from each other; a flat cloud gets thickness from two points of no weight above and below it.
bool CloudHull::begin_solid() {
  const Vec3 along = (finish_ - start_).normalized();
  Point third{}, fourth{};
  double farthest = -1, highest = -1;
  for (const Point& candidate : candidates_) {
    const double away = along.cross(place(candidate) - start_).norm();
    if (away > farthest) farthest = away, third = candidate;
  }
  const Vec3 normal = along.cross(place(third) - start_).normalized();
  for (const Point& candidate : candidates_) {
    const double above = std::abs(normal.dot(place(candidate) - start_));
    if (above > highest) highest = above, fourth = candidate;
  }
  const bool flat = highest < 2 * tolerance_;
  const Vec3 middle = (start_ + finish_ + place(third)) / 3;
  const Vec3 lift = 2 * tolerance_ * normal;
  if (flat) fourth = {auxiliary, 0};
  if (!hull_.begin({start_, finish_, place(third), flat ? Vec3(middle + lift) : place(fourth)})) return false;
  inserted_ = {ends_[0], ends_[1], third, fourth};
  if (hull_.points()[1] != finish_) std::swap(inserted_[1], inserted_[2]);
  if (flat && hull_.insert(middle - lift)) inserted_.push_back({auxiliary, 0});
  return true;
}

bool CloudHull::insert(const Point& p) {
  if (!hull_.insert(place(p))) return false;
  inserted_.push_back(p);
  return true;
}

// Points within the hull of the candidates are done; of the others, the farthest first, those that lie too far outside
// become corners.
void CloudHull::insert_farthest() {
  const int facets = hull_.size();
  planes_.resize(4 * facets);
  float largest = 0;
  for (int f = 0; f < facets; ++f) {
    const Vec3 normal = hull_.normal(f);
    for (int k = 0; k < 3; ++k) planes_[k * facets + f] = static_cast<float>(normal[k]);
    planes_[3 * facets + f] = static_cast<float>(hull_.offset(f));
    largest = std::max(largest, std::abs(planes_[3 * facets + f]));
  }
  const float* rows = planes_.data();
  const PlaneArrays planes{rows, rows + facets, rows + 2 * facets, rows + 3 * facets, nullptr, facets};
  for (const Vec3& corner : {start_, finish_}) largest = std::max(largest, static_cast<float>(corner.cwiseAbs().maxCoeff()));
  const float rounding = 2e-6f * largest;

  outside_.clear();
  for (int c = 0; c < static_cast<int>(clouds_.size()); ++c) {
    heights_.resize(clouds_[c].points.count);
    kernel_->distances(clouds_[c].points, planes, heights_.data());
    for (int i = 0; i < clouds_[c].count; ++i)
      if (heights_[i] > -rounding) outside_.push_back({heights_[i], {c, i}});
  }
  std::sort(outside_.begin(), outside_.end(), [](const Outside& a, const Outside& b) {
    return a.height != b.height ? a.height > b.height : a.point < b.point;
  });
  for (const Outside& one : outside_) {
    if (one.height <= tolerance_) break;
    if (hull_.height(place(one.point)) > tolerance_) insert(one.point);
  }
}

void CloudHull::collect_outermost() {
  std::vector<Point>& points = candidates_;  // no longer needed
  points.clear();
  for (const Point& p : inserted_)
    if (p.cloud != auxiliary) points.push_back(p);
  for (const Outside& one : outside_) points.push_back(one.point);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  outermost_count_ = filled_up(static_cast<int>(points.size()));
  outermost_.resize(3 * outermost_count_);
  for (int i = 0; i < outermost_count_; ++i) {
    const Point& p = points[i < static_cast<int>(points.size()) ? i : 0];
    const PointArrays& from = clouds_[p.cloud].points;
    outermost_[i] = from.x[p.index];
    outermost_[outermost_count_ + i] = from.y[p.index];
    outermost_[2 * outermost_count_ + i] = from.z[p.index];
  }
}

PointArrays CloudHull::outermost() const {
  const float* rows = outermost_.data();
  return {rows, rows + outermost_count_, rows + 2 * outermost_count_, outermost_count_};
}

void CloudHull::corners_of(int c, double tolerance, std::vector<int>& out) const {
  out.clear();
  const std::vector<char> corner = hull_.corners();
  for (std::size_t i = 0; i < inserted_.size(); ++i)
    if (inserted_[i].cloud == c && corner[i]) out.push_back(inserted_[i].index);
  for (const Outside& one : outside_)
    if (one.point.cloud == c && hull_.height(place(one.point)) > (one.point.index < clouds_[c].settled ? 0 : tolerance))
      out.push_back(one.point.index);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

}  // namespace tendril::envelope
