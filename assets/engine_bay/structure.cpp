// Sheet metal of the body: thin open sheets, and the closed rails and crossmembers that carry them.
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/parts.h"
#include "engine_bay/sheet.h"

namespace tendril::engine_bay {
namespace {

// u along x from 20, v along z from 50; the sheet stands near y = 880.
Mesh firewall(const Detail& detail) {
  std::vector<Hole> holes = {{{1020, 180}, 38}, {{1110, 430}, 42}, {{280, 510}, 26}, {{780, 280}, 20},
                             {{350, 120}, 18},  {{880, 90}, 18},   {{580, 480}, 16}, {{780, 520}, 14}};
  for (const char* name : {"heater_inlet", "heater_return"}) {
    const Connection& c = connection(name);
    holes.push_back({{c.tip.x() - 20, c.tip.z() - 50}, 15});
  }
  if (detail.texture)
    for (const Hole& h : hole_field({80, 20}, {1280, 60}, 12, 1, 8)) holes.push_back(h);
  return sheet(1360, 590, holes, detail, [](double u, double v) {
    const double fields = embossed({90, 330}, {370, 540}, 14, u, v) + embossed({940, 100}, {1240, 320}, 14, u, v) +
                          embossed({470, 430}, {880, 560}, 14, u, v);
    const double tunnel = smooth_step(430, 520, u) * smooth_step(890, 800, u) * smooth_step(300, 160, v);
    double beads = 0;
    for (const double bead : {140.0, 180.0, 220.0}) beads += embossed({120, bead}, {400, bead + 6}, 10, u, v);
    return Vec3(20 + u, 880 + 12 * fields + 20 * tunnel - 6 * beads, 50 + v);
  });
}

// u along y from 60, v along z from 60. The wheel arch bulges inwards, the upper edge turns out into a flange.
Mesh inner_fender(const Detail& detail) {
  std::vector<Hole> holes = {{{120, 180}, 22}, {{120, 300}, 14}, {{250, 420}, 18}, {{690, 500}, 16}};
  for (const Hole& h : hole_field({40, 500}, {360, 540}, detail.texture ? 6 : 2, 1, 9)) holes.push_back(h);
  return sheet(820, 600, holes, detail, [](double u, double v) {
    const double along = (u - 590) / 190, up = v / 400;  // an elliptic arch about y = 650
    const double arch = 100 * smooth_step(1.0, 0.72, std::sqrt(along * along + up * up));
    const double flange = 20 * smooth_step(565, 595, v);
    const double swage = 6 * embossed({60, 360}, {340, 372}, 12, u, v);
    return Vec3(20 + arch - flange + swage, 60 + u, 60 + v);
  });
}

Mesh strut_tower(const Detail& detail) {
  return placed(turned({{100, 250}, {97, 480}, {84, 545}, {40, 552}, {40, 560}}, detail, 12),
                facing({135, 650, 0}, Vec3::UnitZ()));
}

Mesh strut_bearing(const Detail& detail) {
  const Vec3 at(135, 650, 552);
  Mesh mesh = placed(turned({{0, 0}, {62, 0}, {62, 6}, {34, 18}, {24, 30}, {0, 30}}, detail, 3), facing(at, Vec3::UnitZ()));
  std::vector<Vec3> nuts;
  for (int k = 0; k < 3; ++k) {
    const double a = 2 * units::pi * k / 3 + 0.4;
    nuts.push_back(at + Vec3(48 * std::cos(a), 48 * std::sin(a), 8));
  }
  mesh.append(bolts(nuts, Vec3::UnitZ(), 8, detail));
  return mesh;
}

Mesh undertray(const Detail& detail) {
  std::vector<Hole> holes = hole_field({60, 60}, {300, 220}, detail.texture ? 4 : 2, detail.texture ? 3 : 1, 14);
  for (const Hole& h : hole_field({640, 500}, {900, 660}, detail.texture ? 5 : 2, detail.texture ? 3 : 1, 12)) holes.push_back(h);
  holes.push_back({{480, 300}, 40});
  return sheet(960, 740, holes, detail, [](double u, double v) {
    double beads = 0;
    for (int k = 0; k < 5; ++k) beads += embossed({360, 60.0 + 45 * k}, {420, 60.0 + 45 * k + 12}, 10, u, v);
    for (int k = 0; k < 4; ++k) beads += embossed({680, 80.0 + 80 * k}, {900, 80.0 + 80 * k + 14}, 14, u, v);
    const double basin = embossed({120, 330}, {400, 640}, 40, u, v);
    const double rim = smooth_step(18, 2, std::min({u, v, 960 - u, 740 - v}));
    return Vec3(220 + u, 100 + v, 24 + 8 * beads - 24 * basin + 18 * rim);
  });
}

// u along x from 100, v along y from 270.
Mesh battery_tray(const Detail& detail) {
  return sheet(235, 285, hole_field({30, 40}, {205, 245}, 3, 4, 10), detail, [](double u, double v) {
    const double rim = smooth_step(14, 2, std::min({u, v, 235 - u, 285 - v}));
    return Vec3(100 + u, 270 + v, 345 + 22 * rim);
  });
}

// u along x from 30, v over the curved rear edge of the bay.
Mesh cowl(const Detail& detail) {
  return sheet(1340, 130, hole_field({120, 30}, {1220, 100}, detail.texture ? 22 : 8, 2, 9), detail, [](double u, double v) {
    const double middle = (u - 670) / 670;
    return Vec3(30 + u, 900 - 0.72 * v, 640 + 44 * smooth_step(0, 110, v) + 16 * (1 - middle * middle));
  });
}

Mesh crossmember(const Detail& detail) {
  Mesh mesh = box({40, 15, 608}, {1360, 70, 648}, 9, detail);
  mesh.append(ribs({240, 68, 612}, {1160, 78, 644}, 0, 12, 5, detail));
  return mesh;
}

Mesh hood_latch(const Detail& detail) {
  Mesh mesh = box({672, 22, 646}, {728, 62, 664}, 4, detail);
  mesh.append(strap({{700, 30, 662}, {700, 30, 682}, {700, 56, 682}, {700, 56, 664}}, 10, 4, Vec3::UnitX(), detail));
  return mesh;
}

// From tower to tower over the rear of the engine.
Mesh tower_brace(const Detail& detail) {
  const Path line = rounded_path({{150, 650, 590}, {300, 652, 618}, {1100, 652, 618}, {1250, 650, 590}}, 90, detail);
  return sweep(line, rounded_rectangle(34, 16, 6, detail), Ends::capped, detail, Vec3::UnitZ());
}

}  // namespace

void add_structure(Parts& parts, const Detail& detail) {
  parts.sheet("firewall", firewall(detail));
  const Mesh fender = inner_fender(detail), tower = strut_tower(detail), bearing = strut_bearing(detail);
  parts.sheet("inner_fender_right", fender);
  parts.sheet("inner_fender_left", mirrored(fender, 700));
  parts.sheet("strut_tower_right", tower);
  parts.sheet("strut_tower_left", mirrored(tower, 700));
  parts.body("strut_bearing_right", bearing);
  parts.body("strut_bearing_left", mirrored(bearing, 700));
  parts.body("tower_brace", tower_brace(detail));
  const Mesh rail = together({box({150, 40, 255}, {215, 870, 335}, 10, detail),
                              ribs({213, 120, 262}, {220, 480, 328}, 1, 7, 5, detail)});
  parts.body("rail_right", rail);
  parts.body("rail_left", mirrored(rail, 700));
  parts.body("crossmember_lower", box({100, 20, 40}, {1300, 78, 108}, 12, detail));
  parts.body("crossmember_upper", crossmember(detail));
  parts.body("hood_latch", hood_latch(detail));
  parts.sheet("undertray", undertray(detail));
  parts.sheet("battery_tray", battery_tray(detail));
  parts.body("battery_tray_bracket",
             together({strap({{120, 300, 343}, {120, 300, 300}, {160, 300, 300}}, 30, 3, Vec3::UnitY(), detail),
                       strap({{120, 520, 343}, {120, 520, 300}, {160, 520, 300}}, 30, 3, Vec3::UnitY(), detail),
                       strap({{320, 400, 343}, {320, 400, 302}, {290, 400, 302}}, 40, 3, Vec3::UnitY(), detail)}));
  parts.sheet("cowl", cowl(detail));
}

}  // namespace tendril::engine_bay
