// One system of a scene, solved for many outcomes of its variables.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "method/variation/branch_check.h"
#include "method/variation/clear_way.h"
#include "method/variation/measures.h"
#include "method/variation/variables.h"
#include "scene/scene_equilibrium.h"
#include "statics/batch.h"

namespace tendril::variation {

/// What became of the outcomes ("rows") that were solved together.
struct SystemAnswers {
  BatchResults batch;                                            ///< empty where there is no batch
  std::vector<OutcomeStatus> status;
  std::vector<std::unique_ptr<SystemEquilibrium>> equilibria;    ///< null: what the batch says
  std::vector<std::string> messages;
};

class SystemSolver {
 public:
  /// `deviations`: the columns' standard deviations. The nominal equilibrium and the variables must outlive this.
  SystemSolver(const SceneEquilibrium& nominal, int system, const Variables& variables, std::span<const double> deviations,
               const SolveOptions& options, const RunContext& context);

  /// `values`: a row of columns for each outcome. `whole`: an equilibrium for each, else a batch's frames will do.
  void solve(std::span<const double> values, int rows, bool whole, SystemAnswers& answers, const RunContext& context) const;

  /// Outcomes go one by one, not in a batch.
  bool one_by_one() const { return !batch_ && varies_; }
  bool varies() const { return varies_; }
  const Batch* batch() const { return batch_ ? &*batch_ : nullptr; }
  const SystemEquilibrium& nominal() const { return nominal_; }
  std::size_t bytes_of_row() const;  ///< that the batch's answer to one row takes

  /// The problem of one outcome, or of a share of the way there, in place of an earlier one; without surroundings.
  void make_problem(std::span<const double> row, double share, SystemProblem& problem) const;

 private:
  struct Row;  ///< one outcome at work in one thread
  std::vector<SystemProblem> varied_problems(std::span<const double> deviations) const;
  void begin_batch(std::span<const double> deviations);
  void begin_check(std::span<const double> deviations, const RunContext& context);
  void settle(Row& row) const;
  void settle_batched(Row& row) const;
  void solve_alone(Row& row) const;
  void judge(Row& row) const;
  bool solve_half_way(const Row& row, Positions& out) const;
  void follow_from_nominal(Row& row) const;
  void make_whole(Row& row) const;
  void put_surroundings(SystemProblem& problem) const;
  double farthest_apart(const Row& row, const SystemEquilibrium& other) const;
  bool clear(Row& row) const;
  void read_positions(const SystemEquilibrium& equilibrium, Positions& out) const;
  void read_positions(const Row& row, Positions& out) const;

  const Variables& variables_;
  int number_;
  SolveOptions options_;
  SystemProblem problem_;        ///< nominal, with its surroundings
  SystemProblem free_problem_;   ///< without
  SystemEquilibrium nominal_;
  bool varies_ = false;
  std::optional<Batch> batch_;   ///< of the free problem
  std::optional<ClearWay> way_;  ///< with surroundings
  std::vector<std::string> rod_names_;
  std::vector<std::vector<double>> shares_;  ///< nominal vertices' arc lengths over the length, by rod
  std::vector<std::vector<int>> compared_;   ///< some vertices of each rod: those that tell one branch from another
  BranchCheck check_;
};

}  // namespace tendril::variation
