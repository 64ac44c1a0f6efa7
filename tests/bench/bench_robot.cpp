// Kinematics of a six-axis arm: all link frames, the Jacobian of the flange, the joint values for a place of it, and
// whether the links of builtin:six_axis touch each other.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "robot/inverse.h"
#include "robot/load_robot.h"
#include "robot/robot_collision.h"

using namespace tendril;

namespace {

constexpr int poses = 256;

Robot arm() {
  const Vec3 at[] = {{0, 0, 0.4}, {0.3, 0, 0.4}, {0, 0, 1.05}, {0.4, 0, 0.2}, {0.76, 0, 0}, {0.2, 0, 0}};
  const Vec3 axis[] = {Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitX()};
  std::vector<Link> links = {{"base"}};
  std::vector<Joint> joints;
  for (int k = 0; k < 6; ++k) {
    links.push_back({"link_" + std::to_string(k + 1)});
    joints.push_back({"joint_" + std::to_string(k + 1), JointKind::revolute, k, {at[k], Quat::Identity()}, axis[k], -3, 3});
  }
  links.push_back({"flange"});
  joints.push_back({"to_flange", JointKind::fixed, 6, {{0.1, 0, 0}, exp_rotation({0, 1.5, 0})}});
  return Robot("arm", links, joints);
}

std::vector<std::array<double, 6>> values() {
  std::vector<std::array<double, 6>> q(poses);
  for (int i = 0; i < poses; ++i)
    for (int k = 0; k < 6; ++k) q[i][k] = 3 * std::sin(1.7 * i + 2.3 * k);
  return q;
}

void robot_link_frames(benchmark::State& state) {
  const Robot robot = arm();
  const auto q = values();
  std::vector<Frame> frames(robot.links().size());
  int i = 0;
  for (auto _ : state) {
    robot.link_frames(q[++i % poses], frames);
    benchmark::DoNotOptimize(frames.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(robot_link_frames);

void robot_jacobian(benchmark::State& state) {
  const Robot robot = arm();
  const auto q = values();
  Jacobian out(6, 6);
  int i = 0;
  for (auto _ : state) {
    Frame frame = robot.jacobian(7, q[++i % poses], out);
    benchmark::DoNotOptimize(frame);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(robot_jacobian);

void robot_inverse(benchmark::State& state) {
  const auto robot = std::make_shared<const Robot>(arm());
  const InverseKinematics inverse(robot, 7);
  const auto q = values();
  std::vector<Frame> targets;
  for (const auto& one : q) targets.push_back(robot->link_frame(7, one));
  std::size_t found = 0;
  int i = 0;
  for (auto _ : state) found += inverse.solve(targets[++i % poses], {.turns = false}).solutions.size();
  state.counters["solutions"] = static_cast<double>(found) / static_cast<double>(state.iterations());
}
BENCHMARK(robot_inverse);

void robot_collides(benchmark::State& state) {
  const auto robot = load_robot("builtin:six_axis");
  const RobotCollision collision(robot);
  auto q = values();
  for (auto& one : q)
    for (int k = 0; k < 6; ++k) one[k] = std::clamp(one[k], robot->lower()[k], robot->upper()[k]);
  int i = 0, touching = 0;
  for (auto _ : state) touching += collision.any(q[++i % poses]);
  benchmark::DoNotOptimize(touching);
}
BENCHMARK(robot_collides);

}  // namespace
