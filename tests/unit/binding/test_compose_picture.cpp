#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "binding/compose_picture.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::testing;
using Catch::Matchers::Contains;

namespace {

/// The value of a card's row, "" without it.
std::string row(const Picture& picture, const std::string& label) {
  for (const PictureCard::Row& r : picture.card.rows)
    if (r.label == label) return r.value;
  return "";
}

bool alarm(const Picture& picture, const std::string& label) {
  return std::any_of(picture.card.rows.begin(), picture.card.rows.end(),
                     [&](const PictureCard::Row& r) { return r.label == label && r.alarm; });
}

/// The hose above a floor with its lowest point about 0.6 m up.
Scene above_floor(double floor, double clearance) {
  Scene scene(earth);
  scene.add(sagging_hose());
  scene.add(solid("floor", HalfSpace{}, {0, 0, floor}, clearance));
  return scene;
}

}  // namespace

TEST_CASE("a picture shows the rod smoothly, its holds and its gap", "[binding][picture]") {
  const Scene scene = above_floor(0.3, 0.01);
  const SceneEquilibrium eq = scene.solve();
  const Picture picture = compose_picture(scene, &eq, {});
  REQUIRE(picture.tubes.size() == 1);
  const PictureTube& tube = picture.tubes[0];
  CHECK(tube.radius == Approx(0.01));
  CHECK(tube.points.size() > 200);
  CHECK(tube.values.size() == tube.points.size());
  CHECK(tube.points.front() == Vec3(0, 0, 1));
  CHECK(tube.points.back().isApprox(Vec3(0.8, 0, 1), 1e-12));
  for (std::size_t i = 1; i < tube.points.size(); ++i) CHECK((tube.points[i] - tube.points[i - 1]).norm() < 0.0055);
  const double least = *std::min_element(tube.values.begin(), tube.values.end());
  CHECK(least == Approx(1e3 * eq.clearance(eq.rods[0]).value).margin(0.01));
  CHECK(picture.scale.meaning == ColourMeaning::clearance);
  CHECK(picture.scale.limit == Approx(10));
  CHECK(picture.holds.size() == 2);
  REQUIRE(picture.labels.size() == 1);
  CHECK_THAT(picture.labels[0].text, Contains("gap 2") && Contains(" mm"));
  CHECK_FALSE(picture.labels[0].alarm);
  CHECK((picture.labels[0].at - *picture.labels[0].to).norm() == Approx(eq.clearance(eq.rods[0]).value));
  CHECK_NOTHROW(check_picture(picture));
  CHECK(picture.card.title == "hose");
  CHECK(row(picture, "status") == "solved, stable");
  CHECK_THAT(row(picture, "min. clearance"), Contains("required 10 mm"));
  CHECK_THAT(row(picture, "min. bend radius"), Contains("mm"));
  CHECK(row(picture, "estimated error") == "not asked for");
  CHECK_FALSE(row(picture, "tendril").empty());
}

TEST_CASE("what breaks a requirement is red, touching where none is required is not", "[binding][picture]") {
  const Scene tight = above_floor(0.5, 0.2);
  const SceneEquilibrium eq = tight.solve();
  const Picture broken = compose_picture(tight, &eq, {});
  CHECK(alarm(broken, "min. clearance"));
  CHECK(broken.labels.at(0).alarm);

  const Scene lying = above_floor(0.75, 0);
  const SceneEquilibrium rest = lying.solve();
  REQUIRE(rest.ok());
  const Picture fine = compose_picture(lying, &rest, {});
  CHECK_FALSE(alarm(fine, "min. clearance"));
  CHECK(fine.labels.at(0).text == "touches");
  for (const double value : fine.tubes[0].values) CHECK(value >= *fine.scale.limit);
}

TEST_CASE("obstacles that require different clearances are coloured by margin and have rows", "[binding][picture]") {
  Scene scene = above_floor(0.3, 0);
  scene.add(solid("hot", Sphere{0.05}, {0.4, 0.3, 0.6}, 0.5));
  const SceneEquilibrium eq = scene.solve();
  const Picture picture = compose_picture(scene, &eq, {});
  CHECK(picture.scale.name == "margin to required clearance");
  CHECK(picture.scale.limit == Approx(0));
  CHECK(alarm(picture, "min. clearance"));
  CHECK_THAT(row(picture, "min. clearance"), Contains("to hot"));
}

TEST_CASE("the other colours: curvature, tension, twist, plain", "[binding][picture]") {
  Scene scene(earth);
  PlacedRod& hose = scene.add(sagging_hose());
  hose.hold({1.2, hose.hold_at(1.2)->frame, true, true, 0.5});
  hose.load({0.6, {0, 0, -1}, {0, 0, 0}});
  const SceneEquilibrium eq = scene.solve();
  REQUIRE(eq.ok());
  PictureWish wish;
  wish.colour = RodColour::curvature;
  const Picture curved = compose_picture(scene, &eq, wish);
  CHECK(*std::max_element(curved.tubes[0].values.begin(), curved.tubes[0].values.end()) ==
        Approx(1 / eq.rods[0].equilibrium.smallest_bend_radius()));
  CHECK(curved.arrows.size() == 1);
  CHECK(curved.arrows[0].label == "1 N");
  wish.colour = RodColour::tension;
  const Picture tense = compose_picture(scene, &eq, wish);
  CHECK(tense.scale.meaning == ColourMeaning::diverging);
  CHECK(*std::max_element(tense.tubes[0].values.begin(), tense.tubes[0].values.end()) ==
        Approx(eq.rods[0].equilibrium.largest_tension()).epsilon(0.02));
  wish.colour = RodColour::twist;
  CHECK(compose_picture(scene, &eq, wish).scale.unit == "rad/m");
  wish.colour = RodColour::plain;
  wish.plain = {1, 0, 0};
  const Picture plain = compose_picture(scene, &eq, wish);
  CHECK(plain.tubes[0].values.empty());
  CHECK(plain.tubes[0].colour == Rgb{1, 0, 0});
}

TEST_CASE("ghosts, fits and scenes that are not solved", "[binding][picture]") {
  Scene scene = above_floor(0.3, 0);
  scene.add(solid("box", Box{{0.2, 0.2, 0.2}}, {0.4, 0, 0.2}));
  const SceneEquilibrium eq = scene.solve();
  PictureWish wish;
  wish.ghost = {"box"};
  wish.fit = {"box"};
  const Picture picture = compose_picture(scene, &eq, wish);
  CHECK(picture.surfaces[0].style == SurfaceStyle::solid);
  CHECK(picture.surfaces[1].style == SurfaceStyle::ghost);
  REQUIRE(picture.fit);
  CHECK(picture.fit->low.isApprox(Vec3(0.3, -0.1, 0.1), 1e-12));
  CHECK(picture.fit->high.isApprox(Vec3(0.5, 0.1, 0.3), 1e-12));
  wish.ghost = {"bx"};
  CHECK_THROWS_WITH(compose_picture(scene, &eq, wish), Contains("did you mean 'box'?"));
  wish.ghost.reset();
  wish.fit = {"hosee"};
  CHECK_THROWS_WITH(compose_picture(scene, &eq, wish), Contains("did you mean 'hose'?"));
  const Picture unsolved = compose_picture(scene, nullptr, {});
  CHECK(unsolved.tubes.empty());
  CHECK(unsolved.surfaces.size() == 2);
  CHECK(row(unsolved, "status") == "not solved");
}

TEST_CASE("solids are drawn as closed surfaces of the right size", "[binding][picture]") {
  const auto volume = [](Solid shape) { return drawn_mesh(solid("s", shape, {1, 2, 3}), {})->volume(); };
  CHECK(volume(Box{{1, 2, 3}}) == Approx(6));
  CHECK(volume(Sphere{1}) == Approx(4.18879).epsilon(0.01));
  CHECK(volume(Cylinder{0.5, 2}) == Approx(1.5708).epsilon(0.01));
}
