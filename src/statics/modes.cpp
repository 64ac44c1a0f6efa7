#include "statics/modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "statics/network_guess.h"

namespace tendril {
namespace {

using Vectors = std::vector<std::vector<Vec6>>;

constexpr int rounds = 40;
constexpr double settled_eigenvalue = 1e-10;
constexpr double same_place = 1e-4;     // of the length
constexpr double same_energy = 1e-7;    // relative: neighbours on a neutral family of equilibria
constexpr double neutral = 1e-4;        // an eigenvalue below this costs nothing to move along

double dot(const std::vector<Vec6>& a, const std::vector<Vec6>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

/// M v.
std::vector<Vec6> weighted(const RodNetwork& network, const std::vector<Vec6>& v) {
  std::vector<Vec6> out(v.size());
  for (int i = 0; i < network.nodes(); ++i) {
    const auto& weight = network.shift_weights()[i];
    out[i].head<3>() = weight.position * v[i].head<3>();
    out[i].tail<3>() = weight.rotation * v[i].tail<3>();
  }
  return out;
}

/// Unknowns that are held, or follow a branch point, are not free to be disturbed on their own.
void clear_bound(const RodNetwork& network, std::vector<Vec6>& v) {
  for (int i = 0; i < network.nodes(); ++i)
    for (int c = 0; c < 6; ++c)
      if (network.held()[i] >> c & 1) v[i][c] = 0;
  for (const Joints::Joint& joint : network.joints())
    for (int c = 0; c < 6; ++c)
      if (joint.part >> c & 1) v[joint.section][c] = 0;
}

Vectors first_vectors(const RodNetwork& network, int count) {
  Vectors vectors(count, std::vector<Vec6>(network.nodes()));
  for (int k = 0; k < count; ++k) {
    for (int i = 0; i < network.nodes(); ++i)
      for (int c = 0; c < 6; ++c) vectors[k][i][c] = std::sin(1.0 + 0.7 * (k + 1) * i / network.nodes() + 1.3 * c + 2.1 * k);
    clear_bound(network, vectors[k]);
  }
  return vectors;
}

/// Rayleigh and Ritz: the best vectors in their span. `images`: (K + shift M)^-1 M v. Returns 1/(lambda + shift), largest first.
Eigen::VectorXd ritz(const RodNetwork& network, Vectors& vectors, const Vectors& images) {
  const int n = static_cast<int>(vectors.size());
  Eigen::MatrixXd a(n, n), b(n, n);  // y^T M v and y^T M y for y = image: the pencil of (K + shift M)^-1 M on their span
  for (int i = 0; i < n; ++i) {
    const std::vector<Vec6> my = weighted(network, images[i]);
    for (int j = 0; j < n; ++j) {
      a(i, j) = dot(my, vectors[j]);
      b(i, j) = dot(my, images[j]);
    }
  }
  a = 0.5 * (a + a.transpose().eval());
  // On the span of the images: K_s y = M v, so y^T K_s y = a and y^T M y = b; a x = (lambda + shift) b x.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> pencil(a, b);
  for (int k = 0; k < n; ++k) {
    std::vector<Vec6> sum(network.nodes(), Vec6::Zero());
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < network.nodes(); ++i) sum[i] += pencil.eigenvectors()(j, k) * images[j][i];
    vectors[k] = std::move(sum);
  }
  return pencil.eigenvalues();
}

double largest_distance(const SystemEquilibrium& a, const SystemEquilibrium& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.rods.size(); ++k)
    for (std::size_t i = 0; i < a.rods[k].points.size(); ++i)
      largest = std::max(largest, (a.rods[k].points[i] - b.rods[k].points[i]).norm() / a.rods[k].s.back());
  // The same centre line may still be twisted otherwise.
  for (std::size_t k = 0; k < a.rods.size(); ++k)
    for (std::size_t i = 0; i < a.rods[k].rotations.size(); ++i)
      largest = std::max(largest, 0.1 * log_rotation(a.rods[k].rotations[i].conjugate() * b.rods[k].rotations[i]).norm());
  return largest;
}

/// What kinds of first guess there are for one rod.
constexpr GuessVariant variants[] = {{-1, 90, 0}, {-1, -90, 0}, {-1, 180, 0}, {-1, 0, 1}, {-1, 0, -1}, {-1, 0, 2}, {-1, 0, -2}, {-1, 45, 0}};

}  // namespace

std::vector<Eigenmode> softest_modes(NetworkSolver& solver, const RodState& state, int count) {
  const RodNetwork& network = solver.network();
  StepSystem linear(network);
  solver.assemble_exact(state, linear);
  int factorisations = 0;
  linear.begin();
  linear.factor(true, factorisations);
  if (linear.broken()) return {};
  const double shift = linear.applied_shift();
  Vectors vectors = first_vectors(network, count + 3), images(count + 3);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count + 3);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < vectors.size(); ++k) {
      double size = network.size_of(vectors[k]);
      for (Vec6& v : vectors[k]) v /= size;
      images[k] = weighted(network, vectors[k]);
      linear.apply_inverse(state, images[k]);
      clear_bound(network, images[k]);
    }
    const Eigen::VectorXd before = values;
    values = ritz(network, vectors, images);
    if ((values - before).head(count).cwiseAbs().maxCoeff() < settled_eigenvalue * values.head(count).cwiseAbs().maxCoeff()) break;
  }
  std::vector<Eigenmode> modes;
  for (int k = 0; k < count; ++k) {
    Eigenmode mode{values[k] - shift, std::move(vectors[k])};
    network.complete(state, mode.shape);
    const double size = network.size_of(mode.shape);
    for (Vec6& v : mode.shape) v /= size;
    modes.push_back(std::move(mode));
  }
  return modes;
}

std::vector<SystemEquilibrium> other_equilibria(const SystemProblem& problem, const SolveOptions& options,
                                                const RunContext& context, const SystemEquilibrium& found,
                                                const ModeSearch& search) {
  NetworkSolver solver(problem, options);
  RodNetwork& network = solver.network();
  const RodState here = solver.starting_state(&found);
  const std::vector<Eigenmode> modes = softest_modes(solver, here, search.modes);
  const bool drifts = !modes.empty() && std::abs(modes.front().eigenvalue) < neutral;
  std::vector<RodState> starts;
  for (const Eigenmode& mode : modes)
    for (const double way : {search.push, -search.push}) {
      RodState start = here;
      network.apply(start, mode.shape, way);
      starts.push_back(std::move(start));
    }
  for (const GuessVariant& variant : variants)
    for (int k = 0; k < network.rods() && static_cast<int>(starts.size()) < search.most_starts; ++k) {
      GuessVariant of_rod = variant;
      of_rod.rod = k;
      const NetworkGuess guess = network_guess(network, of_rod);
      starts.push_back(network.state_from(guess.rods, guess.branches));
    }
  std::vector<SystemEquilibrium> others;
  const double scale = std::abs(found.energy()) + 1e-300;
  const auto known = [&](const SystemEquilibrium& eq) {
    const auto same = [&](const SystemEquilibrium& other) {
      return largest_distance(eq, other) < same_place ||
             (drifts && std::abs(eq.energy() - other.energy()) < same_energy * scale);
    };
    return same(found) || std::any_of(others.begin(), others.end(), same);
  };
  for (RodState& start : starts) {
    if (context.stop()) break;
    SystemEquilibrium eq = solver.solve_from(std::move(start), false, context);
    if (eq.ok() && eq.rods.front().stable && !known(eq)) others.push_back(std::move(eq));
  }
  std::sort(others.begin(), others.end(),
            [](const SystemEquilibrium& a, const SystemEquilibrium& b) { return a.energy() < b.energy(); });
  return others;
}

}  // namespace tendril
