// A design as a function of its adjustable parameters: its equilibrium, its cost, and how well it keeps what is demanded, with
// exact derivatives. What both solvers of local refinement work on.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "method/route/constrained_descent.h"
#include "method/route/design_space.h"
#include "method/route/gap_profile.h"
#include "method/route/surroundings_by_use.h"
#include "statics/measure.h"

namespace tendril {
class SystemSensitivity;
}

namespace tendril::routing {

/// Scaled variables are those of the space over their scales. Slacks are shares of what is demanded.
class DesignModel final : public ConstrainedProblem {
 public:
  /// Both must outlive this. Throws UsageError for a problem of statics that makes no sense.
  DesignModel(const SurroundingsByUse& around, const Vec3& gravity, const DesignSpace& space, const RefinementOptions& options,
              const RunContext& context);

  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  Value evaluate(const Eigen::VectorXd& x) override;
  void accept() override { accepted_ = candidate_; }
  bool linearise(const std::vector<Tag>& always, Linear& out) override;
  Eigen::VectorXd slacks(const std::vector<Tag>& tags) override;

  /// A first equilibrium at these variables, from the design's route, that passes through nothing: where it stands is outside.
  /// False: there is none.
  bool begin(const Eigen::VectorXd& x);
  const std::string& why_not() const { return why_not_; }

  Eigen::VectorXd start() const;                   ///< the design as it was given, scaled, within the bounds
  Eigen::VectorXd unscaled(const Eigen::VectorXd& x) const { return x.cwiseProduct(scale_); }

  /// A design in equilibrium.
  struct State {
    Eigen::VectorXd x;                             ///< scaled
    std::shared_ptr<const SceneEquilibrium> equilibrium;
    Value value;
    std::vector<Room> rooms;
    const Equilibrium& rod() const { return equilibrium->rods.front().equilibrium; }
    const RodProblem& problem() const { return equilibrium->rods.front().problem; }
  };
  const State& accepted() const { return accepted_; }
  void go_back_to(const State& state) { accepted_ = state; }

  /// The equilibrium at these variables in contact with all obstacles, from the accepted one.
  std::shared_ptr<SceneEquilibrium> verified(const Eigen::VectorXd& x) const;
  /// From now on equilibria are found in contact with all obstacles.
  void touch_all() { contact_ = around_->all.get(); }
  bool touches_all() const { return contact_ == around_->all.get(); }

  const std::vector<RefinementRecord>& history() const { return history_; }
  std::vector<RefinementRecord> take_history() { return std::move(history_); }

 private:
  enum Kind { span, bend, room, tension, strain };
  enum class Purpose { first, trial, last };
  std::shared_ptr<SceneEquilibrium> solved(const Eigen::VectorXd& x, const ContactField* contact, const Equilibrium* from,
                                           Purpose purpose) const;
  std::optional<Equilibrium> guess(const Design& design) const;
  double cost_at(const State& state, Eigen::VectorXd* slope, const SystemSensitivity* sensitivity) const;
  double cost_of_place(const Vec3& p, const Vec3& outside, double radius, Vec3* gradient) const;
  double span_slack(const RodProblem& problem, int index) const;
  double bend_slack(const Equilibrium& rod, int vertex) const;
  double least_slack(const State& state) const;
  std::vector<Tag> pressing(const State& state) const;
  Room room_at(const State& state, double place) const;
  double slack_of(const Tag& tag, const State& state) const;
  Eigen::VectorXd slope_of(const Tag& tag, const SystemSensitivity& sensitivity) const;
  Eigen::VectorXd derivatives(const Measure& measure, const SystemSensitivity& sensitivity) const;

  const SurroundingsByUse* around_;
  const ContactField* contact_;
  Vec3 gravity_;
  const DesignSpace* space_;
  const RefinementOptions* options_;
  const RunContext* context_;
  Eigen::VectorXd lower_, upper_, scale_;
  double room_scale_ = 1;     ///< m
  double span_share_ = 1;
  std::shared_ptr<const SceneEquilibrium> outside_;
  State accepted_, candidate_;
  std::string why_not_;
  std::vector<RefinementRecord> history_;
  RunContext::Clock::time_point began_ = RunContext::Clock::now();
  // Of the accepted state, kept while it is linearised.
  std::vector<Parameter> parameters_;
  std::vector<std::vector<std::pair<int, double>>> directions_;  ///< by variable: number of a parameter, weight
};

}  // namespace tendril::routing
