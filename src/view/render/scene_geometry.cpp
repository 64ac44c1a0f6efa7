#include "view/render/scene_geometry.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace tendril::render {
namespace {

constexpr std::size_t most_paints = 4096;

float paint_of(const PictureSurface& surface, std::vector<Paint>& palette) {
  const float strength = surface.style == SurfaceStyle::solid ? 1.0f : 0.66f;
  const Paint wanted{surface.colour, static_cast<float>(surface.share), strength, surface.style == SurfaceStyle::veil};
  std::size_t i = 0;
  while (i < palette.size() && !(palette[i] == wanted)) ++i;
  if (i == palette.size() && i < most_paints) palette.push_back(wanted);
  return static_cast<float>(std::min(i, most_paints - 1)) / 65535.0f;
}

/// Depth (share of the buffer) and rectangle (shares of the page) of a box.
struct Shadow {
  double left, right, bottom, top, near, far;
  bool on_page() const { return right >= 0 && left <= 1 && top >= 0 && bottom <= 1; }
};

Shadow shadow_of(const MeshPiece& run, const SceneGeometry::Page& page) {
  const Vec3 middle = 0.5 * (run.low + run.high).cast<double>() + page.origin;
  const Vec3 half = 0.5 * (run.high - run.low).cast<double>();
  const ViewCamera& c = page.camera;
  const Vec3 p = c.project(middle);
  const double dx = half.dot(c.right.cwiseAbs()) / c.metres_per_pixel + 2;
  const double dy = half.dot(c.up.cwiseAbs()) / c.metres_per_pixel + 2;
  const double dz = half.dot(c.back.cwiseAbs()) + 4 * c.metres_per_pixel;
  return {(p.x() - dx) / c.width,
          (p.x() + dx) / c.width,
          1 - (p.y() + dy) / c.height,
          1 - (p.y() - dy) / c.height,
          (page.nearest - p.z() - dz) / page.range,
          (page.nearest - p.z() + dz) / page.range};
}

/// What a piece needs for a layer: nothing, to be drawn whole, or to be tested against the cut.
enum class Need { nothing, whole, tested };

Need need_of(SurfaceStyle style, Layer layer, const Shadow& shadow, const Cutaway& cut) {
  if (style == SurfaceStyle::solid) return layer == Layer::base ? Need::whole : Need::nothing;
  if (style == SurfaceStyle::veil) return layer == Layer::veil ? Need::whole : Need::nothing;
  const Cutaway::Range range = cut.over(shadow.left, shadow.right, shadow.bottom, shadow.top);
  const bool all_behind = shadow.near >= range.most, all_before = shadow.far < range.least;
  if (layer == Layer::base) return all_before ? Need::nothing : all_behind ? Need::whole : Need::tested;
  return all_behind ? Need::nothing : all_before ? Need::whole : Need::tested;
}

template <class T>
std::size_t total(const std::vector<PreparedMesh>& meshes, std::vector<T> PreparedMesh::*part) {
  std::size_t sum = 0;
  for (const PreparedMesh& mesh : meshes) sum += (mesh.*part).size();
  return sum;
}

GLuint new_buffer(GLenum target, std::size_t bytes) {
  GLuint name = 0;
  glGenBuffers(1, &name);
  glBindBuffer(target, name);
  glBufferData(target, static_cast<GLsizeiptr>(bytes), nullptr, GL_STATIC_DRAW);
  return name;
}

template <class T>
std::size_t fill(GLenum target, std::size_t offset, const std::vector<T>& data) {
  if (!data.empty())
    glBufferSubData(target, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size() * sizeof(T)),
                    data.data());
  return offset + data.size() * sizeof(T);
}

}  // namespace

PreparedScene prepare_scene(const Picture& picture, const Vec3& origin, const RunContext& context) {
  PreparedScene scene;
  const std::size_t count = picture.surfaces.size();
  scene.meshes.resize(count);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count && !context.stop(); i = next++)
      scene.meshes[i] = prepare_mesh(picture.surfaces[i], origin);
  };
  const std::size_t cores = context.threads > 0 ? static_cast<std::size_t>(context.threads)
                                                : std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::jthread> helpers;
  for (std::size_t i = 1; i < std::min({cores, count, std::size_t{8}}); ++i) helpers.emplace_back(work);
  work();
  helpers.clear();
  scene.low.setConstant(INFINITY), scene.high.setConstant(-INFINITY);
  for (std::size_t i = 0; i < count; ++i) {
    scene.styles.push_back(picture.surfaces[i].style);
    scene.paints.push_back(paint_of(picture.surfaces[i], scene.palette));
    scene.triangles += scene.meshes[i].triangles.size() / 3;
    scene.edges += scene.meshes[i].edges.size() / 2;
    scene.left_out += scene.meshes[i].left_out;
    for (const MeshPiece& piece : scene.meshes[i].triangle_pieces) {
      scene.low = scene.low.cwiseMin(piece.low);
      scene.high = scene.high.cwiseMax(piece.high);
    }
  }
  if (scene.palette.empty()) scene.palette.push_back({{}, 0.2f, 1, false});
  return scene;
}

SceneGeometry::SceneGeometry(PreparedScene&& scene)
    : palette_(std::move(scene.palette)), low_(scene.low), high_(scene.high) {
  const std::vector<PreparedMesh>& meshes = scene.meshes;
  glGenVertexArrays(1, &array_);
  glBindVertexArray(array_);
  positions_ = new_buffer(GL_ARRAY_BUFFER, total(meshes, &PreparedMesh::positions) * sizeof(Eigen::Vector3f));
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  std::size_t offset = 0;
  for (const PreparedMesh& mesh : meshes) offset = fill(GL_ARRAY_BUFFER, offset, mesh.positions);
  normals_ = new_buffer(GL_ARRAY_BUFFER, total(meshes, &PreparedMesh::normals) * 2 * sizeof(std::int16_t));
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 2, GL_SHORT, GL_TRUE, 0, nullptr);
  offset = 0;
  for (const PreparedMesh& mesh : meshes) offset = fill(GL_ARRAY_BUFFER, offset, mesh.normals);
  if (total(meshes, &PreparedMesh::values) > 0) {
    // Attributes are counted by vertex over all meshes: those without values hold places, too.
    values_ = new_buffer(GL_ARRAY_BUFFER, total(meshes, &PreparedMesh::positions) * sizeof(float));
    glVertexAttribPointer(3, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
    offset = 0;
    for (const PreparedMesh& mesh : meshes) {
      fill(GL_ARRAY_BUFFER, offset, mesh.values);
      offset += mesh.positions.size() * sizeof(float);
    }
  }
  indices_ = new_buffer(
      GL_ELEMENT_ARRAY_BUFFER,
      (total(meshes, &PreparedMesh::triangles) + total(meshes, &PreparedMesh::edges)) * sizeof(std::uint32_t));
  offset = 0;
  std::uint32_t first_vertex = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (int kind = 0; kind < 2; ++kind) {
      const std::uint32_t first = static_cast<std::uint32_t>(offset / sizeof(std::uint32_t));
      for (MeshPiece piece : kind == 0 ? meshes[i].triangle_pieces : meshes[i].edge_pieces) {
        piece.first += first;
        (kind == 0 ? pieces_ : edge_pieces_).push_back({piece, first_vertex, scene.styles[i], scene.paints[i], !meshes[i].values.empty()});
      }
      offset = fill(GL_ELEMENT_ARRAY_BUFFER, offset, kind == 0 ? meshes[i].triangles : meshes[i].edges);
    }
    first_vertex += static_cast<std::uint32_t>(meshes[i].positions.size());
  }
}

SceneGeometry::~SceneGeometry() {
  for (GLuint buffer : {positions_, normals_, values_, indices_}) glDeleteBuffers(1, &buffer);
  glDeleteVertexArrays(1, &array_);
}

void SceneGeometry::draw(const std::vector<Piece>& pieces, const Page& page, Layer layer, bool tested,
                         GLenum mode) const {
  std::vector<std::pair<double, const Piece*>> shown;
  for (const Piece& piece : pieces) {
    const Shadow shadow = shadow_of(piece.run, page);
    if (!shadow.on_page()) continue;
    const Need need = need_of(piece.style, layer, shadow, page.cut);
    if (need == (tested ? Need::tested : Need::whole)) shown.emplace_back(shadow.near, &piece);
  }
  std::stable_sort(shown.begin(), shown.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  glBindVertexArray(array_);
  for (const auto& [depth, piece] : shown) {
    glVertexAttrib1f(2, piece->paint);
    if (piece->valued) glEnableVertexAttribArray(3);
    else glDisableVertexAttribArray(3), glVertexAttrib1f(3, no_value);
    glDrawElementsBaseVertex(mode, static_cast<GLsizei>(piece->run.count), GL_UNSIGNED_INT,
                             reinterpret_cast<const void*>(piece->run.first * sizeof(std::uint32_t)),
                             static_cast<GLint>(piece->first_vertex));
  }
}

void SceneGeometry::draw_triangles(const Page& page, Layer layer, bool tested) const {
  draw(pieces_, page, layer, tested, GL_TRIANGLES);
}

void SceneGeometry::draw_edges(const Page& page, Layer layer, bool tested) const {
  draw(edge_pieces_, page, layer, tested, GL_LINES);
}

}  // namespace tendril::render
