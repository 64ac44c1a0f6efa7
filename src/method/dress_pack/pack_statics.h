// The equilibrium equations of a dress pack as a function of where its holds are: factorised once at a state, they say how the
// rods and what acts on the holds change when the robot moves.
//
// With the gradient g of all terms, free unknowns x and the increments c of the attached holds:
//     dx/dc = -K_xx^-1 K_xc,      dF/dc = K_cc + K_cx dx/dc  for the end forces and moments F = g_c.
// Increments are those of block_system.h. Rotations' second derivatives in them are not symmetric where the gradient is not zero:
// K_cc has half of the cross matrix of the moment beside its symmetric part (a derivative by theta of a gradient m in the section's
// axes is H theta + m x theta / 2). At free nodes in equilibrium that part is zero.
//
// Not done: contact, dead moments, holds that slide, staggered elements.
#pragma once

#include <memory>
#include <vector>

#include "method/dress_pack/pack.h"
#include "statics/block_ldlt.h"
#include "statics/rod_network.h"

namespace tendril::dress_pack {

/// The vertices of all rods, one after the other.
RodState state_of(const SystemEquilibrium& equilibrium);

class PackStatics {
 public:
  /// The pack must outlive this and have passed check(). Throws UsageError where a rod slides through a hold.
  explicit PackStatics(const PackProblem& pack);

  const PackProblem& pack() const { return pack_; }
  RodNetwork& network() { return *network_; }
  const RodNetwork& network() const { return *network_; }
  int attachments() const { return static_cast<int>(nodes_.size()); }
  int node_of(int attachment) const { return nodes_[attachment]; }

  /// Of the ordinary solver's solution.
  RodState state_of(const SystemEquilibrium& equilibrium) const { return dress_pack::state_of(equilibrium); }
  /// Arc lengths, places, rotations, forces, strains, reactions and energies; no verdict.
  SystemEquilibrium describe(const RodState& state);

  /// Assembles and factorises the exact second derivative. False: it is not positive, so the state is not a stable equilibrium.
  bool stand_at(const RodState& state);

  /// The gradient alone, without second derivative.
  void load_at(const RodState& state) { network_->gradient(state, gradient_); }

  /// At the state last stood at, or asked for by load_at(): the gradient of all terms; at held unknowns what the holds exert on the rods (force in world
  /// axes, N; moment in the section's axes, N m).
  const std::vector<Vec6>& gradient() const { return gradient_; }
  Vec6 end_load(int attachment) const { return gradient_[nodes_[attachment]]; }

  /// How the nodes follow when attachments move by `c`, six numbers each; by node.
  void respond(const Eigen::VectorXd& c, std::vector<Vec6>& step) const;
  /// What that changes of the end loads, six numbers for each attachment; `step`: of respond().
  Eigen::VectorXd load_change(const std::vector<Vec6>& step) const;
  /// Derivative by c of a function of the end loads and the nodes, from its partial derivatives: one solution.
  Eigen::VectorXd pull_back(const Eigen::VectorXd& by_load, std::vector<Vec6> by_node) const;

  /// One motion of the holds to `poses`: the first-order step, then Newton's method with mixed stresses (newton.h) until the next
  /// step would be less than `tolerance`. Leaves `state` where it was and returns false when that leads to nothing stable.
  struct Moved {
    bool ok = false;
    double predicted = 0, corrected = 0;  ///< rad, and share of the length: the first step, and the sum of all later ones
    int iterations = 0;                   ///< factorisations
  };
  Moved move(RodState& state, const std::vector<Frame>& poses, double tolerance = 1e-9);

  /// Puts the nodes of the attachments there; the other nodes stay.
  void place(const std::vector<Frame>& poses, RodState& state) const;

 private:
  void collect_rows();
  int clear_and_factor();
  void zero_held(std::vector<Vec6>& x) const;
  bool correct(RodState& state, double tolerance, Moved& out);
  Vec6 increment(int attachment, const RodState& state, const Frame& pose) const;

  const PackProblem& pack_;
  std::unique_ptr<RodNetwork> network_;
  BlockLdlt ldlt_;
  BlockSystem block_;
  std::vector<Vec6> gradient_;
  std::vector<int> nodes_;             ///< by attachment
  std::vector<int> held_nodes_;        ///< all, attached or not
  struct Row {
    Mat6 diagonal;
    int node[2] = {-1, -1};            ///< neighbours,
    Mat6 block[2];                     ///< their blocks: rows of this node
  };
  std::vector<Row> rows_;              ///< by attachment
  std::vector<Vec6> step_;
};

}  // namespace tendril::dress_pack
