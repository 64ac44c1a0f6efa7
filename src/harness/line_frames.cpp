#include "harness/line_frames.h"

#include <algorithm>

namespace tendril {
namespace {

constexpr int places = 24;

/// The frame carried on to another place of the line, with this tangent.
Frame carried(const Frame& from, const Vec3& at, const Vec3& tangent) {
  const Vec3 chord = at - from.at;
  const Vec3 d3 = from.d3();
  // Across a kink, or where the two places are one, the chord says nothing: the shortest turn must do.
  if (!(chord.dot(d3) > 0.5 * chord.norm())) return Frame::looking(at, tangent, shortest_turn(d3, tangent) * from.d1());
  const auto mirrored = [](const Vec3& v, const Vec3& normal) -> Vec3 { return v - 2 * normal.dot(v) / normal.squaredNorm() * normal; };
  const Vec3 d1 = mirrored(from.d1(), chord), between = tangent - mirrored(d3, chord);
  return Frame::looking(at, tangent, between.squaredNorm() < 1e-24 ? d1 : mirrored(d1, between));
}

}  // namespace

LineFrames::LineFrames(CentreLine line) : line_(std::move(line)) {
  for (const CentreLine::Place& place : line_.places(places)) {
    s_.push_back(place.s);
    frames_.push_back(frames_.empty() ? Frame::looking(place.at, place.tangent) : carried(frames_.back(), place.at, place.tangent));
  }
}

Frame LineFrames::at(double s) const {
  const auto after = std::upper_bound(s_.begin(), s_.end(), s);
  const std::size_t before = after == s_.begin() ? 0 : after - s_.begin() - 1;
  const CentreLine::Place place = line_.place(s);
  return carried(frames_[before], place.at, place.tangent);
}

}  // namespace tendril
