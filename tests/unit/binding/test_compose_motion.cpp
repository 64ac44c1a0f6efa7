#include <catch2/catch.hpp>

#include "base/error.h"
#include "binding/compose_motion.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::testing;
using Catch::Matchers::Contains;

namespace {

/// A box that turns about z, with a hose on its top.
Scene carousel() {
  Link base{"base"}, table{"table"};
  table.collision.push_back({Solid(tendril::Box{{1, 0.2, 0.1}}), {{0.5, 0, 0}, Quat::Identity()}});
  Joint turn;
  turn.name = "turn";
  turn.kind = JointKind::continuous;
  turn.axis = Vec3::UnitZ();
  Scene scene(earth);
  scene.add(PlacedRobot{"arm", std::make_shared<const Robot>("carousel", std::vector<Link>{base, table}, std::vector<Joint>{turn}), {}});
  scene.add(PlacedRod("hose", Rod::uniform(0.3, soft_section(), 12), {}, {}));
  Attachment a;
  a.rod = "hose";
  a.robot = "arm";
  a.link = 1;
  a.in_link = Frame::looking({0.9, 0, 0.05}, {0, 0, 1});
  scene.attach(a);
  return scene;
}

SceneMotion quarter_turn(Scene& scene, int steps) {
  SceneMotion motion;
  for (int k = 0; k <= steps; ++k) {
    scene.set_joints("arm", {0.5 * units::pi * k / steps});
    motion.times.push_back(double(k) / steps);
    motion.equilibria.push_back(std::make_shared<SceneEquilibrium>(scene.solve()));
  }
  motion.status = Status::solved;
  return motion;
}

}  // namespace

TEST_CASE("key frames are spread evenly and end with the last state", "[binding][picture]") {
  Scene scene = carousel();
  const SceneMotion motion = quarter_turn(scene, 8);
  const auto times = [&](int count) {
    std::vector<double> t;
    for (const MotionFrame& frame : key_frames(motion, count)) t.push_back(frame.t);
    return t;
  };
  CHECK(times(1) == std::vector<double>{1});
  CHECK(times(2) == std::vector<double>{0, 1});
  CHECK(times(5) == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
  CHECK(times(100).size() == 9);
  CHECK_THROWS_WITH(key_frames(motion, 0), Contains("got 0 states"));
  CHECK_THROWS_WITH(key_frames(SceneMotion{}, 3), Contains("no states"));
  CHECK_THROWS_WITH(compose_frames(scene, {}, {}), Contains("no states"));
}

TEST_CASE("frames of a motion share what the views show and the colours", "[binding][picture]") {
  Scene scene = carousel();
  const SceneMotion motion = quarter_turn(scene, 2);
  const std::vector<Picture> pictures = compose_frames(scene, key_frames(motion, 3), {});
  REQUIRE(pictures.size() == 3);
  for (const Picture& picture : pictures) {
    REQUIRE(picture.fit);
    CHECK((picture.fit->low - pictures[0].fit->low).norm() == 0);
    CHECK((picture.fit->high - pictures[0].fit->high).norm() == 0);
    // The table at 0 and at 90 degrees, and the hose that stands on it.
    CHECK(picture.fit->high.x() >= 1);
    CHECK(picture.fit->high.y() >= 1);
    CHECK(picture.fit->high.z() > 0.3);
    CHECK(picture.scale.high == pictures[0].scale.high);
    CHECK(picture.scale.low == pictures[0].scale.low);
    REQUIRE(picture.surfaces.size() == 1);
    CHECK(picture.surfaces[0].name == "arm.table");
    CHECK(picture.surfaces[0].style == SurfaceStyle::solid);
  }
  CHECK((pictures[0].surfaces[0].pose.at - pictures[2].surfaces[0].pose.at).norm() == Approx(std::sqrt(0.5)));

  const Picture strip = compose_strip(scene, key_frames(motion, 3), {});
  REQUIRE(strip.panels.size() == 3);
  CHECK(strip.columns == 0);
  CHECK(strip.panels[1].card.title == "t = 0.5");
  CHECK(strip.panels[1].views == std::vector<std::string>{"iso"});
  check_picture(strip);
  CHECK(compose_strip(scene, key_frames(quarter_turn(scene, 5), 6), {}).columns == 3);
}

TEST_CASE("the swept picture has the states between and the robot where it began", "[binding][picture]") {
  Scene scene = carousel();
  const SceneMotion motion = quarter_turn(scene, 4);
  const Picture picture = compose_sweep(scene, key_frames(motion, 3), {});
  CHECK(picture.tubes.size() == 3);
  REQUIRE(picture.surfaces.size() == 2);
  CHECK(picture.surfaces[1].style == SurfaceStyle::veil);
  CHECK(picture.surfaces[1].name == "arm.table at t = 0");
  CHECK(picture.surfaces[1].pose.at.x() == Approx(0.5));
  CHECK(picture.fit->high.x() >= 1);
  check_picture(picture);
}

TEST_CASE("a robot is named as a whole in pictures", "[binding][picture]") {
  Scene scene = carousel();
  const SceneEquilibrium eq = scene.solve();
  PictureWish wish;
  wish.ghost = std::vector<std::string>{"arm"};
  wish.fit = {"arm"};
  const Picture picture = compose_picture(scene, &eq, wish);
  CHECK(picture.surfaces[0].style == SurfaceStyle::ghost);
  CHECK(picture.fit->high.x() == Approx(1));
  CHECK(picture.fit->high.z() == Approx(0.05));
  wish.ghost = std::vector<std::string>{"amr"};
  CHECK_THROWS_WITH(compose_picture(scene, &eq, wish), Contains("did you mean 'arm'?"));
}

TEST_CASE("panels that cannot be drawn", "[binding][picture]") {
  Scene scene = carousel();
  Picture strip = compose_strip(scene, key_frames(quarter_turn(scene, 4), 4), {});
  strip.width = 40;
  strip.columns = 4;
  CHECK_THROWS_WITH(check_picture(strip), Contains("too small for 4 panels"));
  strip.width = 400;
  strip.columns = -1;
  CHECK_THROWS_WITH(check_picture(strip), Contains("-1 columns"));
}
