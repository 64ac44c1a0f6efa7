// What the engine breathes through: intake in front, exhaust behind.
#include "engine_bay/box.h"
#include "engine_bay/fastener.h"
#include "engine_bay/parts.h"
#include "engine_bay/sheet.h"

namespace tendril::engine_bay {
namespace {

double cylinder_axis(int k) { return 620 + 110.0 * k; }

Mesh plenum(const Detail& detail) {
  Mesh mesh = box({586, 246, 446}, {1000, 332, 524}, 30, detail);
  mesh.append(ribs({620, 250, 500}, {966, 328, 529}, 0, 9, 5, detail));
  return mesh;
}

// Down out of the plenum, back under it and up into the head.
Mesh intake_runner(double x, const Detail& detail) {
  const Path line = rounded_path({{x, 272, 462}, {x, 268, 400}, {x, 330, 392}, {x, 362, 476}, {x, 398, 476}}, 42, detail);
  Mesh mesh = sweep(line, circle(20, detail), Ends::capped, detail);
  mesh.append(placed(cylinder(24, 8, 1.5, detail), facing(line.back() - Vec3(0, 9, 0), Vec3::UnitY())));
  return mesh;
}

Mesh throttle_body(const Detail& detail) {
  Mesh mesh = placed(turned({{0, 0}, {44, 0}, {44, 8}, {37, 10}, {37, 46}, {0, 46}}, detail, 2), facing({999, 290, 482}, Vec3::UnitX()));
  mesh.append(box({1008, 318, 456}, {1042, 352, 508}, 6, detail));
  return mesh;
}

Mesh injector(double x, const Detail& detail) {
  return placed(turned({{0, 0}, {6, 0}, {6, 12}, {10, 14}, {10, 34}, {7, 36}, {7, 52}, {0, 52}}, detail, 1),
                facing({x, 392, 490}, Vec3(0, -0.62, 0.78).normalized()));
}

Mesh air_box_lid(const Detail& detail) {
  Mesh mesh = box({1136, 96, 404}, {1344, 324, 498}, 20, detail);
  mesh.append(box({1130, 90, 400}, {1350, 330, 410}, 3, detail));
  mesh.append(ribs({1160, 120, 490}, {1320, 300, 503}, 0, 6, 6, detail));
  return mesh;
}

Mesh air_box_clips(const Detail& detail) {
  Mesh mesh;
  for (const double x : {1180.0, 1240.0, 1300.0})
    for (const auto& [y, out] : {std::pair{90.0, -1.0}, std::pair{330.0, 1.0}})
      mesh.append(strap({{x, y, 420}, {x, y + out * 6, 416}, {x, y + out * 6, 392}, {x, y - out * 6, 384}}, 16, 2, Vec3::UnitX(), detail));
  return mesh;
}

Mesh exhaust_runner(int k, const Detail& detail) {
  const double x = cylinder_axis(k), end = 785 + 30 * (k - 1.5);
  const Path line = rounded_path({{x, 614, 466}, {x, 690, 466}, {(x + end) / 2, 740, 430}, {end, 762, 320}}, 52, detail);
  return sweep(line, circle(19, detail), Ends::capped, detail);
}

Mesh catalyst(const Detail& detail) {
  Mesh mesh = moved(turned({{0, 0}, {30, 0}, {30, 18}, {58, 44}, {58, 150}, {50, 172}, {72, 190}, {72, 222}, {0, 222}}, detail, 6),
                    {785, 762, 112});
  mesh.append(moved(turned({{58, 0}, {63, 0}, {63, 8}, {58, 8}, {58, 0}}, detail), {785, 762, 180}));
  return mesh;
}

// A dimpled sheet over the runners; u along x, v down its bent side.
Mesh heat_shield(const Detail& detail) {
  const double depth = detail.texture ? 1.6 : 0;
  const Detail smooth = detail.texture ? detail.with_edge(3) : detail;
  return sheet(420, 200, {{{60, 30}, 8}, {{360, 30}, 8}, {{210, 30}, 8}}, smooth, [=](double u, double v) {
    const double bend = smooth_step(60, 130, v);
    const double dimple = depth * std::sin(u * units::pi / 9) * std::sin(v * units::pi / 9);
    return Vec3(575 + u, 640 + v * (1 - 0.45 * bend) + dimple * bend, 508 - 0.55 * bend * (v - 60) + dimple);
  });
}

}  // namespace

void add_breathing(Parts& parts, const Detail& detail) {
  parts.body("intake_plenum", plenum(detail));
  parts.body("intake_flange", box({578, 386, 444}, {992, 397, 508}, 4, detail));
  parts.body("fuel_rail", together({round_bar({{596, 358, 534}, {976, 358, 534}}, 9, detail),
                                    placed(cylinder(14, 20, 3, detail), facing({576, 358, 534}, Vec3::UnitX()))}));
  for (int k = 0; k < 4; ++k) {
    const std::string number = std::to_string(k + 1);
    parts.body("intake_runner_" + number, intake_runner(cylinder_axis(k), detail));
    parts.body("injector_" + number, injector(cylinder_axis(k), detail));
    parts.body("exhaust_runner_" + number, exhaust_runner(k, detail));
  }
  parts.body("throttle_body", throttle_body(detail));
  parts.body("intake_duct", corrugated(rounded_path({{1044, 290, 482}, {1090, 290, 482}, {1140, 232, 462}}, 50, detail), 38, 5, 10, detail));
  parts.body("air_box", tapered_box({1140, 100, 298}, {1340, 320, 401}, 16, 10, detail));
  parts.body("air_box_lid", air_box_lid(detail));
  parts.body("air_box_clips", air_box_clips(detail));
  parts.body("intake_snorkel", sweep(rounded_path({{1240, 112, 450}, {1240, 60, 450}, {1240, 14, 490}}, 50, detail),
                                     rounded_rectangle(110, 46, 14, detail), Ends::capped, detail, Vec3::UnitZ()));
  parts.body("exhaust_flange", box({584, 614, 436}, {986, 626, 496}, 4, detail));
  parts.body("exhaust_catalyst", catalyst(detail));
  parts.body("exhaust_downpipe", round_bar(rounded_path({{785, 762, 118}, {785, 762, 78}, {785, 868, 72}}, 38, detail), 28, detail));
  parts.body("exhaust_probe", placed(turned({{0, 0}, {8, 0}, {8, 14}, {12, 16}, {12, 26}, {7, 28}, {7, 60}, {0, 60}}, detail, 1),
                                    facing({840, 770, 232}, Vec3(1, 0.3, 0.35).normalized())));
  parts.sheet("exhaust_heat_shield", heat_shield(detail));
}

}  // namespace tendril::engine_bay
