// Triangles of tubes, holds, arrows and paths, at their true size or, where the page rules, at a size in pixels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "view/picture.h"
#include "view/view_camera.h"

namespace tendril::render {

struct TubeVertex {
  Eigen::Vector3f position;  ///< m, relative to the origin
  Eigen::Vector3f outward;   ///< unit
  float radius = 0;          ///< m; 0: never blown up to a least radius
  float value = 0;
  float along = 0, around = 0;           ///< arc length (m) and turns, for stripes and dashes
  std::array<std::uint8_t, 4> colour{};  ///< alpha 0: by value
};

struct TubeMesh {
  std::vector<TubeVertex> vertices;
  std::vector<std::uint32_t> triangles;
};

/// A tube with round ends. At most `most_rings` rings are made; more points than that are thinned evenly.
void add_tube(const PictureTube& tube, const Vec3& origin, TubeMesh& mesh, int sides = 32, int most_rings = 6000);

void add_hold(const PictureHold& hold, const ViewCamera& camera, const Vec3& origin, TubeMesh& mesh);
void add_arrow(const PictureArrow& arrow, const ViewCamera& camera, const Vec3& origin, TubeMesh& mesh);
void add_path(const PicturePath& path, const ViewCamera& camera, const Vec3& origin, TubeMesh& mesh);

/// Where an arrow's head and tail lie: its length is a twelfth of the view's smaller side.
std::array<Vec3, 2> arrow_ends(const PictureArrow& arrow, const ViewCamera& camera);

}  // namespace tendril::render
