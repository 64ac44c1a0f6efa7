// The whole engine bay, and what can be said about it.
#pragma once

#include "engine_bay/parts.h"

namespace tendril::engine_bay {

/// About 1.4 x 0.9 x 0.7 m of our own design; the same detail gives the same bits. Parts keep a fixed order.
std::vector<Part> engine_bay(const Detail& detail);

/// Figures of one part.
struct Figures {
  std::size_t triangles = 0;
  std::size_t open_edges = 0;      ///< edges of one triangle
  std::size_t crossed_edges = 0;   ///< edges of three or more triangles, or of two that run the same way
  std::size_t slivers = 0;         ///< triangles without area
  double volume = 0;               ///< mm^3, for bodies; shells that overlap count twice
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< mm
};

Figures figures(const Mesh& mesh);

}  // namespace tendril::engine_bay
