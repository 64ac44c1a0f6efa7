#include "robot/robot_collision.h"

#include <algorithm>
#include <random>

#include "base/error.h"
#include "base/units.h"

namespace tendril {

const char* name_of(PairKind kind) {
  switch (kind) {
    case PairKind::checked:
      return "checked";
    case PairKind::rigid:
      return "rigid";
    case PairKind::neighbours:
      return "neighbours";
    case PairKind::always:
      return "always";
    case PairKind::never:
      return "never";
  }
  return "unknown";
}

RobotCollision::RobotCollision(std::shared_ptr<const Robot> robot, const PairOptions& options, const RunContext& context)
    : robot_(std::move(robot)) {
  if (options.samples < 1)
    throw UsageError("robot collision: got " + std::to_string(options.samples) + " samples, expected one or more");
  add_bodies();
  sort_pairs();
  sample_pairs(options, context);
}

void RobotCollision::add_bodies() {
  for (const Link& link : robot_->links()) {
    std::vector<Body>& bodies = links_.emplace_back();
    for (const LinkShape& shape : link.collision) {
      if (const auto* mesh = std::get_if<std::shared_ptr<const LinkMesh>>(&shape.shape))
        bodies.push_back({bodies_.add((*mesh)->surface()), shape.pose});
      else
        bodies.push_back({bodies_.add(std::get<Solid>(shape.shape)), shape.pose});
    }
  }
}

void RobotCollision::sort_pairs() {
  const auto& joints = robot_->joints();
  group_ = {0};
  for (std::size_t k = 0; k < joints.size(); ++k)
    group_.push_back(joints[k].kind == JointKind::fixed ? group_[joints[k].parent] : static_cast<int>(k) + 1);
  const auto carried_by = [&](int a, int b) { return group_[a] > 0 && group_[joints[group_[a] - 1].parent] == group_[b]; };
  for (int a = 0; a < static_cast<int>(links_.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(links_.size()); ++b) {
      if (links_[a].empty() || links_[b].empty()) continue;
      PairKind kind = PairKind::checked;
      if (group_[a] == group_[b])
        kind = PairKind::rigid;
      else if (carried_by(a, b) || carried_by(b, a))
        kind = PairKind::neighbours;
      pairs_.push_back({a, b, kind});
    }
}

// A pair is decided once it has been seen touching and seen clear.
void RobotCollision::sample_pairs(const PairOptions& options, const RunContext& context) {
  struct Open {
    LinkPair* pair;
    bool touched = false, clear = false;
  };
  std::vector<Open> open;
  for (LinkPair& pair : pairs_)
    if (pair.kind == PairKind::checked) open.push_back({&pair});
  std::mt19937_64 random(options.seed);
  std::vector<double> q(robot_->size());
  std::vector<Frame> frames(links_.size());
  int sample = 0;
  for (; sample < options.samples && !open.empty() && !context.stop(); ++sample) {
    for (int k = 0; k < robot_->size(); ++k) {
      const double range =
          robot_->variable(k).kind == JointKind::prismatic ? 1 : units::pi;  // m or rad, where there are no limits
      const double lower =
          std::isfinite(robot_->lower()[k]) ? robot_->lower()[k] : std::min(-range, robot_->upper()[k] - 2 * range);
      const double upper = std::isfinite(robot_->upper()[k]) ? robot_->upper()[k] : lower + 2 * range;
      q[k] = lower + (upper - lower) * static_cast<double>(random() >> 11) * 0x1.0p-53;
    }
    robot_->link_frames(q, frames);
    for (Open& one : open) (touch(one.pair->a, one.pair->b, frames) ? one.touched : one.clear) = true;
    std::erase_if(open, [](const Open& one) { return one.touched && one.clear; });
  }
  decided_ = open.empty() || sample == options.samples;
  if (!decided_) return;
  for (const Open& one : open) {
    if (one.touched)
      one.pair->kind = PairKind::always;
    else if (options.skip_never)
      one.pair->kind = PairKind::never;
  }
}

bool RobotCollision::touch(int a, int b, const std::vector<Frame>& frames) const {
  for (const Body& first : links_[a])
    for (const Body& second : links_[b])
      if (bodies_.touch(first.number, frames[a] * first.pose, second.number, frames[b] * second.pose)) return true;
  return false;
}

bool RobotCollision::touch_obstacle(int link, const Obstacle& obstacle, const std::vector<Frame>& frames) const {
  for (const Body& body : links_[link])
    if (bodies_.touch(body.number, frames[link] * body.pose, obstacle.number, obstacle.pose)) return true;
  return false;
}

int RobotCollision::add_obstacle(const CollisionShape& shape, const Frame& pose) {
  if (!all_finite(pose.at) || !all_finite(pose.rotation.coeffs()))
    throw UsageError("robot collision: an obstacle's pose is not finite");
  obstacles_.push_back({bodies_.add(shape), pose});
  return obstacles() - 1;
}

// Until `visit` returns false.
template <class Visit>
void RobotCollision::visit_contacts(Robot::JointValues q, Visit&& visit) const {
  robot_->check(q, "collision");
  const std::vector<Frame> frames = robot_->link_frames(q);
  for (const LinkPair& pair : pairs_)
    if (pair.kind == PairKind::checked && touch(pair.a, pair.b, frames) && !visit(RobotContact{pair.a, pair.b})) return;
  for (int link = 0; link < static_cast<int>(links_.size()); ++link) {
    if (group_[link] == 0) continue;
    for (int o = 0; o < obstacles(); ++o)
      if (touch_obstacle(link, obstacles_[o], frames) && !visit(RobotContact{link, -1, o})) return;
  }
}

std::vector<RobotContact> RobotCollision::contacts(Robot::JointValues q) const {
  std::vector<RobotContact> found;
  visit_contacts(q, [&](const RobotContact& contact) {
    found.push_back(contact);
    return true;
  });
  return found;
}

bool RobotCollision::any(Robot::JointValues q) const {
  bool found = false;
  visit_contacts(q, [&](const RobotContact&) {
    found = true;
    return false;
  });
  return found;
}

}  // namespace tendril
