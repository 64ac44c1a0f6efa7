#include "statics/batch.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/error.h"
#include "base/parallel.h"
#include "statics/batch_scalar.h"
#include "statics/batch_worker.h"

namespace tendril {
namespace {

const SystemProblem& checked(const SystemProblem& problem, const SolveOptions& options) {
  if (const std::string why = Batch::why_not(problem, options); !why.empty())
    throw UsageError("batch: this problem cannot be solved in batches: " + why);
  problem.check();
  return problem;
}

Batch::Start nominal_start(const SystemProblem& nominal, const SolveOptions& options, const RunContext& context) {
  checked(nominal, options);
  const ScalarAnswer answer = solve_scalar(nominal, options, context);
  if (answer.status != Status::solved)
    throw UsageError("batch: the nominal equilibrium was not found: " + answer.message);
  return answer.at;
}

Frame frame_of(const double* n) { return {{n[0], n[1], n[2]}, Quat(n[3], n[4], n[5], n[6])}; }

}  // namespace

// ---------------------------------------------------------------- results

void BatchResults::resize(int outcomes, const SystemProblem& nominal, const BatchLayout& layout) {
  first_vertex_ = {0};
  first_hold_ = {0};
  for (int k = 0; k < layout.rods(); ++k) {
    first_vertex_.push_back(first_vertex_.back() + layout.vertices(k));
    first_hold_.push_back(first_hold_.back() + static_cast<int>(nominal.rods[k].holds.size()));
  }
  branches_ = static_cast<int>(nominal.branches.size());
  frame_numbers_ = 7 * (first_vertex_.back() + branches_);
  reaction_numbers_ = 6 * (first_hold_.back() + branches_);
  outcomes_.assign(outcomes, {});
  frames_.resize(static_cast<std::size_t>(outcomes) * frame_numbers_);
  reactions_.resize(static_cast<std::size_t>(outcomes) * reaction_numbers_);
  messages_.clear();
}

std::span<const double> BatchResults::frames(int outcome, int rod) const {
  return {&frames_[static_cast<std::size_t>(outcome) * frame_numbers_ + 7 * first_vertex_[rod]],
          static_cast<std::size_t>(7 * vertices(rod))};
}

Frame BatchResults::frame(int outcome, int rod, int vertex) const { return frame_of(&frames(outcome, rod)[7 * vertex]); }

Frame BatchResults::branch(int outcome, int branch) const {
  return frame_of(&frames_[static_cast<std::size_t>(outcome) * frame_numbers_ + 7 * (first_vertex_.back() + branch)]);
}

BatchResults::Support BatchResults::support(int outcome, int index) const {
  const double* n = &reactions_[static_cast<std::size_t>(outcome) * reaction_numbers_ + 6 * index];
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

BatchResults::Support BatchResults::reaction(int outcome, int rod, int hold) const {
  return support(outcome, first_hold_[rod] + hold);
}

BatchResults::Support BatchResults::branch_support(int outcome, int branch) const {
  return support(outcome, first_hold_.back() + branch);
}

std::string BatchResults::message(int outcome) const {
  const auto found = messages_.find(outcome);
  if (found != messages_.end()) return found->second;
  switch (outcomes_[outcome].status) {
    case Status::cancelled: return "interrupted before this outcome was solved";
    case Status::timeout: return "out of time before this outcome was solved";
    default: return {};
  }
}

// ---------------------------------------------------------------- nominal equilibrium

Batch::Batch(const SystemProblem& nominal, const SolveOptions& options, const RunContext& context)
    : Batch(nominal, nominal_start(nominal, options, context), options) {}

Batch::Batch(const SystemProblem& nominal, const Start& start, const SolveOptions& options,
             std::span<const SystemProblem> varied)
    : nominal_(nominal),
      options_(options),
      layout_(checked(nominal, options)),
      kernel_(&best_batch_kernel()),
      parameters_(layout_.parameter_count()),
      frames_(7 * layout_.node_count()),
      wrenches_(BatchBlocks::wrench * layout_.segment_count()) {
  begin(start, varied);
}

/// Empty: all of them, or not known.
std::vector<char> Batch::varying_numbers(std::span<const SystemProblem> varied) const {
  std::vector<char> varies;
  std::vector<double> numbers(parameters_.size());
  for (const SystemProblem& problem : varied) {
    if (!layout_.read(problem, numbers.data())) return {};
    varies.resize(numbers.size(), 0);
    for (std::size_t i = 0; i < numbers.size(); ++i) varies[i] = varies[i] || numbers[i] != parameters_[i];
  }
  return varies;
}

void Batch::begin(const Start& start, std::span<const SystemProblem> varied) {
  if (start.vertices.size() != nominal_.rods.size() || start.branches.size() != nominal_.branches.size())
    throw UsageError("batch: the nominal equilibrium has " + std::to_string(start.vertices.size()) + " rods and " +
                     std::to_string(start.branches.size()) + " branch points, expected " +
                     std::to_string(nominal_.rods.size()) + " and " + std::to_string(nominal_.branches.size()));
  for (int k = 0; k < layout_.rods(); ++k)
    if (static_cast<int>(start.vertices[k].size()) != layout_.vertices(k))
      throw UsageError("batch: the nominal equilibrium of rod " + std::to_string(k + 1) + " has " +
                       std::to_string(start.vertices[k].size()) + " vertices, expected " +
                       std::to_string(layout_.vertices(k)));
  if (!layout_.read(nominal_, parameters_.data()))
    throw UsageError("batch: the nominal problem holds a number that makes no sense");
  frames_ = layout_.node_frames(start.vertices, start.branches);
  // At an equilibrium an iteration changes nothing but the wrenches, which become the actual ones.
  BatchWorker(*this).refine(frames_, wrenches_);
  for (int k = 0; k < layout_.rods(); ++k) {
    Equilibrium rod;
    rod.s = layout_.arc_lengths(k, parameters_.data());
    shares_.push_back(rod.s);
    for (double& share : shares_.back()) share /= rod.s.back();
    for (const Frame& frame : start.vertices[k]) {
      rod.points.push_back(frame.at);
      rod.rotations.push_back(frame.rotation);
    }
    equilibrium_.rods.push_back(rod);
  }
  equilibrium_.branches = start.branches;
  predictor_ = BatchPredictor(layout_, *kernel_, parameters_, frames_, wrenches_, varying_numbers(varied));
}

Batch::Start Batch::predicted(const SystemProblem& outcome) const {
  std::vector<double> numbers(layout_.parameter_count()), frames = frames_, wrenches, scratch;
  if (layout_.read(outcome, numbers.data())) predictor_.predict(numbers, frames, wrenches, scratch);
  else numbers = parameters_;
  Start start;
  for (int k = 0; k < layout_.rods(); ++k) {
    start.vertices.emplace_back();
    for (int v = 0; v < layout_.vertices(k); ++v) {
      const BatchLayout::Vertex vertex = layout_.vertex(k, v);
      const Frame node = frame_of(&frames[7 * vertex.node]);
      start.vertices.back().push_back(vertex.joint < 0 ? node : node * frame_of(&numbers[vertex.joint]));
    }
  }
  for (std::size_t b = 0; b < nominal_.branches.size(); ++b)
    start.branches.push_back(frame_of(&frames[7 * layout_.branch_node(static_cast<int>(b))]));
  return start;
}

// ---------------------------------------------------------------- outcomes

void Batch::solve(int outcomes, const Fill& fill, BatchResults& results, const RunContext& context) const {
  results.resize(outcomes, nominal_, layout_);
  std::atomic<int> next = 0;
  std::mutex guard;
  // A worker is worth its start for a few packs.
  const int most = (outcomes + 4 * kernel_->lanes - 1) / (4 * kernel_->lanes);
  const int workers = std::min(thread_count(context.threads), most);
  run_workers(workers, [&](int) { BatchWorker(*this, {fill, results, next, guard, context}).run(); });
  const auto stop = context.stop();
  for (BatchOutcome& outcome : results.outcomes_)
    if (outcome.status == Status::cancelled && stop) outcome.status = *stop;
}

void Batch::solve(std::span<const SystemProblem> outcomes, BatchResults& results, const RunContext& context) const {
  solve(static_cast<int>(outcomes.size()),
        [&](int outcome, SystemProblem& problem) { problem = outcomes[outcome]; }, results, context);
}

}  // namespace tendril
