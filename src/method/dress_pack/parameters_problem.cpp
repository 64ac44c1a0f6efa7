// The objective of parameters.h and its gradient.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "method/dress_pack/parameters.h"

namespace tendril::dress_pack {
namespace {

constexpr double difference = 1e-4;       // share of the bounds' distance: of equilibria
constexpr double pose_difference = 1e-5;  // the same, of poses

PathWeights no_effort() {
  PathWeights weights;
  weights.effort = 0;
  return weights;
}

double share_of(std::size_t k, std::size_t times) { return (k == 0 || k + 1 == times ? 0.5 : 1.0) / static_cast<double>(times - 1); }

/// Tasks on as many threads as there are; results by index.
template <class Work>
void each_task(std::size_t tasks, int threads, Work work) {
  const int workers = std::min(thread_count(threads), static_cast<int>(tasks));
  run_workers(workers, [&](int worker) {
    for (std::size_t k = worker; k < tasks; k += workers) work(k);
  });
}

}  // namespace

ParameterProblem::ParameterProblem(const PackProblem& pack, const std::vector<PackParameter>& parameters, const std::vector<PackTask>& tasks,
                                   const ParameterOptions& options)
    : pack_(pack), parameters_(parameters), tasks_(tasks), options_(options) {}

Eigen::VectorXd ParameterProblem::start() const {
  Eigen::VectorXd x(variables());
  for (int k = 0; k < variables(); ++k) x[k] = (parameters_[k].start - parameters_[k].lower) / (parameters_[k].upper - parameters_[k].lower);
  return x;
}

std::vector<double> ParameterProblem::values_of(const Eigen::VectorXd& x) const {
  std::vector<double> out;
  for (int k = 0; k < variables(); ++k) out.push_back((1 - x[k]) * parameters_[k].lower + x[k] * parameters_[k].upper);
  return out;
}

PackProblem ParameterProblem::pack_with(const Eigen::VectorXd& x) const {
  PackProblem out = pack_;
  const std::vector<double> values = values_of(x);
  for (int k = 0; k < variables(); ++k) parameters_[k].apply(values[k], out);
  return out;
}

double ParameterProblem::length_of(const PackProblem& pack) const {
  double sum = 0;
  for (const RodProblem& rod : pack.rods) sum += rod.rod.length;
  return sum;
}

ParameterProblem::Point ParameterProblem::at(const Eigen::VectorXd& x, const RunContext& context) const {
  Point out;
  out.x = x;
  const PackProblem pack = pack_with(x);
  pack.check();
  std::vector<PackFollower::Outcome> ways(tasks_.size());
  std::vector<double> costs(tasks_.size());
  out.states.resize(tasks_.size());
  RunContext silent = context;
  silent.progress = nullptr;
  each_task(tasks_.size(), context.threads, [&](std::size_t k) {
    ReducedProblem problem(pack, tasks_[k].path, options_.steps, options_.demands, no_effort());
    ways[k] = problem.start(silent);
    costs[k] = problem.objective();
    out.states[k] = problem.states();
  });
  out.objective = options_.length_weight * length_of(pack);
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    if (!ways[k].ok()) {
      out.status = ways[k].status;
      out.message = "the rods cannot follow path " + std::to_string(k + 1) + ": " + ways[k].message;
      return out;
    }
    out.objective += tasks_[k].weight * costs[k];
  }
  out.status = std::isfinite(out.objective) ? Status::solved : Status::stalled;
  return out;
}

bool ParameterProblem::gradient(const Point& point, Eigen::VectorXd& out, const RunContext& context) const {
  const PackProblem pack = pack_with(point.x);
  std::vector<Eigen::VectorXd> slopes(tasks_.size());
  std::vector<char> good(tasks_.size());
  each_task(tasks_.size(), context.threads, [&](std::size_t k) { good[k] = task_gradient(point, pack, k, slopes[k], context); });
  out.setZero(variables());
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    if (!good[k]) return false;
    out += tasks_[k].weight * slopes[k];
  }
  if (options_.length_weight == 0) return true;
  // The length is linear in what changes it.
  for (int i = 0; i < variables(); ++i) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(variables(), i);
    const double change = length_of(pack_with(point.x + difference * unit)) - length_of(pack_with(point.x - difference * unit));
    out[i] += options_.length_weight * change / (2 * difference);
  }
  return true;
}

bool ParameterProblem::task_gradient(const Point& point, const PackProblem& pack, std::size_t task, Eigen::VectorXd& out,
                                     const RunContext& context) const {
  out.setZero(variables());
  if (!adjoint(point, pack, task, out, context)) return false;
  for (int i = 0; i < variables(); ++i) {
    if (parameters_[i].moves_attachments) continue;
    const Eigen::VectorXd by = difference * Eigen::VectorXd::Unit(variables(), i);
    double more = 0, less = 0;
    const PackProblem larger = pack_with(point.x + by), smaller = pack_with(point.x - by);
    if (!moved_cost(point, larger, task, more, context) || !moved_cost(point, smaller, task, less, context)) return false;
    out[i] = (more - less) / (2 * difference);
  }
  return true;
}

/// Of the parameters that move attachments: how they move them, and what that changes.
bool ParameterProblem::adjoint(const Point& point, const PackProblem& pack, std::size_t task, Eigen::VectorXd& out,
                               const RunContext& context) const {
  std::vector<int> movers;
  for (int i = 0; i < variables(); ++i)
    if (parameters_[i].moves_attachments) movers.push_back(i);
  if (movers.empty()) return true;
  std::vector<PackProblem> ahead, behind;
  for (const int i : movers) {
    const Eigen::VectorXd by = pose_difference * Eigen::VectorXd::Unit(variables(), i);
    ahead.push_back(pack_with(point.x + by));
    behind.push_back(pack_with(point.x - by));
  }
  PackStatics statics(pack);
  const PackCost cost(statics, options_.demands);
  const std::vector<double> times = JointPath::times(options_.steps);
  Eigen::VectorXd by_load;
  std::vector<Vec6> by_node;
  std::vector<Frame> more, less;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (context.stop() || !statics.stand_at(point.states[task][k])) return false;
    cost.slopes(statics, point.states[task][k], by_load, by_node);
    const Eigen::VectorXd by_pose = statics.pull_back(by_load, by_node);
    const JointVector q = tasks_[task].path.at(times[k]);
    for (std::size_t m = 0; m < movers.size(); ++m) {
      ahead[m].poses(q, more);
      behind[m].poses(q, less);
      double sum = 0;
      for (int a = 0; a < statics.attachments(); ++a)
        sum += by_pose.segment<3>(6 * a).dot(more[a].at - less[a].at) +
               by_pose.segment<3>(6 * a + 3).dot(log_rotation(less[a].rotation.conjugate() * more[a].rotation));
      out[movers[m]] += share_of(k, times.size()) * sum / (2 * pose_difference);
    }
  }
  return true;
}

/// The mean cost of a changed pack at the equilibria next to those of the point.
bool ParameterProblem::moved_cost(const Point& point, const PackProblem& pack, std::size_t task, double& cost, const RunContext& context) const {
  PackStatics statics(pack);
  const std::vector<RodState>& states = point.states[task];
  if (statics.network().nodes() != static_cast<int>(states.front().r.size())) {
    // The rod is cut otherwise: its motion begins anew.
    ReducedProblem anew(pack, tasks_[task].path, options_.steps, options_.demands, no_effort());
    const bool ok = anew.start(context).ok();
    cost = anew.objective();
    return ok;
  }
  const PackCost judge(statics, options_.demands);
  const std::vector<double> times = JointPath::times(options_.steps);
  std::vector<Frame> poses;
  cost = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (context.stop()) return false;
    RodState state = states[k];
    pack.poses(tasks_[task].path.at(times[k]), poses);
    if (!statics.move(state, poses).ok) return false;
    statics.load_at(state);
    cost += share_of(k, times.size()) * judge.value(statics, state);
  }
  return true;
}

}  // namespace tendril::dress_pack
