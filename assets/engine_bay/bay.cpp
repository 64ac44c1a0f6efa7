#include "engine_bay/bay.h"

namespace tendril::engine_bay {

std::vector<Part> engine_bay(const Detail& detail) {
  Parts parts;
  add_structure(parts, detail);
  add_engine(parts, detail);
  add_transmission(parts, detail);
  add_breathing(parts, detail);
  add_belt_drive(parts, detail);
  add_cooling(parts, detail);
  add_electrics(parts, detail);
  add_fluids(parts, detail);
  add_fasteners(parts, detail);
  return std::move(parts.all);
}

Figures figures(const Mesh& mesh) {
  Figures f;
  f.triangles = mesh.triangles.size();
  f.low = f.high = mesh.points.front();
  for (const Vec3& p : mesh.points) f.low = f.low.cwiseMin(p), f.high = f.high.cwiseMax(p);

  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // as they run
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    f.volume += a.dot(b.cross(c)) / 6;
    if ((b - a).cross(c - a).norm() < 1e-9) ++f.slivers;
    for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  }
  const auto key = [](const auto& e) { return std::pair(std::min(e.first, e.second), std::max(e.first, e.second)); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && key(edges[j]) == key(edges[i])) ++j;
    if (j - i == 1) ++f.open_edges;
    if (j - i > 2 || (j - i == 2 && edges[i] == edges[i + 1])) ++f.crossed_edges;
    i = j;
  }
  return f;
}

}  // namespace tendril::engine_bay
