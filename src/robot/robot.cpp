#include "robot/robot.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/number_text.h"

namespace tendril {

namespace {

std::string of_joint(const std::string& robot, const Joint& joint) {
  return "robot '" + robot + "', joint '" + joint.name + "': ";
}

// A unit quaternion times the pure quaternion of a vector.
Quat times_vector(const Quat& q, const Vec3& v) { return q * Quat(0, v.x(), v.y(), v.z()); }

}  // namespace

const char* name_of(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return "fixed";
    case JointKind::revolute:
      return "revolute";
    case JointKind::continuous:
      return "continuous";
    case JointKind::prismatic:
      return "prismatic";
  }
  return "unknown";
}

Robot Robot::with_source(std::string source) const {
  Robot copy = *this;
  copy.source_ = std::move(source);
  return copy;
}

Robot::Robot(std::string name, std::vector<Link> links, std::vector<Joint> joints)
    : name_(std::move(name)), links_(std::move(links)), joints_(std::move(joints)) {
  if (links_.empty() || links_.size() != joints_.size() + 1)
    throw UsageError("robot '" + name_ + "': got " + std::to_string(links_.size()) + " links and " +
                     std::to_string(joints_.size()) + " joints, expected one link more than joints");
  check_names();
  for (int k = 0; k < static_cast<int>(joints_.size()); ++k) check_joint(k);
  number_variables();
  prepare_steps();
  find_limits();
  find_tip();
}

void Robot::check_names() const {
  std::set<std::string> seen;
  for (const Link& link : links_) {
    if (link.name.empty()) throw UsageError("robot '" + name_ + "': a link has no name");
    if (!seen.insert(link.name).second) throw UsageError("robot '" + name_ + "': two links are called '" + link.name + "'");
    for (const auto* shapes : {&link.visual, &link.collision})
      for (const LinkShape& body : *shapes) {
        if (const Solid* solid = std::get_if<Solid>(&body.shape))
          tendril::check(*solid, ("robot '" + name_ + "', link '" + link.name + "'").c_str());
        else if (!std::get<0>(body.shape))
          throw UsageError("robot '" + name_ + "', link '" + link.name + "': a shape has no mesh");
      }
  }
  seen.clear();
  for (const Joint& joint : joints_) {
    if (joint.name.empty()) throw UsageError("robot '" + name_ + "': a joint has no name");
    if (!seen.insert(joint.name).second) throw UsageError("robot '" + name_ + "': two joints are called '" + joint.name + "'");
  }
}

void Robot::check_joint(int k) {
  Joint& joint = joints_[k];
  const auto fail = [&](const std::string& why) { throw UsageError(of_joint(name_, joint) + why); };
  if (joint.parent < 0 || joint.parent > k) fail("it must hang on an earlier link");
  const auto is_far = [](const Vec3& v) { return !(v.cwiseAbs().maxCoeff() <= largest_number); };
  if (!all_finite(joint.origin.at) || !all_finite(joint.origin.rotation.coeffs())) fail("its origin is not finite");
  if (is_far(joint.origin.at)) fail("its origin lies more than " + number_text(largest_number) + " m away");
  if (std::abs(joint.origin.rotation.norm() - 1) > 1e-6) fail("the rotation of its origin is not a unit quaternion");
  joint.origin.rotation.normalize();
  if (joint.kind == JointKind::fixed) return;

  if (!all_finite(joint.axis) || !(joint.axis.norm() > 1e-9)) fail("its axis must be a finite vector other than zero");
  if (is_far(joint.axis)) fail("its axis has a number beyond " + number_text(largest_number));
  joint.axis.normalize();
  if (std::isnan(joint.lower) || std::isnan(joint.upper)) fail("its limits are not numbers");
  if (joint.lower > joint.upper)
    fail("its lower limit " + number_text(joint.lower) + " lies above the upper one, " + number_text(joint.upper));
  if (joint.lower == std::numeric_limits<double>::infinity() || joint.upper == -std::numeric_limits<double>::infinity())
    fail("its limits leave no place for it");
  if (!(joint.velocity > 0)) fail("its velocity is " + number_text(joint.velocity) + ", expected more than 0");
  if (joint.mimics == -1) return;
  if (joint.mimics < 0 || joint.mimics >= static_cast<int>(joints_.size()) || joint.mimics == k)
    fail("it must mimic another joint of the robot");
  const Joint& followed = joints_[joint.mimics];
  if (followed.kind == JointKind::fixed) fail("it mimics '" + followed.name + "', which is fixed");
  if (followed.mimics != -1) fail("it mimics '" + followed.name + "', which mimics another joint itself");
  if (!std::isfinite(joint.factor) || !std::isfinite(joint.shift)) fail("what it multiplies and adds by mimicking is not finite");
  if (!(std::max(std::abs(joint.factor), std::abs(joint.shift)) <= largest_number))
    fail("what it multiplies and adds by mimicking lies beyond " + number_text(largest_number));
}

void Robot::number_variables() {
  for (int k = 0; k < static_cast<int>(joints_.size()); ++k)
    if (joints_[k].kind != JointKind::fixed && joints_[k].mimics == -1) variables_.push_back(k);
}

void Robot::prepare_steps() {
  std::vector<int> number(joints_.size(), -1);
  for (int v = 0; v < size(); ++v) number[variables_[v]] = v;
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const Joint& joint = joints_[k];
    Step step;
    step.turn = joint.origin.rotation;
    step.at = joint.origin.at;
    step.axis = joint.axis;
    step.turn_axis = times_vector(step.turn, joint.axis);
    step.shift_axis = step.turn * joint.axis;
    step.parent = joint.parent;
    step.turns = joint.kind != JointKind::prismatic;
    step.factor = 1;
    step.shift = 0;
    step.variable = number[k];
    if (joint.kind == JointKind::fixed)
      step.variable = -1;
    else if (joint.mimics != -1) {
      step.variable = number[joint.mimics];
      step.factor = joint.factor;
      step.shift = joint.shift;
    }
    steps_.push_back(step);
  }
}

void Robot::find_limits() {
  for (int k : variables_) {
    lower_.push_back(joints_[k].lower);
    upper_.push_back(joints_[k].upper);
  }
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const Joint& joint = joints_[k];
    if (joint.kind == JointKind::fixed || joint.mimics == -1 || joint.factor == 0) continue;
    const int v = steps_[k].variable;
    double a = (joint.lower - joint.shift) / joint.factor, b = (joint.upper - joint.shift) / joint.factor;
    if (a > b) std::swap(a, b);
    lower_[v] = std::max(lower_[v], a);
    upper_[v] = std::min(upper_[v], b);
    if (lower_[v] > upper_[v])
      throw UsageError(of_joint(name_, joint) + "its limits leave no place to '" + joints_[joint.mimics].name +
                       "', which it mimics");
  }
}

void Robot::find_tip() {
  std::vector<int> moving(links_.size(), 0), depth(links_.size(), 0);
  std::vector<bool> carries(links_.size(), false);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    carries[joints_[k].parent] = true;
    moving[k + 1] = moving[joints_[k].parent] + (joints_[k].kind != JointKind::fixed);
    depth[k + 1] = depth[joints_[k].parent] + 1;
  }
  tip_ = -1;
  for (std::size_t i = 0; i < links_.size(); ++i)
    if (!carries[i] && (tip_ < 0 || moving[i] > moving[tip_] || (moving[i] == moving[tip_] && depth[i] > depth[tip_])))
      tip_ = static_cast<int>(i);
}

int Robot::link(const std::string& name) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].name == name) return static_cast<int>(i);
    names.push_back(links_[i].name);
  }
  throw UsageError("robot '" + name_ + "': there is no link " + unknown_name(name, "links", names));
}

int Robot::joint(const std::string& name) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].name == name) return static_cast<int>(i);
    names.push_back(joints_[i].name);
  }
  throw UsageError("robot '" + name_ + "': there is no joint " + unknown_name(name, "joints", names));
}

std::vector<int> Robot::chain(int link) const {
  std::vector<int> links;
  check_link(link);
  for (int at = link; at >= 0; at = parent(at)) links.push_back(at);
  std::reverse(links.begin(), links.end());
  return links;
}

void Robot::check(JointValues q, const char* who) const {
  if (static_cast<int>(q.size()) != size())
    throw UsageError(std::string(who) + ": got " + std::to_string(q.size()) + " joint values, expected " +
                     std::to_string(size()) + " for '" + name_ + "'");
  for (int k = 0; k < size(); ++k)
    if (!std::isfinite(q[k]))
      throw UsageError(std::string(who) + ": the value of joint '" + variable(k).name + "' is " + number_text(q[k]) +
                       ", expected a finite number");
}

bool Robot::within_limits(JointValues q, double tolerance) const {
  check(q, "joint limits");
  for (int k = 0; k < size(); ++k)
    if (!(q[k] >= lower_[k] - tolerance && q[k] <= upper_[k] + tolerance)) return false;
  return true;
}

std::string Robot::beyond_limits(JointValues q, double tolerance) const {
  check(q, "joint limits");
  std::string text;
  for (int k = 0; k < size(); ++k) {
    if (q[k] >= lower_[k] - tolerance && q[k] <= upper_[k] + tolerance) continue;
    text += (text.empty() ? "" : "; ") + ("'" + variable(k).name) + "' at " + number_text(q[k]) + ", limits " +
            number_text(lower_[k]) + " ... " + number_text(upper_[k]);
  }
  return text;
}

}  // namespace tendril
