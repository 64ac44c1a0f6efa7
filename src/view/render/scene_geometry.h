// All surfaces of a picture on the drawing side: uploaded once, drawn piece by piece for each view.
#pragma once

#include <vector>

#include "view/prepared_mesh.h"
#include "view/render/cutaway.h"
#include "view/render/gl.h"

namespace tendril::render {

/// One colour and style in the palette texture.
struct Paint {
  Rgb colour;
  float share, strength;
  bool veil;  ///< transparent everywhere; otherwise whole up to the cut
  bool operator==(const Paint&) const = default;
};

/// Surfaces before they are uploaded: made without a context, so that both can go on at once.
struct PreparedScene {
  std::vector<PreparedMesh> meshes;  ///< in the order of the picture's surfaces
  std::vector<SurfaceStyle> styles;
  std::vector<float> paints;   ///< per surface: its index in the palette over 65535
  std::vector<Paint> palette;  ///< at most 4096; further colours share the last
  std::size_t triangles = 0, edges = 0, left_out = 0;
  Eigen::Vector3f low, high;  ///< of all drawn vertices, m, relative to the origin
};

PreparedScene prepare_scene(const Picture& picture, const Vec3& origin, const RunContext& context);

/// Which layer of the page a draw goes to.
enum class Layer { base, veil };

class SceneGeometry {
 public:
  explicit SceneGeometry(PreparedScene&& scene);
  ~SceneGeometry();
  SceneGeometry(const SceneGeometry&) = delete;
  SceneGeometry& operator=(const SceneGeometry&) = delete;

  struct Page {
    const ViewCamera& camera;
    Vec3 origin;
    double nearest, range;  ///< m: the depth buffer's span
    const Cutaway& cut;
  };
  /// Draws the pieces that show on the page and may hold fragments for the layer, nearest first: either
  /// those that the cut runs through (`tested`: the current program tests every fragment) or those that need no test.
  void draw_triangles(const Page& page, Layer layer, bool tested) const;
  void draw_edges(const Page& page, Layer layer, bool tested) const;

  const std::vector<Paint>& palette() const { return palette_; }
  bool empty() const { return pieces_.empty(); }
  const Eigen::Vector3f& low() const { return low_; }
  const Eigen::Vector3f& high() const { return high_; }

 private:
  struct Piece {
    MeshPiece run;
    std::uint32_t first_vertex;
    SurfaceStyle style;
    float paint;
    bool valued;
  };
  void draw(const std::vector<Piece>& pieces, const Page& page, Layer layer, bool tested, GLenum mode) const;

  std::vector<Piece> pieces_, edge_pieces_;
  std::vector<Paint> palette_;
  Eigen::Vector3f low_, high_;
  GLuint array_ = 0, positions_ = 0, normals_ = 0, values_ = 0, indices_ = 0;
};

}  // namespace tendril::render
