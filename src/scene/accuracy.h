// Error against run time: the same scene solved with more and more segments.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "scene/scene.h"

namespace tendril {

struct AccuracyOptions {
  std::vector<int> segments{10, 20, 40, 80, 160, 320};  ///< of every rod
  SolveOptions solve;          ///< element, clamp and tolerance; `error` asks for the estimates too
  double seconds_each = 0.05;  ///< solves are repeated for about this long, 3 to 2000 times
  /// Richardson: every row solves with half its segments too and extrapolates the centre line to the places that both
  /// meshes have; error and time are those of the two together. `segments` must be even then.
  bool extrapolate = false;
  /// The exact centre line (m, world axes) of each rod (its number in the scene) at an arc length, where it is known;
  /// empty: a fine solution is the reference.
  std::function<Vec3(std::size_t rod, double s)> exact;
};

struct AccuracyRow {
  int segments = 0;
  double seconds = 0;       ///< median of the repeated cold solves of all rods, without building trees
  double fastest = 0;       ///< s, the shortest of them: what is left when nothing else ran meanwhile
  double error = 0;         ///< m, largest distance of a vertex from the reference at the same arc length
  double order = 0;         ///< observed against the row before; NaN in the first
  double estimate = 0;      ///< m, what ErrorEstimate said; NaN when not asked for or not valid
  int iterations = 0;
  Status status = Status::stalled;
};

struct Accuracy {
  std::vector<AccuracyRow> rows;
  SolveOptions solve;                ///< as they were asked for
  bool row_extrapolated = false;     ///< every row is extrapolated, as it was asked for
  int reference_segments = 0;        ///< se3 element; with Richardson extrapolation where its order is the fourth; 0: exact
  bool extrapolated = false;         ///< the reference is
  double reference_uncertainty = 0;  ///< m, what the last refinement of the reference still changed; errors below are noise
  Status status = Status::solved;    ///< not solved: the reference could not be had, or the time was up
  std::string message;

  /// True when an error in the rows is not well above what is known of the reference.
  bool unresolved() const;

  /// "se3", "staggered" or "staggered, thesis's clamp"; with ", extrapolated" behind it where the rows are.
  std::string element() const;
};

/// Solves `scene` for each number of segments. Throws UsageError for an empty list, for numbers of segments out of range
/// and for odd ones where the rows are extrapolated. The scene is not changed.
Accuracy study_accuracy(const Scene& scene, const AccuracyOptions& options = {}, const RunContext& context = {});

}  // namespace tendril
