#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "view/view_camera.h"

using namespace tendril;

TEST_CASE("named views: right-handed axes, z up, the eye where it should be") {
  for (const char* name : {"iso", "front", "top", "side"}) {
    const ViewCamera c = named_camera(name);
    INFO(name);
    CHECK((c.right.cross(c.up) - c.back).norm() < 1e-12);
    CHECK(c.right.norm() == Approx(1));
    CHECK(c.up.norm() == Approx(1));
  }
  CHECK((named_camera("front").right - Vec3::UnitX()).norm() < 1e-12);
  CHECK((named_camera("front").back + Vec3::UnitY()).norm() < 1e-12);
  CHECK((named_camera("top").right - Vec3::UnitX()).norm() < 1e-12);
  CHECK((named_camera("top").back - Vec3::UnitZ()).norm() < 1e-12);
  CHECK((named_camera("side").right - Vec3::UnitY()).norm() < 1e-12);
  // Isometric: the three axes are equally foreshortened.
  const ViewCamera iso = named_camera("iso");
  for (int axis = 0; axis < 3; ++axis) CHECK(std::hypot(iso.right[axis], iso.up[axis]) == Approx(std::sqrt(2.0 / 3)));
}

TEST_CASE("a fitted view shows the balls in the middle of ten twelfths of the page, touching it in one direction") {
  const unsigned seed = 11;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1, 1), radius(0.001, 0.05);
  for (const char* name : {"iso", "front", "top", "side"})
    for (int run = 0; run < 50; ++run) {
      std::vector<FitBall> balls;
      for (int i = 0; i < 20; ++i)
        balls.push_back({Vec3(place(random), place(random), place(random)) + Vec3(100, 200, -50), radius(random)});
      const ViewCamera c = fitted_camera(name, balls, 800, 600);
      double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
      for (const FitBall& ball : balls) {
        const Vec3 p = c.project(ball.at);
        const double r = ball.radius / c.metres_per_pixel;
        left = std::min(left, p.x() - r), right = std::max(right, p.x() + r);
        top = std::min(top, p.y() - r), bottom = std::max(bottom, p.y() + r);
      }
      const double share = std::max((right - left) / 800, (bottom - top) / 600);
      CHECK(share == Approx(1 / 1.2));
      CHECK(left + right == Approx(800));
      CHECK(top + bottom == Approx(600));
    }
}

TEST_CASE("the fit box rules over the tubes; without tubes everything is shown") {
  Picture picture;
  PictureTube tube;
  tube.radius = 0.1;
  tube.points = {{0, 0, 0}, {1, 0, 0}};
  picture.tubes.push_back(tube);
  CHECK(fit_balls(picture).size() == 2);
  CHECK(fit_balls(picture)[0].radius == 0.1);
  picture.fit = PictureBox{{-2, -1, -1}, {2, 1, 1}};
  CHECK(fit_balls(picture).size() == 8);
  const ViewCamera front = fitted_camera("front", fit_balls(picture), 1000, 1000);
  CHECK(front.metres_per_pixel == Approx(4 * 1.2 / 1000));
  picture.fit.reset();
  picture.tubes.clear();
  picture.paths.push_back({"path", {{0, 0, 0}, {0, 0, 2}}});
  CHECK(fitted_camera("front", fit_balls(picture), 1000, 1000).metres_per_pixel == Approx(2 * 1.2 / 1000));
}

TEST_CASE("a view along a straight rod shows a third of its length; a single point still has a scale") {
  const std::vector<FitBall> rod{{{0, 0, 0}, 0.001}, {{0, 3, 0}, 0.001}};
  CHECK(fitted_camera("front", rod, 1000, 1000).metres_per_pixel * 1000 == Approx(1.2 * 3.002 / 3));
  const ViewCamera point = fitted_camera("iso", {{{5, 5, 5}, 0}}, 100, 100);
  CHECK(point.metres_per_pixel > 0);
  CHECK(std::isfinite(point.metres_per_pixel));
}
