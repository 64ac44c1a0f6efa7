// Stability analysis (thesis 2.3.2): how robust a design is to first order. The exact derivatives of measures by design
// variables, and how far each variable moves each rod.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/run_context.h"
#include "scene/scene_gradient.h"

namespace tendril::stability {

/// Names as in scene_gradient.h; a name that others begin with means all of them.
struct Variable {
  std::string name;
  double tolerance = 0;  ///< in the variable's unit; 0: none given
};

struct Options {
  std::vector<Variable> vary;         ///< empty: lengths, frames of holds and branch points, gravity
  std::vector<std::string> measures;  ///< empty: bend radius, tension, length and clearance of every rod
};

struct Result {
  struct Row {
    std::string name, unit;
    double value = 0;
    bool ok = false;      ///< its derivatives exist
    std::string message;
  };
  struct Column {
    std::string name, unit;
    double tolerance = 0;
  };
  bool ok = false;            ///< all of them exist
  Status status = Status::stalled;
  std::string message;        ///< "solved", or why derivatives are missing
  double seconds = 0;
  std::vector<Row> measures;
  std::vector<Column> variables;
  Eigen::MatrixXd matrix;  ///< measures x variables, unit of the measure over that of the variable; NaN in rows that are not ok
  Eigen::MatrixXd scaled;     ///< the same times the tolerance, unit of the measure; zero where none was given

  /// How far a unit of each variable moves the vertices of each rod, m per unit of the variable, world axes:
  /// [variable][rod][vertex]. Rods of the equilibrium in its order; zero where a variable does not reach. Empty where the rods
  /// have no derivatives.
  std::vector<std::vector<std::vector<Vec3>>> moves;

  /// At each vertex of a rod: the largest of |move| * tolerance over the variables that have one (m); without tolerances the
  /// norm over all variables of |move|. What colours a rod.
  std::vector<double> colour(int rod) const;

  std::string unit(int measure, int variable) const {
    return SceneGradient::unit_of(measures[measure].unit, variables[variable].unit);
  }
};

/// Throws UsageError for unknown names, with the nearest, and for an equilibrium without derivatives (staggered elements, clips
/// that slide, joined rods in contact). An equilibrium that is not solved gives a result that is not ok.
Result run(const SceneEquilibrium& equilibrium, const Options& options = {}, const RunContext& context = {});

}  // namespace tendril::stability
