// LDL^T of a 6x6 block tridiagonal symmetric matrix, without pivoting and, once sized, without allocation.
#pragma once

#include <vector>

#include "rod/lanes.h"
#include "statics/block_system.h"

namespace tendril {

/// Factorises and solves in one sweep along the rod. The signs of D are the matrix's inertia.
class BlockLdlt {
 public:
  /// Factorises and forward-eliminates the gradient in the same sweep. Returns the number of pivots that are not
  /// positive: zero means positive definite. The factor is usable unless `broken()`.
  int factor(const BlockSystem& system);

  /// step = -(matrix)^-1 gradient, for the gradient given to factor().
  void newton_step(std::vector<Vec6>& step) const;

  /// In place: x = (matrix)^-1 x for any further right-hand side.
  void solve(std::vector<Vec6>& x) const;

  /// A pivot was zero or not a number: do not solve.
  bool broken() const { return broken_; }

 private:
  struct Row {
    Pack low, high;  // columns 0-3; columns 4, 5, the right-hand side, nothing
  };
  struct Block {
    Row row[6];        // D^-1 L^-1 (upper block | right-hand side)
    double lower[6][6];  // unit lower triangle
    double inverse[6];   // 1/D
  };

  std::vector<Block> blocks_;
  bool broken_ = false;
};

}  // namespace tendril
