#include "statics/sliding_clips.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "statics/network_solver.h"

namespace tendril {
namespace {

constexpr double difference = 1e-6;    // of the shorter side: step of the differences by arc length; shapes may bend anew every few mm
constexpr double longest_slip = 0.3;   // of the way to the next stop, in one step
constexpr double nearest_stop = 2e-3;  // of the length: a rod so near to its end or another stop has slid out
constexpr int most_steps = 60;

/// One clip and the places it cannot slide past.
struct Clip {
  int rod, hold;
  double low, high;
  bool alone = true;  ///< nothing else that needs a vertex lies where it is
};

std::vector<Clip> clips_of(const SystemProblem& problem) {
  std::vector<Clip> clips;
  for (int k = 0; k < static_cast<int>(problem.rods.size()); ++k) {
    const RodProblem& rod = problem.rods[k];
    std::vector<double> stops = {0, rod.rod.length};
    for (const Hold& hold : rod.holds) stops.push_back(hold.at);
    for (const PointLoad& load : rod.loads) stops.push_back(load.at);
    for (const RodPart& part : rod.rod.parts) stops.push_back(part.upto);
    for (const BranchPoint& branch : problem.branches)
      for (const JoinedSection& section : branch.sections)
        if (section.rod == k) stops.push_back(section.at);
    std::sort(stops.begin(), stops.end());
    for (int h = 0; h < static_cast<int>(rod.holds.size()); ++h) {
      if (!rod.holds[h].slide) continue;
      const double at = rod.holds[h].at, same = 1e-9 * rod.rod.length;
      Clip clip{k, h, 0, rod.rod.length};
      clip.alone = std::count_if(stops.begin(), stops.end(), [&](double stop) { return std::abs(stop - at) <= same; }) == 1;
      for (const double stop : stops) {
        if (stop < at - same) clip.low = stop;
        if (stop > at + same) {
          clip.high = stop;
          break;
        }
      }
      clips.push_back(clip);
    }
  }
  return clips;
}

double& at(SystemProblem& problem, const Clip& clip) { return problem.rods[clip.rod].holds[clip.hold].at; }

/// The energy of one rod at a state of the whole system, with the sections at its clips displaced along it, and its gradient by the
/// state. The other rods do not feel that: left out, they add no rounding to the small differences either.
class DisplacedEnergy {
 public:
  DisplacedEnergy(const SystemProblem& problem, const SolveOptions& options, const std::vector<Clip>& clips, const RodNetwork& network,
                  const RodState& state, int rod)
      : problem_(problem.rods[rod]), options_(options), clips_(clips), network_(network), state_(state), rod_(rod) {
    problem_.surroundings = nullptr;
    const RodMesh& mesh = network.rod(rod).mesh();
    for (const int vertex : mesh.joint_vertex) joined_.push_back(mesh.s[vertex]);
  }

  /// `a`: m, of all clips; those of other rods count for nothing.
  double operator()(const std::vector<double>& a, std::vector<Vec6>* gradient = nullptr) const {
    RodProblem displaced = problem_;
    for (std::size_t k = 0; k < clips_.size(); ++k)
      if (clips_[k].rod == rod_) displaced.holds[clips_[k].hold].at += a[k];
    const auto system = make_rod_system(displaced, options_, cut_into_segments(displaced, displaced.rod.segments, 1, joined_));
    std::vector<Vec6> own(network_.nodes(), Vec6::Zero());
    const double energy = system->gradient(network_.of_rod(rod_, state_), own.data() + network_.first_node(rod_));
    if (gradient) {
      network_.join_gradient(state_, own);
      *gradient = std::move(own);
    }
    return energy;
  }

 private:
  RodProblem problem_;
  const SolveOptions& options_;
  const std::vector<Clip>& clips_;
  const RodNetwork& network_;
  const RodState& state_;
  int rod_;
  std::vector<double> joined_;  ///< arc lengths where it belongs to branch points
};

/// Slope and curvature of the energy of the equilibria as functions of the arc lengths at the clips.
struct Reduced {
  Eigen::VectorXd slope;
  Eigen::MatrixXd curvature;
  bool sound = false;  ///< the equilibrium's second derivative could be factorised
};

Reduced reduce(NetworkSolver& solver, const RodState& state, const SystemProblem& problem, const SolveOptions& options,
               const std::vector<Clip>& clips) {
  const int m = static_cast<int>(clips.size());
  StepSystem linear(solver.network());
  solver.assemble_exact(state, linear);
  int factorisations = 0;
  linear.begin();
  linear.factor(true, factorisations);
  Reduced out;
  out.sound = !linear.broken();
  if (!out.sound) return out;
  out.slope.resize(m);
  out.curvature.resize(m, m);
  std::vector<std::vector<Vec6>> mixed(m), response(m);
  std::vector<double> steps(m);
  for (int k = 0; k < m; ++k) {
    SystemProblem copy = problem;
    const double here = at(copy, clips[k]);
    steps[k] = difference * std::min(here - clips[k].low, clips[k].high - here);
  }
  out.curvature.setZero();
  for (int k = 0; k < m; ++k) {
    const DisplacedEnergy energy(problem, options, clips, solver.network(), state, clips[k].rod);
    const double d = steps[k], middle = energy(std::vector<double>(m, 0.0));
    std::array<double, 4> e;
    std::array<std::vector<Vec6>, 4> g;
    constexpr std::array<double, 4> places = {-2, -1, 1, 2};
    for (int i = 0; i < 4; ++i) {
      std::vector<double> a(m, 0.0);
      a[k] = places[i] * d;
      e[i] = energy(a, &g[i]);
    }
    out.slope[k] = (8 * (e[2] - e[1]) - (e[3] - e[0])) / (12 * d);
    out.curvature(k, k) = (16 * (e[2] + e[1]) - (e[3] + e[0]) - 30 * middle) / (12 * d * d);
    mixed[k].resize(g[0].size());
    for (std::size_t i = 0; i < g[0].size(); ++i) mixed[k][i] = (8 * (g[2][i] - g[1][i]) - (g[3][i] - g[0][i])) / (12 * d);
    response[k] = mixed[k];
    linear.apply_inverse(state, response[k]);
    for (int l = 0; l < k; ++l) {
      if (clips[l].rod != clips[k].rod) continue;
      double corner[2][2];
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
          std::vector<double> a(m, 0.0);
          a[k] = (2 * i - 1) * d;
          a[l] = (2 * j - 1) * steps[l];
          corner[i][j] = energy(a);
        }
      out.curvature(k, l) = out.curvature(l, k) = (corner[1][1] - corner[1][0] - corner[0][1] + corner[0][0]) / (4 * d * steps[l]);
    }
  }
  for (int k = 0; k < m; ++k)
    for (int l = 0; l < m; ++l)
      for (std::size_t i = 0; i < mixed[k].size(); ++i) out.curvature(k, l) -= mixed[k][i].dot(response[l][i]);
  return out;
}

/// Newton's step where the energy curves upwards, else down the slope with the curvatures' sizes.
Eigen::VectorXd slip_of(const Reduced& reduced) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(reduced.curvature);
  const double floor = 1e-9 * modes.eigenvalues().cwiseAbs().maxCoeff();
  const Eigen::VectorXd sizes = modes.eigenvalues().cwiseAbs().cwiseMax(floor);
  return -(modes.eigenvectors() * (modes.eigenvectors().transpose() * reduced.slope).cwiseQuotient(sizes));
}

void set_status(SystemEquilibrium& eq, Status status, const std::string& message) {
  for (Equilibrium& rod : eq.rods) {
    rod.status = status;
    rod.message = message;
    rod.stable = rod.stable && status == Status::solved;
  }
}

void begin_where_it_was(const SystemEquilibrium& from, SystemProblem& problem) {
  if (from.rods.size() != problem.rods.size()) return;
  for (std::size_t k = 0; k < problem.rods.size(); ++k) {
    std::vector<Hold>& holds = problem.rods[k].holds;
    if (from.rods[k].reactions.size() < holds.size()) return;
    for (std::size_t h = 0; h < holds.size(); ++h) {
      const double s = from.rods[k].reactions[h].s;
      if (holds[h].slide && s > 0 && s < problem.rods[k].rod.length) holds[h].at = s;
    }
  }
}

}  // namespace

bool has_sliding_clips(const SystemProblem& problem) {
  for (const RodProblem& rod : problem.rods)
    for (const Hold& hold : rod.holds)
      if (hold.slide) return true;
  return false;
}

SystemEquilibrium solve_sliding(const SystemProblem& given, const SolveOptions& options, const RunContext& context,
                                const SystemEquilibrium* from) {
  SystemProblem problem = given;
  for (RodProblem& rod : problem.rods)
    for (Hold& hold : rod.holds)
      if (hold.slide && hold.cut_at < 0) hold.cut_at = hold.at;
  if (from) begin_where_it_was(*from, problem);
  const std::vector<Clip> clips = clips_of(problem);
  auto solver = std::make_unique<NetworkSolver>(problem, options);
  SystemEquilibrium best = solver->solve(context, from);
  int iterations = best.rods.front().iterations;
  if (const auto met = std::find_if(clips.begin(), clips.end(), [](const Clip& clip) { return !clip.alone; }); met != clips.end() && best.ok())
    set_status(best, Status::infeasible, "the clip at " + number_text(at(problem, *met)) + " m, through which the rod slips, lies where a load "
                                         "acts, the section changes or rods are joined: put it a little beside");
  for (int step = 0; best.ok(); ++step) {
    const RodState state = solver->starting_state(&best);
    const Reduced reduced = reduce(*solver, state, problem, options, clips);
    if (!reduced.sound) {
      set_status(best, Status::stalled, "the second derivative is singular while a clip slides");
      break;
    }
    Eigen::VectorXd slip = slip_of(reduced);
    double share = 1, largest = 0;
    for (std::size_t k = 0; k < clips.size(); ++k) {
      const double here = at(problem, clips[k]), length = problem.rods[clips[k].rod].rod.length;
      const double room = slip[k] > 0 ? clips[k].high - here : here - clips[k].low;
      if (room < nearest_stop * length && std::abs(slip[k]) > 1e-6 * length) {
        set_status(best, Status::infeasible,
                   "the rod slides out of the clip that was put at " + number_text(given.rods[clips[k].rod].holds[clips[k].hold].at) +
                       " m: it has reached " + number_text(here) + " m");
        break;
      }
      if (std::abs(slip[k]) > longest_slip * room) share = std::min(share, longest_slip * room / std::abs(slip[k]));
      largest = std::max(largest, std::abs(slip[k]) / length);
    }
    if (!best.ok()) break;
    const bool bends_up = Eigen::LLT<Eigen::MatrixXd>(reduced.curvature).info() == Eigen::Success;
    if (largest < std::max(1e-9, options.tolerance) && bends_up) break;
    if (step == most_steps) {
      set_status(best, Status::stalled, "the rod does not settle in its clips in " + std::to_string(most_steps) + " steps");
      break;
    }
    // A step that does not lower the energy is halved.
    const double before = best.energy(), rounding = 1e-12 * std::abs(before) + 1e-300;
    bool lower = false;
    for (int half = 0; half < 12 && !lower; ++half, share *= 0.5) {
      SystemProblem trial = problem;
      for (std::size_t k = 0; k < clips.size(); ++k) at(trial, clips[k]) += share * slip[k];
      auto next = std::make_unique<NetworkSolver>(trial, options);
      SystemEquilibrium found = next->solve(context, &best);
      iterations += found.rods.front().iterations;
      if (!found.ok() && found.rods.front().status != Status::stalled) {
        set_status(best, found.rods.front().status, found.rods.front().message);
        break;
      }
      lower = found.ok() && found.energy() <= before + rounding;
      if (!lower) continue;
      problem = std::move(trial);
      solver = std::move(next);
      best = std::move(found);
    }
    if (!best.ok()) break;
    if (!lower) {
      if (largest > 1e-6) set_status(best, Status::stalled, "no way for the rod to slide on in its clips lowers the energy");
      break;
    }
  }
  for (Equilibrium& rod : best.rods) rod.iterations = iterations;
  return best;
}

}  // namespace tendril
