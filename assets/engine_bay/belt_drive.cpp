// Accessories on the engine's end, driven by one ribbed belt in the plane x = 1064.
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/parts.h"

namespace tendril::engine_bay {
namespace {

constexpr double belt_plane = 1064, belt_width = 22;

struct Pulley {
  const char* name;
  Vec2 centre;  // y, z
  double radius;
};

const std::array<Pulley, 5> pulleys = {{{"crank_pulley", {510, 160}, 72},
                                        {"water_pump_pulley", {545, 380}, 55},
                                        {"tensioner_pulley", {430, 424}, 34},
                                        {"alternator_pulley", {335, 306}, 30},
                                        {"compressor_pulley", {340, 152}, 50}}};

// Rims, grooves, a dished web and a hub.
Mesh pulley(const Pulley& p, const Detail& detail) {
  const double r = p.radius, w = belt_width / 2;
  std::vector<Vec2> profile{{0, -w - 2}, {r, -w - 2}, {r, -w}};
  const int grooves = 5;
  for (int k = 0; k < grooves; ++k) {
    const double z = -w + belt_width * (k + 0.5) / grooves;
    profile.push_back({r - 5, z});
    profile.push_back({r - 2, z + belt_width * 0.5 / grooves});
  }
  for (const Vec2& corner : {Vec2(r, w), Vec2(r, w + 2), Vec2(0.82 * r, w + 2), Vec2(0.72 * r, w - 8), Vec2(0.36 * r, w - 8),
                             Vec2(0.3 * r, w + 4), Vec2(0, w + 4)})
    profile.push_back(corner);
  Mesh mesh = placed(turned(profile, detail), facing({belt_plane, p.centre.x(), p.centre.y()}, Vec3::UnitX()));
  mesh.append(placed(bolt(0.14 * r + 5, detail), facing({belt_plane + w + 4, p.centre.x(), p.centre.y()}, Vec3::UnitX())));
  return mesh;
}

double cross(const Vec2& a, const Vec2& b, const Vec2& c) { return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x(); }

// The belt lies on the hull of the pulleys' circles.
std::vector<Vec2> hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vec2> out;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = out.size();
    for (const Vec2& p : points) {
      while (out.size() >= start + 2 && cross(out[out.size() - 2], out.back(), p) <= 1e-9) out.pop_back();
      out.push_back(p);
    }
    out.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return out;
}

Mesh belt(const Detail& detail) {
  std::vector<Vec2> points;
  for (const Pulley& p : pulleys)
    for (const Vec2& c : circle(p.radius + 1, detail)) points.push_back(p.centre + c);
  Path line;
  for (const Vec2& p : hull(points)) line.emplace_back(belt_plane, p.x(), p.y());
  line.push_back(line.front());
  line = divided(line, detail);
  line.pop_back();
  return sweep(line, rounded_rectangle(4, belt_width - 2, 1, detail), Ends::joined, detail, Vec3::UnitX());
}

Mesh alternator(const Detail& detail) {
  const Vec3 at(1046, 335, 306);
  Mesh mesh = placed(turned({{0, 0}, {34, 0}, {58, 8}, {63, 14}, {63, 44}, {60, 46}, {60, 66}, {63, 68}, {63, 104}, {54, 116}, {22, 120}, {0, 120}},
                            detail, 3),
                     facing(at, -Vec3::UnitX()));
  for (int k = 0; detail.texture && k < 24; ++k) {  // cooling fins at both bearing shields
    const double a = 2 * units::pi * k / 24;
    const Frame frame = Frame::looking(at, -Vec3::UnitX(), Vec3(0, std::cos(a), std::sin(a)));
    mesh.append(placed(box({40, -1.6, 4}, {66, 1.6, 22}, 1, detail), frame));
    mesh.append(placed(box({36, -1.6, 98}, {65, 1.6, 121}, 1, detail), frame));
  }
  mesh.append(placed(cylinder(7, 16, 1, detail), facing({930, 362, 330}, -Vec3::UnitX())));
  return mesh;
}

Mesh compressor(const Detail& detail) {
  const Vec3 at(1046, 340, 152);
  Mesh mesh = placed(turned({{0, 0}, {48, 0}, {50, 20}, {54, 22}, {54, 36}, {50, 38}, {50, 96}, {54, 98}, {54, 110}, {46, 128}, {0, 130}}, detail, 4),
                     facing(at, -Vec3::UnitX()));
  mesh.append(box({948, 322, 196}, {992, 358, 222}, 5, detail));
  for (const double x : {960.0, 980.0}) mesh.append(moved(cylinder(8, 12, 1, detail), {x, 340, 220}));
  return mesh;
}

}  // namespace

void add_belt_drive(Parts& parts, const Detail& detail) {
  for (const Pulley& p : pulleys) parts.body(p.name, pulley(p, detail));
  parts.body("accessory_belt", belt(detail));
  parts.body("alternator", alternator(detail));
  parts.body("compressor", compressor(detail));
  parts.body("alternator_bracket", together({box({940, 352, 352}, {1030, 402, 372}, 5, detail),
                                             box({960, 384, 270}, {1000, 402, 360}, 5, detail)}));
  parts.body("compressor_bracket", together({box({935, 384, 100}, {1005, 402, 200}, 5, detail),
                                             ribs({940, 370, 110}, {1000, 392, 190}, 0, 3, 8, detail)}));
  parts.body("tensioner", together({placed(cylinder(26, 14, 3, detail), facing({1044, 455, 350}, Vec3::UnitX())),
                                    strap({{1052, 455, 350}, {1052, 430, 424}}, 24, 7, Vec3(0, 0.947, 0.32), detail)}));
}

}  // namespace tendril::engine_bay
