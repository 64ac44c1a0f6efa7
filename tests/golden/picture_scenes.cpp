#include "picture_scenes.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace tendril::scenes {
namespace {

using units::pi;

/// A cubic Bezier chain would do as well: a smooth curve through the points (Catmull-Rom), evenly in parameter.
std::vector<Vec3> smooth_curve(const std::vector<Vec3>& points, int samples) {
  std::vector<Vec3> curve;
  const int spans = static_cast<int>(points.size()) - 1;
  for (int i = 0; i <= samples; ++i) {
    const double u = static_cast<double>(i) / samples * spans;
    const int k = std::min(static_cast<int>(u), spans - 1);
    const double t = u - k;
    const Vec3 &p1 = points[k], &p2 = points[k + 1];
    const Vec3 p0 = k > 0 ? points[k - 1] : Vec3(2 * p1 - p2), p3 = k + 2 <= spans ? points[k + 2] : Vec3(2 * p2 - p1);
    curve.push_back(0.5 * (2 * p1 + t * (p2 - p0) + t * t * (2 * p0 - 5 * p1 + 4 * p2 - p3) +
                           t * t * t * (3 * p1 - p0 - 3 * p2 + p3)));
  }
  return curve;
}

Frame end_frame(const std::vector<Vec3>& curve, bool start) {
  const std::size_t n = curve.size();
  return start ? Frame::looking(curve[0], curve[1] - curve[0])
               : Frame::looking(curve[n - 1], curve[n - 1] - curve[n - 2]);
}

void add_hose(Picture& picture) {
  PictureTube hose;
  hose.name = "hose";
  hose.radius = 0.011;
  hose.points = smooth_curve({{-0.30, 0.10, 0.34},
                              {-0.17, 0.085, 0.30},
                              {-0.02, 0.06, 0.24},
                              {0.12, 0.04, 0.152},
                              {0.26, 0.0, 0.121},
                              {0.38, -0.06, 0.16},
                              {0.47, -0.10, 0.30},
                              {0.47, -0.12, 0.42}},
                             240);
  for (std::size_t i = 0; i < hose.points.size(); ++i) {
    const double t = static_cast<double>(i) / (hose.points.size() - 1.0);
    hose.values.push_back(3 + 28 * std::pow(std::abs(t - 0.56), 1.2) / std::pow(0.56, 1.2) + 4 * std::sin(9 * t));
  }
  const std::size_t least = std::min_element(hose.values.begin(), hose.values.end()) - hose.values.begin();
  const Vec3 at = hose.points[least];
  picture.labels.push_back({at - Vec3(0, 0, hose.radius), Vec3(at.x(), at.y(), 0.1), "gap 1.2 mm", true});
  picture.holds.push_back({end_frame(hose.points, true), hose.radius, PictureHold::Kind::clamp, "pump outlet"});
  picture.holds.push_back({end_frame(hose.points, false), hose.radius, PictureHold::Kind::clamp, "radiator"});
  picture.tubes.push_back(std::move(hose));

  PictureTube cable;
  cable.name = "cable";
  cable.radius = 0.004;
  cable.colour = {0.85f, 0.45f, 0.10f};
  cable.points = smooth_curve(
      {{-0.30, -0.12, 0.20}, {-0.10, -0.10, 0.13}, {0.10, -0.12, 0.11}, {0.30, -0.16, 0.14}, {0.45, -0.16, 0.25}}, 120);
  picture.tubes.push_back(std::move(cable));

  picture.scale = {ColourMeaning::clearance, "clearance", "mm", std::nullopt, std::nullopt, 8.0, LimitSide::below};
  picture.card.title = "Coolant hose in the engine bay";
  picture.card.rows = {{"length", "1 012.4 mm"},
                       {"smallest bend radius", "84.2 mm"},
                       {"smallest clearance", "1.2 mm (required 8 mm)", true},
                       {"residual", "3.1e-10 N"},
                       {"discretisation error", "0.012 mm"},
                       {"solved in", "0.41 ms"},
                       {"seed", "1"},
                       {"version", "0.1.0"}};
}

Mesh ribbed_block(int ribs) {
  Mesh block;
  block.box({0.0, -0.22, -0.10}, {0.42, 0.22, 0.06});
  for (int i = 0; i < ribs; ++i) {
    const double x = 0.02 + 0.38 * i / std::max(ribs - 1, 1);
    block.box({x - 0.006, -0.20, 0.06}, {x + 0.006, 0.20, 0.10});
  }
  return block;
}

}  // namespace

void Mesh::box(const Vec3& low, const Vec3& high) {
  const std::int32_t base = static_cast<std::int32_t>(vertices.size());
  for (int i = 0; i < 8; ++i)
    vertices.push_back({i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z()});
  static constexpr int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    triangles.push_back({base + q[0], base + q[1], base + q[2]});
    triangles.push_back({base + q[0], base + q[2], base + q[3]});
  }
}

void Mesh::cylinder(const Vec3& from, const Vec3& to, double radius, int sides) {
  const Frame frame = Frame::looking(from, to - from);
  const std::int32_t base = static_cast<std::int32_t>(vertices.size());
  for (const Vec3& centre : {from, to})
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * pi * i / sides;
      vertices.push_back(centre + radius * (std::cos(angle) * frame.d1() + std::sin(angle) * frame.d2()));
    }
  vertices.push_back(from), vertices.push_back(to);
  for (int i = 0; i < sides; ++i) {
    const std::int32_t a = base + i, b = base + (i + 1) % sides, c = a + sides, d = b + sides;
    triangles.push_back({a, b, c}), triangles.push_back({b, d, c});
    triangles.push_back({base + 2 * sides, b, a}), triangles.push_back({base + 2 * sides + 1, c, d});
  }
}

void Mesh::sphere(const Vec3& centre, double radius, int rings) {
  const std::int32_t base = static_cast<std::int32_t>(vertices.size());
  const int sides = 2 * rings;
  for (int k = 1; k < rings; ++k)
    for (int i = 0; i < sides; ++i) {
      const double up = pi * k / rings - 0.5 * pi, around = 2 * pi * i / sides;
      vertices.push_back(centre +
                         radius * Vec3(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up)));
    }
  const std::int32_t south = static_cast<std::int32_t>(vertices.size()), north = south + 1;
  vertices.push_back(centre - radius * Vec3::UnitZ()), vertices.push_back(centre + radius * Vec3::UnitZ());
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    triangles.push_back({south, base + j, base + i});
    triangles.push_back({north, base + (rings - 2) * sides + i, base + (rings - 2) * sides + j});
    for (int k = 0; k + 2 < rings; ++k) {
      const std::int32_t a = base + k * sides + i, b = base + k * sides + j;
      triangles.push_back({a, b, a + sides}), triangles.push_back({b, b + sides, a + sides});
    }
  }
}

void Mesh::perforated_plate(double x, double thickness, double y0, double z0, double pitch, int across, int upward,
                            double radius) {
  constexpr int sides = 32;
  for (int u = 0; u < across; ++u)
    for (int v = 0; v < upward; ++v) {
      const double cy = y0 + (u + 0.5) * pitch, cz = z0 + (v + 0.5) * pitch;
      const std::int32_t base = static_cast<std::int32_t>(vertices.size());
      for (double side : {x, x + thickness})
        for (int i = 0; i < sides; ++i) {
          const double angle = 2 * pi * i / sides, c = std::cos(angle), s = std::sin(angle),
                       square = 0.5 * pitch / std::max(std::abs(c), std::abs(s));
          vertices.push_back({side, cy + radius * c, cz + radius * s});
          vertices.push_back({side, cy + square * c, cz + square * s});
        }
      for (int i = 0; i < sides; ++i) {
        const std::int32_t a = base + 2 * i, b = base + 2 * ((i + 1) % sides), over = 2 * sides;
        triangles.push_back({a, a + 1, b}), triangles.push_back({b, a + 1, b + 1});
        triangles.push_back({a + over, b + over, a + over + 1}),
            triangles.push_back({b + over, b + over + 1, a + over + 1});
        triangles.push_back({a, b, a + over}), triangles.push_back({b, b + over, a + over});
        const Vec3 middle = 0.5 * (vertices[a + 1] + vertices[b + 1]);
        const double far_y = y0 + across * pitch, far_z = z0 + upward * pitch, near = 1e-9;
        const bool border = std::abs(middle.y() - y0) < near || std::abs(middle.y() - far_y) < near ||
                            std::abs(middle.z() - z0) < near || std::abs(middle.z() - far_z) < near;
        if (border)
          triangles.push_back({a + 1, a + 1 + over, b + 1}), triangles.push_back({b + 1, a + 1 + over, b + 1 + over});
      }
    }
}

void Mesh::wavy_sheet(const Vec3& corner, double size, double height, int n) {
  const std::int32_t base = static_cast<std::int32_t>(vertices.size());
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) {
      const double x = size * i / n, y = size * k / n;
      const double folds = std::abs(std::fmod(x / size * 18, 1.0) - 0.5);
      vertices.push_back(
          corner +
          Vec3(x, y, height * (std::sin(13 * x / size) * std::cos(11 * y / size) + 0.3 * std::min(folds * 4, 1.0))));
    }
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const std::int32_t a = base + i * (n + 1) + k, b = a + n + 1;
      triangles.push_back({a, b, a + 1}), triangles.push_back({a + 1, b, b + 1});
    }
}

PictureSurface surface(std::string name, Mesh mesh, SurfaceStyle style) {
  const auto kept = std::make_shared<const Mesh>(std::move(mesh));
  PictureSurface result;
  result.name = std::move(name);
  result.vertices = kept->vertices;
  result.triangles = kept->triangles;
  result.owner = kept;
  result.style = style;
  return result;
}

Picture hose_in_bay() {
  Picture picture;
  Mesh plate, pipes, cover;
  plate.perforated_plate(-0.16, 0.006, -0.28, -0.04, 0.14, 4, 4, 0.045);
  for (int i = 0; i < 4; ++i) pipes.cylinder({0.08 + 0.1 * i, 0.12, 0.06}, {0.08 + 0.1 * i, 0.16, 0.30}, 0.028);
  pipes.cylinder({0.02, 0.17, 0.30}, {0.46, 0.17, 0.30}, 0.035);
  pipes.sphere({0.30, -0.15, 0.10}, 0.05, 32);
  cover.box({-0.10, -0.26, 0.36}, {0.36, 0.20, 0.37});
  cover.box({-0.05, -0.30, 0.00}, {0.34, -0.29, 0.30});
  picture.surfaces.push_back(surface("plate", std::move(plate)));
  picture.surfaces.push_back(surface("block", ribbed_block(9)));
  picture.surfaces.push_back(surface("pipes", std::move(pipes)));
  picture.surfaces.push_back(surface("cover", std::move(cover)));
  picture.surfaces[2].colour = {0.66f, 0.71f, 0.74f};
  add_hose(picture);
  return picture;
}

Picture hose_behind_solid() {
  Picture picture;
  Mesh solid, shell;
  solid.box({0.05, -0.20, -0.08}, {0.25, -0.10, 0.14});
  shell.box({-0.28, -0.08, -0.10}, {-0.10, 0.10, 0.12});
  picture.surfaces.push_back(surface("robot", std::move(solid), SurfaceStyle::solid));
  picture.surfaces.back().colour = {0.93f, 0.62f, 0.22f};
  picture.surfaces.push_back(surface("shell", std::move(shell)));
  PictureTube hose;
  hose.name = "hose";
  hose.radius = 0.012;
  for (int i = 0; i <= 160; ++i) {
    const double x = -0.42 + 0.84 * i / 160.0;
    hose.points.push_back({x, 0.03 * std::sin(6 * x), 0.05 * std::cos(9 * x)});
    hose.values.push_back(-4.05 * std::cos(9 * x) + (i < 20 ? NAN : 0));
  }
  picture.holds.push_back({end_frame(hose.points, true), hose.radius, PictureHold::Kind::clamp, ""});
  picture.arrows.push_back({hose.points.back(), Vec3(0, 0, -1), false, {0.70f, 0.25f, 0.10f}, "12 N"});
  PicturePath path{"plan", {}, {0.15f, 0.15f, 0.15f}, 1.5, true};
  for (int i = 0; i <= 40; ++i) path.points.push_back({-0.42 + 0.021 * i, -0.05, 0.10 + 0.02 * std::sin(0.3 * i)});
  picture.paths.push_back(std::move(path));
  picture.tubes.push_back(std::move(hose));
  picture.scale = {ColourMeaning::diverging, "bending about d1", "1/m", std::nullopt, std::nullopt, std::nullopt,
                   LimitSide::none};
  picture.card.title = "Behind the arm";
  return picture;
}

Picture envelope_of_hose() {
  Picture picture;
  PictureTube hose;
  hose.name = "hose";
  Mesh envelope;
  for (int i = 0; i <= 120; ++i) {
    const double t = i / 120.0;
    hose.points.push_back({0.5 * t, 0.08 * std::sin(3 * t), 0.12 * t * (1 - t) * 4});
    hose.radii.push_back(t < 0.5 ? 0.010 : 0.016);
    hose.values.push_back(8 + 6 * std::sin(5 * t));
  }
  for (int i = 0; i < 120; i += 12) envelope.sphere(hose.points[i + 6], 0.035 + 0.015 * std::sin(pi * i / 120), 20);
  picture.surfaces.push_back(surface("envelope", std::move(envelope), SurfaceStyle::veil));
  picture.surfaces.back().colour = {0.35f, 0.55f, 0.80f};
  picture.surfaces.back().edges = false;
  picture.surfaces.back().share = 0.25;
  picture.holds.push_back({end_frame(hose.points, true), 0.010, PictureHold::Kind::pin, "pin"});
  picture.holds.push_back(
      {Frame::looking(hose.points[60], hose.points[61] - hose.points[59]), 0.016, PictureHold::Kind::guide, "guide"});
  picture.tubes.push_back(std::move(hose));
  picture.scale = {ColourMeaning::magnitude, "curvature", "1/m", 0.0, 16.0, 12.5, LimitSide::above};
  return picture;
}

Picture envelope_by_clearance() {
  Picture picture;
  PictureTube hose;
  hose.name = "hose";
  hose.radius = 0.012;
  for (int i = 0; i <= 100; ++i) {
    const double t = i / 100.0;
    hose.points.push_back({0.6 * t, 0.05 * std::sin(5 * t), 0.16 - 0.32 * t * (1 - t)});
  }
  // Rings about the hose, wider in the middle.
  constexpr int sides = 48;
  Mesh shell;
  for (std::size_t i = 0; i < hose.points.size(); ++i) {
    const double t = static_cast<double>(i) / 100, radius = 0.016 + 0.05 * std::sin(pi * t);
    for (int k = 0; k < sides; ++k)
      shell.vertices.push_back(hose.points[i] + radius * Vec3(0, std::cos(2 * pi * k / sides), std::sin(2 * pi * k / sides)));
  }
  for (std::int32_t i = 0; i + 1 < static_cast<std::int32_t>(hose.points.size()); ++i)
    for (std::int32_t k = 0; k < sides; ++k) {
      const std::int32_t a = sides * i + k, b = sides * i + (k + 1) % sides;
      shell.triangles.push_back({a, b, a + sides});
      shell.triangles.push_back({b, b + sides, a + sides});
    }
  Mesh step;
  step.box({0.0, -0.15, -0.04}, {0.35, 0.15, 0.0});
  step.box({0.35, -0.15, -0.04}, {0.6, 0.15, 0.03});
  PictureSurface envelope = surface("envelope", shell, SurfaceStyle::veil);
  for (const Vec3& v : shell.vertices)
    envelope.values.push_back(v.x() > 0.5 ? NAN : 1e3 * (v.z() - (v.x() > 0.35 ? 0.03 : 0.0)));
  envelope.share = 0.55;
  envelope.edges = false;
  envelope.colour = {0.35f, 0.55f, 0.80f};
  picture.surfaces.push_back(surface("step", std::move(step)));
  picture.surfaces.push_back(std::move(envelope));
  picture.holds.push_back({end_frame(hose.points, true), hose.radius, PictureHold::Kind::clamp, ""});
  picture.tubes.push_back(std::move(hose));
  picture.scale = {ColourMeaning::clearance, "envelope: clearance", "mm", std::nullopt, std::nullopt, 10.0, LimitSide::below};
  return picture;
}

Picture straight_hose() {
  Picture picture;
  PictureTube hose;
  hose.name = "hose";
  hose.radius = 0.02;
  hose.points = {{0, 0, 0}, {0, 0.25, 0}, {0, 0.25, 0}, {0, 1, 0}};
  hose.values = {30, 40, 40, 90};
  picture.tubes.push_back(std::move(hose));
  picture.labels.push_back({{0, 0.25, 0.02}, std::nullopt, "30.0 mm", false});
  picture.scale = {ColourMeaning::clearance, "clearance", "mm", std::nullopt, std::nullopt, 8.0, LimitSide::none};
  picture.card = {"Straight", {{"length", "1000 mm", false}}};
  return picture;
}

Picture hose_over_fine_bay(std::size_t triangles) {
  Picture picture = hose_in_bay();
  Mesh fine;
  const int n = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(triangles) / 4)));
  fine.wavy_sheet({-0.45, -0.45, -0.14}, 1.1, 0.03, n);
  fine.sphere({0.62, 0.2, 0.25}, 0.14, static_cast<int>(std::sqrt(static_cast<double>(triangles) / 8)) + 2);
  fine.wavy_sheet({-0.45, 0.30, 0.40}, 1.1, 0.02, static_cast<int>(n / 2.0) + 1);
  picture.surfaces.push_back(surface("fine", std::move(fine)));
  return picture;
}

}  // namespace tendril::scenes
