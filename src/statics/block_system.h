// The linear system of one Newton step of one rod: 6x6 block tridiagonal, symmetric.
#pragma once

#include <vector>

#include "base/vectors.h"

namespace tendril {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Unknowns of vertex i: (position increment in world axes, m; rotation increment theta in the section's own axes, rad),
/// applied as r <- r + dr, R <- R exp([theta]). Arrays: gradient and diagonal have segments + 1 blocks, upper has
/// segments; upper[i] couples rows of vertex i with columns of vertex i + 1.
struct BlockSystem {
  std::vector<Vec6> gradient;
  std::vector<Mat6> diagonal;  ///< both triangles are filled
  std::vector<Mat6> upper;

  void resize(int vertices) {
    gradient.resize(vertices);
    diagonal.resize(vertices);
    upper.resize(vertices > 0 ? vertices - 1 : 0);
  }
  int vertices() const { return static_cast<int>(diagonal.size()); }
};

}  // namespace tendril
