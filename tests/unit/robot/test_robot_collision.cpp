// Robots against themselves and their surroundings.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "robot/robot_collision.h"
#include "robot/urdf.h"
#include "unit/robot/robots.h"

using namespace tendril;
using namespace tendril::test;
using Catch::Matchers::Contains;

namespace {

LinkShape box(const Vec3& size, const Vec3& at) { return {Solid(Box{size}), {at, Quat::Identity()}}; }

// A planar arm of three links of 1 m with bars of 0.9 m x 0.1 m, a hand rigidly at the end of the last bar, and a post
// beside the base.
std::shared_ptr<const Robot> barred_arm(double limit) {
  std::vector<Joint> joints = planar_arm({1, 1, 1}).joints();
  for (Joint& joint : joints) joint.lower = -limit, joint.upper = limit;
  std::vector<Link> links = named_links(5);
  for (int k = 1; k <= 3; ++k) links[k].collision = {box({0.9, 0.1, 0.1}, {0.5, 0, 0})};
  links[4].collision = {box({0.1, 0.1, 0.1}, {0.05, 0, 0})};
  links[0].collision = {box({0.2, 0.2, 0.1}, {-0.5, 0, 0})};
  return std::make_shared<const Robot>("barred", links, joints);
}

PairKind kind_of(const RobotCollision& collision, int a, int b) {
  for (const LinkPair& pair : collision.pairs())
    if (pair.a == a && pair.b == b) return pair.kind;
  FAIL("no pair " << a << ", " << b);
  return PairKind::checked;
}

}  // namespace

TEST_CASE("pairs: rigid ones, neighbours, those that always and never touch", "[robot]") {
  const RobotCollision wide(barred_arm(3));
  CHECK(kind_of(wide, 3, 4) == PairKind::rigid);
  CHECK(kind_of(wide, 0, 1) == PairKind::neighbours);
  CHECK(kind_of(wide, 2, 3) == PairKind::neighbours);
  CHECK(kind_of(wide, 2, 4) == PairKind::neighbours);  // through what it is rigidly joined to
  CHECK(kind_of(wide, 1, 3) == PairKind::checked);
  CHECK(kind_of(wide, 1, 4) == PairKind::checked);
  CHECK(kind_of(wide, 0, 2) == PairKind::checked);
  CHECK(wide.pairs().size() == 10);

  const RobotCollision narrow(barred_arm(0.3));
  CHECK(kind_of(narrow, 1, 3) == PairKind::never);
  const RobotCollision careful(barred_arm(0.3), {.skip_never = false});
  CHECK(kind_of(careful, 1, 3) == PairKind::checked);

  auto fat = *barred_arm(0.3);
  std::vector<Link> links = fat.links();
  links[0].collision = {{Solid(Sphere{5}), {}}};
  const RobotCollision always(std::make_shared<const Robot>("fat", links, fat.joints()));
  CHECK(kind_of(always, 0, 2) == PairKind::always);
  CHECK_FALSE(always.any(std::vector<double>(3, 0.0)));
  CHECK_THROWS_WITH(RobotCollision(barred_arm(1), {.samples = 0}), Contains("got 0 samples"));
  std::atomic<bool> cancel{true};
  RunContext context;
  context.cancel = &cancel;
  const RobotCollision stopped(barred_arm(0.3), {}, context);
  CHECK(kind_of(stopped, 1, 3) == PairKind::checked);
  CHECK_FALSE(stopped.decided());
  CHECK(narrow.decided());
}

TEST_CASE("a folded arm touches itself where plane geometry says", "[robot]") {
  const auto robot = barred_arm(3.1);
  const RobotCollision collision(robot);
  const auto touching = [&](const std::vector<double>& q) {
    std::vector<std::pair<int, int>> pairs;
    for (const RobotContact& contact : collision.contacts(q)) pairs.emplace_back(contact.link, contact.other_link);
    CHECK(collision.any(q) == !pairs.empty());
    return pairs;
  };
  CHECK(touching({0, 0, 0}).empty());
  CHECK(touching({0, 2.2, 2.2}) == std::vector<std::pair<int, int>>{{1, 3}});
  // A square: the hand (0 ... 0.1 m beyond the third bar's end, 0.05 m to each side) comes back to the base's post.
  CHECK(touching({0, 1.5707963267948966, 1.5707963267948966}).empty());
  CHECK(touching({2.0, 2.0, 2.0}).size() >= 1);
  CHECK_THROWS_WITH(collision.contacts(std::vector<double>(2, 0.0)), Contains("collision: got 2 joint values"));
}

TEST_CASE("surroundings: moving links are checked, the base is not", "[robot]") {
  const auto robot = barred_arm(3);
  RobotCollision collision(robot);
  CHECK(collision.add_obstacle(Solid(Box{{0.2, 0.2, 0.2}}), {{3.3, 0, 0}, Quat::Identity()}) == 0);
  CHECK(collision.add_obstacle(Solid(HalfSpace{}), {{0, 0, -0.04}, Quat::Identity()}) == 1);
  CHECK(collision.obstacles() == 2);
  const std::vector<double> straight(3, 0.0);
  // Everything touches the ground; the hand ends at 3.1 m, the box begins at 3.2 m.
  auto found = collision.contacts(straight);
  CHECK(found.size() == 4);
  for (const RobotContact& contact : found) {
    CHECK(contact.link > 0);
    CHECK(contact.obstacle == 1);
  }
  RobotCollision free(robot);
  free.add_obstacle(Solid(Box{{0.3, 0.2, 0.2}}), {{3.3, 0, 0}, Quat::Identity()});
  CHECK_FALSE(free.any(straight));
  free.add_obstacle(Solid(Box{{0.42, 0.2, 0.2}}), {{3.3, 0, 0}, Quat::Identity()});
  found = free.contacts(straight);
  REQUIRE(found.size() == 1);
  CHECK(found[0].link == 4);
  CHECK(found[0].obstacle == 1);
  CHECK(found[0].other_link == -1);
  CHECK_THROWS_WITH(free.add_obstacle(Solid(Sphere{1}), {{std::nan(""), 0, 0}, Quat::Identity()}),
                    Contains("pose is not finite"));
}

TEST_CASE("a real robot: clear in its zero position, touching itself when folded", "[robot][real]") {
  const std::string file = real_robot();
  if (file.empty()) {
    WARN("no shared robots here: skipped");
    return;
  }
  const auto robot = load_urdf(file);
  const RobotCollision collision(robot);
  for (const LinkPair& pair : collision.pairs())
    INFO(robot->links()[pair.a].name << " " << robot->links()[pair.b].name << " " << name_of(pair.kind));
  CHECK(collision.contacts(std::vector<double>(6, 0.0)).empty());
  CHECK(collision.contacts(std::vector<double>{0, 1.4, 1.1, 0, 2, 0}).size() > 0);
}
