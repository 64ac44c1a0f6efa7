// A robot: rigid links joined in a tree, and its kinematics. It never changes: share it by shared_ptr.
//
// Link 0 is the base; joint k carries link k + 1 and hangs on an earlier link. `q` holds one number (rad or m) for each
// joint that moves by itself, in the order of variables(); joints that mimic another one have none of their own.
//
// Frames are those of the links, in the axes of the base: d1, d2, d3 are a link's x, y, z axes. Jacobians are of the link's
// own axes: rows 0-2 the motion of its origin (m), rows 3-5 its rotation vector (rad), both per unit of q. (Siciliano,
// Sciavicco, Villani, Oriolo: Robotics, 2009, chapters 2 and 3.)
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/frame.h"
#include "geometry/solids.h"
#include "robot/link_mesh.h"

namespace tendril {

enum class JointKind { fixed, revolute, continuous, prismatic };

/// "fixed", "revolute", "continuous", "prismatic".
const char* name_of(JointKind kind);

/// What joins a link to the one before it: the link's frame is origin * (turn about, or shift along, `axis`).
struct Joint {
  std::string name;
  JointKind kind = JointKind::fixed;
  int parent = 0;                                           ///< the link that it hangs on
  Frame origin = {};                                        ///< in the parent's axes
  Vec3 axis = Vec3::UnitX();                                ///< unit, in the joint's own axes
  double lower = -std::numeric_limits<double>::infinity();  ///< rad or m
  double upper = std::numeric_limits<double>::infinity();
  double velocity = std::numeric_limits<double>::infinity();  ///< rad/s or m/s; infinite: not stated
  int mimics = -1;                                            ///< another joint: this one stands at factor * (that one) + shift
  double factor = 1, shift = 0;
};

/// A body of a link, for pictures or for collision.
struct LinkShape {
  std::variant<std::shared_ptr<const LinkMesh>, Solid> shape;
  Frame pose = {};  ///< in the link's axes
};

struct Link {
  std::string name;
  std::vector<LinkShape> visual = {}, collision = {};
};

using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

class Robot {
 public:
  using JointValues = std::span<const double>;

  /// No place (m), axis, factor or shift of a joint may have a number beyond this: the next sums would leave the finite ones.
  static constexpr double largest_number = 1e9;

  /// links.size() must be joints.size() + 1. Throws UsageError naming the robot and the joint or link: names given twice or
  /// empty, a joint that hangs on a later link, numbers that are not finite or beyond largest_number, limits in the wrong order, axes of no length
  /// (they are made unit), a joint that mimics itself, a fixed one or one that mimics.
  Robot(std::string name, std::vector<Link> links, std::vector<Joint> joints);

  const std::string& name() const { return name_; }
  /// What load_robot() made it from, "builtin:NAME" or the path of a file; empty: it was made otherwise.
  const std::string& source() const { return source_; }
  Robot with_source(std::string source) const;
  const std::vector<Link>& links() const { return links_; }
  const std::vector<Joint>& joints() const { return joints_; }

  /// The joints behind the entries of q.
  const std::vector<int>& variables() const { return variables_; }
  int size() const { return static_cast<int>(variables_.size()); }  ///< entries of q
  const Joint& variable(int k) const { return joints_[variables_[k]]; }

  /// By name; throws UsageError with the nearest one.
  int link(const std::string& name) const;
  int joint(const std::string& name) const;

  int parent(int link) const { return link == 0 ? -1 : joints_[link - 1].parent; }
  /// The links from the base to `link`, both included.
  std::vector<int> chain(int link) const;
  /// The end of the arm: of the links that carry no other the one behind the most moving joints, then behind the most
  /// joints, then the first.
  int tip() const { return tip_; }

  /// Where a link is. Throws UsageError for a `q` of another size or with numbers that are not finite.
  Frame link_frame(int link, JointValues q) const;
  /// Where all links are; `frames` holds links().size() entries.
  void link_frames(JointValues q, std::span<Frame> frames) const;
  std::vector<Frame> link_frames(JointValues q) const;

  Jacobian jacobian(int link, JointValues q) const;
  /// The same into `out` (6 x size()), without allocating; returns the link's frame.
  Frame jacobian(int link, JointValues q, Eigen::Ref<Jacobian> out) const;

  /// The lower and upper limits of q: also of the joints that mimic, carried over to the one they follow.
  const std::vector<double>& lower() const { return lower_; }
  const std::vector<double>& upper() const { return upper_; }
  bool within_limits(JointValues q, double tolerance = 0) const;
  /// What is beyond its limits, in words; empty when nothing is.
  std::string beyond_limits(JointValues q, double tolerance = 0) const;

  /// Throws UsageError "who: ..." for a `q` of another size or with numbers that are not finite.
  void check(JointValues q, const char* who) const;

 private:
  // One joint as the inner loops read it.
  struct Step {
    Quat turn;        ///< of the origin
    Quat turn_axis;   ///< turn * (0, axis)
    Vec3 at;          ///< of the origin
    Vec3 shift_axis;  ///< the axis in the parent's axes
    Vec3 axis;
    double factor, shift;
    int parent, variable;  ///< variable -1: fixed
    bool turns;
  };
  void check_names() const;
  void check_link(int link) const;
  void check_joint(int k);
  void number_variables();
  void prepare_steps();
  void find_limits();
  void find_tip();
  static Frame moved(const Step& step, const double* q);

  std::string name_, source_;
  std::vector<Link> links_;
  std::vector<Joint> joints_;
  std::vector<int> variables_;
  std::vector<Step> steps_;
  std::vector<double> lower_, upper_;
  int tip_ = 0;
};

}  // namespace tendril
