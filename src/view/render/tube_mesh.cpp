#include "view/render/tube_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace tendril::render {
namespace {

constexpr int cap_rings = 8;

std::array<std::uint8_t, 4> packed(const Rgb& colour, bool own) {
  const auto byte = [](float x) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0f, 1.0f))); };
  return {byte(colour.r), byte(colour.g), byte(colour.b), static_cast<std::uint8_t>(own ? 255 : 0)};
}

/// One ring of a tube: a centre, the radius, how far the normals lean along the axis.
struct Ring {
  Vec3 centre;
  Frame frame;          ///< d3 along the axis
  double radius, lean;  ///< lean: the normal's part along d3
  float tube_radius, value, along;
  std::array<std::uint8_t, 4> colour;
};

void add_ring(const Ring& ring, const Vec3& origin, int sides, bool join, TubeMesh& mesh) {
  const std::uint32_t first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Vec3 d1 = ring.frame.d1(), d2 = ring.frame.d2(), d3 = ring.frame.d3();
  const double level = std::sqrt(std::max(0.0, 1 - ring.lean * ring.lean));
  for (int i = 0; i <= sides; ++i) {
    const double angle = 2 * units::pi * i / sides;
    const Vec3 spoke = std::cos(angle) * d1 + std::sin(angle) * d2;
    TubeVertex vertex;
    vertex.position = (ring.centre + ring.radius * spoke - origin).cast<float>();
    vertex.outward = (level * spoke + ring.lean * d3).cast<float>();
    vertex.radius = ring.tube_radius;
    vertex.value = ring.value;
    vertex.along = ring.along;
    vertex.around = static_cast<float>(i) / static_cast<float>(sides);
    vertex.colour = ring.colour;
    mesh.vertices.push_back(vertex);
  }
  if (!join) return;
  const std::uint32_t stride = static_cast<std::uint32_t>(sides) + 1, before = first - stride;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i)
    mesh.triangles.insert(mesh.triangles.end(),
                          {before + i, before + i + 1, first + i, before + i + 1, first + i + 1, first + i});
}

/// The points that make rings: no two equal, no more than wanted.
std::vector<std::size_t> ring_points(const PictureTube& tube, int most) {
  std::vector<std::size_t> kept;
  const std::size_t stride = std::max<std::size_t>(1, (tube.points.size() + most - 1) / most);
  for (std::size_t i = 0; i < tube.points.size(); i += stride)
    if (kept.empty() || (tube.points[i] - tube.points[kept.back()]).norm() > 1e-12) kept.push_back(i);
  const std::size_t last = tube.points.size() - 1;
  if (kept.back() != last && (tube.points[last] - tube.points[kept.back()]).norm() > 1e-12) kept.push_back(last);
  return kept;
}

std::vector<Frame> ring_frames(const PictureTube& tube, const std::vector<std::size_t>& kept) {
  std::vector<Frame> frames(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Vec3& before = tube.points[kept[i > 0 ? i - 1 : 0]];
    const Vec3& after = tube.points[kept[std::min(i + 1, kept.size() - 1)]];
    const Vec3& here = tube.points[kept[i]];
    Vec3 along = (after - here).norm() > 0 && (here - before).norm() > 0
                     ? Vec3((after - here).normalized() + (here - before).normalized())
                     : Vec3(after - before);
    if (along.norm() < 1e-9) along = kept.size() > 1 && i > 0 ? frames[i - 1].d3() : Vec3::UnitZ();
    if (i == 0) frames[i] = Frame::looking(here, along);
    else frames[i] = {here, shortest_turn(frames[i - 1].d3(), along.normalized()) * frames[i - 1].rotation};
  }
  return frames;
}

/// A body of revolution about the frame's d3 from a profile of (radius, height) points; every profile side is shaded
/// flat.
void add_turned(const Frame& frame, const std::vector<std::array<double, 2>>& profile, const Rgb& colour,
                const Vec3& origin, TubeMesh& mesh, int sides = 28) {
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto [r0, z0] = profile[i];
    const auto [r1, z1] = profile[i + 1];
    const double length = std::hypot(r1 - r0, z1 - z0);
    if (length == 0) continue;
    const double lean = -(r1 - r0) / length;
    Ring ring{frame.at + z0 * frame.d3(), frame, r0, lean, 0, 0, 0, packed(colour, true)};
    add_ring(ring, origin, sides, false, mesh);
    ring.centre = frame.at + z1 * frame.d3(), ring.radius = r1;
    add_ring(ring, origin, sides, true, mesh);
  }
}

}  // namespace

void add_tube(const PictureTube& tube, const Vec3& origin, TubeMesh& mesh, int sides, int most_rings) {
  const std::vector<std::size_t> kept = ring_points(tube, most_rings);
  const std::vector<Frame> frames = ring_frames(tube, kept);
  std::vector<Ring> rings;
  double along = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::size_t k = kept[i];
    if (i > 0) along += (frames[i].at - frames[i - 1].at).norm();
    const double radius = tube.radii.empty() ? tube.radius : tube.radii[k];
    const double value = tube.values.empty() ? 0 : tube.values[k];
    const bool unknown = !std::isfinite(value);
    const Rgb colour = unknown ? Rgb{0.62f, 0.62f, 0.62f} : tube.colour;
    rings.push_back({frames[i].at, frames[i], radius, 0, static_cast<float>(radius),
                     unknown ? 0.0f : static_cast<float>(value), static_cast<float>(along),
                     packed(colour, unknown || tube.values.empty())});
  }
  const auto cap = [&](Ring ring, double sign, int k) {
    const double angle = 0.5 * units::pi * k / cap_rings;
    ring.centre += sign * ring.radius * std::sin(angle) * ring.frame.d3();
    ring.radius *= std::cos(angle);
    ring.lean = sign * std::sin(angle);
    return ring;
  };
  for (int k = cap_rings; k > 0; --k) add_ring(cap(rings.front(), -1, k), origin, sides, k < cap_rings, mesh);
  for (const Ring& ring : rings) add_ring(ring, origin, sides, true, mesh);
  for (int k = 1; k <= cap_rings; ++k) add_ring(cap(rings.back(), 1, k), origin, sides, true, mesh);
}

void add_hold(const PictureHold& hold, const ViewCamera& camera, const Vec3& origin, TubeMesh& mesh) {
  const double r = std::max(hold.radius, 4 * camera.metres_per_pixel);
  const Rgb steel{0.27f, 0.30f, 0.35f};
  if (hold.kind == PictureHold::Kind::pin) {
    std::vector<std::array<double, 2>> ball;
    for (int i = 0; i <= 12; ++i) {
      const double angle = units::pi * (i / 12.0 - 0.5);
      ball.push_back({1.6 * r * std::cos(angle), 1.6 * r * std::sin(angle)});
    }
    add_turned(hold.frame, ball, steel, origin, mesh);
    return;
  }
  const double half = hold.kind == PictureHold::Kind::clamp ? 0.9 * r : 0.35 * r;
  const double bevel = 0.15 * r, outer = 1.5 * r, inner = 0.98 * r;
  add_turned(hold.frame,
             {{inner, -half},
              {outer - bevel, -half},
              {outer, bevel - half},
              {outer, half - bevel},
              {outer - bevel, half},
              {inner, half}},
             steel, origin, mesh);
}

std::array<Vec3, 2> arrow_ends(const PictureArrow& arrow, const ViewCamera& camera) {
  const double length = std::min(camera.width, camera.height) * camera.metres_per_pixel / 12;
  const Vec3 way = length * arrow.direction.normalized();
  return arrow.pushes ? std::array<Vec3, 2>{arrow.at - way, arrow.at} : std::array<Vec3, 2>{arrow.at, arrow.at + way};
}

void add_arrow(const PictureArrow& arrow, const ViewCamera& camera, const Vec3& origin, TubeMesh& mesh) {
  const auto [tail, tip] = arrow_ends(arrow, camera);
  const double length = (tip - tail).norm(), shaft = 0.035 * length, head = 0.11 * length, neck = 0.66 * length;
  add_turned(Frame::looking(tail, arrow.direction.normalized()),
             {{0, 0}, {shaft, 0}, {shaft, neck}, {head, neck}, {0, length}}, arrow.colour, origin, mesh);
}

void add_path(const PicturePath& path, const ViewCamera& camera, const Vec3& origin, TubeMesh& mesh) {
  PictureTube line;
  line.radius = 0.5 * path.width * camera.metres_per_pixel;
  line.colour = path.colour;
  const auto flush = [&] {
    if (line.points.size() >= 2) add_tube(line, origin, mesh, 8, 3000);
    line.points.clear();
  };
  const double on = 9 * camera.metres_per_pixel, off = 6 * camera.metres_per_pixel;
  if (!path.dashed) {
    line.points = path.points;
    return flush();
  }
  double left = on, whole = 0;
  bool drawing = true;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) whole += (path.points[i + 1] - path.points[i]).norm();
  if (!(whole > 0) || whole / (on + off) > 20000) return;
  line.points = {path.points.front()};
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const Vec3 step = path.points[i + 1] - path.points[i];
    const double length = step.norm();
    double done = 0;
    while (length - done > left) {
      done += left;
      const Vec3 at = path.points[i] + done / length * step;
      if (drawing) line.points.push_back(at), flush();
      else line.points = {at};
      drawing = !drawing;
      left = drawing ? on : off;
    }
    left -= length - done;
    if (drawing) line.points.push_back(path.points[i + 1]);
  }
  if (drawing) flush();
}

}  // namespace tendril::render
