#include "method/pcc/pcc_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tendril::routing {

namespace {

// Below this (rad) the leading terms of a series in the turn are exact to rounding.
constexpr double tiny_turn = 1e-5;

double length_of(const PccShape& shape, const std::vector<double>& radii, int piece) {
  return piece % 2 == 0 ? std::max(0.0, shape.straights[piece / 2]) : radii[piece / 2] * shape.turns[piece / 2];
}

/// b(t) for a turn, and its derivative by the turn.
double arc_share(double share, double turn, double* slope) {
  if (turn < tiny_turn) {
    if (slope) *slope = share * share * turn * (1 - share * share) / 6;
    return share * share;
  }
  const double sine = std::sin(0.5 * share * turn), whole = std::sin(0.5 * turn), b = sine * sine / (whole * whole);
  if (slope) *slope = share > 0 ? b * (share * std::cos(0.5 * share * turn) / sine - std::cos(0.5 * turn) / whole) : 0;
  return b;
}

}  // namespace

void PccSamples::add(int piece, double from, double to, double length, bool asked) {
  if (!(to > from)) return;
  const double part = (to - from) * length;
  const int count = std::clamp(static_cast<int>(std::ceil(part / spacing_ - 1e-9)), 1, 100000);
  for (int i = 0; i < count; ++i) {
    Sample sample{piece, asked, from + (i + 0.5) * (to - from) / count, (to - from) / count};
    samples_.push_back(sample);
  }
  grown_[piece] = std::min(grown_[piece], 1.5 * count * spacing_ / (to - from));
}

void PccSamples::plan(const PccShape& shape, const std::vector<double>& radii, double spacing, double free_start,
                      double free_finish, bool everywhere) {
  samples_.clear();
  spacing_ = spacing;
  const int pieces = 2 * static_cast<int>(radii.size()) + 1;
  grown_.assign(pieces, std::numeric_limits<double>::infinity());
  double whole = 0;
  for (int piece = 0; piece < pieces; ++piece) whole += length_of(shape, radii, piece);
  double begin = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double length = length_of(shape, radii, piece);
    const auto share_at = [&](double s) {
      if (length > 0) return std::clamp((s - begin) / length, 0.0, 1.0);
      return begin >= s ? 0.0 : 1.0;
    };
    const double from = share_at(free_start), to = share_at(whole - free_finish);
    if (everywhere) add(piece, 0, std::min(from, to), length, false);
    add(piece, from, to, length, true);
    if (everywhere) add(piece, std::max(from, to), 1, length, false);
    // Just where the free ends end, too: surfaces that the curve comes from are nearest there.
    if (to > from) {
      if (free_start > 0 && from > 0) samples_.push_back({piece, true, from, 0});
      if (free_finish > 0 && to < 1) samples_.push_back({piece, true, to, 0});
    }
    begin += length;
  }
}

bool PccSamples::fits(const PccShape& shape, const std::vector<double>& radii) const {
  for (std::size_t piece = 0; piece < grown_.size(); ++piece)
    if (length_of(shape, radii, static_cast<int>(piece)) > grown_[piece]) return false;
  return true;
}

void PccSamples::locate(const PccShape& shape, const std::vector<double>& radii) {
  for (Sample& sample : samples_) {
    const int i = sample.piece / 2;
    const double length = length_of(shape, radii, sample.piece);
    sample.length = sample.weight * length;
    if (sample.piece % 2 == 0) {
      const double begin = i > 0 ? shape.tangents[i - 1] : 0;
      sample.place = shape.points[i] + (begin + sample.share * shape.straights[i]) * shape.along[i];
    } else {
      const double after = shape.tangents[i] * arc_share(sample.share, shape.turns[i], nullptr);
      const double before = shape.tangents[i] * arc_share(1 - sample.share, shape.turns[i], nullptr);
      sample.place = shape.points[i + 1] + after * shape.along[i + 1] - before * shape.along[i];
    }
  }
}

void PccSamples::pull_back(int index, const Vec3& by, double by_length, const PccShape& shape, const std::vector<double>& radii,
                           PccAdjoint& adjoint) const {
  const Sample& sample = samples_[index];
  const int i = sample.piece / 2;
  if (sample.piece % 2 == 0) {
    const double begin = i > 0 ? shape.tangents[i - 1] : 0, onwards = by.dot(shape.along[i]);
    adjoint.points[i] += by;
    adjoint.along[i] += (begin + sample.share * shape.straights[i]) * by;
    if (i > 0) adjoint.turns[i - 1] += onwards * shape.tangent_slopes[i - 1];
    double by_straight = sample.share * onwards;
    if (shape.straights[i] > 0) by_straight += by_length * sample.weight;
    adjoint.add_straight(shape, i, by_straight);
    return;
  }
  double after_slope, before_slope;
  const double tangent = shape.tangents[i], slope = shape.tangent_slopes[i];
  const double after = arc_share(sample.share, shape.turns[i], &after_slope);
  const double before = arc_share(1 - sample.share, shape.turns[i], &before_slope);
  adjoint.points[i + 1] += by;
  adjoint.along[i + 1] += tangent * after * by;
  adjoint.along[i] -= tangent * before * by;
  adjoint.turns[i] += (slope * after + tangent * after_slope) * by.dot(shape.along[i + 1]) -
                      (slope * before + tangent * before_slope) * by.dot(shape.along[i]) + by_length * sample.weight * radii[i];
}

}  // namespace tendril::routing
