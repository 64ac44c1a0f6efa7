// Numbers that depend on each other through a Gaussian copula.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tendril::variation {

class Copula {
 public:
  /// `who`: the group, for messages. Throws UsageError for a matrix that is no correlation matrix: another size than `count`
  /// (1x1: the correlation between any two), not symmetric, a diagonal other than 1, entries outside -1 ... 1 or not finite, not
  /// positive semi-definite.
  Copula(const Eigen::MatrixXd& correlation, int count, const std::string& who);

  /// Turns independent uniform numbers (0 ... 1) into dependent ones, each still uniform.
  void join(std::span<double> u) const;

 private:
  Eigen::MatrixXd root_;  ///< root * root^T is the correlation
};

}  // namespace tendril::variation
