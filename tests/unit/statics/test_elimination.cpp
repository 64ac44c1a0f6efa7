#include <catch2/catch.hpp>

#include "statics/elimination.h"

using namespace tendril;

TEST_CASE("elimination: rods without branch points are walked along, as the general way does") {
  // Rods of 1, 2, 5 and 3 nodes; a further node without an edge of its own makes the pattern no chain.
  BlockPattern chain;
  for (const int nodes : {1, 2, 5, 3})
    for (int i = 0; i < nodes; ++i) {
      const int here = chain.nodes++;
      chain.edges.push_back(i + 1 < nodes ? BlockPattern::Edge{here, here + 1} : BlockPattern::Edge{});
    }
  BlockPattern general = chain;
  ++general.nodes;
  const Elimination quick(chain), slow(general);
  REQUIRE(quick.columns().size() == 11);
  REQUIRE(slow.columns().size() == 12);
  REQUIRE(quick.links().size() == slow.links().size());
  REQUIRE(quick.sources().size() == slow.sources().size());
  CHECK(quick.links().size() == 7);
  // The orders may differ between rods, not along them: compare what each node is coupled with.
  auto describe = [](const Elimination& elimination, int node) {
    std::vector<int> text;
    for (std::size_t p = 0; p < elimination.columns().size(); ++p) {
      const Elimination::Column& column = elimination.columns()[p];
      if (column.node != node) continue;
      text = {column.filled, column.carried, column.links_end - column.links_begin};
      for (int l = column.links_begin; l < column.links_end; ++l) {
        const Elimination::Link& link = elimination.links()[l];
        text.push_back(elimination.columns()[link.target].node);
        text.push_back(link.filled);
        CHECK(link.target == static_cast<int>(p) + 1);
        for (int s = link.sources_begin; s < link.sources_end; ++s) {
          text.push_back(elimination.sources()[s].edge);
          text.push_back(elimination.sources()[s].transposed);
        }
      }
    }
    return text;
  };
  for (int node = 0; node < chain.nodes; ++node) {
    CAPTURE(node);
    CHECK(describe(quick, node) == describe(slow, node));
  }
}
