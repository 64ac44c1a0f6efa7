// In which order the nodes of a block system are eliminated, and what each elimination touches.
#pragma once

#include <vector>

#include "statics/block_system.h"

namespace tendril {

/// Trees are eliminated from the leaves to the root: no fill, linear in the number of nodes. What closed loops leave is
/// eliminated by least degree: a chain between two branch points fills one block a node.
class Elimination {
 public:
  explicit Elimination(const BlockPattern& pattern);

  /// A block that lends itself to a link: an edge of the pattern, as it is or transposed.
  struct Source {
    int edge;
    bool transposed;
  };
  /// A later node that this one is coupled with when its turn comes.
  struct Link {
    int target;                      ///< position in the order
    int sources_begin, sources_end;  ///< blocks of the matrix that it starts from
    bool filled;                     ///< earlier eliminations have added to it
  };
  struct Column {
    int node;
    int links_begin, links_end;
    bool filled;   ///< earlier eliminations have added to its diagonal, other than the one just before
    bool carried;  ///< the elimination just before adds to its diagonal, and to nothing else
  };

  const std::vector<Column>& columns() const { return columns_; }
  const std::vector<Link>& links() const { return links_; }
  const std::vector<Source>& sources() const { return sources_; }
  /// Index of the link from position `from` to the later position `to`.
  int link_between(int from, int to) const;

 private:
  void eliminate_chain(const BlockPattern& pattern);

  std::vector<Column> columns_;
  std::vector<Link> links_;
  std::vector<Source> sources_;
};

}  // namespace tendril
