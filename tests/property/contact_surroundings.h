// The families' meshes as the project's own surroundings: distance tree, topology and contact terms.
#pragma once

#include "contact_families.h"
#include "geometry/surroundings.h"

namespace tendril::test {

/// `clearance` (m): what every obstacle requires.
inline MakeField as_surroundings(double clearance = 0) {
  return [clearance](const SheetMesh& sheet) {
    Mesh mesh;
    mesh.vertices = sheet.vertices;
    mesh.triangles = sheet.triangles;
    auto all = std::make_shared<Surroundings>();
    all->add({std::make_shared<const TriangleSurface>(std::move(mesh)), Frame{}, clearance, "sheet"});
    return all;
  };
}

}  // namespace tendril::test
