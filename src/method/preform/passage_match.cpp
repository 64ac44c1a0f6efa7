#include "method/preform/passage_match.h"

#include <algorithm>
#include <cmath>

namespace tendril::preform {

namespace {

using routing::Gap;

// A diagram of more cells than this a side costs too much: rungs between them are then looked at only where they are walked.
constexpr int most_cells = 64, fewest_cells = 8;
constexpr double finest_step = 1e-3;  ///< m
constexpr double most_places = 1e5;

/// The diagram of all pairs of places, as many on one curve as on the other. Its cells are filled as they are reached.
class RungDiagram {
 public:
  RungDiagram(const FreeSpace& space, const PccPoints& a, const PccPoints& b, double free_ends) : space_(space) {
    const double kept_clear = space.demands().radius + space.demands().clearance;
    const double step = std::max(0.8 * kept_clear, finest_step);
    // Between two rungs at most half a step is lost; then half of what is kept clear is left.
    least_ = std::max(0.5 * step - 0.5 * kept_clear, -0.5 * space.demands().radius);
    const double longest = std::max(a.length(), b.length());
    const int steps = static_cast<int>(std::clamp(std::ceil(longest / step), double(fewest_cells), most_places));
    stride_ = (steps + most_cells - 1) / most_cells;
    cells_ = (steps + stride_ - 1) / stride_;
    a_ = places(a, free_ends);
    b_ = places(b, free_ends);
    state_.assign(static_cast<std::size_t>(cells_ + 1) * (cells_ + 1), unknown);
  }

  /// Depth first, at even pace where that is possible.
  bool connected() {
    if (!free(0, 0)) return false;
    std::vector<Move> open;
    push_moves(0, 0, open);
    while (!open.empty()) {
      const Move move = open.back();
      open.pop_back();
      if (!passable(move)) continue;
      const int i = move.i + move.along_a, j = move.j + move.along_b;
      if (i == cells_ && j == cells_) return true;
      push_moves(i, j, open);
    }
    return false;
  }

  /// Obstacles between places at equal shares of the lengths, the most frequent first.
  std::vector<int> blocking() const {
    std::vector<int> counts, order;
    for (std::size_t k = 0; k < a_.size(); ++k) {
      const int obstacle = first_obstacle(a_[k], b_[k]);
      if (obstacle < 0) continue;
      if (obstacle >= static_cast<int>(counts.size())) counts.resize(obstacle + 1, 0);
      if (counts[obstacle]++ == 0) order.push_back(obstacle);
    }
    std::stable_sort(order.begin(), order.end(), [&](int x, int y) { return counts[x] > counts[y]; });
    return order;
  }

 private:
  enum State : unsigned char { unknown, reached, blocked };
  struct Move {
    int i, j;              ///< from this cell
    int along_a, along_b;  ///< 0 or 1, to the next
  };

  std::vector<Vec3> places(const PccPoints& curve, double free_ends) const {
    const double length = curve.length(), from = std::min(free_ends, 0.5 * length);
    return places_along(curve, cells_ * stride_ + 1, from, length - from);
  }

  State& state(int i, int j) { return state_[static_cast<std::size_t>(i) * (cells_ + 1) + j]; }
  bool free(int place_a, int place_b) const { return space_.is_free(a_[place_a], b_[place_b], least_); }

  /// Looks at the rung that the move ends at, then at those on the way; notes what it finds.
  bool passable(const Move& move) {
    State& end = state(move.i + move.along_a, move.j + move.along_b);
    if (end != unknown) return false;
    const int a = stride_ * move.i, b = stride_ * move.j;
    if (!free(a + move.along_a * stride_, b + move.along_b * stride_)) {
      end = blocked;
      return false;
    }
    for (int k = 1; k < stride_; ++k)
      if (!free(a + move.along_a * k, b + move.along_b * k)) return false;
    end = reached;
    return true;
  }

  // What comes last is tried first: both at once, then the one that is behind.
  void push_moves(int i, int j, std::vector<Move>& open) const {
    const int ahead = i > j ? 1 : 0;
    for (const auto& [along_a, along_b] : {std::pair{ahead, 1 - ahead}, {1 - ahead, ahead}, {1, 1}})
      if (i + along_a <= cells_ && j + along_b <= cells_) open.push_back({i, j, along_a, along_b});
  }

  /// What stops someone who goes from a to b; -1: nothing does.
  int first_obstacle(const Vec3& a, const Vec3& b) const {
    const double length = (b - a).norm(), smallest = 1e-3;
    for (double at = 0; at <= length;) {
      const Gap gap = space_.gap(length > 0 ? Vec3(a + at / length * (b - a)) : a, least_ + length);
      if (gap.obstacle < 0) return -1;
      if (gap.value < least_) return gap.obstacle;
      at += std::max(gap.value - least_, smallest);
    }
    return -1;
  }

  const FreeSpace& space_;
  double least_ = 0;              ///< m, of a rung's gap
  int cells_ = 0, stride_ = 1;    ///< a side, and places a cell
  std::vector<Vec3> a_, b_;       ///< cells_ * stride_ + 1 places of each curve
  std::vector<State> state_;      ///< of each cell, that is of the rung at its corner
};

}  // namespace

bool same_passage(const FreeSpace& space, const PccPoints& a, const PccPoints& b, double free_ends, std::vector<int>* blocking) {
  if (blocking) blocking->clear();
  if (!space.has_obstacles()) return true;
  RungDiagram diagram(space, a, b, free_ends);
  if (diagram.connected()) return true;
  if (blocking) *blocking = diagram.blocking();
  return false;
}

}  // namespace tendril::preform
