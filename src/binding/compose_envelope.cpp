#include "binding/compose_envelope.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/parallel.h"
#include "base/units.h"
#include "binding/compose_tubes.h"
#include "geometry/inside_test.h"
#include "geometry/surroundings.h"
#include "scene/clearance.h"

namespace tendril {
namespace {

std::string rounded(double value, const char* unit) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.4g %s", value, unit);
  return buffer;
}

constexpr double far = 1;  // m: what lies beyond is of no interest

/// One obstacle, ready for points from several threads.
class Judge {
 public:
  Judge(const Surroundings& surroundings, int index, const PlacedObstacle& obstacle)
      : surroundings_(surroundings), index_(index), pose_(obstacle.body.pose) {
    const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&obstacle.body.shape);
    if (!surface) return;
    mesh_ = &(*surface)->mesh();
    if ((*surface)->topology().watertight()) inside_ = std::make_unique<InsideTest>(*mesh_);
  }

  /// Infinite beyond `far`.
  double distance(const Vec3& p) const {
    const ClosestPoint closest = surroundings_.closest_on(index_, p, far);
    const double away = closest.obstacle < 0 ? std::numeric_limits<double>::infinity() : closest.distance;
    if (inside_ && inside_->inside(pose_.rotation.conjugate() * (p - pose_.at))) return std::isfinite(away) ? -away : -far;
    return away;
  }

  /// Some vertex of the obstacle lies within the shell.
  bool reaches_into(const InsideTest& shell) const {
    return mesh_ && std::any_of(mesh_->vertices.begin(), mesh_->vertices.end(),
                                [&](const Vec3& v) { return shell.inside(pose_.at + pose_.rotation * v); });
  }

 private:
  const Surroundings& surroundings_;
  int index_;
  Frame pose_;
  const Mesh* mesh_ = nullptr;
  std::unique_ptr<InsideTest> inside_;
};

}  // namespace

ShellClearance shell_clearance(const Mesh& shell, const std::vector<PlacedObstacle>& obstacles) {
  Surroundings surroundings;
  std::vector<Judge> judges;
  for (const PlacedObstacle& obstacle : obstacles)
    judges.emplace_back(surroundings, surroundings.add(obstacle.body), obstacle);
  const std::optional<double> alike = common_clearance(obstacles);
  const int count = static_cast<int>(shell.vertices.size()), kinds = static_cast<int>(obstacles.size());
  constexpr int chunk = 1024;
  const int workers = std::max(1, std::min(thread_count(0), (count + chunk - 1) / chunk));
  constexpr double unknown = std::numeric_limits<double>::infinity();
  ShellClearance result;
  result.values.assign(count, std::numeric_limits<double>::quiet_NaN());
  std::vector<std::vector<double>> least(workers, std::vector<double>(kinds, unknown));
  std::atomic<int> next = 0;
  run_workers(workers, [&](int worker) {
    for (int first; (first = chunk * next++) < count;)
      for (int v = first; v < std::min(count, first + chunk); ++v) {
        double value = unknown;
        for (int k = 0; k < kinds; ++k) {
          const double distance = judges[k].distance(shell.vertices[v]);
          least[worker][k] = std::min(least[worker][k], distance);
          value = std::min(value, distance - (alike ? 0 : obstacles[k].clearance));
        }
        if (std::isfinite(value)) result.values[v] = value / units::mm;
      }
  });
  const InsideTest inside(shell);
  result.least = unknown;
  for (int k = 0; k < kinds; ++k) {
    double smallest = unknown;
    for (const auto& of_worker : least) smallest = std::min(smallest, of_worker[k]);
    const bool overlaps = smallest < 0 || judges[k].reaches_into(inside);
    if (overlaps) result.overlaps.push_back(k);
    if (overlaps) smallest = std::min(smallest, 0.0);
    if (smallest < result.least) result.least = smallest, result.nearest = k;
  }
  return result;
}

void add_envelope(const std::shared_ptr<const TriangleSurface>& envelope, const std::vector<PlacedObstacle>& obstacles,
                  bool coloured, Picture& picture) {
  PictureSurface surface;
  surface.name = "envelope";
  surface.vertices = envelope->mesh().vertices;
  surface.triangles = envelope->mesh().triangles;
  surface.owner = envelope;
  surface.style = SurfaceStyle::veil;
  surface.colour = {0.35f, 0.55f, 0.80f};
  surface.share = coloured ? 0.55 : 0.25;
  surface.edges = false;
  auto& rows = picture.card.rows;
  // Before the line that names the program.
  const auto add_row = [&](const std::string& label, const std::string& value, bool alarm) {
    const bool named = !rows.empty() && rows.back().label == "tendril";
    rows.insert(named ? rows.end() - 1 : rows.end(), {label, value, alarm});
  };
  add_row("envelope", rounded(1e3 * envelope->mesh().volume(), "dm^3"), false);
  if (!obstacles.empty()) {
    ShellClearance clearance = shell_clearance(envelope->mesh(), obstacles);
    if (clearance.nearest < 0) {
      add_row("envelope's clearance", "none near", false);
    } else {
      const PlacedObstacle& nearest = obstacles[clearance.nearest];
      const bool overlaps = !clearance.overlaps.empty();
      std::string text = overlaps ? "overlaps " + nearest.name : rounded(clearance.least / units::mm, "mm");
      if (!overlaps && obstacles.size() > 1) text += " to " + nearest.name;
      if (nearest.clearance > 0) text += " (required " + rounded(nearest.clearance / units::mm, "mm") + ")";
      add_row("envelope's clearance", text, overlaps || clearance.least < nearest.clearance);
    }
    if (coloured) {
      surface.values = std::move(clearance.values);
      picture.scale = clearance_scale(obstacles);
      picture.scale.name = "envelope: " + picture.scale.name;
    }
  }
  picture.surfaces.push_back(std::move(surface));
}

}  // namespace tendril
