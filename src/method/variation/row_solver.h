// Rows of variables in, measures out: all systems of a scene together.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "method/variation/measures.h"
#include "method/variation/system_solver.h"
#include "method/variation/variables.h"
#include "scene/scene_equilibrium.h"

namespace tendril::variation {

/// What became of some rows.
struct RowAnswers {
  std::vector<SystemAnswers> systems;
  std::vector<OutcomeStatus> status;  ///< the worst of the systems'
  std::vector<double> measured;       ///< row by row
};

class RowSolver {
 public:
  /// All three must outlive this.
  RowSolver(const SceneEquilibrium& nominal, const Variables& variables, const Measures& measures, const SolveOptions& options,
            const RunContext& context);

  /// `values`: row by row. Measures that are built in; NaN where a row has no equilibrium.
  void solve(std::span<const double> values, int rows, bool whole, RowAnswers& answers, const RunContext& context) const;

  /// How many rows make a good portion: enough to fill the lanes of all threads, few where each takes long.
  int portion(const RunContext& context) const;

  /// One row as an equilibrium of the scene; it was solved with `whole`.
  SceneEquilibrium equilibrium(std::span<const double> row, const RowAnswers& answers, int number) const;
  std::string message(const RowAnswers& answers, int row) const;

  /// Frames of a rod of the scene, seven numbers a vertex; `scratch` holds what is not in a batch's results.
  std::span<const double> frames(const RowAnswers& answers, int row, int rod, std::vector<double>& scratch) const;

 private:
  void read_measures(std::span<const double> values, RowAnswers& answers, const RunContext& context) const;

  const SceneEquilibrium& nominal_;
  const Variables& variables_;
  const Measures& measures_;
  std::vector<std::unique_ptr<SystemSolver>> systems_;
  std::vector<std::pair<int, int>> place_of_rod_;  ///< system and number there, by rod of the scene
};

}  // namespace tendril::variation
