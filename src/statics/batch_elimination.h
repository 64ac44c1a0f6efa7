// Elimination of one node of six unknowns after the other, over a lane type T: what the batch solver's factor consists of.
#pragma once

#include "rod/lanes.h"

namespace TENDRIL_LANES_NAMESPACE {

/// Row by row, lower triangle of a symmetric 6x6.
constexpr int lower(int row, int column) { return row * (row + 1) / 2 + column; }
constexpr int symmetric(int row, int column) { return row >= column ? lower(row, column) : lower(column, row); }

/// What is gathered for a node: second derivative and gradient.
template <class T>
struct NodeTerms {
  T d[21];
  T g[6];
};

/// One eliminated node: its step is -(l^-T)(rhs + row . the parent's step).
template <class T>
struct NodeFactor {
  T l[15];    ///< unit lower triangle below the diagonal
  T row[36];  ///< D^-1 L^-1 U
  T rhs[6];   ///< D^-1 L^-1 gradient
};

/// Row r of the strict lower triangle begins here in NodeFactor::l.
constexpr int strict(int row, int column) { return row * (row - 1) / 2 + column; }

/// L D L^T of the node's block in place of it; its coupling u (6x6 to the parent) and gradient go along. `positive` falls
/// to zero where a pivot is not positive.
template <class T, bool coupled>
inline void eliminate(NodeTerms<T>& own, T* u, NodeTerms<T>* parent, NodeFactor<T>& out, T& positive) {
  const T nothing{};
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const T pivot = own.d[lower(k, k)];
    positive = pivot > nothing ? positive : nothing;
    const T inverse = filled<T>(1) / pivot;
#pragma GCC unroll 6
    for (int r = k + 1; r < 6; ++r) {
      const T l = own.d[lower(r, k)] * inverse;
      out.l[strict(r, k)] = l;
#pragma GCC unroll 6
      for (int c = k + 1; c <= r; ++c) own.d[lower(r, c)] -= l * own.d[lower(c, k)];
      if constexpr (coupled) {
#pragma GCC unroll 6
        for (int c = 0; c < 6; ++c) u[6 * r + c] -= l * u[6 * k + c];
      }
      own.g[r] -= l * own.g[k];
    }
    if constexpr (coupled) {
#pragma GCC unroll 6
      for (int c = 0; c < 6; ++c) out.row[6 * k + c] = inverse * u[6 * k + c];
    }
    out.rhs[k] = inverse * own.g[k];
  }
  if constexpr (coupled) {
#pragma GCC unroll 6
    for (int r = 0; r < 6; ++r) {
#pragma GCC unroll 6
      for (int c = 0; c <= r; ++c) {
        T sum = u[r] * out.row[c];
#pragma GCC unroll 6
        for (int k = 1; k < 6; ++k) sum += u[6 * k + r] * out.row[6 * k + c];
        parent->d[lower(r, c)] -= sum;
      }
      T sum = u[r] * out.rhs[0];
#pragma GCC unroll 6
      for (int k = 1; k < 6; ++k) sum += u[6 * k + r] * out.rhs[k];
      parent->g[r] -= sum;
    }
  }
}

/// x = the node's step, from its parent's (null: a root).
template <class T>
inline void substitute(const NodeFactor<T>& f, const T* parent, T* x) {
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    T sum = f.rhs[k];
    if (parent) {
#pragma GCC unroll 6
      for (int c = 0; c < 6; ++c) sum += f.row[6 * k + c] * parent[c];
    }
    x[k] = -sum;
  }
#pragma GCC unroll 6
  for (int k = 4; k >= 0; --k)
#pragma GCC unroll 6
    for (int r = k + 1; r < 6; ++r) x[k] -= f.l[strict(r, k)] * x[r];
}

}  // namespace TENDRIL_LANES_NAMESPACE
