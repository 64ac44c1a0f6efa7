#include "method/variation/copula.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "base/error.h"
#include "base/number_text.h"
#include "method/variation/distributions.h"

namespace tendril::variation {
namespace {

constexpr double rounding = 1e-10;  // of entries and eigenvalues

Eigen::MatrixXd whole_matrix(const Eigen::MatrixXd& given, int count, const std::string& who) {
  if (given.rows() == count && given.cols() == count) return given;
  if (given.size() != 1)
    throw UsageError(who + ": the correlation is " + std::to_string(given.rows()) + "x" + std::to_string(given.cols()) +
                     ", expected " + std::to_string(count) + "x" + std::to_string(count) + " or one number");
  Eigen::MatrixXd all = Eigen::MatrixXd::Constant(count, count, given(0, 0));
  all.diagonal().setOnes();
  return all;
}

/// Lower triangle with root * root^T = the matrix, which may be singular.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& matrix) {
  const Eigen::Index n = matrix.rows();
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double pivot = matrix(j, j) - root.row(j).head(j).squaredNorm();
    if (pivot <= rounding) continue;  // depends wholly on those before
    root(j, j) = std::sqrt(pivot);
    for (Eigen::Index i = j + 1; i < n; ++i)
      root(i, j) = (matrix(i, j) - root.row(i).head(j).dot(root.row(j).head(j))) / root(j, j);
  }
  return root;
}

}  // namespace

Copula::Copula(const Eigen::MatrixXd& given, int count, const std::string& who) {
  const Eigen::MatrixXd matrix = whole_matrix(given, count, who);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const double entry = matrix(i, j);
      const std::string place = " in row " + std::to_string(i + 1) + ", column " + std::to_string(j + 1);
      if (!(std::abs(entry) <= 1 + rounding))
        throw UsageError(who + ": got a correlation of " + number_text(entry) + place + ", expected -1 to 1");
      if (std::abs(entry - matrix(j, i)) > rounding)
        throw UsageError(who + ": the correlation matrix is not symmetric" + place);
      if (i == j && std::abs(entry - 1) > rounding)
        throw UsageError(who + ": a variable's correlation with itself is 1, got " + number_text(entry) + place);
    }
  const double smallest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (smallest < -rounding * count)
    throw UsageError(who +
                     ": no numbers can be correlated like this: the matrix is not positive semi-definite (smallest eigenvalue " +
                     number_text(smallest) + ")");
  root_ = root_of(matrix);
}

void Copula::join(std::span<double> u) const {
  const int n = static_cast<int>(u.size());
  constexpr double least = 0x1p-53;  // keeps what rounding would make 0 or 1 inside
  for (double& x : u) x = normal_quantile(x);
  for (int i = n; i-- > 0;) {  // from below: each needs only those before it
    double z = 0;
    for (int j = 0; j <= i; ++j) z += root_(i, j) * u[j];
    u[i] = z;
  }
  for (double& x : u) x = std::clamp(normal_below(x), least, 1 - least);
}

}  // namespace tendril::variation
