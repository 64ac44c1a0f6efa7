// Random rods among random obstacles, by family, for the property test and the benchmark of contact.
#pragma once

#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "statics/equilibrium.h"
#include "unit/statics/test_contact_fields.h"

namespace tendril::test {

/// Triangles in plain arrays: the same mesh can be given to any field.
struct SheetMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;

  void add(const SheetMesh& other);
  /// Two triangles for each of nu x nv cells of the surface place(u, v), u and v in 0 ... 1.
  static SheetMesh grid(int nu, int nv, const std::function<Vec3(double, double)>& place);
  static SheetMesh box(const Vec3& low, const Vec3& high, int cuts);
};

/// How a mesh becomes surroundings: the brute-force field of the unit tests or the project's own tree.
using MakeField = std::function<std::shared_ptr<ContactField>(const SheetMesh&)>;

struct ContactCase {
  RodProblem problem;
  std::shared_ptr<ContactField> field;
  /// True for a centre line that can only be there by passing through a surface; by geometry alone, not by the field.
  std::function<bool(const Equilibrium&)> tunnelled;
};

struct ContactFamily {
  std::string name;
  std::function<ContactCase(std::mt19937_64&, const MakeField&)> make;
};

/// `terrain_cells`: squares along each side of the terrain.
std::vector<ContactFamily> contact_families(int terrain_cells);

/// Beside the benchmark's families: preformed hoses over a box's edge, and hoses on a profile whose sheets meet three at
/// a line (no manifold).
std::vector<ContactFamily> further_contact_families();

/// The first guess crosses a square sheet of 60 to 300 mm. Some of these have no way around it.
std::vector<ContactFamily> crossing_families();

/// A harness of three rods at a free branch point.
struct HarnessCase {
  SystemProblem problem;
  std::shared_ptr<ContactField> field;
  std::function<bool(const Equilibrium&)> tunnelled;  ///< of one rod
};

struct HarnessFamily {
  std::string name;
  std::function<HarnessCase(std::mt19937_64&, const MakeField&)> make;
};

/// Harnesses that fall on a floor, on a box's edge and on hills.
std::vector<HarnessFamily> harness_families(int terrain_cells);

/// A field that sums over every triangle; for small meshes.
MakeField every_triangle();

}  // namespace tendril::test
