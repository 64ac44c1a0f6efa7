// What is bad about one state of a dress pack: forces at the holds, twist and curvature beyond their limits, as a number with its
// derivatives.
//
// The cost is the sum over attachments of 1/2 s(|F|)^2, and over rods of the mean along them of 1/2 s(twist)^2 + 1/2 s(curvature)^2,
// with s(v) = softplus((v - limit)/scale): nearly zero below the limit, and growing by one with each scale above it. The whole force
// of a hold counts, not its part along the rod alone, which a rod that is pulled sideways does not show.
#pragma once

#include <limits>
#include <vector>

#include "method/dress_pack/pack_statics.h"

namespace tendril::dress_pack {

/// An infinite limit demands nothing.
struct Demand {
  double limit = std::numeric_limits<double>::infinity();
  double scale = 1;
};

struct PackDemands {
  Demand force = {60, 30};   ///< N, of a hold on its rod
  Demand twist = {};         ///< rad/m, change against the unstressed rod
  Demand curvature = {};     ///< 1/m, at the middle of segments
  double clearance = -1;        ///< m, of the rods from all bodies; negative: bodies are not looked at
  double robot_clearance = -1;  ///< m, of the links' bodies from the fixed ones; negative: not looked at

  /// Throws UsageError for limits that are negative or not numbers, and for scales that are not positive.
  void check() const;
};

/// softplus in units of the scale, a fifth of it soft, and its first and second derivative.
struct SoftExcess {
  double value = 0, slope = 0, bend = 0;
};
SoftExcess soft_excess(double v, const Demand& demand);

class PackCost {
 public:
  PackCost(const PackStatics& statics, const PackDemands& demands);

  /// At the state that the statics stands at.
  double value(const PackStatics& statics, const RodState& state) const;

  /// The same with its derivatives, by the end loads (six numbers for each attachment) and by the nodes.
  double slopes(const PackStatics& statics, const RodState& state, Eigen::VectorXd& by_load, std::vector<Vec6>& by_node) const;

 private:
  double add(const PackStatics& statics, const RodState& state, Eigen::VectorXd* by_load, std::vector<Vec6>* by_node) const;
  double add_shape(const RodState& state, std::vector<Vec6>* by_node) const;

  PackDemands demands_;
  struct Segment {
    int node;
    double length, share;   ///< m, of its rod's length
    double rest_twist;      ///< rad/m
  };
  std::vector<Segment> segments_;
};

}  // namespace tendril::dress_pack
