#include "engine_bay/box.h"

#include <map>

namespace tendril::engine_bay {
namespace {

// Coordinates along one axis of a cube that is blown up to the rounded box. Fillet samples are spaced so that their
// directions from the fillet's centre are equally turned.
std::vector<double> samples(double half, double fillet, const Detail& detail) {
  const int arc = fillet > 0 ? std::max(1, (detail.steps(fillet, units::pi / 2) + 1) / 2) : 0;
  const int flat = detail.steps(2 * (half - fillet));
  std::vector<double> x;
  for (int k = arc; k > 0; --k) x.push_back(-(half - fillet) - fillet * std::tan(units::pi / 4 * k / arc));
  for (int k = 0; k <= flat; ++k) x.push_back((half - fillet) * (2.0 * k / flat - 1));
  for (int k = 1; k <= arc; ++k) x.push_back(half - fillet + fillet * std::tan(units::pi / 4 * k / arc));
  return x;
}

}  // namespace

Mesh box(const Vec3& low, const Vec3& high, double fillet, const Detail& detail) {
  const Vec3 middle = (low + high) / 2, half = (high - low) / 2;
  const double r = std::min(detail.fillet(fillet), 0.98 * half.minCoeff());
  const Vec3 core = half - Vec3::Constant(r);
  std::array<std::vector<double>, 3> x;
  for (int a = 0; a < 3; ++a) x[a] = samples(half[a], r, detail);

  Mesh mesh;
  std::map<std::array<std::size_t, 3>, std::uint32_t> index;
  const auto vertex = [&](const std::array<std::size_t, 3>& at) {
    const auto [it, is_new] = index.try_emplace(at, static_cast<std::uint32_t>(mesh.points.size()));
    if (is_new) {
      const Vec3 cube(x[0][at[0]], x[1][at[1]], x[2][at[2]]);
      const Vec3 inner = cube.cwiseMax(-core).cwiseMin(core);
      const Vec3 out = cube - inner;
      mesh.points.push_back(middle + (r > 0 ? Vec3(inner + r * out.normalized()) : cube));
    }
    return it->second;
  };
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    for (const bool far : {false, true}) {
      for (std::size_t i = 0; i + 1 < x[b].size(); ++i) {
        for (std::size_t j = 0; j + 1 < x[c].size(); ++j) {
          std::array<std::size_t, 3> p00{}, p10{}, p11{}, p01{};
          p00[a] = p10[a] = p11[a] = p01[a] = far ? x[a].size() - 1 : 0;
          p00[b] = p01[b] = i, p10[b] = p11[b] = i + 1;
          p00[c] = p10[c] = j, p11[c] = p01[c] = j + 1;
          const auto q00 = vertex(p00), q10 = vertex(p10), q11 = vertex(p11), q01 = vertex(p01);
          if (far) {
            mesh.triangles.push_back({q00, q10, q11});
            mesh.triangles.push_back({q00, q11, q01});
          } else {
            mesh.triangles.push_back({q00, q11, q10});
            mesh.triangles.push_back({q00, q01, q11});
          }
        }
      }
    }
  }
  return mesh;
}

Mesh tapered_box(const Vec3& low, const Vec3& high, double fillet, double taper, const Detail& detail) {
  const Vec3 middle = (low + high) / 2, half = (high - low) / 2;
  return mapped(box(low, high, fillet, detail), [&](const Vec3& p) {
    const double share = (high.z() - p.z()) / (high.z() - low.z());
    return Vec3(middle.x() + (p.x() - middle.x()) * (1 - share * taper / half.x()),
                middle.y() + (p.y() - middle.y()) * (1 - share * taper / half.y()), p.z());
  });
}

Mesh ribs(const Vec3& low, const Vec3& high, int axis, int count, double thickness, const Detail& detail) {
  Mesh mesh;
  const double pitch = (high[axis] - low[axis] - thickness) / std::max(1, count - 1);
  for (int k = 0; k < count; ++k) {
    Vec3 a = low, b = high;
    a[axis] = low[axis] + k * pitch;
    b[axis] = a[axis] + thickness;
    mesh.append(box(a, b, thickness / 3, detail));
  }
  return mesh;
}

}  // namespace tendril::engine_bay
