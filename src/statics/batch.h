// Many outcomes of one design at once: equilibria of systems that share their structure and differ in numbers.
//
// Every outcome starts from the nominal equilibrium, moved by its first-order change; four or eight of them share the
// lanes of one SIMD register, by the processor that the program runs on. What an outcome gets depends on neither its
// neighbours in the lanes, nor the number of threads, nor the order of calls: the same bits always, and the same for AVX2
// and AVX-512. (A processor or build without fused multiply-add rounds differently.) Lanes take the scalar Newton's shift
// and shortened steps where they must; an outcome that does not settle within a few tens of iterations, or whose structure
// is another one, is solved by the scalar solver, and one that makes no sense is reported.
//
// Same structure: the same rods, branch points, holds and loads by number and kind, the same numbers of segments and parts.
// All other numbers may vary: lengths, places along the rods, sections, gravity, frames, forces, shapes.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "statics/batch_predictor.h"
#include "statics/equilibrium.h"

namespace tendril {

/// How one outcome ended.
struct BatchOutcome {
  Status status = Status::cancelled;
  int iterations = 0;     ///< factorisations
  double last_step = 0;   ///< rotations in rad, positions relative to the longest rod
  bool scalar = false;    ///< solved by the scalar solver
  bool ok() const { return status == Status::solved; }
};

/// The answers of a batch, outcome by outcome. Kept from call to call, it is not allocated anew.
class BatchResults {
 public:
  int size() const { return static_cast<int>(outcomes_.size()); }
  const BatchOutcome& operator[](int outcome) const { return outcomes_[outcome]; }

  int rods() const { return static_cast<int>(first_vertex_.size()) - 1; }
  int vertices(int rod) const { return first_vertex_[rod + 1] - first_vertex_[rod]; }
  int holds(int rod) const { return first_hold_[rod + 1] - first_hold_[rod]; }
  int branches() const { return branches_; }

  /// Frames of a rod's vertices: position (m) and quaternion w, x, y, z, seven numbers a vertex, in order of arc length.
  std::span<const double> frames(int outcome, int rod) const;
  Frame frame(int outcome, int rod, int vertex) const;
  Frame branch(int outcome, int branch) const;
  /// What hold k exerts on the rod: N, N m, world axes, the moment about the hold; from the last step's linearisation.
  struct Support {
    Vec3 force, moment;
  };
  Support reaction(int outcome, int rod, int hold) const;
  /// What holds a branch point, about its place; zero where it is free.
  Support branch_support(int outcome, int branch) const;
  /// Why an outcome is not solved; empty for those that are.
  std::string message(int outcome) const;

 private:
  friend class Batch;
  friend class BatchWorker;
  void resize(int outcomes, const SystemProblem& nominal, const BatchLayout& layout);
  Support support(int outcome, int index) const;
  double* frames_of(int outcome) { return &frames_[static_cast<std::size_t>(outcome) * frame_numbers_]; }
  double* reactions_of(int outcome) { return &reactions_[static_cast<std::size_t>(outcome) * reaction_numbers_]; }

  std::vector<BatchOutcome> outcomes_;
  std::vector<int> first_vertex_, first_hold_;  ///< by rod
  int branches_ = 0;
  int frame_numbers_ = 0, reaction_numbers_ = 0;  ///< by outcome
  std::vector<double> frames_;                    ///< rods' vertices, then branch points
  std::vector<double> reactions_;                 ///< by hold, then by branch point: force, moment
  std::map<int, std::string> messages_;
};

class Batch {
 public:
  /// Makes outcome k of a problem that is the nominal one or an earlier outcome: it sets everything that varies. Called
  /// from several threads at once, for every outcome at least once.
  using Fill = std::function<void(int outcome, SystemProblem& problem)>;

  /// Frames of the nominal equilibrium: of each rod's vertices, and of the branch points.
  struct Start {
    std::vector<std::vector<Frame>> vertices;
    std::vector<Frame> branches;
  };

  /// Solves the nominal problem. Throws UsageError for a problem that batches do not know (see why_not) or whose nominal
  /// equilibrium is not found.
  Batch(const SystemProblem& nominal, const SolveOptions& options = {}, const RunContext& context = {});
  /// Starts from an equilibrium that is known. `varied`: problems that, one or the other, differ from the nominal one in
  /// every number that outcomes will differ in: only those get derivatives, which saves most of the set-up of large systems.
  /// Empty: all numbers.
  Batch(const SystemProblem& nominal, const Start& start, const SolveOptions& options = {},
        std::span<const SystemProblem> varied = {});

  /// Empty, or why this problem is not one for batches: contact, dead moments, clips that slide, closed loops.
  static std::string why_not(const SystemProblem& problem, const SolveOptions& options = {}) {
    return BatchLayout::why_not(problem, options);
  }

  /// Solves `outcomes` outcomes. Cancelled or out of time it keeps what is done; the rest has that status.
  void solve(int outcomes, const Fill& fill, BatchResults& results, const RunContext& context = {}) const;
  void solve(std::span<const SystemProblem> outcomes, BatchResults& results, const RunContext& context = {}) const;

  /// Where an outcome will be to first order: nominal equilibrium plus derivatives times changes. The nominal equilibrium
  /// itself for an outcome of another structure, or one so far off that first order means nothing.
  Start predicted(const SystemProblem& outcome) const;

  const BatchLayout& layout() const { return layout_; }

  /// A kernel other than the fastest one: for tests and benchmarks.
  void use(const BatchKernel& kernel) { kernel_ = &kernel; }
  const BatchKernel& kernel() const { return *kernel_; }

 private:
  friend class BatchWorker;
  void begin(const Start& start, std::span<const SystemProblem> varied);
  std::vector<char> varying_numbers(std::span<const SystemProblem> varied) const;

  SystemProblem nominal_;
  SolveOptions options_;
  BatchLayout layout_;
  const BatchKernel* kernel_;
  std::vector<double> parameters_, frames_, wrenches_;  ///< of the nominal equilibrium
  SystemEquilibrium equilibrium_;                       ///< its shapes alone: where the scalar solver starts
  std::vector<std::vector<double>> shares_;             ///< its vertices' arc lengths over the length, by rod
  BatchPredictor predictor_;
};

}  // namespace tendril
