// LDL^T of a sparse symmetric matrix of 6x6 blocks, without pivoting and, once sized, without allocation.
#pragma once

#include <vector>

#include "rod/lanes.h"
#include "statics/elimination.h"

namespace tendril {

/// Factorises and solves in the order of an Elimination. The signs of D are the matrix's inertia.
class BlockLdlt {
 public:
  explicit BlockLdlt(const BlockPattern& pattern);

  /// Factorises and forward-eliminates the gradient in the same sweep. Returns the number of pivots that are not
  /// positive: zero means positive definite. The factor is usable unless `broken()`.
  int factor(const BlockSystem& system);

  /// step = -(matrix)^-1 gradient, for the gradient given to factor().
  void newton_step(std::vector<Vec6>& step) const;

  /// In place: x = (matrix)^-1 x for any further right-hand side.
  void solve(std::vector<Vec6>& x) const;

  /// Nodes whose pivots in the last factor() were not all positive.
  std::vector<int> nodes_not_positive() const;

  /// A pivot was zero or not a number: do not solve.
  bool broken() const { return broken_; }

 private:
  struct Row {
    Pack low, high;  // columns 0-3; columns 4, 5, the right-hand side, nothing
  };
  struct Rows {
    Row row[6];
  };
  struct Block {
    double lower[6][6];  // unit lower triangle
    double inverse[6];   // 1/D
    double right[6];     // D^-1 L^-1 right-hand side
  };

  void start_diagonal(const BlockSystem& system, const Elimination::Column& column, Row (&diagonal)[6]) const;
  void start_link(const BlockSystem& system, int link, const Row (&diagonal)[6], Rows& upper) const;
  void eliminate(Block& block, Row (&diagonal)[6], Rows* upper, int links, int& not_positive);
  void pass_on(const BlockSystem& system, int position, const Rows* upper, Row (&next)[6]);

  Elimination order_;
  std::vector<Block> blocks_;   // by position
  std::vector<Rows> scaled_;    // by link: D^-1 L^-1 (upper block | right-hand side)
  std::vector<Rows> added_;     // by position: what earlier eliminations add to the diagonal; where filled
  std::vector<Rows> added_to_link_;
  std::vector<Rows> work_;      // the upper blocks of the column at work
  bool broken_ = false;
};

}  // namespace tendril
