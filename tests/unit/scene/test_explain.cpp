#include <catch2/catch.hpp>

#include "base/error.h"
#include "scene/explain.h"
#include "unit/scene/fixtures.h"

using namespace tendril;
using namespace tendril::testing;
using Catch::Matchers::Contains;

TEST_CASE("an empty world leaves everything out, and explaining builds nothing", "[scene][explain]") {
  Scene scene;
  scene.add(sagging_hose());
  const Explanation text = explain(scene);
  for (const char* name : {"gravity", "loads", "contact", "preformed shape", "varying section", "unequal stiffness",
                           "distance trees", "picture", "error estimate", "extra turns", "contact between rods"}) {
    CAPTURE(name);
    CHECK_FALSE(text.uses(name));
  }
  CHECK(text.uses("elastic energy"));
  CHECK(text.uses("element"));
  CHECK_THROWS_WITH(text.uses("gravty"), Contains("did you mean 'gravity'?"));
  CHECK_THAT(text.text(), Contains("- gravity") && Contains("+ holds") && Contains("clamped at its start, clamped at its finish"));
}

TEST_CASE("each term appears when the scene has it", "[scene][explain]") {
  Scene scene(earth);
  PlacedRod& hose = scene.add(sagging_hose());
  CHECK(explain(scene).uses("gravity"));
  hose.load({0.5, {0, 0, -1}, {0, 0, 0}});
  CHECK(explain(scene).uses("loads"));
  hose.hold({1.2, hose.hold_at(1.2)->frame, true, true, 2});
  CHECK(explain(scene).uses("extra turns"));
  scene.add(sheet("sheet", {0, 0, 0.4}));
  CHECK(explain(scene).uses("contact"));
  CHECK_FALSE(explain(scene).uses("distance trees"));
  scene.solve();
  CHECK(explain(scene).uses("distance trees"));
  CHECK_THAT(explain(scene).text(), Contains("1 of 1 built, over 2 triangles"));
  SolveOptions options;
  options.error = true;
  options.element = Element::staggered;
  options.clamp = ClampRule::thesis;
  CHECK(explain(scene, options).uses("error estimate"));
  CHECK_THAT(explain(scene, options).text(), Contains("first order"));
}

TEST_CASE("sections that vary or differ between their axes are told", "[scene][explain]") {
  Rod rod = Rod::uniform(1, soft_section());
  Section flat = soft_section();
  flat.EI2 *= 3;
  rod.parts = {{0.5, soft_section()}, {1, flat}};
  rod.shape = [](double s) { return Frame::looking({0, 0, s}, {0, 0, 1}); };
  Scene scene;
  scene.add(PlacedRod("rod", rod, Frame::looking({0, 0, 0}, {1, 0, 0}), {}));
  const Explanation text = explain(scene);
  CHECK(text.uses("varying section"));
  CHECK(text.uses("unequal stiffness"));
  CHECK(text.uses("preformed shape"));
  CHECK_THAT(text.text(), Contains("finish free") && Contains("2 parts"));
}

TEST_CASE("pairs out of reach and branch points are told", "[scene][explain]") {
  Scene scene(earth);
  const Section section = soft_section();
  const Frame start = Frame::looking({0, 0, 0}, {1, 0, 0});
  PlacedRod& a = scene.add(PlacedRod("a", Rod::uniform(0.5, section, 10), start, std::nullopt));
  PlacedRod& b = scene.add(PlacedRod("b", Rod::uniform(0.5, section, 10), std::nullopt, start.moved({0.9, 0, 0})));
  scene.join("tee", {{&a, 0.5, std::nullopt}, {&b, 0, std::nullopt}}, std::nullopt);
  CHECK_FALSE(explain(scene).uses("collision pairs"));
  CHECK_THAT(explain(scene).text(), Contains("no pair of a rod and an obstacle") &&
                                        Contains("joins 'a' at its finish, 'b' at its start; free: six unknowns"));
  scene.add(sheet("near", {0, 0, -0.2}));
  scene.add(sheet("far", {0, 0, -20}));
  CHECK(explain(scene).uses("collision pairs"));
  CHECK_THAT(explain(scene).text(), Contains("2 of 4 pairs of a rod and an obstacle; 2 out of reach") &&
                                        Contains("with 1 obstacle, at the rod's surface, without friction; out of reach: far"));
  scene.remove("near");
  CHECK_FALSE(explain(scene).uses("contact"));
  CHECK_THAT(explain(scene).text(), Contains("no obstacle is in reach; out of reach: far"));
}
