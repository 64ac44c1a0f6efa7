#include "engine_bay/fastener.h"

#include "engine_bay/box.h"

namespace tendril::engine_bay {

Mesh bolt(double size, const Detail& detail) {
  const double flange = 1.05 * size, head = 0.83 * size;
  // Six corners with the top chamfered by a smaller loop.
  const auto hexagon = [&](double radius, double z) {
    Loop loop;
    for (int k = 0; k < 6; ++k)
      loop.emplace_back(radius * std::cos(units::pi / 3 * k), radius * std::sin(units::pi / 3 * k), z);
    return loop;
  };
  if (!detail.texture) return loft({hexagon(head, 0), hexagon(head, size)}, Ends::capped, detail);
  Mesh mesh = turned({{0, 0}, {flange, 0}, {flange, 0.2 * size}, {0, 0.35 * size}}, detail);
  mesh.append(loft({hexagon(head, 0.1 * size), hexagon(head, 0.85 * size), hexagon(0.85 * head, size)}, Ends::capped,
                   detail.with_edge(1e9)));
  return mesh;
}

Mesh bolts(const std::vector<Vec3>& places, const Vec3& along, double size, const Detail& detail) {
  const Mesh one = bolt(size, detail);
  Mesh mesh;
  for (const Vec3& at : places) mesh.append(placed(one, facing(at, along)));
  return mesh;
}

std::vector<Vec3> rim_places(const Vec3& low, const Vec3& high, int along_x, int along_y) {
  std::vector<Vec3> places;
  for (int k = 0; k < along_x; ++k) {
    const double x = low.x() + (high.x() - low.x()) * k / along_x, back = high.x() - (x - low.x());
    places.emplace_back(x, low.y(), low.z());
    places.emplace_back(back, high.y(), low.z());
  }
  for (int k = 0; k < along_y; ++k) {
    const double y = low.y() + (high.y() - low.y()) * k / along_y, back = high.y() - (y - low.y());
    places.emplace_back(high.x(), y, low.z());
    places.emplace_back(low.x(), back, low.z());
  }
  return places;
}

Mesh hose_clamp(double radius, double width, const Detail& detail) {
  const double h = width / 2;
  Mesh band = turned({{radius, -h}, {radius + 1.2, -h}, {radius + 1.2, h}, {radius, h}, {radius, -h}}, detail);
  band.append(box({radius + 0.5, -7, -h * 0.8}, {radius + 8, 7, h * 0.8}, 1.5, detail));
  band.append(placed(cylinder(3.5, 18, 0.8, detail), facing({radius + 4.5, -10, 0}, Vec3::UnitY())));
  return band;
}

Mesh strap(const Path& corners, double width, double thickness, const Vec3& across, const Detail& detail) {
  // `across` becomes the section's y.
  return sweep(rounded_path(corners, 3 * thickness, detail), rounded_rectangle(thickness, width, 0.3 * thickness, detail),
               Ends::capped, detail, across);
}

}  // namespace tendril::engine_bay
