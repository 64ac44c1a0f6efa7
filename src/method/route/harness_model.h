// A harness as a function of what refinement adjusts (harness_variables.h): how it comes to rest, what it costs, and how well it
// keeps bend radius and clearance, with exact derivatives by the sensitivities of its equilibrium.
#pragma once

#include <memory>
#include <vector>

#include "method/route/constrained_descent.h"
#include "method/route/gap_profile.h"
#include "method/route/harness_variables.h"
#include "method/route/surroundings_by_use.h"
#include "statics/measure.h"

namespace tendril {
class SystemSensitivity;
}

namespace tendril::routing {

/// What all designs of one routed harness share.
struct HarnessSurroundings {
  HarnessSurroundings(const Scene& scene, const HarnessResult& harness);

  SurroundingsByUse by_use;
  SignedGap demanded;                        ///< obstacles that demand a clearance, and zones that are kept out of
  std::vector<Equilibrium> route;            ///< by branch: the first guess, in front of all surfaces
  double room_scale = 1;                     ///< m
};

/// Arc lengths (m) of a branch's rod between which gaps are judged: outside the free ends.
std::pair<double, double> judged_stretch(const HarnessBranch& branch, const HarnessOptions& options, double length);

/// Scaled variables are those of harness_variables.h over their scales. Slacks are shares of what is demanded.
class HarnessModel final : public ConstrainedProblem {
 public:
  /// All must outlive this. `harness`: routed.
  HarnessModel(const HarnessSurroundings& around, const HarnessResult& harness, const HarnessVariables& variables,
               const RunContext& context);

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  Value evaluate(const Eigen::VectorXd& x) override;
  void accept() override { accepted_ = candidate_; }
  bool linearise(const std::vector<Tag>& always, Linear& out) override;
  Eigen::VectorXd slacks(const std::vector<Tag>& tags) override;

  /// Scaled variables of the design that was given.
  Eigen::VectorXd start() const { return variables_->start().cwiseQuotient(scale_); }
  HarnessDesign design(const Eigen::VectorXd& x) const { return variables_->design(x.cwiseProduct(scale_)); }

  struct State {
    Eigen::VectorXd x;                       ///< scaled
    std::shared_ptr<const SceneEquilibrium> equilibrium;
    Value value;
    std::vector<std::vector<Room>> rooms;    ///< by branch
    const Equilibrium& rod(int branch) const { return equilibrium->rods[branch].equilibrium; }
  };
  const State& accepted() const { return accepted_; }
  const State& candidate() const { return candidate_; }
  int evaluations() const { return evaluations_; }

  /// Equilibria begin from this one (of another design of the same harness) instead of from the route.
  void begin_from(std::shared_ptr<const SceneEquilibrium> equilibrium) { accepted_.equilibrium = std::move(equilibrium); }
  /// From now on equilibria are found in contact with all obstacles.
  void touch_all() { contact_ = around_->by_use.all.get(); }
  bool touches_all() const { return contact_ == around_->by_use.all.get(); }

  /// Something that a state misses, or nearly so.
  struct Place {
    int branch = 0;
    double s = 0;                            ///< m, of the rod
    double slack = 0;                        ///< share of what is demanded
  };
  /// By branch and place the slacks of bend radii and rooms, those below `below`. What a whole branch misses is at its middle.
  std::vector<Place> tight_places(const State& state, double below) const;

 private:
  enum Kind { bend, room, stretch, wall, kinds };
  static Tag tag_of(Kind kind, int branch, double place) { return {kind + kinds * branch, place}; }
  std::shared_ptr<SceneEquilibrium> solved(const Eigen::VectorXd& x) const;
  double cost_at(const State& state, Eigen::VectorXd* slope, const std::vector<SystemSensitivity>* sensitivities) const;
  double slack_of(const Tag& tag, const State& state) const;
  Eigen::VectorXd slope_of(const Tag& tag, const std::vector<SystemSensitivity>& sensitivities) const;
  Eigen::VectorXd derivatives(const Measure& measure, int group, const std::vector<SystemSensitivity>& sensitivities) const;
  std::vector<Tag> pressing(const State& state) const;
  void add_pressing(const State& state, int branch, std::vector<Tag>& tags) const;
  Room room_at(const State& state, int branch, double place) const;
  double bend_slack(double radius) const;
  double least_slack(const State& state) const;
  bool walled() const { return harness_->options.space.keep_in.has_value(); }
  /// Distance to wall `side` (0: least x ... 5: largest z) of keep_in, m, of a vertex's surface.
  double wall_gap(const Equilibrium& rod, int vertex, int side) const;
  int nearest_to_wall(const State& state, int branch, int side) const;

  const HarnessSurroundings* around_;
  const HarnessResult* harness_;
  const HarnessVariables* variables_;
  const RunContext* context_;
  const ContactField* contact_;
  Eigen::VectorXd lower_, upper_, scale_;
  State accepted_, candidate_;
  int evaluations_ = 0;
  std::vector<std::vector<Parameter>> parameters_;               ///< by group
  std::vector<std::vector<std::pair<int, double>>> directions_;  ///< by variable: number of its group's parameter, weight
};

}  // namespace tendril::routing
