#include <catch2/catch.hpp>

#include <cmath>

#include "view/colour_map.h"

using namespace tendril;

namespace {

Picture with_values(std::vector<double> values, ColourScale scale) {
  Picture picture;
  PictureTube tube;
  tube.radius = 0.01;
  for (std::size_t i = 0; i < values.size(); ++i) tube.points.push_back({double(i), 0, 0});
  tube.values = std::move(values);
  picture.tubes.push_back(tube);
  picture.scale = scale;
  return picture;
}

float largest_step(const ColourTable& table) {
  float largest = 0;
  for (std::size_t i = 1; i < table.size(); ++i)
    largest = std::max({largest, std::abs(table[i].r - table[i - 1].r), std::abs(table[i].g - table[i - 1].g),
                        std::abs(table[i].b - table[i - 1].b)});
  return largest;
}

}  // namespace

TEST_CASE("lightness of white, black and grey") {
  CHECK(lightness({1, 1, 1}) == Approx(1).margin(1e-3));
  CHECK(lightness({0, 0, 0}) == Approx(0).margin(1e-6));
  CHECK(lightness({0.5f, 0.5f, 0.5f}) ==
        Approx(std::cbrt(0.2140)).margin(1e-3));  // grey: the cube root of its luminance
}

TEST_CASE("the magnitude map grows lighter all the way, without jumps, from dark to light") {
  const ColourTable& table = magnitude_colours();
  for (std::size_t i = 1; i < table.size(); ++i) {
    INFO("entry " << i);
    CHECK(lightness(table[i]) > lightness(table[i - 1]));
  }
  CHECK(lightness(table.front()) == Approx(0.30).margin(0.01));
  CHECK(lightness(table.back()) == Approx(0.90).margin(0.01));
  CHECK(largest_step(table) < 0.06f);  // where red leaves zero, sRGB is steep
}

TEST_CASE("the diverging map is light in the middle and as dark at both ends, blue left and red right") {
  const ColourTable& table = diverging_colours();
  for (std::size_t i = 0; i < table.size() / 2; ++i) {
    CHECK(lightness(table[i]) == Approx(lightness(table[table.size() - 1 - i])).margin(2e-3));
    CHECK(lightness(table[i]) < lightness(table[i + 1]) + 1e-9);
  }
  CHECK(table.front().b > table.front().r + 0.3f);
  CHECK(table.back().r > table.back().b + 0.3f);
  CHECK(largest_step(table) < 0.05f);
}

TEST_CASE("clearance breaks hard at the required value") {
  const ColourRange range = settled_range(
      with_values({2, 8, 20}, {ColourMeaning::clearance, "clearance", "mm", {}, {}, 8.0, LimitSide::none}));
  CHECK(range.low == 2);
  CHECK(range.high == 20);
  CHECK(range.broken == LimitSide::below);
  CHECK(range.breaks(7.999999));
  CHECK_FALSE(range.breaks(8));
  CHECK(range.colour(7.999999) == broken_colour);
  CHECK(lightness(range.colour(8)) == Approx(lightness(magnitude_colours().back())).margin(1e-6));
  CHECK(lightness(range.colour(20)) == Approx(lightness(magnitude_colours().front())).margin(1e-6));
  CHECK(range.colour(NAN) == unknown_colour);
}

TEST_CASE("a limit above is broken above only, and one that only marks breaks nothing") {
  const ColourRange above =
      settled_range(with_values({1, 9}, {ColourMeaning::magnitude, "curvature", "1/m", {}, {}, 5.0, LimitSide::above}));
  CHECK(above.breaks(5.1));
  CHECK_FALSE(above.breaks(5));
  const ColourRange mark =
      settled_range(with_values({1, 9}, {ColourMeaning::magnitude, "curvature", "1/m", {}, {}, 5.0, LimitSide::none}));
  CHECK_FALSE(mark.breaks(100));
  CHECK_FALSE(mark.breaks(-100));
}

TEST_CASE(
    "ranges: from the data, symmetric about zero, with the limit inside, widened when flat, overruled by the user") {
  CHECK(settled_range(with_values({NAN, 3, 5, INFINITY}, {})).high == 5);
  const ColourRange signed_range =
      settled_range(with_values({-2, 7}, {ColourMeaning::diverging, "twist", "1/m", {}, {}, {}, LimitSide::none}));
  CHECK(signed_range.low == -7);
  CHECK(signed_range.high == 7);
  const ColourRange far = settled_range(
      with_values({30, 40}, {ColourMeaning::clearance, "clearance", "mm", {}, {}, 8.0, LimitSide::below}));
  CHECK(far.low == 8);
  const ColourRange flat = settled_range(with_values({4, 4}, {}));
  CHECK(flat.low < 4);
  CHECK(flat.high > 4);
  const ColourRange zero = settled_range(with_values({0, 0}, {}));
  CHECK(zero.low < zero.high);
  const ColourRange none = settled_range(with_values({NAN, NAN}, {}));
  CHECK(none.low == 0);
  CHECK(none.high == 1);
  const ColourRange asked =
      settled_range(with_values({1, 2}, {ColourMeaning::magnitude, "", "", 0.0, 10.0, {}, LimitSide::none}));
  CHECK(asked.low == 0);
  CHECK(asked.high == 10);
}
