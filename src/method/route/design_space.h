// The adjustable parameters of a design as a list of numbers: their names, bounds and scales, the design that they make, and what
// they change of a statics problem to first order.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "method/route/local_refinement.h"
#include "statics/parameter.h"

namespace tendril::routing {

class DesignSpace {
 public:
  /// Throws UsageError, beginning with "refine", for a design and options that make no sense.
  DesignSpace(const Design& design, const RefinementOptions& options);

  struct Variable {
    enum class Kind { length, from_turn, to_turn, from_tilt, to_tilt, clip };
    Kind kind = Kind::length;
    int index = 0;            ///< which axis of a tilt (0: d1, 1: d2), which clip
    std::string name, unit;
    double start = 0;         ///< of the design, m or rad
    double lower = 0, upper = 0;
    double scale = 1;         ///< a change of this much is of order one
  };
  const std::vector<Variable>& variables() const { return variables_; }
  int size() const { return static_cast<int>(variables_.size()); }

  /// Whether the clips stand in their order inside the rod: bounds alone do not see to it when several variables change.
  bool in_order(const Eigen::VectorXd& x) const;
  /// `x`: values of the variables in m and rad.
  Design design(const Eigen::VectorXd& x) const;
  /// Holds are: from, the clips, to. Without surroundings. The number of segments between holds is that of the first design.
  RodProblem problem(const Design& design, const Vec3& gravity) const;

  /// First-order change of problem(x) per unit of a variable: a sum of parameters with weights.
  std::vector<std::pair<Parameter, double>> direction(int variable, const Eigen::VectorXd& x) const;
  /// d s / d variable at arc lengths of a mesh (m, rising): how the vertices move along the rod.
  std::vector<double> moves_along(int variable, const RodProblem& problem, const std::vector<double>& s) const;

  /// A stretch between two holds must be as long as the straight way between them.
  struct Span {
    int begin = 0, end = 0;   ///< holds of the problem
    double chord = 0;         ///< m, over sliding clips between
  };
  const std::vector<Span>& spans() const { return spans_; }

 private:
  void check() const;
  void list_spans();
  void list_variables();
  void add_tilts(const std::string& name, Variable::Kind kind);
  double value(const Eigen::VectorXd& x, Variable::Kind kind, int index, double otherwise) const;
  Frame turned(const Frame& frame, const Eigen::VectorXd& x, Variable::Kind turn, Variable::Kind tilt) const;

  Design first_;
  RefinementOptions options_;
  std::vector<Variable> variables_;
  std::vector<Span> spans_;
};

}  // namespace tendril::routing
