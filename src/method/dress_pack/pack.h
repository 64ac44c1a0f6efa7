// A dress pack: rods whose holds are fastened to the links of a robot.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geometry/surroundings.h"
#include "method/dress_pack/joint_path.h"
#include "statics/problem.h"

namespace tendril::dress_pack {

/// A hold that a link carries. What the hold holds (position, orientation) and where along the rod, the rod's problem says.
struct Attachment {
  int rod = 0;       ///< of the pack
  int hold = 0;      ///< of the rod's problem; its frame there is not read
  int link = 0;      ///< 0: the robot's base
  Frame in_link = {};  ///< the section's frame in the link's axes, m
};

/// Something solid that the rods, and the robot, keep clear of or touch.
struct PackBody {
  Obstacle body;   ///< its pose: in world axes, or in those of
  int link = -1;   ///< a link that carries it; -1: fixed
};

/// Holds that no attachment names stay in the world where their rod's problem has them.
struct PackProblem {
  std::shared_ptr<const Robot> robot;
  Frame base = {};                      ///< of the robot's link 0, in world axes
  std::vector<RodProblem> rods;
  std::vector<Attachment> attachments;
  std::vector<PackBody> bodies = {};    ///< reports number them in this order
  std::vector<std::string> names = {};  ///< of the rods, for messages; may be empty

  std::string rod_name(int rod) const;                ///< "hose"; without names "rod 1"
  std::string attachment_name(int attachment) const;  ///< "hose.start", "hose.finish", "hose.0.4": an arc length in m

  /// Throws UsageError naming what is missing or does not exist: robot, rods, attachments, links and holds; a hold attached
  /// twice; dead moments (their work depends on the way); rods with surroundings of their own, beside the bodies; bodies on links
  /// that do not exist; and as RodProblem::check() and Surroundings::add() do.
  void check() const;

  /// A rod slips through one of its holds: such packs can be simulated, but not optimised.
  bool slides() const;

  /// World frames of the attachments, one each. Throws UsageError as Robot::link_frame() does.
  void poses(const JointVector& q, std::vector<Frame>& out) const;
  std::vector<Frame> poses(const JointVector& q) const;

  /// d(increments)/dq, six rows for each attachment: translation in world axes (m), rotation in the section's own axes (rad). These
  /// are the increments of block_system.h. `out`: resized to 6 attachments x joints.
  void jacobian(const JointVector& q, Eigen::MatrixXd& out) const;

  /// What statics solves when the robot stands at q.
  SystemProblem system_at(const JointVector& q) const;
  void place(const std::vector<Frame>& poses, SystemProblem& system) const;
};

}  // namespace tendril::dress_pack
