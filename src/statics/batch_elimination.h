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

/// L D L^T of the node's block; its coupling u (6x6 to the parent) and gradient go along, and what is left is taken off
/// `parent`. `positive` falls to zero where a pivot is not positive. Works on copies: they cannot overlap with anything.
template <class T, bool coupled>
inline void eliminate(const NodeTerms<T>& own, const T* u, NodeTerms<T>* parent, NodeFactor<T>& out, T& positive) {
  const T nothing{};
  T d[21], g[6], inverse[6], sound = positive;
#pragma GCC unroll 21
  for (int i = 0; i < 21; ++i) d[i] = own.d[i];
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) g[i] = own.g[i];
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const T pivot = d[lower(k, k)];
    sound = pivot > nothing ? sound : nothing;
    inverse[k] = filled<T>(1) / pivot;
    T column[6];
#pragma GCC unroll 6
    for (int r = k + 1; r < 6; ++r) {
      column[r] = d[lower(r, k)];
      d[lower(r, k)] *= inverse[k];
    }
#pragma GCC unroll 6
    for (int r = k + 1; r < 6; ++r) {
#pragma GCC unroll 6
      for (int c = k + 1; c <= r; ++c) d[lower(r, c)] -= d[lower(r, k)] * column[c];
      g[r] -= d[lower(r, k)] * g[k];
    }
  }
  positive = sound;
#pragma GCC unroll 6
  for (int r = 1; r < 6; ++r)
#pragma GCC unroll 6
    for (int k = 0; k < r; ++k) out.l[strict(r, k)] = d[lower(r, k)];
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) out.rhs[k] = inverse[k] * g[k];
  if constexpr (coupled) {
    // Column by column of the coupling: y = L^-1 u, then what it takes off the parent's row.
    T y[36];
#pragma GCC unroll 6
    for (int c = 0; c < 6; ++c) {
#pragma GCC unroll 6
      for (int r = 0; r < 6; ++r) {
        T sum = u[6 * r + c];
#pragma GCC unroll 6
        for (int k = 0; k < r; ++k) sum -= d[lower(r, k)] * y[6 * k + c];
        y[6 * r + c] = sum;
      }
      T scaled[6], sum = parent->g[c];
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k) {
        scaled[k] = inverse[k] * y[6 * k + c];
        sum -= scaled[k] * g[k];
      }
      parent->g[c] = sum;
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k) out.row[6 * k + c] = scaled[k];
#pragma GCC unroll 6
      for (int r = 0; r <= c; ++r) {
        T left = parent->d[lower(c, r)];
#pragma GCC unroll 6
        for (int k = 0; k < 6; ++k) left -= scaled[k] * y[6 * k + r];
        parent->d[lower(c, r)] = left;
      }
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
