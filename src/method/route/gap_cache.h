// Gaps that a search asks for again and again, kept on a fine grid: each node remembers its gap and in which direction it grows.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "method/free_space/free_space.h"

namespace tendril::routing {

/// For one thread. What is asked between nodes follows from the nearest one to first order: exact beside a flat wall, and off by no
/// more than half the diagonal of a cell of `spacing` (m) anywhere. Memory grows with the places that are asked for.
class GapCache {
 public:
  GapCache(const FreeSpace& space, double spacing);

  /// Whether the gap at p is at least `least` (m, small against `reach`).
  bool is_free(const Vec3& p, double least = 0);
  long queries() const { return queries_; }  ///< of the surroundings

 private:
  static constexpr int side = 8;
  struct Entry {
    float gap = 0, gradient[3] = {0, 0, 0};
    bool known = false;
  };
  using Block = std::array<Entry, side * side * side>;
  void measure(const Vec3& node, Entry& entry);

  const FreeSpace& space_;
  double spacing_, reach_;
  Vec3 corner_;
  std::array<int, 3> blocks_;
  std::vector<std::unique_ptr<Block>> block_;
  long queries_ = 0;
};

}  // namespace tendril::routing
