// What refinement adjusts of a harness as a list of numbers: the unstressed length of every stretch between two places where a
// branch is held or joined, and the directions in which branches other than the trunk leave their junctions. The statics problems
// that they make, and what they change of those to first order.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "method/route/harness_routing.h"
#include "statics/parameter.h"

namespace tendril::routing {

class HarnessVariables {
 public:
  /// Of a routed harness with these clips, whose arc lengths `at` are those of rods as long as design.lengths says.
  HarnessVariables(const Scene& scene, const HarnessResult& harness, const HarnessDesign& design);

  struct Variable {
    enum class Kind { stretch, tilt };
    Kind kind = Kind::stretch;
    int branch = 0;            ///< of a stretch; of a tilt: the one that leaves
    int index = 0;             ///< which stretch of it; of a tilt: about which axis of the section (0: d1, 1: d2)
    int junction = 0, section = 0;  ///< of a tilt
    double start = 0, lower = 0, upper = 0;  ///< m or rad
    double scale = 1;          ///< a change of this much is of order one
  };
  const std::vector<Variable>& variables() const { return variables_; }
  int size() const { return static_cast<int>(variables_.size()); }
  Eigen::VectorXd start() const;

  /// `x`: values of the variables in m and rad.
  HarnessDesign design(const Eigen::VectorXd& x) const;

  /// Rods that hang together. Numbers are those of branches and junctions.
  struct Group {
    SystemProblem problem;     ///< without surroundings
    std::vector<int> branches, junctions;
  };
  std::vector<Group> problems(const Eigen::VectorXd& x) const;
  int group_of(int branch) const { return group_[branch]; }
  int place_in_group(int branch) const { return place_[branch]; }

  /// First-order change of the problem of group_of(variable's branch) per unit of a variable.
  std::vector<std::pair<Parameter, double>> direction(int variable, const Eigen::VectorXd& x) const;
  /// d s / d variable at arc lengths of a branch's mesh (m, rising).
  std::vector<double> moves_along(int variable, int branch, const Eigen::VectorXd& x, const std::vector<double>& s) const;

 private:
  /// Arc lengths of a branch where it is held or joined, from 0 to its length.
  std::vector<double> stops(int branch, const Eigen::VectorXd& x) const;
  Vec3 tilt(int junction, int section, const Eigen::VectorXd& x) const;

  HarnessDesign first_;
  std::vector<Group> base_;
  std::vector<int> group_, place_;
  std::vector<int> first_stretch_;          ///< by branch: number of a variable
  std::vector<std::vector<int>> first_tilt_;///< by junction and section; -1: none
  std::vector<Variable> variables_;
};

/// The harness as it is routed: the route's lengths and directions, no clips.
HarnessDesign design_as_routed(const HarnessResult& harness);

}  // namespace tendril::routing
