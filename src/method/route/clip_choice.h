// Which of many places for clips to take: as few as hold what is demanded.
#pragma once

#include <functional>
#include <limits>
#include <vector>

namespace tendril::routing {

/// How well a stretch between two held places keeps what is demanded: below 0 not; the more above 0, the more is in reserve.
using SpanMargin = std::function<double(int from, int to)>;

struct ClipChoice {
  std::vector<int> places;  ///< rising, of 1 ... n
  double margin = -std::numeric_limits<double>::infinity();  ///< the smallest of its stretches
  int needed = -1;          ///< clips that would do, were there no limit; -1: no number does
};

/// 0 (the start) and n + 1 (the finish) are held, places 1 ... n between them may be. A clip that holds position and orientation
/// makes the stretches on both sides independent of each other, so that the best choice is a path from 0 to n + 1: one of the
/// fewest clips whose stretches all have a margin of at least 0, among those the one of the largest smallest margin. Where at most
/// `most` clips do not do: the largest smallest margin that they reach.
/// Each stretch is asked for at most once, from each place from short to long; after `patience` in a row below 0 longer ones count
/// as lost, but for the one to the finish from the start.
ClipChoice fewest_clips(int n, int most, const SpanMargin& margin, int patience = 4);

/// For stretches that depend on each other, as those beside a branch point do: leaves out one place after the other, the most
/// dispensable first, while `margin` of those that stay is at least 0. What is given must be kept as it is where its own margin is
/// below 0. Asks for at most n (n + 1) / 2 + 1 margins.
std::vector<int> pruned_clips(std::vector<int> places, const std::function<double(const std::vector<int>&)>& margin);

}  // namespace tendril::routing
