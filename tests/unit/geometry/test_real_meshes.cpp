// Real meshes, where the folder of shared data is there: TENDRIL_SHARED, or ../shared beside the source.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "geometry/closest_point.h"
#include "geometry/import_mesh.h"
#include "geometry/surroundings.h"
#include "unit/geometry/random_mesh.h"

using namespace tendril;
using tendril::test::Random;

namespace {

std::vector<std::string> shared_meshes() {
  const char* named = std::getenv("TENDRIL_SHARED");
  const std::filesystem::path shared = named ? named : "../shared";
  std::vector<std::string> found;
  for (const char* name : {"data/meshes/audi_chassis.obj", "data/meshes/forklift_body.obj", "data/robots/irb6640/visual/link_2.stl",
                           "data/robots/irb6640/collision/link_3.stl"})
    if (std::filesystem::exists(shared / name)) found.push_back((shared / name).string());
  if (found.empty()) WARN("no shared meshes here: skipped");
  return found;
}

}  // namespace

TEST_CASE("real meshes: queries agree with brute force and the contact energy is smooth", "[real]") {
  for (const std::string& path : shared_meshes()) {
    CAPTURE(path);
    const LoadedMesh loaded = load_mesh(path, 1);
    CHECK(loaded.warning.empty());
    CHECK(loaded.mesh.triangles.size() > 100);
    const auto surface = std::make_shared<const TriangleSurface>(loaded.mesh);
    Surroundings field;
    field.add({surface, {}, 0});
    const Mesh& mesh = surface->mesh();
    const Eigen::AlignedBox3d box = surface->box();
    const double size = box.diagonal().norm(), range = 0.02 * size;
    Random random(123);
    int smooth = 0;
    for (int i = 0; i < 60; ++i) {
      const auto& t = mesh.triangles[random.below(static_cast<int>(mesh.triangles.size()))];
      const Vec3 p = mesh.vertices[t[0]] + 0.015 * size * random.direction();
      double expected = 1e300;
      for (const auto& s : mesh.triangles)
        expected = std::min(expected, closest_on_triangle(p, mesh.vertices[s[0]], mesh.vertices[s[1]], mesh.vertices[s[2]]).squared);
      const double distance = field.closest(p, 1e9).distance;
      CHECK(distance == std::sqrt(expected));

      // phi(d) = (1 - d/range)^(5/2): its sum's gradient against central differences.
      const auto energy = [&](const Vec3& at, Vec3* gradient) {
        std::vector<DistanceTerm> terms;
        field.terms(at, range, terms);
        double sum = 0;
        for (const DistanceTerm& term : terms) {
          const double x = 1 - term.distance / range;
          sum += term.weight * std::pow(x, 2.5);
          if (gradient) *gradient -= term.weight * 2.5 / range * std::pow(x, 1.5) * term.normal;
        }
        return sum;
      };
      if (distance < 1e-3 * size) continue;
      Vec3 gradient = Vec3::Zero(), numeric;
      energy(p, &gradient);
      const double h = 1e-7 * size;
      for (int k = 0; k < 3; ++k) numeric[k] = (energy(p + h * Vec3::Unit(k), nullptr) - energy(p - h * Vec3::Unit(k), nullptr)) / (2 * h);
      CHECK((gradient - numeric).norm() < 1e-3 / range);
      ++smooth;
    }
    CHECK(smooth > 20);
  }
}
