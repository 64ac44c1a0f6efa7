#include "view/render/view_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "view/render/shaders.h"

namespace tendril::render {
namespace {

constexpr int fine = 2;  // samples a pixel in each direction
constexpr int tile_pixels = 1600;
constexpr int tile_margin = 40;  // what ambient occlusion and silhouettes see beyond the tile

using PageMatrix = Eigen::Matrix4f;

/// From positions relative to the origin to clip space.
PageMatrix page_matrix(const SceneGeometry::Page& page) {
  const ViewCamera& c = page.camera;
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  const Vec3 shift = page.origin - c.centre;
  const double sx = 2 / (c.metres_per_pixel * c.width), sy = 2 / (c.metres_per_pixel * c.height), sz = -2 / page.range;
  m.row(0) << sx * c.right.transpose(), sx * c.right.dot(shift);
  m.row(1) << sy * c.up.transpose(), sy * c.up.dot(shift);
  m.row(2) << sz * c.back.transpose(), sz * (c.back.dot(shift) - page.nearest) - 1;
  return m.cast<float>();
}

void set_page(const Program& program, const SceneGeometry::Page& page) {
  const PageMatrix matrix = page_matrix(page);
  Eigen::Matrix3f turn;
  turn << page.camera.right.transpose().cast<float>(), page.camera.up.transpose().cast<float>(),
      page.camera.back.transpose().cast<float>();
  program.use();
  glUniformMatrix4fv(program.at("page"), 1, GL_FALSE, matrix.data());
  glUniformMatrix3fv(program.at("turn"), 1, GL_FALSE, turn.data());
}

}  // namespace

ViewPainter::Look ViewPainter::look_of(const ViewCamera& camera) {
  const double size = std::min(camera.width, camera.height);
  return {std::clamp(0.06 * size, 4.0, tile_margin - 4.0), 0.06 * fine * cut_slope * size};
}

struct ViewPainter::Programs {
  Program whole{shader::surface_vertex, shader::surface_fragment, "#define KEEP_ALL\n"};
  Program behind{shader::surface_vertex, shader::surface_fragment, "#define KEEP_BEHIND\n"};
  Program before{shader::surface_vertex, shader::surface_fragment, "#define KEEP_BEFORE\n"};
  Program edges_whole{shader::surface_vertex, shader::edge_fragment, "#define KEEP_ALL\n"};
  Program edges_behind{shader::surface_vertex, shader::edge_fragment, "#define KEEP_BEHIND\n"};
  Program edges_before{shader::surface_vertex, shader::edge_fragment, "#define KEEP_BEFORE\n"};
  Program tube{shader::tube_vertex, shader::tube_fragment};
  Program nearest{shader::page_vertex, shader::nearest_fragment};
  Program occlusion{shader::page_vertex, shader::occlusion_fragment};
  Program smooth{shader::page_vertex, shader::smooth_fragment};
  Program compose{shader::page_vertex, shader::compose_fragment};
};

/// Targets of one size: w x h pixels, fine * w x fine * h samples.
struct ViewPainter::Buffers {
  Buffers(int w, int h) : width(w), height(h) {}

  int width, height, samples_x = fine * width, samples_y = fine * height;
  Texture base{GL_RGBA16, samples_x, samples_y, GL_RGBA, GL_UNSIGNED_SHORT},
      veil{GL_RGBA16, samples_x, samples_y, GL_RGBA, GL_UNSIGNED_SHORT},
      tube{GL_RGBA16, samples_x, samples_y, GL_RGBA, GL_UNSIGNED_SHORT},
      tube_colour{GL_RGBA8, samples_x, samples_y, GL_RGBA, GL_UNSIGNED_BYTE},
      base_depth{GL_DEPTH_COMPONENT32F, samples_x, samples_y, GL_DEPTH_COMPONENT, GL_FLOAT},
      veil_depth{GL_DEPTH_COMPONENT32F, samples_x, samples_y, GL_DEPTH_COMPONENT, GL_FLOAT},
      tube_depth{GL_DEPTH_COMPONENT32F, samples_x, samples_y, GL_DEPTH_COMPONENT, GL_FLOAT},
      base_edges{GL_R8, samples_x, samples_y, GL_RED, GL_UNSIGNED_BYTE, nullptr, GL_LINEAR_MIPMAP_NEAREST},
      veil_edges{GL_R8, samples_x, samples_y, GL_RED, GL_UNSIGNED_BYTE, nullptr, GL_LINEAR_MIPMAP_NEAREST},
      page{GL_RGBA8, samples_x, samples_y, GL_RGBA, GL_UNSIGNED_BYTE},
      nearest{GL_RGBA32F, width, height, GL_RGBA, GL_FLOAT}, rough{GL_R8, width, height, GL_RED, GL_UNSIGNED_BYTE},
      light{GL_R8, width, height, GL_RED, GL_UNSIGNED_BYTE, nullptr, GL_LINEAR};
  Target to_base{{base.name}, base_depth.name, samples_x, samples_y},
      to_veil{{veil.name}, veil_depth.name, samples_x, samples_y},
      to_base_edges{{base_edges.name}, base_depth.name, samples_x, samples_y},
      to_veil_edges{{veil_edges.name}, veil_depth.name, samples_x, samples_y},
      to_tube{{tube.name, tube_colour.name}, tube_depth.name, samples_x, samples_y},
      to_nearest{{nearest.name}, 0, width, height}, to_rough{{rough.name}, 0, width, height},
      to_light{{light.name}, 0, width, height}, to_page{{page.name}, 0, samples_x, samples_y};
};

/// A tube mesh in buffers of its own.
class ViewPainter::Tubes {
 public:
  explicit Tubes(const TubeMesh& mesh) : count_(static_cast<GLsizei>(mesh.triangles.size())) {
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    glGenBuffers(2, buffers_);
    glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(TubeVertex)),
                 mesh.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(std::uint32_t)),
                 mesh.triangles.data(), GL_STATIC_DRAW);
    const auto attribute = [](GLuint index, GLint size, GLenum type, std::size_t offset) {
      glEnableVertexAttribArray(index);
      glVertexAttribPointer(index, size, type, type == GL_UNSIGNED_BYTE, sizeof(TubeVertex),
                            reinterpret_cast<const void*>(offset));
    };
    attribute(0, 3, GL_FLOAT, offsetof(TubeVertex, position));
    attribute(1, 3, GL_FLOAT, offsetof(TubeVertex, outward));
    attribute(2, 1, GL_FLOAT, offsetof(TubeVertex, radius));
    attribute(3, 1, GL_FLOAT, offsetof(TubeVertex, value));
    attribute(4, 2, GL_FLOAT, offsetof(TubeVertex, along));
    attribute(5, 4, GL_UNSIGNED_BYTE, offsetof(TubeVertex, colour));
  }
  ~Tubes() {
    glDeleteBuffers(2, buffers_);
    glDeleteVertexArrays(1, &array_);
  }
  Tubes(const Tubes&) = delete;
  Tubes& operator=(const Tubes&) = delete;

  void draw() const {
    if (count_ == 0) return;
    glBindVertexArray(array_);
    glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
  }

 private:
  GLsizei count_;
  GLuint array_ = 0, buffers_[2] = {0, 0};
};

/// What is drawn at a size on the page: holds and arrows, which get an outline, and paths, which do not.
struct ViewPainter::Marks {
  Tubes solids, lines;
};

ViewPainter::ViewPainter(const Picture& picture, const SceneGeometry& surroundings, const Vec3& origin)
    : picture_(picture),
      surroundings_(surroundings),
      origin_(origin),
      range_(settled_range(picture)),
      programs_(std::make_unique<Programs>()) {
  for (const PictureTube& tube : picture.tubes) {
    add_tube(tube, origin, tube_mesh_);
    const double radius = tube.radii.empty() ? tube.radius : *std::max_element(tube.radii.begin(), tube.radii.end());
    stripe_ = std::max(stripe_, 3 * radius);
  }
  tubes_ = std::make_unique<Tubes>(tube_mesh_);

  std::vector<float> paints(surroundings.palette().size() * 8);
  const std::size_t count = surroundings.palette().size();
  for (std::size_t i = 0; i < count; ++i) {
    const Paint& paint = surroundings.palette()[i];
    const float colour[4] = {paint.colour.r, paint.colour.g, paint.colour.b, paint.share};
    std::copy_n(colour, 4, &paints[4 * i]);
    paints[4 * (count + i)] = paint.strength;
    paints[4 * (count + i) + 1] = paint.veil ? 1.0f : 0.0f;
  }
  palette_ = std::make_unique<Texture>(GL_RGBA32F, static_cast<int>(count), 2, GL_RGBA, GL_FLOAT, paints.data());

  ColourRange unbroken = range_;
  unbroken.broken = LimitSide::none;
  constexpr int steps = 1024;
  std::vector<float> colours;
  for (int i = 0; i < steps; ++i) {
    const Rgb c = unbroken.colour(range_.low + (range_.high - range_.low) * (i + 0.5) / steps);
    colours.insert(colours.end(), {c.r, c.g, c.b});
  }
  colours_ = std::make_unique<Texture>(GL_RGB32F, steps, 1, GL_RGB, GL_FLOAT, colours.data(), GL_LINEAR);
}

ViewPainter::~ViewPainter() = default;

ViewPainter::Span ViewPainter::depth_span(const ViewCamera& camera, const std::vector<const TubeMesh*>& meshes) const {
  double low = INFINITY, high = -INFINITY;
  const auto see = [&](const Eigen::Vector3f& point) {
    const double z = camera.project(point.cast<double>() + origin_).z();
    low = std::min(low, z), high = std::max(high, z);
  };
  if (!surroundings_.empty())
    for (int i = 0; i < 8; ++i) {
      const auto pick = [&](int axis) { return (i >> axis & 1 ? surroundings_.high() : surroundings_.low())[axis]; };
      see({pick(0), pick(1), pick(2)});
    }
  for (const TubeMesh* mesh : meshes)
    for (const TubeVertex& vertex : mesh->vertices) see(vertex.position);
  if (low > high) low = high = 0;
  const double spare = 0.01 * (high - low) + 8 * camera.metres_per_pixel;
  return {high + spare, high - low + 2 * spare};
}

void ViewPainter::set_range(const Program& program) const {
  program.set("range", static_cast<float>(range_.low), static_cast<float>(range_.high));
  const float side = !range_.limit || range_.broken == LimitSide::none ? 0.0f
                     : range_.broken == LimitSide::below               ? -1.0f
                                                                       : 1.0f;
  program.set("limit", static_cast<float>(range_.limit.value_or(0)), side);
}

void ViewPainter::draw_surroundings(const SceneGeometry::Page& page, GLuint cut, const Buffers& buffers) const {
  const auto begin = [&](const Program& program, double nearer) {
    set_page(program, page);
    program.texture("cut", 0, cut);
    program.set("per_pixel", 1.0f / static_cast<float>(buffers.samples_x),
                1.0f / static_cast<float>(buffers.samples_y));
    program.set("nearer", static_cast<float>(nearer));
    set_range(program);
  };
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glClearColor(0, 0, 0, 0);
  for (Layer layer : {Layer::base, Layer::veil}) {
    (layer == Layer::base ? buffers.to_base : buffers.to_veil).bind();
    glDepthMask(GL_TRUE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);  // so that edges win over the faces they border
    begin(programs_->whole, 0);
    surroundings_.draw_triangles(page, layer, false);
    begin(layer == Layer::base ? programs_->behind : programs_->before, 0);
    surroundings_.draw_triangles(page, layer, true);
    glDisable(GL_POLYGON_OFFSET_FILL);

    (layer == Layer::base ? buffers.to_base_edges : buffers.to_veil_edges).bind();
    glDepthMask(GL_FALSE);
    glClear(GL_COLOR_BUFFER_BIT);
    glLineWidth(fine);
    const double nearer = 2 * 0.5 * page.camera.metres_per_pixel / page.range;
    begin(programs_->edges_whole, nearer);
    surroundings_.draw_edges(page, layer, false);
    begin(layer == Layer::base ? programs_->edges_behind : programs_->edges_before, nearer);
    surroundings_.draw_edges(page, layer, true);
    glDepthMask(GL_TRUE);
    glBindTexture(GL_TEXTURE_2D, (layer == Layer::base ? buffers.base_edges : buffers.veil_edges).name);
    glGenerateMipmap(GL_TEXTURE_2D);  // coarse levels tell how edges crowd
  }
}

void ViewPainter::draw_tubes(const SceneGeometry::Page& page, const Marks& marks, const Buffers& buffers) const {
  buffers.to_tube.bind();
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const double pixel = page.camera.metres_per_pixel;
  const Program& program = programs_->tube;
  set_page(program, page);
  program.texture("colours", 0, colours_->name);
  set_range(program);
  program.set("stripe", static_cast<float>(std::max(stripe_, 12 * pixel)));
  program.set("broken", broken_colour.r, broken_colour.g, broken_colour.b);
  program.set("broken_stripe", broken_stripe.r, broken_stripe.g, broken_stripe.b);
  program.set("least_radius", static_cast<float>(0.9 * pixel));
  // Outlines are blown-up hulls seen from inside: they lie behind the tube and before what is behind it.
  struct Hull {
    double pixels;
    Rgb colour;
    float opacity;
  };
  constexpr double halo = 2.4, outline = 1.1;
  for (const Hull& hull :
       {Hull{halo, {0.99f, 0.99f, 0.985f}, 1}, Hull{outline, {0.13f, 0.14f, 0.17f}, 1}, Hull{0, {}, 0}}) {
    if (hull.pixels > 0) glEnable(GL_CULL_FACE), glCullFace(GL_FRONT);
    else glDisable(GL_CULL_FACE);
    program.set("blow_up", static_cast<float>(hull.pixels * pixel));
    glUniform4f(program.at("flat_colour"), hull.colour.r, hull.colour.g, hull.colour.b, hull.opacity);
    tubes_->draw();
    marks.solids.draw();
    if (hull.pixels != outline) marks.lines.draw();
  }
  glDisable(GL_CULL_FACE);
}

void ViewPainter::compose(const SceneGeometry::Page& page, const Look& look, GLuint cut, const Buffers& b) const {
  glDisable(GL_DEPTH_TEST);
  const float pixels = static_cast<float>(page.range / page.camera.metres_per_pixel);
  const auto radius = static_cast<float>(look.occlusion);

  b.to_nearest.bind();
  const Program& nearest = programs_->nearest;
  nearest.use();
  nearest.texture("base", 0, b.base.name), nearest.texture("base_depth", 1, b.base_depth.name);
  nearest.texture("tube", 2, b.tube.name), nearest.texture("tube_depth", 3, b.tube_depth.name);
  nearest.set("depth_pixels", pixels);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  b.to_rough.bind();
  const Program& occlusion = programs_->occlusion;
  occlusion.use();
  occlusion.texture("nearest", 0, b.nearest.name);
  occlusion.set("radius", radius);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  b.to_light.bind();
  const Program& smooth = programs_->smooth;
  smooth.use();
  smooth.texture("nearest", 0, b.nearest.name), smooth.texture("rough", 1, b.rough.name);
  smooth.set("radius", radius);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  b.to_page.bind();
  const Program& all = programs_->compose;
  all.use();
  const std::pair<const char*, GLuint> inputs[] = {
      {"base", b.base.name},   {"base_depth", b.base_depth.name},   {"base_edges", b.base_edges.name},
      {"veil", b.veil.name},   {"veil_depth", b.veil_depth.name},   {"veil_edges", b.veil_edges.name},
      {"tube", b.tube.name},   {"tube_colour", b.tube_colour.name}, {"tube_depth", b.tube_depth.name},
      {"light", b.light.name}, {"palette", palette_->name},         {"cut", cut},
      {"colours", colours_->name}};
  int unit = 0;
  for (const auto& [name, texture] : inputs) all.texture(name, unit++, texture);
  all.set("broken", broken_colour.r, broken_colour.g, broken_colour.b);
  all.set("broken_stripe", broken_stripe.r, broken_stripe.g, broken_stripe.b);
  all.set("depth_pixels", pixels * fine);
  all.set("fade", static_cast<float>(look.fade));
  all.set("paper", paper.r, paper.g, paper.b);
  all.set("ink", ink.r, ink.g, ink.b);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ViewPainter::paint_tile(const ViewCamera& camera, const Span& span, const Look& look, const Marks& marks,
                             const Buffers& buffers) const {
  const Cutaway cut = cutaway_of(picture_.tubes, camera, span.nearest, span.range);
  const SceneGeometry::Page page{camera, origin_, span.nearest, span.range, cut};
  const Texture cut_depth(GL_R32F, cut.columns, cut.rows, GL_RED, GL_FLOAT, cut.depth.data(), GL_LINEAR);
  draw_surroundings(page, cut_depth.name, buffers);
  draw_tubes(page, marks, buffers);
  compose(page, look, cut_depth.name, buffers);
}

namespace {

/// Averages fine x fine samples a pixel; samples come bottom row first.
void average_into(const std::vector<std::uint8_t>& samples, int samples_x, int samples_y, int skip_x, int skip_y,
                  int x0, int y0, int width, int height, Image& image) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      int sum[4] = {0, 0, 0, 0};
      for (int v = 0; v < fine; ++v)
        for (int u = 0; u < fine; ++u) {
          const int row = samples_y - 1 - (fine * (y + skip_y) + v), column = fine * (x + skip_x) + u;
          const std::uint8_t* sample = &samples[(static_cast<std::size_t>(row) * samples_x + column) * 4];
          for (int k = 0; k < 4; ++k) sum[k] += sample[k];
        }
      std::uint8_t* pixel = image.at(x0 + x, y0 + y);
      for (int k = 0; k < 4; ++k) pixel[k] = static_cast<std::uint8_t>((sum[k] + fine * fine / 2) / (fine * fine));
    }
}

}  // namespace

Image ViewPainter::paint(const ViewCamera& camera, const RunContext& context) {
  const int width = static_cast<int>(camera.width), height = static_cast<int>(camera.height);
  Image image(width, height);
  TubeMesh solids, lines;
  for (const PictureHold& hold : picture_.holds) add_hold(hold, camera, origin_, solids);
  for (const PictureArrow& arrow : picture_.arrows) add_arrow(arrow, camera, origin_, solids);
  for (const PicturePath& path : picture_.paths)
    if (path.points.size() >= 2) add_path(path, camera, origin_, lines);
  const Span span = depth_span(camera, {&tube_mesh_, &solids, &lines});
  const Look look = look_of(camera);
  const Marks marks{Tubes(solids), Tubes(lines)};
  for (int y0 = 0; y0 < height; y0 += tile_pixels)
    for (int x0 = 0; x0 < width; x0 += tile_pixels) {
      if (context.stop()) return image;
      const int w = std::min(tile_pixels, width - x0), h = std::min(tile_pixels, height - y0);
      const bool alone = width <= tile_pixels && height <= tile_pixels;
      const int margin = alone ? 0 : tile_margin;
      ViewCamera tile = camera;
      tile.width = w + 2 * margin, tile.height = h + 2 * margin;
      tile.centre += camera.metres_per_pixel *
                     ((x0 + 0.5 * w - 0.5 * width) * camera.right + (0.5 * height - y0 - 0.5 * h) * camera.up);
      if (!buffers_ || buffers_->width != w + 2 * margin || buffers_->height != h + 2 * margin) {
        buffers_.reset();
        buffers_ = std::make_unique<Buffers>(w + 2 * margin, h + 2 * margin);
      }
      paint_tile(tile, span, look, marks, *buffers_);
      samples_.resize(static_cast<std::size_t>(buffers_->samples_x) * buffers_->samples_y * 4);
      buffers_->to_page.bind();
      glPixelStorei(GL_PACK_ALIGNMENT, 1);
      glReadPixels(0, 0, buffers_->samples_x, buffers_->samples_y, GL_RGBA, GL_UNSIGNED_BYTE, samples_.data());
      average_into(samples_, buffers_->samples_x, buffers_->samples_y, margin, margin, x0, y0, w, h, image);
    }
  return image;
}

}  // namespace tendril::render
