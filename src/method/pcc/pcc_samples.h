// Places along a curve of straights and arcs where its surroundings are asked about, and how they move with the curve.
//
// A place on an arc at the share t of its turn a, with the tangent length T, the directions u- before and u+ after vertex V:
//   V + T (b(t) u+ - b(1 - t) u-),   b(t) = sin^2(t a / 2) / sin^2(a / 2)
// which is regular from a = 0 to a = pi.
#pragma once

#include <vector>

#include "method/pcc/pcc_unknowns.h"

namespace tendril::routing {

class PccSamples {
 public:
  /// Chooses shares of each straight and arc, which stay until the next call: at most `spacing` (m) apart on this shape.
  /// Places within `free_start` and `free_finish` (m) of the ends are not asked about; they are there only with `everywhere` (for
  /// integrals).
  void plan(const PccShape& shape, const std::vector<double>& radii, double spacing, double free_start, double free_finish,
            bool everywhere);
  /// True while no straight or arc has grown to more than 1.5 times the spacing between its samples.
  bool fits(const PccShape& shape, const std::vector<double>& radii) const;

  int size() const { return static_cast<int>(samples_.size()); }
  bool asked(int sample) const { return samples_[sample].asked; }
  const Vec3& place(int sample) const { return samples_[sample].place; }
  /// The length that a sample stands for, m; those of all samples make up the curve (with `everywhere`). Not below 0.
  double length(int sample) const { return samples_[sample].length; }

  void locate(const PccShape& shape, const std::vector<double>& radii);
  /// Adds to the adjoint what a derivative by the sample's place (1/m) and by its length makes. After locate().
  void pull_back(int sample, const Vec3& by_place, double by_length, const PccShape& shape, const std::vector<double>& radii,
                 PccAdjoint& adjoint) const;

 private:
  struct Sample {
    int piece;      ///< even: straight piece / 2; odd: arc of vertex (piece + 1) / 2
    bool asked;
    double share;   ///< 0 ... 1 along the piece
    double weight;  ///< share of the piece's length that it stands for
    Vec3 place = Vec3::Zero();
    double length = 0;
  };
  void add(int piece, double from, double to, double length, bool asked);
  std::vector<Sample> samples_;
  std::vector<double> grown_;  ///< by piece: the length (m) from which on the samples are too far apart
  double spacing_ = 0;
};

}  // namespace tendril::routing
