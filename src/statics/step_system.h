// The linear system of one Newton step: held unknowns taken out, a shift where the matrix is not positive, dead moments.
#pragma once

#include <vector>

#include "statics/block_ldlt.h"
#include "statics/rod_network.h"

namespace tendril {

class StepSystem {
 public:
  explicit StepSystem(const RodNetwork& network);

  BlockSystem block;  ///< to be assembled before each step

  /// A new computation: no shift.
  void begin();

  /// Takes the held unknowns out and lets the holds' remaining way to their places act on the others.
  void take_out_held(const RodState& state);

  /// Factorises. `only_positive`: with a shift where needed; `try_neutral`: first one for a neutral direction. Returns the
  /// number of pivots that were not positive before any larger shift; adds to `factorisations`.
  int factor(bool only_positive, int& factorisations, bool try_neutral = true);
  /// Factorises without any shift; returns the number of pivots that are not positive.
  int factor_as_is(int& factorisations);
  bool broken() const { return ldlt_.broken(); }

  /// The step, joined sections included.
  void solve(const RodState& state, std::vector<Vec6>& step) const;

  /// In place: x = (matrix)^-1 x with the last factor, held unknowns zero, joined sections filled in; without dead moments.
  void apply_inverse(const RodState& state, std::vector<Vec6>& x) const;

  /// The direction in which the energy curves least, by inverse iteration with the last factor.
  std::vector<Vec6> softest_mode(const RodState& state) const;

  /// The largest of the rods' shifts. Each rod has its own: where one is about to snap through, the others go on undisturbed.
  double shift() const;
  /// What the last factor really has on its diagonal, a neutral direction's lift included.
  double applied_shift() const { return applied_; }
  void relax_shift();  ///< after a full step

 private:
  void add_shift(const std::vector<double>& change);
  std::vector<char> rods_not_positive() const;
  void clear_held(int node, const std::vector<int>& edges);
  void solve_with_moments(const RodState& state, std::vector<Vec6>& step) const;

  const RodNetwork& network_;
  BlockLdlt ldlt_;
  std::vector<Vec6> wanted_;  ///< what is left to the holds' places; empty when they are in place
  std::vector<int> rod_of_;                      ///< by node; of branch points -1
  std::vector<double> shifts_, last_shifts_;     ///< by rod, in its own bending_scale()
  double applied_ = 0;
};

}  // namespace tendril
