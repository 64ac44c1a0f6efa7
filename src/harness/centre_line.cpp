#include "harness/centre_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"

namespace tendril {
namespace {

constexpr double most_gap = 0.5e-3, most_length_off = 0.5e-3, most_relative_off = 2e-3;

HarnessCurve straight(const Vec3& from, const Vec3& to) { return {1, {from, to}, {}, {}}; }

bool all_have_knots(const HarnessSegment& segment) {
  return std::all_of(segment.curves.begin(), segment.curves.end(), [](const HarnessCurve& c) { return !c.knots.empty(); });
}

}  // namespace

CentreLine::CentreLine(const HarnessFile& file, const HarnessSegment& segment, KnotReading reading) : reading_(reading) {
  const Vec3 from = file.nodes[segment.start].at, to = file.nodes[segment.finish].at;
  const std::vector<HarnessCurve> drawn = segment.curves.empty() ? std::vector{straight(from, to)} : segment.curves;
  reached_.push_back(0);
  for (const HarnessCurve& curve : drawn) {
    const std::size_t begin = spans_.size();
    for (SplineSpan& span : spans_of(curve, reading)) {
      reached_.push_back(reached_.back() + span.length());
      spans_.push_back(std::move(span));
    }
    if (begin > 0 && spans_.size() > begin)
      inner_gap = std::max(inner_gap, (spans_[begin].values(0).at - spans_[begin - 1].values(1).at).norm());
  }
  if (spans_.empty()) {  // knots that coincide throughout
    spans_.emplace_back(straight(from, to), knots_of(straight(from, to), KnotReading::clamped), 1);
    reached_.push_back(spans_.back().length());
  }
  stated_ = segment.virtual_length;
  end_ = whole_length();
  measure(from, to);
}

void CentreLine::measure(const Vec3& from, const Vec3& to) {
  start_gap = (at(0) - from).norm();
  finish_gap = (at(length()) - to).norm();
  length_off = stated_ > 0 ? length() - stated_ : 0;
}

CentreLine::CentreLine(const HarnessFile& file, const HarnessSegment& segment)
    : CentreLine(file, segment, KnotReading::clamped) {
  if (segment.curves.empty()) return;
  if (!all_have_knots(segment)) {
    CentreLine other(file, segment, KnotReading::unclamped);
    if (other.misfit() < misfit()) *this = std::move(other);
  }
  if (!sound() && stated_ > 0 && stated_ < length()) cut_to(file.nodes[segment.start].at, file.nodes[segment.finish].at);
}

void CentreLine::cut_to(const Vec3& from, const Vec3& to) {
  CentreLine part = *this;
  part.begin_ = nearest(from);
  part.end_ = nearest(to);
  if (!(part.begin_ < part.end_)) return;
  part.measure(from, to);
  if (!part.sound()) return;
  part.cut_off = length() - part.length();
  *this = std::move(part);
}

/// Arc length of the whole line where it is nearest to `p`: the best of many places, then ever closer around it.
double CentreLine::nearest(const Vec3& p) const {
  constexpr int places = 64;
  const int count = places * static_cast<int>(spans_.size());
  const auto distance = [&](double s) { return (at(s) - p).squaredNorm(); };  // of the whole: nothing is cut off yet
  double step = whole_length() / count, best = 0, least = distance(0);
  for (int k = 1; k <= count; ++k)
    if (const double d = distance(k * step); d < least) {
      least = d;
      best = k * step;
    }
  for (; step > 1e-9 * whole_length(); step *= 0.5)
    for (const double s : {best - 0.5 * step, best + 0.5 * step})
      if (const double d = distance(s); d < least) {
        least = d;
        best = std::clamp(s, 0.0, whole_length());
      }
  return best;
}

double CentreLine::misfit() const { return start_gap + finish_gap + inner_gap + std::abs(length_off); }

bool CentreLine::sound() const {
  return start_gap <= most_gap && finish_gap <= most_gap && inner_gap <= most_gap && length() > 0 &&
         std::abs(length_off) <= std::max(most_length_off, most_relative_off * stated_);
}

std::string CentreLine::complaint() const {
  if (sound()) return "";
  const auto mm = [](double metres) { return number_text(1e3 * metres) + " mm"; };
  std::string text;
  const auto add = [&](bool wrong, const std::string& what) {
    if (wrong) text += (text.empty() ? "" : ", ") + what;
  };
  add(length() <= 0, "its centre line has no length");
  add(start_gap > most_gap, "its centre line begins " + mm(start_gap) + " from its start node");
  add(finish_gap > most_gap, "its centre line ends " + mm(finish_gap) + " from its end node");
  add(inner_gap > most_gap, "its curves are " + mm(inner_gap) + " apart");
  add(std::abs(length_off) > std::max(most_length_off, most_relative_off * stated_),
      "its centre line is " + mm(length()) + " long, stated are " + mm(stated_));
  return text;
}

CentreLine::Place CentreLine::place_on(int span, double t, double s) const {
  const SplineSpan::Values v = spans_[span].values(t);
  if (v.first.norm() > 1e-9 * spans_[span].length()) return {s, v.at, v.first.normalized()};
  const Vec3 chord = spans_[span].values(std::min(1.0, t + 0.01)).at - spans_[span].values(std::max(0.0, t - 0.01)).at;
  return {s, v.at, chord.norm() > 0 ? Vec3(chord.normalized()) : Vec3(Vec3::UnitX())};
}

CentreLine::Place CentreLine::place(double s) const {
  const double whole = std::clamp(begin_ + s, begin_, end_);
  const auto after = std::upper_bound(reached_.begin(), reached_.end(), whole);
  const int span = std::clamp(static_cast<int>(after - reached_.begin()) - 1, 0, static_cast<int>(spans_.size()) - 1);
  return place_on(span, spans_[span].parameter(std::clamp(whole - reached_[span], 0.0, spans_[span].length())), s);
}

std::vector<CentreLine::Place> CentreLine::places(int each) const {
  std::vector<Place> found = {place(0)};
  for (int span = 0; span < static_cast<int>(spans_.size()); ++span)
    for (int k = 0; k < each; ++k) {
      const double t = (k + 0.5) / each, s = reached_[span] + spans_[span].length_to(t) - begin_;
      if (s > 0 && s < length()) found.push_back(place_on(span, t, s));
    }
  found.push_back(place(length()));
  return found;
}

double CentreLine::min_bend_radius() const {
  constexpr int places = 64;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t span = 0; span < spans_.size(); ++span) {
    if (reached_[span + 1] <= begin_ || reached_[span] >= end_) continue;
    for (int k = 0; k <= places; ++k) {
      const SplineSpan::Values v = spans_[span].values(double(k) / places);
      const double bend = v.first.cross(v.second).norm();
      if (bend > 0) smallest = std::min(smallest, std::pow(v.first.norm(), 3) / bend);
    }
  }
  return smallest;
}

}  // namespace tendril
