#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <random>

#include "statics/block_ldlt.h"

using namespace tendril;

namespace {

BlockSystem random_system(std::mt19937& random, int vertices, double shift) {
  std::normal_distribution<double> normal;
  BlockSystem s;
  s.resize(vertices);
  for (int i = 0; i < vertices; ++i) {
    const Mat6 m = Mat6::NullaryExpr([&] { return normal(random); });
    s.diagonal[i] = m + m.transpose() + shift * Mat6::Identity();
    s.gradient[i] = Vec6::NullaryExpr([&] { return normal(random); });
    if (i + 1 < vertices) s.upper[i] = Mat6::NullaryExpr([&] { return normal(random); });
  }
  return s;
}

Eigen::MatrixXd dense(const BlockSystem& s) {
  const int n = s.vertices();
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  for (int i = 0; i < n; ++i) {
    m.block<6, 6>(6 * i, 6 * i) = s.diagonal[i];
    if (i + 1 == n) break;
    m.block<6, 6>(6 * i, 6 * i + 6) = s.upper[i];
    m.block<6, 6>(6 * i + 6, 6 * i) = s.upper[i].transpose();
  }
  return m;
}

}  // namespace

TEST_CASE("block LDL^T solves as a dense solver does and counts the negative eigenvalues", "[statics]") {
  std::mt19937 random(5);
  for (const int vertices : {1, 2, 3, 17})
    for (const double shift : {0.0, 4.0, 30.0}) {
      CAPTURE(vertices, shift);
      const BlockSystem s = random_system(random, vertices, shift);
      const Eigen::MatrixXd m = dense(s);
      Eigen::VectorXd g(6 * vertices);
      for (int i = 0; i < vertices; ++i) g.segment<6>(6 * i) = s.gradient[i];
      BlockLdlt ldlt(BlockPattern::chain(vertices));
      const int negative = ldlt.factor(s);
      const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues();
      CHECK(negative == (eigenvalues.array() < 0).count());
      const Eigen::VectorXd expected = -m.fullPivLu().solve(g);
      std::vector<Vec6> step, x = s.gradient;
      ldlt.newton_step(step);
      ldlt.solve(x);
      for (int i = 0; i < vertices; ++i) {
        CHECK((step[i] - expected.segment<6>(6 * i)).norm() < 1e-8 * expected.norm());
        CHECK((x[i] + expected.segment<6>(6 * i)).norm() < 1e-8 * expected.norm());
      }
    }
}

TEST_CASE("block LDL^T reports a matrix that it cannot factorise", "[statics]") {
  BlockSystem s;
  s.resize(2);
  s.diagonal = {Mat6::Zero(), Mat6::Identity()};
  s.upper = {Mat6::Zero()};
  s.gradient = {Vec6::Zero(), Vec6::Zero()};
  BlockLdlt ldlt(BlockPattern::chain(s.vertices()));
  ldlt.factor(s);
  CHECK(ldlt.broken());
}
