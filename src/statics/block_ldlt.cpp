#include "statics/block_ldlt.h"

#include <cmath>

namespace tendril {
namespace {

inline Pack broadcast(double x) { return Pack{x, x, x, x}; }

}  // namespace

int BlockLdlt::factor(const BlockSystem& system) {
  const int n = system.vertices();
  blocks_.resize(n);
  broken_ = false;
  int not_positive = 0;
  Row diagonal[6];  // rows of the current block's Schur complement, right-hand side in column 6
  for (int r = 0; r < 6; ++r) {
    const double* d = system.diagonal[0].data() + 6 * r;
    diagonal[r] = {Pack{d[0], d[1], d[2], d[3]}, Pack{d[4], d[5], system.gradient[0][r], 0}};
  }
  for (int i = 0; i < n; ++i) {
    Block& block = blocks_[i];
    Row upper[6];
    const bool last = i + 1 == n;
    for (int r = 0; r < 6; ++r) {
      if (last) {
        upper[r] = {Pack{}, Pack{0, 0, diagonal[r].high[2], 0}};
        continue;
      }
      const double* u = system.upper[i].data() + r;
      upper[r] = {Pack{u[0], u[6], u[12], u[18]}, Pack{u[24], u[30], diagonal[r].high[2], 0}};
    }
    // Gaussian elimination on the rows (Schur complement | upper block, right-hand side).
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
      const double pivot = k < 4 ? diagonal[k].low[k] : diagonal[k].high[k - 4];
      if (!(pivot > 0)) {
        ++not_positive;
        if (pivot == 0 || std::isnan(pivot)) broken_ = true;
      }
      const double inverse = 1 / pivot;
      block.inverse[k] = inverse;
#pragma GCC unroll 6
      for (int r = k + 1; r < 6; ++r) {
        const double l = (k < 4 ? diagonal[r].low[k] : diagonal[r].high[k - 4]) * inverse;
        block.lower[r][k] = l;
        const Pack wide = broadcast(l);
        diagonal[r].low -= wide * diagonal[k].low;
        diagonal[r].high -= wide * diagonal[k].high;
        upper[r].low -= wide * upper[k].low;
        upper[r].high -= wide * upper[k].high;
      }
    }
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
      const Pack wide = broadcast(block.inverse[k]);
      block.row[k] = {wide * upper[k].low, wide * upper[k].high};
    }
    if (last) break;
    const double* d = system.diagonal[i + 1].data();
#pragma GCC unroll 6
    for (int r = 0; r < 6; ++r) {
      Pack low = Pack{d[6 * r], d[6 * r + 1], d[6 * r + 2], d[6 * r + 3]};
      Pack high = Pack{d[6 * r + 4], d[6 * r + 5], system.gradient[i + 1][r], 0};
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k) {
        const Pack wide = broadcast(r < 4 ? upper[k].low[r] : upper[k].high[r - 4]);
        low -= wide * block.row[k].low;
        high -= wide * block.row[k].high;
      }
      diagonal[r] = {low, high};
    }
  }
  return not_positive;
}

void BlockLdlt::newton_step(std::vector<Vec6>& step) const {
  const int n = static_cast<int>(blocks_.size());
  step.resize(n);
  Pack low{}, high{};  // the solution of the block behind: x0..x3; x4, x5, -1, 0 so that the right-hand side joins in
  high[2] = -1;
  for (int i = n - 1; i >= 0; --i) {
    const Block& block = blocks_[i];
    double x[6];
    for (int k = 0; k < 6; ++k) {
      const Pack sum = block.row[k].low * low + block.row[k].high * high;
      x[k] = -((sum[0] + sum[2]) + (sum[1] + sum[3]));
    }
    for (int k = 4; k >= 0; --k)
      for (int r = k + 1; r < 6; ++r) x[k] -= block.lower[r][k] * x[r];
    for (int k = 0; k < 6; ++k) step[i][k] = -x[k];
    low = Pack{x[0], x[1], x[2], x[3]};
    high = Pack{x[4], x[5], -1, 0};
  }
}

void BlockLdlt::solve(std::vector<Vec6>& x) const {
  const int n = static_cast<int>(blocks_.size());
  for (int i = 0; i < n; ++i) {
    const Block& block = blocks_[i];
    for (int k = 0; k < 6; ++k)
      for (int r = k + 1; r < 6; ++r) x[i][r] -= block.lower[r][k] * x[i][k];
    if (i + 1 < n)
      for (int k = 0; k < 6; ++k)
        for (int c = 0; c < 6; ++c)
          x[i + 1][c] -= (c < 4 ? block.row[k].low[c] : block.row[k].high[c - 4]) * x[i][k];
    for (int k = 0; k < 6; ++k) x[i][k] *= block.inverse[k];
  }
  for (int i = n - 1; i >= 0; --i) {
    const Block& block = blocks_[i];
    if (i + 1 < n)
      for (int k = 0; k < 6; ++k)
        for (int c = 0; c < 6; ++c)
          x[i][k] -= (c < 4 ? block.row[k].low[c] : block.row[k].high[c - 4]) * x[i + 1][c];
    for (int k = 4; k >= 0; --k)
      for (int r = k + 1; r < 6; ++r) x[i][k] -= block.lower[r][k] * x[i][r];
  }
}

}  // namespace tendril
