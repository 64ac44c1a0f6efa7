// Derivatives of one rod's discrete equilibrium equations, and of what is measured on it, by everything the rod is made of:
// each segment's length, flexibilities, reference rates and mass, gravity, and the arc lengths of vertices. What parameter
// of a design moves which of these is another matter (parameter.h).
//
// Not done: the staggered element.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "rod/se3_parameters.h"
#include "statics/rod_system.h"

namespace tendril {

/// Changes of what one segment is, or a number's derivatives by them.
struct SegmentChange {
  double length = 0;                ///< m; the frames of its ends stay
  Vec6 flexibility = Vec6::Zero();  ///< of 1/(GA1, GA2, EA, EI1, EI2, GJ), in that order
  Vec6 rate = Vec6::Zero();         ///< of the reference rates: stretch and shear with e3 included, curvature and twist
  double mass = 0;                  ///< kg/m
  double radius = 0;                ///< m; contact and strain know it

  SegmentChange& operator+=(const SegmentChange& other);
  double dot(const SegmentChange& other) const;
};

/// A number's derivatives by what one rod is made of.
struct RodSlopes {
  std::vector<SegmentChange> segments;
  std::vector<double> places;     ///< by the vertices' arc lengths (1/m), beside what the segments' lengths say
  Vec3 gravity = Vec3::Zero();    ///< by gravity, s^2/m

  explicit RodSlopes(int segment_count = 0) : segments(segment_count), places(segment_count + 1, 0.0) {}
};

/// Derivatives of a function of the segments' wrenches and rates, to be pulled back (rod/se3_parameters.h).
class WrenchSlopes {
 public:
  explicit WrenchSlopes(int segments) : by_wrench_((segments + 3) / 4), by_rate_(by_wrench_.size()), used_(by_wrench_.size(), 0) {}
  void add(int segment, const Wrench<double>& by_wrench, const Wrench<double>& by_rate = {});

 private:
  friend class RodDerivatives;
  std::vector<Wrench<Pack>> by_wrench_, by_rate_;
  std::vector<char> used_;
};

/// One rod of SE(3) elements at one state. All derivatives are exact; they cost about one evaluation of the gradient.
class RodDerivatives {
 public:
  /// Throws UsageError for the staggered element. The system must outlive this.
  explicit RodDerivatives(const RodSystem& system);

  /// To be called first, and at every new state, which must stay until the next one.
  void stand_at(StateView state);

  int segments() const { return count_; }
  const RodSystem& system() const { return *system_; }
  const StateView& state() const { return state_; }

  Se3Segment<double> segment(int i) const;
  Wrench<double> wrench(int i) const;     ///< at mid-segment, in the segment's axes
  Wrench<double> rate(int i) const;       ///< strain and curvature rates, e3 included
  Wrench<double> variation(int i) const;  ///< the wrench's change along the segment
  Vec3 force(int i) const;                ///< internal force in world axes, N

  /// Adds the derivatives of step . gradient, the step being held fixed in the nodes' own axes: elements and weight.
  void add_work(const Vec6* step, RodSlopes& out) const;

  /// Adds the first-order change of the gradient when the segments change, one change for each.
  void add_gradient_change(std::span<const SegmentChange> changes, Vec6* gradient) const;
  /// ... and when gravity changes by `by`.
  void add_gradient_change(const Vec3& by_gravity, Vec6* gradient) const;

  /// Adds the derivatives of a function of the wrenches and rates.
  void add_pull_back(const WrenchSlopes& slopes, Vec6* by_state, RodSlopes& out) const;

  /// Adds the derivatives of weight . n_i, n_i the internal force of segment `i` in world axes.
  void add_force(int i, const Vec3& weight, Vec6* by_state, RodSlopes& out) const;

 private:
  struct WeightSlopes;
  WeightSlopes weight_of(int i, const Vec6* step) const;
  void add_weight(int i, const Vec3& half, const Vec3& slope, Vec6* gradient) const;
  int packs() const { return static_cast<int>(packs_.size()); }
  int lanes_in(int pack) const { return std::min(4, count_ - 4 * pack); }

  const RodSystem* system_;
  int count_;
  std::vector<Se3Segment<Pack>> packs_;
  std::vector<Se3Slopes<Pack>> slopes_;  ///< at the state
  StateView state_;
};

}  // namespace tendril
