// Which links of a robot touch each other or their surroundings.
#pragma once

#include <string>
#include <vector>

#include "base/run_context.h"
#include "geometry/collision.h"
#include "robot/robot.h"

namespace tendril {

/// Why a pair of links is not looked at.
enum class PairKind { checked, rigid, neighbours, always, never };

/// "checked", "rigid", "neighbours", "always", "never".
const char* name_of(PairKind kind);

struct LinkPair {
  int a, b;  ///< links with collision bodies, a < b
  PairKind kind;
};

/// Two that touch: link and link, or link and obstacle.
struct RobotContact {
  int link;
  int other_link = -1;
  int obstacle = -1;
};

struct PairOptions {
  int samples = 10'000;  ///< places drawn within the joint limits, to find the pairs that always or never touch
  std::uint64_t seed = 1;
  bool skip_never = true;  ///< false: pairs that no sample has seen touching are checked all the same
};

/// Links are taken by their collision bodies. Not looked at: links that are joined rigidly; neighbours, which are joined by
/// one moving joint (each with all that is rigidly joined to it); pairs that touch at every sampled place, whose bodies
/// overlap by the way they were modelled; and pairs that touch at none (so a touch rarer than one in `samples` can be missed:
/// see PairOptions::skip_never). Obstacles are checked against the links that move.
///
/// Meshes are read by the constructor. Queries are const and safe from several threads.
class RobotCollision {
 public:
  /// Throws UsageError for meshes that cannot be read and fewer than one sample. Polls the context; stopped by it, pairs that
  /// were not decided are checked.
  explicit RobotCollision(std::shared_ptr<const Robot> robot, const PairOptions& options = {}, const RunContext& context = {});

  const Robot& robot() const { return *robot_; }
  const std::vector<LinkPair>& pairs() const { return pairs_; }
  bool decided() const { return decided_; }  ///< false: stopped before all samples were looked at

  /// In the axes of the robot's base. Returns the obstacle's number, counted from 0; throws UsageError as CollisionBodies::add.
  int add_obstacle(const CollisionShape& shape, const Frame& pose);
  int obstacles() const { return static_cast<int>(obstacles_.size()); }

  /// All that touch; pairs of links first, in the order of links, then obstacles. Throws UsageError for a `q` that does not fit.
  std::vector<RobotContact> contacts(Robot::JointValues q) const;
  /// Whether anything touches: stops at the first.
  bool any(Robot::JointValues q) const;

 private:
  struct Body {
    int number;
    Frame pose;  ///< in the link's axes
  };
  struct Obstacle {
    int number;
    Frame pose;
  };
  void add_bodies();
  void sort_pairs();
  void sample_pairs(const PairOptions& options, const RunContext& context);
  bool touch(int a, int b, const std::vector<Frame>& frames) const;
  bool touch_obstacle(int link, const Obstacle& obstacle, const std::vector<Frame>& frames) const;
  template <class Visit>
  void visit_contacts(Robot::JointValues q, Visit&& visit) const;

  std::shared_ptr<const Robot> robot_;
  CollisionBodies bodies_;
  std::vector<std::vector<Body>> links_;  ///< the bodies of each link
  std::vector<int> group_;                ///< of each link: the first link that it is rigidly joined to
  std::vector<LinkPair> pairs_;
  bool decided_ = true;
  std::vector<Obstacle> obstacles_;
};

}  // namespace tendril
