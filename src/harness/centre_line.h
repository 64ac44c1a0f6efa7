// The centre line of a harness segment as its file draws it, and whether what the file says of it fits together.
#pragma once

#include <string>
#include <vector>

#include "harness/harness_file.h"
#include "harness/harness_spline.h"

namespace tendril {

class CentreLine {
 public:
  /// Several curves follow each other; without any, the line is straight from node to node. Of the two readings of curves
  /// without knots it takes the one that meets the nodes, itself and the stated length better.
  CentreLine(const HarnessFile& file, const HarnessSegment& segment);

  double length() const { return reached_.back(); }  ///< m
  Vec3 at(double s) const;                           ///< m
  Vec3 tangent(double s) const;                      ///< unit vector; where the curve stands still, that of the chord
  double min_bend_radius() const;                    ///< m, over 64 places of each piece; infinite for a straight one
  KnotReading reading() const { return reading_; }

  /// How far the line is from what the file says beside it, m; 0 where it does not say.
  double start_gap = 0, finish_gap = 0;  ///< between its ends and the nodes
  double inner_gap = 0;                  ///< the largest between two of its curves
  double length_off = 0;                 ///< its length less the stated one

  /// Ends and curves meet within 0.5 mm, the length fits within 0.5 mm or 0.2 %.
  bool sound() const;
  /// Empty for a sound line; else what is wrong, in mm.
  std::string complaint() const;

 private:
  CentreLine(const HarnessFile& file, const HarnessSegment& segment, KnotReading reading);
  double misfit() const;
  const SplineSpan& span_at(double s, double& t) const;

  KnotReading reading_ = KnotReading::clamped;
  std::vector<SplineSpan> spans_;
  std::vector<double> reached_;  ///< arc length at the pieces' ends, from 0
  double stated_ = 0;
};

}  // namespace tendril
