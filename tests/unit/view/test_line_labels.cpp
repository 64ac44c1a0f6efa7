#include <catch2/catch.hpp>

#include "view/line_labels.h"

using tendril::ChartTrace;
using tendril::line_labels;
using tendril::LinePlace;

TEST_CASE("a name stands behind its line's last point where there is room", "[view]") {
  const std::vector<LinePlace> places = line_labels({{{0.1, 0.2}, {0.5, 0.5}}, {{0.1, 0.8}, {0.5, 0.9}}}, {0.2, 0.2}, 0.05);
  REQUIRE(places.size() == 2);
  for (const LinePlace& place : places) {
    CHECK(place.point == 1);
    CHECK_FALSE(place.left);
  }
}

TEST_CASE("a name keeps inside the axes", "[view]") {
  const std::vector<LinePlace> places = line_labels({{{0.1, 0.2}, {0.95, 0.5}}}, {0.3}, 0.05);
  const bool inside = places[0].point == 0 ? !places[0].left : places[0].left;
  CHECK(inside);
}

TEST_CASE("names do not cover other lines or each other", "[view]") {
  // The second line runs where the first one's name would begin.
  const ChartTrace first{{0.3, 0.1}, {0.4, 0.5}}, across{{0.5, 0.1}, {0.5, 0.9}};
  const LinePlace place = line_labels({first, across}, {0.25, 0.1}, 0.05)[0];
  CHECK((place.point != 1 || place.left));
  // Both lines end at one place.
  const std::vector<LinePlace> both = line_labels({{{0.2, 0.9}, {0.6, 0.5}}, {{0.2, 0.1}, {0.6, 0.5}}}, {0.2, 0.2}, 0.05);
  CHECK((both[0].point != both[1].point || both[0].left != both[1].left));
}

TEST_CASE("lines without points or names need no place", "[view]") {
  const std::vector<LinePlace> places = line_labels({{}, {{0.5, 0.5}}}, {0.2, 0}, 0.05);
  CHECK(places.size() == 2);
  CHECK(places[1].point == 0);
}
