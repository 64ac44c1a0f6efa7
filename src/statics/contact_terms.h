// Contact as a further term of Newton's method: energy, gradient and second derivative, and the step guards.
#pragma once

#include <memory>

#include "statics/contact_guards.h"
#include "statics/newton.h"

namespace tendril {

class ContactTerms final : public FurtherTerms {
 public:
  /// Points along the rod of `system` against its problem's surroundings, which must outlive this. Points within one
  /// radius of a held position take no part: a rod leaves its fitting there.
  ContactTerms(const RodSystem& system, Element element);

  double assemble(const RodState& state, Stress stress, BlockSystem& system) override;
  double energy(const RodState& state) override;
  double allowed(const RodState& state, const std::vector<Vec6>& step, double share) override;
  bool stiffen(const RodState& state, const std::vector<Vec6>& step, double share) override;
  void stepped(const RodState& before, const std::vector<Vec6>& step, double share) override;

  /// To be called before a Newton run at the state it starts from: notes crossings, forgets what the last run left.
  /// The forces of the set's law before a change are kept as prediction.
  void begin(const RodState& state);

  /// A run on the soft law need not end when a point is nearly through (distance below 0.35 radii) and the guards keep
  /// cutting the step (below 0.7, three times running): then the next step is refused.
  void set_early_end(bool on) { early_end_ = on; }

  /// Exact curvature in every matrix (energy descent, inertia), or the mixed-stress one.
  void set_exact(bool on) { exact_ = on; }

  ContactSet& set() { return *set_; }
  const ContactSet& set() const { return *set_; }
  ContactGuard& guard() { return *guard_; }

  /// Evaluates the set at a state unless it stands there already. Returns the energy.
  double stand_at(const RodState& state);

  /// Where the rod between the points, looked at four times more finely, overlaps deepest (m; negative: nowhere).
  struct Deepest {
    double penetration = -1;
    int obstacle = -1;
    ContactPoint point{};
  };
  Deepest deepest_at(const RodState& state);

  /// Adds points where the rod overlaps more than `most` radii between two points, and `window` radii to both sides: four
  /// times as many there. They form a group (contact_set.h). Returns how many were added.
  int refine(const RodState& state, double most, double window = 1.5);

  /// Gives the points around those that overlap more than `most` radii one shift in common.
  void group_deep_points(const RodState& state, double most);

  /// The same around given arc lengths: where an earlier solution had contact between this set's points.
  int refine_around(const std::vector<double>& arc_lengths);

 private:
  Deepest deepest_between(int i, const VertexShape& shape) const;
  int refine_intervals(const std::vector<int>& intervals, double window);
  void replace_set(std::vector<ContactPoint> points, const std::vector<double>& shifts);
  bool near_hold(double s, double radius) const;

  const RodSystem* system_;
  Element element_;
  std::vector<double> radii_;        ///< per segment
  std::vector<double> held_s_;       ///< arc lengths of held positions
  std::unique_ptr<ContactSet> set_;
  std::unique_ptr<ContactGuard> guard_;
  std::vector<Vec3> x_;
  double energy_ = 0;
  bool standing_ = false;
  bool exact_ = false, early_end_ = false;
  int cut_short_ = 0;
  int stiffened_ = 0;
  std::vector<Blockade> blockades_;  ///< of the last guarded step
  std::vector<Blockade> springs_;    ///< in the matrix until a step is made
};

}  // namespace tendril
