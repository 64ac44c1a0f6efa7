// The engine: a ribbed block of four cylinders with head, covers and pan, mounted across the car.
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/parts.h"

namespace tendril::engine_bay {
namespace {

double cylinder_axis(int k) { return 620 + 110.0 * k; }  // x of cylinder k = 0 ... 3

Mesh block(const Detail& detail) {
  Mesh mesh = box({560, 400, 130}, {1010, 620, 419}, 9, detail);
  for (int k = 0; k < 4; ++k)
    for (const double y : {414.0, 606.0})  // the water jackets bulge out of both sides
      mesh.append(moved(cylinder(47, 200, 10, detail), {cylinder_axis(k), y, 212}));
  for (const auto& [near, far] : {std::pair{386.0, 404.0}, std::pair{616.0, 634.0}}) {
    mesh.append(ribs({566, near, 134}, {1004, far, 205}, 0, 12, 7, detail));
    mesh.append(box({562, near - 2, 198}, {1008, far + 2, 208}, 3, detail));
    mesh.append(box({562, near, 406}, {1008, far, 418}, 3, detail));
  }
  mesh.append(placed(cylinder(22, 12, 2, detail), facing({590, 400, 300}, -Vec3::UnitY())));
  mesh.append(placed(cylinder(22, 12, 2, detail), facing({690, 400, 170}, -Vec3::UnitY())));
  return mesh;
}

Mesh head(const Detail& detail) {
  Mesh mesh = box({550, 405, 423}, {1020, 615, 519}, 7, detail);
  for (int k = 0; k < 4; ++k) {
    mesh.append(placed(cylinder(30, 14, 3, detail), facing({cylinder_axis(k), 406, 476}, -Vec3::UnitY())));
    mesh.append(placed(cylinder(28, 12, 3, detail), facing({cylinder_axis(k), 613, 466}, Vec3::UnitY())));
  }
  for (int k = 0; k < 5; ++k) mesh.append(box({563.0 + 110 * k, 396, 430}, {577.0 + 110 * k, 410, 512}, 4, detail));
  return mesh;
}

Mesh valve_cover(const Detail& detail) {
  Mesh mesh = box({558, 422, 518}, {1012, 598, 527}, 3, detail);
  mesh.append(box({574, 440, 510}, {996, 580, 572}, 16, detail));
  mesh.append(ribs({590, 446, 560}, {980, 466, 577}, 0, 14, 6, detail));
  mesh.append(ribs({590, 554, 560}, {980, 574, 577}, 0, 14, 6, detail));
  for (int k = 0; k < 4; ++k) mesh.append(moved(cylinder(26, 12, 3, detail), {cylinder_axis(k), 510, 566}));
  return mesh;
}

Mesh oil_pan(const Detail& detail) {
  Mesh mesh = box({564, 402, 122}, {1006, 618, 131}, 3, detail);
  mesh.append(tapered_box({576, 414, 52}, {994, 606, 126}, 16, 26, detail));
  mesh.append(ribs({640, 440, 46}, {930, 580, 60}, 1, 8, 5, detail));
  mesh.append(placed(bolt(16, detail), facing({700, 510, 53}, -Vec3::UnitZ())));
  return mesh;
}

Mesh timing_cover(const Detail& detail) {
  Mesh mesh = box({1011, 398, 92}, {1040, 618, 546}, 12, detail);
  mesh.append(ribs({1036, 412, 430}, {1046, 604, 535}, 1, 9, 5, detail));
  mesh.append(box({1036, 410, 424}, {1046, 606, 431}, 2, detail));
  for (const auto& [y, z, r] : {std::tuple{510.0, 160.0, 46.0}, std::tuple{545.0, 380.0, 40.0}, std::tuple{430.0, 420.0, 24.0}})
    mesh.append(placed(cylinder(r, 16, 3, detail), facing({1034, y, z}, Vec3::UnitX())));
  return mesh;
}

Mesh ignition_coil(double x, const Detail& detail) {
  Mesh mesh = moved(turned({{0, 0}, {17, 0}, {17, 14}, {12, 20}, {0, 20}}, detail, 2), {x, 510, 577});
  mesh.append(box({x - 14, 512, 590}, {x + 14, 552, 606}, 4, detail));
  mesh.append(box({x - 9, 546, 592}, {x + 9, 566, 604}, 2, detail));
  return mesh;
}

Mesh oil_filler_cap(const Detail& detail) {
  Mesh mesh = moved(turned({{0, 0}, {21, 0}, {21, 10}, {27, 11}, {27, 22}, {0, 24}}, detail, 2), {970, 510, 570});
  for (int k = 0; detail.texture && k < 12; ++k) {
    const double a = units::pi / 6 * k;
    mesh.append(moved(cylinder(3, 12, 1, detail), {970 + 26.5 * std::cos(a), 510 + 26.5 * std::sin(a), 581}));
  }
  return mesh;
}

Mesh dipstick(const Detail& detail) {
  Mesh mesh = round_bar(rounded_path({{900, 380, 150}, {900, 372, 330}, {885, 365, 420}, {885, 352, 548}}, 60, detail), 5, detail);
  const Path loop = rounded_path({{885, 352, 546}, {885, 340, 575}, {885, 364, 582}, {885, 354, 548}}, 8, detail);
  mesh.append(round_bar(loop, 3, detail));
  return mesh;
}

Mesh oil_filter(const Detail& detail) {
  return placed(turned({{0, 0}, {36, 0}, {38, 8}, {38, 70}, {30, 82}, {0, 84}}, detail, 5), facing({780, 400, 165}, -Vec3::UnitY()));
}

}  // namespace

void add_engine(Parts& parts, const Detail& detail) {
  parts.body("engine_block", block(detail));
  parts.body("head_gasket", box({556, 402, 418}, {1014, 618, 424}, 1, detail));
  parts.body("cylinder_head", head(detail));
  parts.body("valve_cover", valve_cover(detail));
  parts.body("oil_pan", oil_pan(detail));
  parts.body("timing_cover", timing_cover(detail));
  parts.body("oil_filler_cap", oil_filler_cap(detail));
  parts.body("dipstick", dipstick(detail));
  parts.body("oil_filter", oil_filter(detail));
  for (int k = 0; k < 4; ++k) parts.body("ignition_coil_" + std::to_string(k + 1), ignition_coil(cylinder_axis(k), detail));
}

}  // namespace tendril::engine_bay
