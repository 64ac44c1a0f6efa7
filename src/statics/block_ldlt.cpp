#include "statics/block_ldlt.h"

#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

inline Pack broadcast(double x) { return Pack{x, x, x, x}; }

}  // namespace

BlockLdlt::BlockLdlt(const BlockPattern& pattern) : order_(pattern) {
  const auto& columns = order_.columns();
  blocks_.resize(columns.size());
  scaled_.resize(order_.links().size());
  int most_links = 1;
  bool filled = false, links_filled = false;
  for (const auto& column : columns) {
    most_links = std::max(most_links, column.links_end - column.links_begin);
    filled = filled || column.filled;
  }
  for (const auto& link : order_.links()) links_filled = links_filled || link.filled;
  if (filled) added_.resize(columns.size());
  if (links_filled) added_to_link_.resize(order_.links().size());
  work_.resize(most_links);
}

/// Rows of the Schur complement, right-hand side in column 6.
void BlockLdlt::start_diagonal(const BlockSystem& system, const Elimination::Column& column, Row (&diagonal)[6]) const {
  for (int r = 0; r < 6; ++r) {
    const double* d = system.diagonal[column.node].data() + 6 * r;
    diagonal[r] = {Pack{d[0], d[1], d[2], d[3]}, Pack{d[4], d[5], system.gradient[column.node][r], 0}};
  }
}

void BlockLdlt::start_link(const BlockSystem& system, int index, const Row (&diagonal)[6], Rows& upper) const {
  const Elimination::Link& link = order_.links()[index];
  for (int r = 0; r < 6; ++r) upper.row[r] = {Pack{}, Pack{0, 0, diagonal[r].high[2], 0}};
  for (int k = link.sources_begin; k < link.sources_end; ++k) {
    const Elimination::Source& source = order_.sources()[k];
    const double* block = system.upper[source.edge].data();
    const int down = source.transposed ? 6 : 1, across = source.transposed ? 1 : 6;
    for (int r = 0; r < 6; ++r) {
      const double* u = block + r * down;
      upper.row[r].low += Pack{u[0], u[across], u[2 * across], u[3 * across]};
      upper.row[r].high += Pack{u[4 * across], u[5 * across], 0, 0};
    }
  }
  if (!link.filled) return;
  for (int r = 0; r < 6; ++r) {
    upper.row[r].low += added_to_link_[index].row[r].low;
    upper.row[r].high += added_to_link_[index].row[r].high;
  }
}

/// Gaussian elimination on the rows (Schur complement | upper blocks, right-hand side).
inline void BlockLdlt::eliminate(Block& block, Row (&diagonal)[6], Rows* upper, int links, int& not_positive) {
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
      for (int link = 0; link < links; ++link) {
        upper[link].row[r].low -= wide * upper[link].row[k].low;
        upper[link].row[r].high -= wide * upper[link].row[k].high;
      }
    }
  }
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) block.right[k] = diagonal[k].high[2] * block.inverse[k];
}

/// What the elimination at `position` takes from the blocks of the later nodes that it is coupled with. `next`: the rows of
/// the position after it, when that one is carried.
void BlockLdlt::pass_on(const BlockSystem& system, int position, const Rows* upper, Row (&next)[6]) {
  const Elimination::Column& column = order_.columns()[position];
  for (int a = column.links_begin; a < column.links_end; ++a) {
    const Rows& from = upper[a - column.links_begin];
    const int target = order_.links()[a].target;
    for (int b = a; b < column.links_end; ++b) {
      Row* to;
      if (a != b) {
        to = added_to_link_[order_.link_between(target, order_.links()[b].target)].row;
      } else if (order_.columns()[target].carried) {
        start_diagonal(system, order_.columns()[target], next);
        to = next;
      } else {
        to = added_[target].row;
      }
      const Rows& scaled = scaled_[b];
#pragma GCC unroll 6
      for (int r = 0; r < 6; ++r) {
        Pack low = to[r].low, high = to[r].high;
#pragma GCC unroll 6
        for (int k = 0; k < 6; ++k) {
          const Pack wide = broadcast(r < 4 ? from.row[k].low[r] : from.row[k].high[r - 4]);
          low -= wide * scaled.row[k].low;
          high -= wide * scaled.row[k].high;
        }
        // The right-hand side goes with the diagonal alone.
        if (a != b) high[2] = 0;
        to[r] = {low, high};
      }
    }
  }
}

int BlockLdlt::factor(const BlockSystem& system) {
  const auto& columns = order_.columns();
  const int n = static_cast<int>(columns.size());
  broken_ = false;
  int not_positive = 0;
  if (!added_.empty()) std::fill(added_.begin(), added_.end(), Rows{});
  if (!added_to_link_.empty()) std::fill(added_to_link_.begin(), added_to_link_.end(), Rows{});
  Row diagonal[6];
  for (int p = 0; p < n; ++p) {
    const Elimination::Column& column = columns[p];
    if (!column.carried) start_diagonal(system, column, diagonal);
    if (column.filled)
      for (int r = 0; r < 6; ++r) {
        diagonal[r].low += added_[p].row[r].low;
        diagonal[r].high += added_[p].row[r].high;
      }
    const int links = column.links_end - column.links_begin;
    for (int k = 0; k < links; ++k) start_link(system, column.links_begin + k, diagonal, work_[k]);
    Block& block = blocks_[p];
    if (links == 1)
      eliminate(block, diagonal, work_.data(), 1, not_positive);
    else
      eliminate(block, diagonal, work_.data(), links, not_positive);
    for (int link = 0; link < links; ++link)
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k) {
        const Pack wide = broadcast(block.inverse[k]);
        Rows& scaled = scaled_[column.links_begin + link];
        scaled.row[k] = {wide * work_[link].row[k].low, wide * work_[link].row[k].high};
      }
    pass_on(system, p, work_.data(), diagonal);
  }
  return not_positive;
}

std::vector<int> BlockLdlt::nodes_not_positive() const {
  std::vector<int> nodes;
  for (std::size_t p = 0; p < blocks_.size(); ++p)
    for (const double inverse : blocks_[p].inverse)
      if (!(inverse > 0)) {
        nodes.push_back(order_.columns()[p].node);
        break;
      }
  return nodes;
}

void BlockLdlt::newton_step(std::vector<Vec6>& step) const {
  const auto& columns = order_.columns();
  step.resize(columns.size());
  for (int p = static_cast<int>(columns.size()) - 1; p >= 0; --p) {
    const Block& block = blocks_[p];
    const Elimination::Column& column = columns[p];
    double x[6];
    for (int k = 0; k < 6; ++k) x[k] = block.right[k];
    for (int link = column.links_begin; link < column.links_end; ++link) {
      // The right-hand side in column 6 of the rows meets a zero: it is in `right` already.
      const Vec6& other = step[columns[order_.links()[link].target].node];
      const Pack low{other[0], other[1], other[2], other[3]}, high{other[4], other[5], 0, 0};
      for (int k = 0; k < 6; ++k) {
        const Pack sum = scaled_[link].row[k].low * low + scaled_[link].row[k].high * high;
        x[k] += (sum[0] + sum[2]) + (sum[1] + sum[3]);
      }
    }
    for (int k = 4; k >= 0; --k)
      for (int r = k + 1; r < 6; ++r) x[k] -= block.lower[r][k] * x[r];
    for (int k = 0; k < 6; ++k) step[column.node][k] = -x[k];
  }
}

void BlockLdlt::solve(std::vector<Vec6>& x) const {
  const auto& columns = order_.columns();
  const int n = static_cast<int>(columns.size());
  const auto coefficient = [](const Row& row, int c) { return c < 4 ? row.low[c] : row.high[c - 4]; };
  for (int p = 0; p < n; ++p) {
    const Block& block = blocks_[p];
    Vec6& here = x[columns[p].node];
    for (int k = 0; k < 6; ++k)
      for (int r = k + 1; r < 6; ++r) here[r] -= block.lower[r][k] * here[k];
    for (int link = columns[p].links_begin; link < columns[p].links_end; ++link) {
      Vec6& other = x[columns[order_.links()[link].target].node];
      for (int k = 0; k < 6; ++k)
        for (int c = 0; c < 6; ++c) other[c] -= coefficient(scaled_[link].row[k], c) * here[k];
    }
    for (int k = 0; k < 6; ++k) here[k] *= block.inverse[k];
  }
  for (int p = n - 1; p >= 0; --p) {
    const Block& block = blocks_[p];
    Vec6& here = x[columns[p].node];
    for (int link = columns[p].links_begin; link < columns[p].links_end; ++link) {
      const Vec6& other = x[columns[order_.links()[link].target].node];
      for (int k = 0; k < 6; ++k)
        for (int c = 0; c < 6; ++c) here[k] -= coefficient(scaled_[link].row[k], c) * other[c];
    }
    for (int k = 4; k >= 0; --k)
      for (int r = k + 1; r < 6; ++r) here[k] -= block.lower[r][k] * here[r];
  }
}

}  // namespace tendril
