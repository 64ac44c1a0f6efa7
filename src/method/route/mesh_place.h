// Places that move with a rod's mesh when lengths change: 3.25 is a quarter of the way from vertex 3 to vertex 4.
#pragma once

#include <algorithm>
#include <vector>

namespace tendril::routing {

/// `s`: arc lengths of the vertices (m, rising).
inline double mesh_place(const std::vector<double>& s, double at) {
  const auto after = std::upper_bound(s.begin() + 1, s.end() - 1, at);
  const auto k = after - s.begin() - 1;
  return static_cast<double>(k) + std::clamp((at - s[k]) / (s[k + 1] - s[k]), 0.0, 1.0);
}

inline double arc_length_at(const std::vector<double>& s, double place) {
  const std::size_t k = std::min(static_cast<std::size_t>(place), s.size() - 2);
  return s[k] + std::clamp(place - static_cast<double>(k), 0.0, 1.0) * (s[k + 1] - s[k]);
}

}  // namespace tendril::routing
