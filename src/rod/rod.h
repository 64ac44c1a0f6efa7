// The design of one rod: how long it is, what it is made of, what shape it has without load.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/frame.h"
#include "rod/section.h"

namespace tendril {

/// A part of a rod with one section: from the end of the part before up to arc length `upto` (m).
struct RodPart {
  double upto = 0;
  Section section;
};

/// An immutable rod design. Arc lengths are those of the unstressed rod, 0 ... length.
struct Rod {
  /// Reference (unstressed) shape of a preformed rod: the frame at an arc length. Only relative frames matter.
  /// Empty: straight.
  using Shape = std::function<Frame(double arc_length)>;

  static constexpr int max_segments = 1'000'000;

  double length = 0;            ///< m
  int segments = 40;
  std::vector<RodPart> parts;   ///< at least one; the last ends at `length`
  Shape shape;
  std::vector<double> shape_breaks;  ///< arc lengths where the shape's curvature jumps; the solver puts nodes there

  const Section& section_at(double arc_length) const;
  double largest_radius() const;
  double mass() const;  ///< kg

  /// Throws UsageError unless length, segments (1 ... max_segments) and every section make sense.
  void check() const;

  static Rod uniform(double length, const Section& section, int segments = 40);
};

}  // namespace tendril
