#include <catch2/catch.hpp>
#include <string>

#include "view/legend_corner.h"

using tendril::ChartTrace;
using tendril::legend_corner;

TEST_CASE("the legend stays at the top right where nothing is", "[view]") {
  CHECK(std::string(legend_corner({}, 2, true)) == "top right");
  const ChartTrace falling{{0.05, 0.95}, {0.95, 0.05}};
  CHECK(std::string(legend_corner({falling}, 3, true)) == "top right");
}

TEST_CASE("the legend goes to the first corner that is free", "[view]") {
  const ChartTrace rising{{0.05, 0.05}, {0.95, 0.95}};
  CHECK(std::string(legend_corner({rising}, 3, true)) == "top left");
  const ChartTrace along_top{{0.02, 0.97}, {0.98, 0.97}};
  CHECK(std::string(legend_corner({along_top}, 3, true)) == "bottom right");
  const ChartTrace down_right{{0.98, 0.97}, {0.98, 0.02}};
  CHECK(std::string(legend_corner({along_top, down_right}, 3, true)) == "bottom left");
}

TEST_CASE("a line between two points counts only where points are joined", "[view]") {
  const ChartTrace across_corner{{0.55, 0.99}, {0.999, 0.80}};
  CHECK(std::string(legend_corner({across_corner}, 4, true)) == "top left");
  CHECK(std::string(legend_corner({across_corner}, 3, false)) == "top right");
}

TEST_CASE("a taller legend hides more", "[view]") {
  const ChartTrace below_one_row{{0.9, 0.85}};
  CHECK(std::string(legend_corner({below_one_row}, 1, false)) == "top right");
  CHECK(std::string(legend_corner({below_one_row}, 6, false)) == "top left");
}
