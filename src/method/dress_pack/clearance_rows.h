// How far a dress pack, and the links that carry it, are from keeping the clearances that are demanded: as a smooth penalty, and as
// single gaps, all with exact derivatives.
//
// A gap is the distance of a point of a rod's centre line from a body, less the radius there; its gradient is the direction away from
// the body, that of the body's motion the opposite at the body's nearest point. A kink of the distance has one of its gradients.
#pragma once

#include <optional>

#include "method/dress_pack/pack_cost.h"
#include "method/dress_pack/pack_gaps.h"
#include "method/dress_pack/robot_gaps.h"

namespace tendril::dress_pack {

/// One gap at one state.
struct ClearanceRow {
  double gap = 0, wanted = 0;     ///< m
  JointVector slope;              ///< d gap / d q, m/rad or m/m
  int rod = -1, link = -1;        ///< one of them
  int body = -1;
  double s = 0;                   ///< m along the rod
};

class ClearanceRows {
 public:
  /// The statics' pack has the bodies; it must outlive this. `states`: how many states are asked about in turn, each close to
  /// what it was before.
  ClearanceRows(const PackStatics& statics, const PackDemands& demands, int states);

  bool any() const { return demands_.clearance >= 0 || demands_.robot_clearance >= 0; }
  const PackBodies& bodies() const { return *bodies_; }

  /// What is demanded, more than was asked for by so much (m).
  void set_reserve(double reserve) { reserve_ = reserve; }
  double reserve() const { return reserve_; }
  /// How much the penalty counts; 0: not at all.
  void set_weight(double weight) { weight_ = weight; }
  double weight() const { return weight_; }

  /// Sum over points of weight * share of the length * 1/2 s(gap)^2, s = softplus((wanted - gap) / scale), and the same over pairs of
  /// link and fixed body.
  double penalty(const RodState& state, const JointVector& q, int k);
  /// With the derivatives added: by nodes, and by the joints where bodies move.
  double penalty(const RodState& state, const JointVector& q, int k, std::vector<Vec6>& by_node, JointVector& by_joint);

  /// The gaps at state k that are smaller than wanted + `margin`: along each rod the smallest of each valley and points a few
  /// radii from it. The statics stand at the state.
  void near(const PackStatics& statics, const RodState& state, const JointVector& q, int k, double margin, std::vector<ClearanceRow>& out);

  /// The gap that falls shortest; `wanted - gap` is not positive where all is kept. Slope left empty.
  std::optional<ClearanceRow> worst(const RodState& state, const JointVector& q, int k);

  /// "hose comes within 12 mm of obstacle 'post', 30 mm are demanded".
  std::string text(const ClearanceRow& row) const;

 private:
  double rods_wanted() const { return demands_.clearance + reserve_; }
  double links_wanted() const { return demands_.robot_clearance + reserve_; }
  double add(const RodState& state, const JointVector& q, int k, std::vector<Vec6>* by_node, JointVector* by_joint);
  void add_body_motion(int body, const Vec3& at, const Vec3& force, const JointVector& q, JointVector& by_joint) const;
  VertexShape shape_at(const RodState& state, int point) const;
  JointVector slope_of(const PackStatics& statics, const RodState& state, const JointVector& q, int point, int body,
                       const PackGaps::Lowest& lowest) const;

  const PackProblem& pack_;
  PackDemands demands_;
  double reserve_ = 0, weight_ = 0;
  std::unique_ptr<PackBodies> bodies_;
  std::unique_ptr<PackGaps> gaps_;
  std::unique_ptr<RobotGaps> links_;               ///< null where links are not looked at
  std::vector<PackGaps::Memory> memory_;           ///< by state
  std::vector<RobotGaps::Memory> link_memory_;
  PackPlaces places_;
};

}  // namespace tendril::dress_pack
