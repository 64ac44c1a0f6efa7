// Inverse kinematics: the joint values that bring a link to a frame.
//
// Arms of six turning joints whose second and third axes are parallel and whose last three meet in a point are solved in
// closed form, all branches (spherical_wrist.h); every other arm by damped least squares from many starts.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "robot/robot.h"
#include "robot/spherical_wrist.h"

namespace tendril {

struct InverseOptions {
  std::vector<double> near =
      {};                ///< all of q: solutions are given nearest to it first; joints that do not carry the link and joints
                         ///< that are free where the arm is singular stay there. Empty: 0, or the limit nearest to it
  bool limits = true;    ///< only solutions within the joint limits
  bool turns = true;     ///< also those that differ by whole turns, of joints whose limits leave room for two to six; false:
                         ///< of each only the one nearest to `near`. Without limits no turns are added.
  bool numeric = false;  ///< not in closed form, even where there is one
  int starts = 100;      ///< of the numeric search
};

struct InverseResult {
  /// solved; infeasible: proven that there is no solution; stalled: the numeric search found none; cancelled, timeout: what
  /// was found until then is kept.
  Status status = Status::infeasible;
  std::string message;                         ///< why there is none; with solutions: what is singular, else empty
  std::vector<std::vector<double>> solutions;  ///< of all of q, nearest to `near` first (largest difference of a joint)
  bool closed_form = false;
  bool singular = false;  ///< a joint may stand anywhere, or branches meet; see the message
};

/// Solutions reproduce the frame to 1e-9 (m, rad).
class InverseKinematics {
 public:
  /// For the frame of `link`.
  InverseKinematics(std::shared_ptr<const Robot> robot, int link);

  bool closed_form() const { return wrist_.has_value(); }
  const std::string& why_not_closed_form() const { return why_not_; }  ///< empty when it is

  /// Throws UsageError for a target or `near` that is not finite or not of the robot's size, and a negative count of starts.
  InverseResult solve(const Frame& target, const InverseOptions& options = {}, const RunContext& context = {}) const;

  /// How far the link is from the target with these joint values: m and rad added.
  double residual(Robot::JointValues q, const Frame& target) const;

 private:
  std::vector<double> reference(const InverseOptions& options) const;
  void solve_closed_form(const Frame& target, const InverseOptions& options, const std::vector<double>& near,
                         InverseResult& result) const;
  void solve_numeric(const Frame& target, const InverseOptions& options, const std::vector<double>& near,
                     const RunContext& context, InverseResult& result) const;
  bool polish(const Frame& target, std::vector<double>& q) const;
  std::vector<double> places_of(int v, double at, double near, const InverseOptions& options) const;
  void add_turns(const std::vector<double>& q, const InverseOptions& options, const std::vector<double>& near,
                 InverseResult& result) const;

  std::shared_ptr<const Robot> robot_;
  int link_;
  std::vector<int> moving_;  ///< entries of q that move the link, from the base on
  std::optional<SphericalWristArm> wrist_;
  std::string why_not_;
};

}  // namespace tendril
