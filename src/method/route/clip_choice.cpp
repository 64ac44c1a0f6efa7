#include "method/route/clip_choice.h"

#include <algorithm>

namespace tendril::routing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Margins of the stretches from each place; what was not asked for is lost.
std::vector<std::vector<double>> spans_of(int n, const SpanMargin& margin, int patience) {
  std::vector<std::vector<double>> spans(n + 2, std::vector<double>(n + 2, -infinity));
  for (int i = 0; i <= n; ++i) {
    int lost = 0;
    for (int j = i + 1; j <= n + 1 && lost < patience; ++j) {
      spans[i][j] = margin(i, j);
      lost = spans[i][j] < 0 ? lost + 1 : 0;
    }
  }
  if (spans[0][n + 1] == -infinity) spans[0][n + 1] = margin(0, n + 1);
  return spans;
}

/// best[j]: the largest smallest margin of a path of so many stretches from 0 to j; before[j]: where its last one begins.
struct Level {
  std::vector<double> best;
  std::vector<int> before;
};

Level next_level(const Level& last, const std::vector<std::vector<double>>& spans) {
  const int places = static_cast<int>(spans.size());
  Level level{std::vector<double>(places, -infinity), std::vector<int>(places, -1)};
  for (int j = 1; j < places; ++j)
    for (int i = 0; i < j; ++i) {
      const double here = std::min(last.best[i], spans[i][j]);
      if (here > level.best[j]) {
        level.best[j] = here;
        level.before[j] = i;
      }
    }
  return level;
}

std::vector<int> path_to(const std::vector<Level>& levels, int last, int finish) {
  std::vector<int> places;
  for (int l = last, at = finish; l > 1; --l) {
    at = levels[l].before[at];
    places.push_back(at);
  }
  std::reverse(places.begin(), places.end());
  return places;
}

}  // namespace

ClipChoice fewest_clips(int n, int most, const SpanMargin& margin, int patience) {
  const auto spans = spans_of(n, margin, patience);
  std::vector<Level> levels(1);
  levels[0].best.assign(n + 2, -infinity);
  levels[0].best[0] = infinity;
  ClipChoice choice;
  int taken = 0;
  for (int l = 1; l <= n + 1; ++l) {
    levels.push_back(next_level(levels.back(), spans));
    const double reached = levels[l].best[n + 1];
    if (l <= most + 1 && reached > choice.margin) {
      choice.margin = reached;
      taken = l;
    }
    if (reached < 0) continue;
    choice.needed = l - 1;
    break;
  }
  if (taken > 0) choice.places = path_to(levels, taken, n + 1);
  return choice;
}

std::vector<int> pruned_clips(std::vector<int> places, const std::function<double(const std::vector<int>&)>& margin) {
  if (margin(places) < 0) return places;
  while (!places.empty()) {
    double best = -infinity;
    std::vector<int> left;
    for (std::size_t k = 0; k < places.size(); ++k) {
      std::vector<int> without = places;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
      const double here = margin(without);
      if (here >= 0 && here > best) {
        best = here;
        left = std::move(without);
      }
    }
    if (best < 0) break;
    places = std::move(left);
  }
  return places;
}

}  // namespace tendril::routing
