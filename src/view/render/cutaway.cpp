#include "view/render/cutaway.h"

#include <algorithm>
#include <cmath>

namespace tendril::render {
namespace {

constexpr double cell_pixels = 8;
constexpr std::size_t most_probes = 400;

struct Probe {
  double x, y, z, radius;  // pixels, pixels, m, m
};

std::vector<Probe> probes_of(const std::vector<PictureTube>& tubes, const ViewCamera& camera) {
  std::size_t points = 0;
  for (const PictureTube& tube : tubes) points += tube.points.size();
  const std::size_t stride = std::max<std::size_t>(1, points / most_probes);
  std::vector<Probe> probes;
  const auto add = [&](const Vec3& at, double radius) {
    const Vec3 p = camera.project(at);
    probes.push_back({p.x(), camera.height - p.y(), p.z(), radius});
  };
  for (const PictureTube& tube : tubes)
    for (std::size_t i = 0; i < tube.points.size(); i += stride) {
      const double radius = tube.radii.empty() ? tube.radius : tube.radii[i];
      add(tube.points[i], radius);
      // Few points far apart: the cut follows the line between them.
      const Vec3& next = tube.points[std::min(i + stride, tube.points.size() - 1)];
      const double pixels = (next - tube.points[i]).norm() / camera.metres_per_pixel;
      const int between = std::clamp(static_cast<int>(pixels / (2 * cell_pixels)), 0, 100);
      for (int k = 1; k <= between; ++k) add(tube.points[i] + (next - tube.points[i]) * k / (between + 1.0), radius);
    }
  return probes;
}

}  // namespace

Cutaway::Range Cutaway::over(double left, double right, double bottom, double top) const {
  const auto cell = [](double share, int count) {
    return std::clamp(static_cast<int>(std::floor(share * count)), 0, count - 1);
  };
  // One cell more on each side: the texture is read with linear interpolation.
  const int x0 = std::max(cell(left, columns) - 1, 0), x1 = std::min(cell(right, columns) + 1, columns - 1);
  const int y0 = std::max(cell(bottom, rows) - 1, 0), y1 = std::min(cell(top, rows) + 1, rows - 1);
  Range range{1e30f, -1e30f};
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const float d = depth[static_cast<std::size_t>(y) * columns + x];
      range.least = std::min(range.least, d), range.most = std::max(range.most, d);
    }
  return range;
}

Cutaway cutaway_of(const std::vector<PictureTube>& tubes, const ViewCamera& camera, double nearest, double range) {
  Cutaway cut;
  const std::vector<Probe> probes = probes_of(tubes, camera);
  if (probes.empty()) return cut;
  cut.columns = std::max(1, static_cast<int>(std::ceil(camera.width / cell_pixels)));
  cut.rows = std::max(1, static_cast<int>(std::ceil(camera.height / cell_pixels)));
  cut.depth.resize(static_cast<std::size_t>(cut.columns) * cut.rows);
  for (int row = 0; row < cut.rows; ++row)
    for (int column = 0; column < cut.columns; ++column) {
      const double x = (column + 0.5) * camera.width / cut.columns, y = (row + 0.5) * camera.height / cut.rows;
      double lowest = INFINITY;
      for (const Probe& probe : probes) {
        const double away = std::hypot(x - probe.x, y - probe.y) * camera.metres_per_pixel;
        lowest = std::min(lowest, probe.z + 0.7 * probe.radius + cut_slope * std::max(away - 2.5 * probe.radius, 0.0));
      }
      cut.depth[static_cast<std::size_t>(row) * cut.columns + column] = static_cast<float>((nearest - lowest) / range);
    }
  return cut;
}

}  // namespace tendril::render
