// Contact as a further term of Newton's method: energy, gradient and second derivative, and the step guards.
#pragma once

#include "statics/contact_guards.h"
#include "statics/contact_sliding.h"
#include "statics/newton.h"

namespace tendril {

class ContactTerms final : public FurtherTerms {
 public:
  /// Points along the rod of `system` against its problem's surroundings, which must outlive this. Points within one
  /// radius of a held position take no part: a rod leaves its fitting there.
  /// `first_node`: where the rod's nodes begin in the states, steps and systems that are given. `also_held`: arc lengths
  /// (m) of sections that a held branch point holds.
  ContactTerms(const RodSystem& system, Element element, int first_node = 0,
               ClearanceRule clearance = ClearanceRule::judge, const std::vector<double>& also_held = {});
  ContactTerms(const ContactTerms&) = delete;  // parts point at each other
  ContactTerms& operator=(const ContactTerms&) = delete;

  double assemble(const RodState& state, Stress stress, BlockSystem& system) override;
  double energy(const RodState& state) override;
  double allowed(const RodState& state, const std::vector<Vec6>& step, double share) override;
  bool stiffen(const RodState& state, const std::vector<Vec6>& step, double share) override;
  void stepped(const RodState& before, const std::vector<Vec6>& step, double share) override;

  /// Adds gradient and second derivative at a state as it is, without looking for further edges.
  void add_to(const RodState& state, bool exact, BlockSystem& system);

  /// To be called before a Newton run at the state it starts from: notes crossings, forgets what the last run left.
  /// The forces of the set's law before a change are kept as prediction.
  void begin(const RodState& state);

  /// A run on the soft law need not end when a point is nearly through (distance below 0.35 radii) and the guards keep
  /// cutting the step (below 0.7, three times running): then the next step is refused.
  void set_early_end(bool on) { early_end_ = on; }

  /// Exact curvature in every matrix (energy descent, inertia), or the mixed-stress one.
  void set_exact(bool on) { exact_ = on; }

  ContactSet& set() { return set_; }
  const ContactSet& set() const { return set_; }
  const FieldAlong& field() const { return field_; }
  const SlidingContacts& sliding() const { return sliding_; }

  /// True when a force acts where only a part of the obstacle's clearance counts (contact_points.h, kept_at()).
  bool pressed_near_hold() const;
  ContactGuard& guard() { return guard_; }

  /// Evaluates the set at a state unless it stands there already. Returns the energy.
  double stand_at(const RodState& state);

  /// Place of the centre line at an arc length (m).
  Vec3 position_at(double s, const RodState& state) const;

  /// Where the rod between the points, looked at four times more finely, overlaps deepest (m; negative: nowhere).
  struct Deepest {
    double penetration = -1;
    int obstacle = -1;
    ContactPoint point{};
    Vec3 normal = Vec3::Zero();  ///< from the surface to the centre line
  };
  Deepest deepest_at(const RodState& state);

  /// Augmented Lagrangian step of all points at a state: the forces stay, the overlap goes. Where the rod overlaps deeper
  /// between two points than at them, they then rest that much farther off.
  /// Where it overlaps more than `most` radii beside a sliding point there is another edge, and another such point.
  void update_shifts(const RodState& state, double most);

  /// The farthest that a point which carries a force is from where it should touch (m): a shift too large does that.
  double widest_gap(const RodState& state);

  /// After update_shifts(): a law `factor` times as stiff, with shifts that leave the forces what they are.
  void harden(double factor);

  /// Shifts that make up the forces (N) of an earlier solution, by its places; the others become zero.
  void take_forces(const std::vector<ContactForce>& forces);

  /// No forces known: as at first.
  void forget_forces();

 private:
  /// A place where the contact is known: a fixed or a sliding point.
  struct Station {
    double s;
    int point;       ///< the fixed point there or before it
    bool covered;    ///< a sliding point, or one that a sliding point stands for
    double overlap;  ///< m; minus infinity when unknown or none
    int obstacle;
  };
  void list_stations();
  double evaluate(const VertexShape& shape);
  VertexShape shape_of(const RodState& state) const;
  std::span<const Vec6> own(const std::vector<Vec6>& step) const;
  Deepest deepest_between(const Station& low, const Station& high, const VertexShape& shape) const;
  void track_edges(const RodState& state);
  int point_before(double s) const;
  std::vector<ContactPoint> placed_points() const;
  double way_to_hold(double s) const;
  double kept(double s, double radius) const;
  bool grows(int i, int obstacle) const;

  const RodSystem* system_;
  Element element_;
  int first_;                        ///< node
  std::vector<double> radii_;        ///< per segment
  std::vector<double> held_s_;       ///< arc lengths of held positions
  double keep_;                      ///< m, the largest clearance that pushes
  FieldAlong field_;
  ContactSet set_;
  SlidingContacts sliding_;
  ContactGuard guard_;
  std::vector<Vec3> x_;
  std::vector<ContactSet::Cover> covers_;
  std::vector<double> beside_;       ///< how much farther off each fixed point rests than its radius, m
  std::vector<Station> stations_;
  double energy_ = 0;
  bool standing_ = false;
  bool exact_ = false, early_end_ = false;
  int cut_short_ = 0;
  int stiffened_ = 0;
  std::vector<Blockade> blockades_;  ///< of the last guarded step
  std::vector<Blockade> springs_;    ///< in the matrix until a step is made
};

}  // namespace tendril
