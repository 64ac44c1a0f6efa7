// Forward kinematics and Jacobians. Each joint's turn is its origin's quaternion times that of its own angle, both folded
// into two constant quaternions: turn * cos(angle/2) + turn_axis * sin(angle/2).
#include <cmath>

#include "base/error.h"
#include "robot/robot.h"

namespace tendril {

inline Frame Robot::moved(const Step& step, const double* q) {
  if (step.variable < 0) return {step.at, step.turn};
  const double value = step.factor * q[step.variable] + step.shift;
  if (!step.turns) return {step.at + value * step.shift_axis, step.turn};
  const double c = std::cos(0.5 * value), s = std::sin(0.5 * value);
  Frame frame{step.at, {}};
  frame.rotation.coeffs() = c * step.turn.coeffs() + s * step.turn_axis.coeffs();
  return frame;
}

void Robot::check_link(int link) const {
  if (link < 0 || link >= static_cast<int>(links_.size()))
    throw UsageError("robot '" + name_ + "': there is no link of the number " + std::to_string(link));
}

Frame Robot::link_frame(int link, JointValues q) const {
  check(q, "link_frame");
  check_link(link);
  Frame frame;
  for (int at = link; at > 0; at = steps_[at - 1].parent) frame = moved(steps_[at - 1], q.data()) * frame;
  return frame;
}

void Robot::link_frames(JointValues q, std::span<Frame> frames) const {
  check(q, "link_frames");
  if (frames.size() != links_.size())
    throw UsageError("link_frames: got room for " + std::to_string(frames.size()) + " frames, expected " +
                     std::to_string(links_.size()));
  frames[0] = Frame{};
  for (std::size_t k = 0; k < steps_.size(); ++k) frames[k + 1] = frames[steps_[k].parent] * moved(steps_[k], q.data());
}

std::vector<Frame> Robot::link_frames(JointValues q) const {
  std::vector<Frame> frames(links_.size());
  link_frames(q, frames);
  return frames;
}

Frame Robot::jacobian(int link, JointValues q, Eigen::Ref<Jacobian> out) const {
  check(q, "jacobian");
  check_link(link);
  if (out.cols() != size())
    throw UsageError("jacobian: got room for " + std::to_string(out.cols()) + " columns, expected " + std::to_string(size()));
  out.setZero();
  Frame frame;  // of the link, in the axes of the link at hand
  for (int at = link; at > 0; at = steps_[at - 1].parent) {
    const Step& step = steps_[at - 1];
    if (step.variable >= 0) {
      const Quat back = frame.rotation.conjugate();
      if (step.turns) {
        out.col(step.variable).head<3>() += step.factor * (back * step.axis.cross(frame.at));
        out.col(step.variable).tail<3>() += step.factor * (back * step.axis);
      } else {
        out.col(step.variable).head<3>() += step.factor * (back * step.axis);
      }
    }
    frame = moved(step, q.data()) * frame;
  }
  return frame;
}

Jacobian Robot::jacobian(int link, JointValues q) const {
  Jacobian out(6, size());
  jacobian(link, q, out);
  return out;
}

}  // namespace tendril
