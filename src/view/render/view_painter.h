// Draws one view of the picture into an image.
#pragma once

#include <functional>
#include <memory>

#include "view/colour_map.h"
#include "view/render/gl.h"
#include "view/render/image.h"
#include "view/render/scene_geometry.h"
#include "view/render/tube_mesh.h"

namespace tendril::render {

inline constexpr Rgb paper{0.973f, 0.973f, 0.965f};
inline constexpr Rgb ink{0.16f, 0.17f, 0.20f};

/// Everything that the views of one picture share.
class ViewPainter {
 public:
  ViewPainter(const Picture& picture, const SceneGeometry& surroundings, const Vec3& origin);
  ~ViewPainter();

  /// The view at camera.width x camera.height pixels, in tiles. Stops early, leaving the rest white, when the context
  /// says so.
  Image paint(const ViewCamera& camera, const RunContext& context);

 private:
  struct Programs;
  struct Buffers;
  struct Span {
    double nearest, range;
  };
  /// Lengths that belong to the whole view, whatever the tile: pixels, and samples of depth.
  struct Look {
    double occlusion, fade;
  };
  class Tubes;
  struct Marks;

  static Look look_of(const ViewCamera& camera);
  Span depth_span(const ViewCamera& camera, const std::vector<const TubeMesh*>& meshes) const;
  void paint_tile(const ViewCamera& camera, const Span& span, const Look& look, const Marks& marks,
                  const Buffers& buffers) const;
  void draw_surroundings(const SceneGeometry::Page& page, GLuint cut, const Buffers& buffers) const;
  void draw_tubes(const SceneGeometry::Page& page, const Marks& marks, const Buffers& buffers) const;
  void set_range(const Program& program) const;
  void compose(const SceneGeometry::Page& page, const Look& look, GLuint cut, const Buffers& buffers) const;

  const Picture& picture_;
  const SceneGeometry& surroundings_;
  Vec3 origin_;
  ColourRange range_;
  double stripe_ = 0;  ///< m: the largest tube radius times three
  TubeMesh tube_mesh_;
  std::unique_ptr<Programs> programs_;
  std::unique_ptr<Tubes> tubes_;
  std::unique_ptr<Texture> palette_, colours_;
  std::unique_ptr<Buffers> buffers_;  ///< kept from view to view: new ones cost more than drawing
  std::vector<std::uint8_t> samples_;
};

}  // namespace tendril::render
