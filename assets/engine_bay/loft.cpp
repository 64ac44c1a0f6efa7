#include "engine_bay/loft.h"

namespace tendril::engine_bay {
namespace {

Vec3 centre_of(const Loop& loop) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : loop) sum += p;
  return sum / static_cast<double>(loop.size());
}

double radius_of(const Loop& loop, const Vec3& centre) {
  double r = 0;
  for (const Vec3& p : loop) r = std::max(r, (p - centre).norm());
  return r;
}

// Closes a hole with rings shrunk towards the centre and a fan in the middle.
void close(Mesh& mesh, std::uint32_t rim, const Loop& loop, bool at_start, const Detail& detail) {
  const auto n = static_cast<std::uint32_t>(loop.size());
  const Vec3 centre = centre_of(loop);
  const int rings = std::min(detail.steps(radius_of(loop, centre)), 12);
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (at_start)
      mesh.triangles.push_back({a, c, b});
    else
      mesh.triangles.push_back({a, b, c});
  };
  for (int k = 1; k < rings; ++k) {
    const auto next = static_cast<std::uint32_t>(mesh.points.size());
    for (const Vec3& p : loop) mesh.points.push_back(centre + (p - centre) * (1 - double(k) / rings));
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t j1 = (j + 1) % n;
      triangle(rim + j, rim + j1, next + j1);
      triangle(rim + j, next + j1, next + j);
    }
    rim = next;
  }
  const auto tip = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(centre);
  for (std::uint32_t j = 0; j < n; ++j) triangle(rim + j, rim + (j + 1) % n, tip);
}

Vec3 tangent(const Path& path, std::size_t i, bool joined) {
  const std::size_t n = path.size();
  const std::size_t before = i > 0 ? i - 1 : (joined ? n - 1 : 0);
  const std::size_t after = i + 1 < n ? i + 1 : (joined ? 0 : n - 1);
  const Vec3 in = path[i] - path[before], out = path[after] - path[i];
  // The bisector, so that a mitre keeps the section's plane between the two pieces.
  return ((in.norm() > 0 ? in.normalized() : in) + (out.norm() > 0 ? out.normalized() : out)).normalized();
}

}  // namespace

Mesh loft(const std::vector<Loop>& loops, Ends ends, const Detail& detail) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(loops.front().size());
  for (const Loop& loop : loops) mesh.points.insert(mesh.points.end(), loop.begin(), loop.end());
  const std::size_t bands = loops.size() - (ends == Ends::joined ? 0 : 1);
  for (std::size_t i = 0; i < bands; ++i) {
    const auto low = static_cast<std::uint32_t>(i * n);
    const auto high = static_cast<std::uint32_t>((i + 1) % loops.size() * n);
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t j1 = (j + 1) % n;
      mesh.triangles.push_back({low + j, low + j1, high + j1});
      mesh.triangles.push_back({low + j, high + j1, high + j});
    }
  }
  if (ends == Ends::capped) {
    close(mesh, 0, loops.front(), true, detail);
    close(mesh, static_cast<std::uint32_t>((loops.size() - 1) * n), loops.back(), false, detail);
  }
  return mesh;
}

Section circle(double radius, const Detail& detail) {
  const int n = detail.around(radius);
  Section out;
  for (int k = 0; k < n; ++k)
    out.emplace_back(radius * std::cos(2 * units::pi * k / n), radius * std::sin(2 * units::pi * k / n));
  return out;
}

Section rounded_rectangle(double width, double height, double radius, const Detail& detail) {
  const double w = width / 2, h = height / 2;
  Path corners = {{0, -h, 0}, {w, -h, 0}, {w, h, 0}, {-w, h, 0}, {-w, -h, 0}, {0, -h, 0}};
  Path path = rounded_path(corners, detail.fillet(radius), detail);
  Section out;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) out.emplace_back(path[i].x(), path[i].y());
  return out;
}

Mesh sweep(const Path& path, const Section& section, Ends ends, const Detail& detail, const Vec3& up, const Scale& scale) {
  const std::vector<double> s = arc_lengths(path);
  std::vector<Loop> loops;
  Vec3 carried = up;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3 t = tangent(path, i, ends == Ends::joined);
    if (i == 0 && up.isZero()) carried = Frame::looking(Vec3::Zero(), t).d1();
    carried = ((up.isZero() ? carried : up) - t * t.dot(up.isZero() ? carried : up)).normalized();
    const Vec3 side = carried.cross(t);  // x of the section; side x carried = t
    const double k = scale ? scale(s[i], s.back()) : 1;
    Loop loop;
    for (const Vec2& p : section) loop.push_back(path[i] + k * (p.x() * side + p.y() * carried));
    loops.push_back(std::move(loop));
  }
  return loft(loops, ends, detail);
}

Mesh round_bar(const Path& path, double radius, const Detail& detail) {
  return sweep(path, circle(radius, detail), Ends::capped, detail);
}

Mesh pipe(const Path& path, double outer_radius, double inner_radius, const Detail& detail) {
  const Section section = circle(outer_radius, detail);
  Mesh mesh = sweep(path, section, Ends::open, detail);
  Mesh bore = sweep(path, section, Ends::open, detail, Vec3::Zero(),
                    [=](double, double) { return inner_radius / outer_radius; });
  for (auto& t : bore.triangles) std::swap(t[1], t[2]);
  const auto n = static_cast<std::uint32_t>(section.size());
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  const std::uint32_t last_loop = first - n;
  mesh.append(bore);
  for (std::uint32_t j = 0; j < n; ++j) {  // the two rims
    const std::uint32_t j1 = (j + 1) % n;
    mesh.triangles.push_back({j, first + j1, j1});
    mesh.triangles.push_back({j, first + j, first + j1});
    mesh.triangles.push_back({last_loop + j, last_loop + j1, first + last_loop + j1});
    mesh.triangles.push_back({last_loop + j, first + last_loop + j1, first + last_loop + j});
  }
  return mesh;
}

Mesh corrugated(const Path& path, double radius, double depth, double pitch, const Detail& detail) {
  if (!detail.texture) return round_bar(path, radius, detail);
  const Detail along = detail.with_edge(pitch / 8);
  return sweep(divided(path, along), circle(radius, detail), Ends::capped, detail.with_edge(radius / 3), Vec3::Zero(),
               [=](double s, double total) {
                 const double cuff = std::min({s, total - s, 2 * pitch}) / (2 * pitch);  // waves fade in at the ends
                 const double wave = 0.5 - 0.5 * std::cos(2 * units::pi * s / pitch);
                 return 1 - cuff * depth / radius * wave;
               });
}

Mesh turned(const std::vector<Vec2>& profile, const Detail& detail, double fillet) {
  Path corners;
  for (const Vec2& p : profile) corners.emplace_back(p.x(), 0, p.y());
  Path line = rounded_path(corners, detail.fillet(fillet), detail);
  const bool ring = (line.front() - line.back()).norm() < 1e-9;
  const bool body = line.front().x() < 1e-9 && line.back().x() < 1e-9;
  const Vec3 bottom = line.front(), top = line.back();
  if (ring || body) line.pop_back();
  if (body) line.erase(line.begin());

  double largest = 0;
  for (const Vec3& p : line) largest = std::max(largest, p.x());
  const Section unit = circle(largest, detail);
  std::vector<Loop> loops;
  for (const Vec3& p : line) {
    Loop loop;
    for (const Vec2& c : unit) loop.emplace_back(c.x() / largest * p.x(), c.y() / largest * p.x(), p.z());
    loops.push_back(std::move(loop));
  }
  // The profile itself brings the rings of a body's ends: one fan each is left.
  Mesh mesh = loft(loops, ring ? Ends::joined : body ? Ends::capped : Ends::open, detail.with_edge(1e9));
  if (body) {
    mesh.points[mesh.points.size() - 2] = bottom;
    mesh.points[mesh.points.size() - 1] = top;
  }
  return mesh;
}

Mesh cylinder(double radius, double height, double fillet, const Detail& detail) {
  return turned({{0, 0}, {radius, 0}, {radius, height}, {0, height}}, detail, fillet);
}

}  // namespace tendril::engine_bay
