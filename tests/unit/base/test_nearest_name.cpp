#include <catch2/catch.hpp>

#include "base/nearest_name.h"

using namespace tendril;

TEST_CASE("the edit distance counts insertions, deletions, replacements and swaps", "[base]") {
  CHECK(edit_distance("hose", "hose") == 0);
  CHECK(edit_distance("hos", "hose") == 1);
  CHECK(edit_distance("hsoe", "hose") == 1);
  CHECK(edit_distance("outter", "outer") == 1);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("Hose", "hose") == 0);
}

TEST_CASE("a mistyped name finds its neighbour, a foreign one finds nothing", "[base]") {
  const std::vector<std::string> names = {"hose", "cable", "engine_block"};
  CHECK(nearest_name("hoes", names) == "hose");
  CHECK(nearest_name("engin_block", names) == "engine_block");
  CHECK(nearest_name("radiator", names).empty());
  CHECK(nearest_name("", names).empty());
  CHECK(unknown_name("hoes", "rods", names) == "'hoes'; did you mean 'hose'? (rods: hose, cable, engine_block)");
  CHECK(unknown_name("radiator", "rods", names) == "'radiator' (rods: hose, cable, engine_block)");
  CHECK(unknown_name("x", "rods", {}) == "'x' (there are no rods)");
}
