// Gearbox beside the engine, shafts to the wheels, mounts and starter.
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/parts.h"

namespace tendril::engine_bay {
namespace {

const Vec3 shaft_axis(0, 660, 170);  // y and z of the wheels' axis

Mesh bell_housing(const Detail& detail) {
  const Vec3 at(560, 500, 235);
  Mesh mesh = placed(turned({{0, 0}, {174, 0}, {174, 14}, {158, 16}, {122, 112}, {0, 112}}, detail, 5), facing(at, -Vec3::UnitX()));
  for (int k = 0; k < 14; ++k) {  // ribs from the flange up the cone
    const double a = 2 * units::pi * k / 14;
    const Frame frame = Frame::looking(at, -Vec3::UnitX(), Vec3(0, std::cos(a), std::sin(a)));
    mesh.append(placed(mapped(box({118, -3.5, 8}, {130, 3.5, 108}, 2, detail),
                              [](const Vec3& p) { return Vec3(p.x() + 36 * (108 - p.z()) / 100, p.y(), p.z()); }),
                       frame));
  }
  return mesh;
}

Mesh gearbox(const Detail& detail) {
  Mesh mesh = box({262, 405, 115}, {455, 595, 300}, 18, detail);
  mesh.append(ribs({280, 412, 296}, {445, 588, 310}, 0, 7, 6, detail));
  mesh.append(ribs({280, 394, 130}, {445, 408, 285}, 0, 7, 6, detail));
  mesh.append(placed(turned({{0, 0}, {60, 0}, {92, 20}, {92, 120}, {60, 140}, {0, 140}}, detail, 12),
                     facing(shaft_axis + Vec3(280, 0, 0), Vec3::UnitX())));
  return mesh;
}

Mesh end_cover(const Detail& detail) {
  return placed(turned({{0, 0}, {84, 0}, {84, 8}, {70, 18}, {30, 20}, {24, 26}, {0, 26}}, detail, 4),
                facing({263, 500, 208}, -Vec3::UnitX()));
}

Mesh shift_tower(const Detail& detail) {
  Mesh mesh = moved(turned({{0, 0}, {34, 0}, {34, 8}, {24, 14}, {20, 40}, {0, 44}}, detail, 4), {330, 550, 300});
  mesh.append(strap({{330, 550, 340}, {330, 590, 340}, {330, 600, 332}}, 18, 5, Vec3::UnitX(), detail));
  return mesh;
}

// The trough that a hose lies in, smooth where it touches: it widens upwards, and its two ends bend down and apart.
Mesh hose_trough(const Frame& frame, const Detail& detail) {
  const Detail smooth{detail.texture ? 3.0 : 14.0, detail.texture ? 9 * units::deg : 30 * units::deg, detail.texture};
  const Path across = rounded_path({{-38, 0, 42}, {-24, 0, 26}, {-17, 0, 0}, {17, 0, 0}, {24, 0, 26}, {38, 0, 42}}, 16, smooth);
  const Mesh straight = sweep(across, rounded_rectangle(3, 84, 1.4, smooth), Ends::capped, smooth, Vec3::UnitY());
  return placed(mapped(straight, [](const Vec3& p) {
                  const double past = std::max(0.0, std::abs(p.y()) - 8), bend = past * past / 110;
                  return Vec3(p.x() * (1 + 0.03 * bend), p.y(), p.z() - bend);
                }),
                frame);
}

// Carries the trough over the gearbox: a pressed bridge.
Mesh hose_bridge(const Detail& detail) {
  Mesh mesh = strap({{408, 430, 309}, {408, 462, 309}, {408, 484, 366}, {408, 526, 366}, {408, 548, 309}, {408, 575, 309}}, 46, 4,
                    Vec3::UnitX(), detail);
  mesh.append(hose_trough(Frame::looking({408, 505, 369}, Vec3::UnitZ(), Vec3(0.95, -0.31, 0)), detail));
  return mesh;
}

Mesh bellows(double from, double to, const Detail& detail) {
  const int waves = 6;
  const double length = std::abs(to - from), wide = 44, narrow = 22;
  std::vector<Vec2> profile{{0, 0}, {wide, 0}};
  for (int k = 0; k < waves; ++k) {
    const double r = wide + (narrow - wide) * (k + 1.0) / waves, z = length * (k + 0.5) / waves;
    profile.push_back({r - 5, z});
    profile.push_back({r, z + length * 0.5 / waves});
  }
  profile.push_back({0, length});
  return placed(turned(profile, detail, 3), facing(shaft_axis + Vec3(from, 0, 0), to > from ? Vec3::UnitX() : Vec3(-1, 0, 0)));
}

Mesh drive_shaft(double from, double to, const Detail& detail) {
  Mesh mesh = placed(cylinder(13, std::abs(to - from), 2, detail),
                     facing(shaft_axis + Vec3(from, 0, 0), to > from ? Vec3::UnitX() : Vec3(-1, 0, 0)));
  const double sign = to > from ? 1 : -1;
  mesh.append(bellows(from + sign * 4, from + sign * 84, detail));
  mesh.append(bellows(to - sign * 4, to - sign * 84, detail));
  return mesh;
}

Mesh starter(const Detail& detail) {
  Mesh mesh = placed(turned({{0, 0}, {40, 0}, {40, 110}, {32, 122}, {0, 124}}, detail, 5), facing({562, 672, 318}, -Vec3::UnitX()));
  mesh.append(placed(turned({{0, 0}, {22, 0}, {22, 78}, {8, 80}, {8, 92}, {0, 92}}, detail, 3), facing({560, 655, 374}, -Vec3::UnitX())));
  mesh.append(box({548, 610, 290}, {560, 690, 390}, 3, detail));
  return mesh;
}

Mesh rubber_mount(const Vec3& at, const Detail& detail) {
  return moved(turned({{0, 0}, {40, 0}, {44, 10}, {36, 24}, {44, 40}, {40, 48}, {12, 50}, {12, 62}, {0, 62}}, detail, 4), at);
}

}  // namespace

void add_transmission(Parts& parts, const Detail& detail) {
  parts.body("bell_housing", bell_housing(detail));
  parts.body("gearbox", gearbox(detail));
  parts.body("gearbox_end_cover", end_cover(detail));
  parts.body("shift_tower", shift_tower(detail));
  parts.body("hose_bridge", hose_bridge(detail));
  parts.body("drive_shaft_right", drive_shaft(282, 120, detail));
  parts.body("drive_shaft_left", drive_shaft(418, 1280, detail));
  parts.body("starter", starter(detail));
  parts.body("mount_right", together({rubber_mount({182, 600, 334}, detail),
                                      strap({{182, 600, 398}, {250, 590, 398}, {285, 585, 304}, {310, 580, 304}}, 44, 7,
                                            Vec3(0.1, 1, 0).normalized(), detail)}));
  parts.body("mount_left", together({rubber_mount({1218, 520, 334}, detail),
                                     strap({{1218, 520, 398}, {1120, 520, 398}, {1090, 520, 500}, {1038, 520, 500}}, 56, 8,
                                           Vec3::UnitY(), detail)}));
  parts.body("mount_lower", together({box({640, 690, 66}, {720, 850, 96}, 10, detail),
                                      placed(cylinder(34, 60, 5, detail), facing({650, 690, 82}, Vec3::UnitX())),
                                      strap({{680, 634, 150}, {680, 680, 150}, {680, 690, 90}}, 50, 8, Vec3::UnitX(), detail)}));
}

}  // namespace tendril::engine_bay
