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

  double length() const { return end_ - begin_; }    ///< m
  struct Place {
    double s = 0;                 ///< arc length from the line's start, m
    Vec3 at, tangent;             ///< m; a unit vector, where the curve stands still that of the chord
  };
  Place place(double s) const;
  Vec3 at(double s) const { return place(s).at; }
  /// Both ends and `each` places of every piece between them, in order.
  std::vector<Place> places(int each) const;
  double min_bend_radius() const;          ///< m, over 64 places of each piece; infinite for a straight one
  KnotReading reading() const { return reading_; }

  /// How far the line is from what the file says beside it, m; 0 where it does not say.
  double start_gap = 0, finish_gap = 0;  ///< between its ends and the nodes
  double inner_gap = 0;                  ///< the largest between two of its curves
  double length_off = 0;                 ///< its length less the stated one

  /// Some files keep the curve of a segment that was split as it was before: the line is then the part of it between the nodes,
  /// where that has the stated length. How much was cut off, m, in sum.
  double cut_off = 0;

  /// Ends and curves meet within 0.5 mm, the length fits within 0.5 mm or 0.2 %.
  bool sound() const;
  /// Empty for a sound line; else what is wrong, in mm.
  std::string complaint() const;

 private:
  CentreLine(const HarnessFile& file, const HarnessSegment& segment, KnotReading reading);
  double misfit() const;
  void measure(const Vec3& from, const Vec3& to);
  void cut_to(const Vec3& from, const Vec3& to);
  double nearest(const Vec3& p) const;
  double whole_length() const { return reached_.back(); }
  Place place_on(int span, double t, double s) const;

  KnotReading reading_ = KnotReading::clamped;
  std::vector<SplineSpan> spans_;
  std::vector<double> reached_;  ///< arc length at the pieces' ends, from 0
  double begin_ = 0, end_ = 0;   ///< the part of them that is the line
  double stated_ = 0;
};

}  // namespace tendril
